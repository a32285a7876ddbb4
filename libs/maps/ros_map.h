// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "maps/grid_map.h"
#include "maps/image_file.h"

namespace sidestep {

/// What a map.yaml of ROS says.
struct RosMapHeader {
  std::string image;  ///< path, the folder of the yaml before it unless it is absolute
  double resolution_m = 0;
  mrpt::math::TPose2D origin;  ///< T_map_corner, of the lower left pixel's corner
  double occupied_thresh = 0.65, free_thresh = 0.196;
  bool negate = false;
  std::string mode = "trinary";  ///< or scale, raw
};

/// @throws DatasetError, `file: what is wrong with which key`.
RosMapHeader readRosMapHeader(const std::string& yaml_file);

/// The grid of an image, as ROS's map_server reads it; cells of unknown state get probability 0.5.
GridMap gridOfImage(const GreyImage& image, const RosMapHeader& header);

}  // namespace sidestep
