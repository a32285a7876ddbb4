// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/ros_map.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "core/errors.h"
#include "maps/map_file.h"

namespace sidestep {
namespace {

/// MRPT moves the corner of a grid to a whole number of cells; this one stays where the map says.
class PlacedGrid final : public mrpt::maps::COccupancyGridMap2D {
 public:
  PlacedGrid(int width, int height, float resolution_m, float x, float y) {
    const auto span = [&](int cells) { return resolution_m * static_cast<float>(cells); };
    setSize(0, span(width), 0, span(height), resolution_m);
    m_xMin = x, m_xMax = x + span(width);
    m_yMin = y, m_yMax = y + span(height);
  }
};

/// Reads keys of one file and complains by name.
class Header {
 public:
  explicit Header(const std::string& file) : file_(file) {
    try {
      root_ = YAML::Load(readBytes(file, "a map"));
    } catch (const YAML::Exception& e) {
      throw DatasetError::corrupt(file + ":" + std::to_string(e.mark.line + 1) + ": is no YAML: " + e.msg);
    }
    if (!root_.IsMap()) fail("holds no keys; a map needs image, resolution and origin");
  }

  [[noreturn]] void fail(const std::string& what) const { throw DatasetError::corrupt(file_ + ": " + what); }

  template <typename T>
  std::optional<T> optional(const std::string& key, const char* kind) const {
    const auto node = root_[key];
    if (!node) return std::nullopt;
    try {
      return node.as<T>();
    } catch (const YAML::Exception&) {
      fail(key + " must be " + kind);
    }
  }
  template <typename T>
  T required(const std::string& key, const char* kind) const {
    auto value = optional<T>(key, kind);
    if (value) return *value;
    std::vector<std::string> words;
    for (const auto& entry : root_) words.push_back(entry.first.as<std::string>());
    const auto near = nearestWord(key, words);
    fail("lacks " + key + (near.empty() ? "" : " (is '" + near + "' meant?)"));
  }

 private:
  std::string file_;
  YAML::Node root_;
};

bool readNegate(const Header& h) {
  const auto text = h.optional<std::string>("negate", "0 or 1").value_or("0");
  if (text == "1" || text == "true" || text == "True") return true;
  if (text == "0" || text == "false" || text == "False") return false;
  h.fail("negate = " + text + ", allowed 0, 1");
}

mrpt::math::TPose2D readOrigin(const Header& h) {
  const auto origin = h.required<std::vector<double>>("origin", "three numbers [x, y, yaw]");
  if (origin.size() != 3 || !std::all_of(origin.begin(), origin.end(), [](double v) { return std::isfinite(v); }))
    h.fail("origin must be three numbers [x, y, yaw]");
  return {origin[0], origin[1], origin[2]};
}

void check(const RosMapHeader& m, const Header& h) {
  if (!(m.resolution_m > 0) || !std::isfinite(m.resolution_m))
    h.fail("resolution = " + shortestNumber(m.resolution_m) + ", must be a positive number of metres a pixel");
  for (const double t : {m.occupied_thresh, m.free_thresh})
    if (!(t >= 0 && t <= 1)) h.fail("occupied_thresh and free_thresh must be between 0 and 1");
  if (m.free_thresh > m.occupied_thresh)
    h.fail("free_thresh = " + shortestNumber(m.free_thresh) +
           " lies above occupied_thresh = " + shortestNumber(m.occupied_thresh) + "; exchange them");
  const std::vector<std::string> modes = {"trinary", "scale", "raw"};
  if (std::find(modes.begin(), modes.end(), m.mode) == modes.end()) {
    const auto near = nearestWord(m.mode, modes);
    h.fail("mode = " + m.mode + ", allowed trinary, scale, raw" +
           (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
}

/// Probability of being occupied, for each grey value; 0.5 = unknown. As map_server: raw pixels are percent, and above
/// 100 unknown; in scale mode what lies between the thresholds is spread over 0 .. 1.
std::array<double, 256> occupancyOfGrey(const RosMapHeader& m) {
  std::array<double, 256> out{};
  for (size_t grey = 0; grey < out.size(); ++grey) {
    const double value = static_cast<double>(grey), p = (m.negate ? value : 255 - value) / 255;
    double& occupied = out[grey];
    if (m.mode == "raw")
      occupied = value <= 100 ? value / 100 : 0.5;
    else if (p > m.occupied_thresh)
      occupied = 1;
    else if (p < m.free_thresh)
      occupied = 0;
    else
      occupied = m.mode == "scale" ? (p - m.free_thresh) / std::max(1e-9, m.occupied_thresh - m.free_thresh) : 0.5;
  }
  return out;
}

}  // namespace

RosMapHeader readRosMapHeader(const std::string& yaml_file) {
  const Header h(yaml_file);
  RosMapHeader m;
  const std::filesystem::path image = h.required<std::string>("image", "the name of a file");
  m.image = (std::filesystem::path(yaml_file).parent_path() / image).string();
  m.resolution_m = h.required<double>("resolution", "a number");
  m.origin = readOrigin(h);
  m.occupied_thresh = h.optional<double>("occupied_thresh", "a number").value_or(m.occupied_thresh);
  m.free_thresh = h.optional<double>("free_thresh", "a number").value_or(m.free_thresh);
  m.negate = readNegate(h);
  m.mode = h.optional<std::string>("mode", "a word").value_or(m.mode);
  check(m, h);
  return m;
}

namespace {

/// MRPT rounds the size that a grid is asked for.
void requireSize(const mrpt::maps::COccupancyGridMap2D& grid, const GreyImage& image, const std::string& file) {
  if (static_cast<int>(grid.getSizeX()) == image.width && static_cast<int>(grid.getSizeY()) == image.height) return;
  throw DatasetError::corrupt(file + ": " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                              " pixels do not fit a grid of this resolution");
}

}  // namespace

GridMap gridOfImage(const GreyImage& image, const RosMapHeader& header) {
  const bool turned = header.origin.phi != 0;
  const mrpt::math::TPose2D corner = turned ? mrpt::math::TPose2D() : header.origin;
  GridMap map{std::make_shared<PlacedGrid>(image.width, image.height, static_cast<float>(header.resolution_m),
                                           static_cast<float>(corner.x), static_cast<float>(corner.y)),
              turned ? header.origin : mrpt::math::TPose2D()};
  requireSize(*map.grid, image, header.image);
  const auto occupied = occupancyOfGrey(header);
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const auto i = static_cast<size_t>(row) * static_cast<size_t>(image.width) + static_cast<size_t>(column);
      const bool hidden = header.mode == "scale" && !image.transparent.empty() && image.transparent[i];
      const double p = hidden ? 0.5 : occupied[image.grey[i]];
      map.grid->setCell(column, image.height - 1 - row, static_cast<float>(1 - p));
    }
  return map;
}

}  // namespace sidestep
