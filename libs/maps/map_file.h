// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "maps/grid_map.h"

namespace sidestep {

/// What some kinds of map files do not say themselves.
struct MapReadParams {
  double image_resolution_m = 0;         ///< of plain images; 0 = not known
  double simplemap_resolution_m = 0.05;  ///< of the grid made from the scans of a .simplemap

  void visit(ParamVisitor& v);
};

/// Reads a map; the name's ending says of which kind:
/// - .yaml, .yml: of ROS's map_server, with image (pgm, png, bmp), resolution, origin (x, y, yaw), occupied_thresh,
///   free_thresh, negate, and mode trinary (default), scale or raw; the turn of the origin is kept (`T_map_grid`);
/// - .gridmap, .gridmap.gz: MRPT's occupancy grid; .simplemap, .simplemap.gz: MRPT's scans with poses, laid on a grid;
/// - .pgm, .png, .bmp: a plain image, white free, black occupied; needs `image_resolution_m`; lower left corner at (0,
/// 0). Sizes that the headers name are believed only as far as the file can hold them.
/// @throws DatasetError missing or corrupt, ConfigError for an unknown ending or a missing resolution; one line each.
GridMap readMap(const std::string& file, const MapReadParams& params = {});

/// Whether the name is that of a .pgm, .png or .bmp, which does not say how large its pixels are.
bool isPlainImage(const std::string& file);

/// Writes NAME.yaml and NAME.pgm, trinary: occupied from 0.65 on, free below 0.196, else unknown.
/// @param yaml_file  must end in .yaml
/// @throws DatasetError if it does not reach the disk, ConfigError for another ending.
void writeRosMap(const GridMap& map, const std::string& yaml_file);

/// Writes MRPT's .gridmap, gzip if the name ends in .gz.
/// @throws DatasetError if it does not reach the disk, ConfigError if the map is turned, or its
///         corner is no whole number of cells from (0, 0): MRPT's reader cannot take either.
void writeGridmap(const GridMap& map, const std::string& file);

}  // namespace sidestep
