// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_file.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/errors.h"
#include "core/process_limits.h"
#include "maps/image_file.h"
#include "maps/ros_map.h"

namespace sidestep {
namespace {

using mrpt::maps::COccupancyGridMap2D;

constexpr size_t kMostBytes = 1u << 29;       ///< of a map once unpacked
constexpr size_t kDecodeMemory = 2ull << 30;  ///< what decoding scans may take on top of what we have
constexpr double kDecodeSeconds = 60;         ///< of CPU time

/// The file's bytes, unpacked if it is gzip.
std::string unpacked(const std::string& file) {
  if (readBytes(file, "a map").empty()) throw DatasetError::corrupt(file + ": is empty");
  std::string out;
  gzFile gz = gzopen(file.c_str(), "rb");
  if (gz == nullptr) throw DatasetError::missing(file + ": a map cannot be read");
  std::vector<char> part(1 << 20);
  int got = 0;
  while ((got = gzread(gz, part.data(), static_cast<unsigned>(part.size()))) > 0 && out.size() <= kMostBytes)
    out.append(part.data(), static_cast<size_t>(got));
  int error = Z_OK;
  gzerror(gz, &error);
  gzclose_r(gz);
  if (out.size() > kMostBytes)
    throw DatasetError::corrupt(file + ": unpacks to more than 512 MiB, too large for a map");
  if (got < 0 || error != Z_OK) throw DatasetError::corrupt(file + ": its compression is damaged or cut short");
  return out;
}

/// Length of "class name and version" at the start, if the name ends in `name`; else 0. New archives start with the
/// length and the top bit set, old ones with the length in four bytes.
size_t classHeader(const std::string& bytes, const std::string& name) {
  if (bytes.size() < 6) return 0;
  const auto first = static_cast<uint8_t>(bytes[0]);
  const size_t start = (first & 0x80) != 0 ? 1 : 4, length = first & 0x7f;
  if (bytes.size() < start + length + 1 || !bytes.substr(start, length).ends_with(name)) return 0;
  return start + length + 1;
}

void registerClasses() {
  static const bool done = [] {
    mrpt::obs::registerAllClasses_mrpt_obs();
    mrpt::maps::registerAllClasses_mrpt_maps();
    return true;
  }();
  (void)done;
}

template <typename Map>
void decode(const std::string& bytes, Map& out) {
  mrpt::io::CMemoryStream stream;
  stream.assignMemoryNotOwn(bytes.data(), bytes.size());
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive.ReadObject(&out);
}

/// The sizes at the start of a grid, before MRPT takes memory for them.
void checkGridHeader(const std::string& file, const std::string& bytes) {
  const size_t at = classHeader(bytes, "OccupancyGridMap2D");
  if (at == 0 || bytes.size() < at + 29) throw DatasetError::corrupt(file + ": is no occupancy grid of MRPT's");
  const auto version = static_cast<uint8_t>(bytes[at - 1]);
  const size_t sizes = at + (version >= 2 ? 1 : 0);
  uint32_t size_x = 0, size_y = 0;
  std::memcpy(&size_x, &bytes[sizes], 4);
  std::memcpy(&size_y, &bytes[sizes + 4], 4);
  if (size_x == 0 || size_y == 0) throw DatasetError::corrupt(file + ": the grid has no cells");
  if (static_cast<uint64_t>(size_x) * size_y > bytes.size())
    throw DatasetError::corrupt(file + ": its header claims " + std::to_string(size_x) + " x " +
                                std::to_string(size_y) + " cells, which its " + std::to_string(bytes.size()) +
                                " bytes cannot hold; it is cut short or damaged");
}

GridMap readGridmap(const std::string& file) {
  const std::string bytes = unpacked(file);
  checkGridHeader(file, bytes);
  registerClasses();
  GridMap map{std::make_shared<COccupancyGridMap2D>(), {}};
  try {
    decode(bytes, *map.grid);
  } catch (const std::exception&) {
    throw DatasetError::corrupt(file + ": the grid does not decode; it is cut short or damaged");
  }
  const double r = map.grid->getResolution();
  if (!(r > 0) || !std::isfinite(r)) throw DatasetError::corrupt(file + ": the grid's resolution is not positive");
  for (const float v : {map.grid->getXMin(), map.grid->getXMax(), map.grid->getYMin(), map.grid->getYMax()})
    if (!std::isfinite(v)) throw DatasetError::corrupt(file + ": the grid's extent is not finite");
  if (map.grid->getRawMap().size() < static_cast<size_t>(map.grid->getSizeX()) * map.grid->getSizeY())
    throw DatasetError::corrupt(file + ": the grid has fewer cells than its header says; it is damaged");
  return map;
}

/// Whether a child process with little memory survives decoding: MRPT believes all lengths inside of scans.
bool survivesDecoding(const std::string& bytes) {
  const pid_t child = fork();
  if (child == 0) {
    limitMemory(kDecodeMemory);
    limitCpuTime(kDecodeSeconds);
    try {
      mrpt::maps::CSimpleMap map;
      decode(bytes, map);
      _exit(0);
    } catch (...) {
      _exit(1);
    }
  }
  int status = 1;
  if (child < 0 || waitpid(child, &status, 0) != child) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Occupied, unknown, free as grey values, by the thresholds that writeRosMap writes; the top row first.
GreyImage greyOf(const GridMap& map) {
  const GridFrame frame = map.frame();
  GreyImage out{frame.width, frame.height, {}, {}};
  for (int row = frame.height - 1; row >= 0; --row)
    for (int column = 0; column < frame.width; ++column) {
      const float free = map.grid->getCell(column, row);
      out.grey.push_back(free < 0.35F ? 0 : (free > 0.804F ? 254 : 205));
    }
  return out;
}

GridMap readSimplemap(const std::string& file, double resolution_m) {
  const std::string bytes = unpacked(file);
  registerClasses();
  const bool known = classHeader(bytes, "CSimpleMap") != 0 || classHeader(bytes, "CSensFrameProbSequence") != 0;
  if (!known) throw DatasetError::corrupt(file + ": is no simplemap of MRPT's");
  if (!survivesDecoding(bytes))
    throw DatasetError::corrupt(file + ": the simplemap does not decode; it is cut short or damaged");
  mrpt::maps::CSimpleMap scans;
  decode(bytes, scans);
  if (scans.size() == 0) throw DatasetError::corrupt(file + ": the simplemap holds no scans");
  GridMap map{std::make_shared<COccupancyGridMap2D>(-1, 1, -1, 1, static_cast<float>(resolution_m)), {}};
  map.grid->loadFromSimpleMap(scans);
  return map;
}

GridMap readPlainImage(const std::string& file, double resolution_m) {
  if (!(resolution_m > 0))
    throw ConfigError(file + ": a plain image does not say how large a pixel is; give its resolution in metres");
  RosMapHeader header;
  header.image = file;
  header.resolution_m = resolution_m;
  return gridOfImage(readImage(file), header);
}

/// MRPT keeps lengths as floats; so many digits give the same one back.
std::string shortFloat(float value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

bool endsWith(const std::string& file, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(), [&](const char* e) { return file.ends_with(e); });
}

}  // namespace

void MapReadParams::visit(ParamVisitor& v) {
  v.number("image_resolution_m", image_resolution_m, {0, 100}, "m", "side of a pixel of a plain image; 0 = not known");
  v.number("simplemap_resolution_m", simplemap_resolution_m, {0.005, 10}, "m",
           "side of a cell of the grid made from a simplemap");
}

bool isPlainImage(const std::string& file) { return endsWith(file, {".pgm", ".png", ".bmp"}); }

GridMap readMap(const std::string& file, const MapReadParams& params) {
  if (endsWith(file, {".yaml", ".yml"})) {
    const auto header = readRosMapHeader(file);
    if (!std::filesystem::exists(header.image))
      throw DatasetError::missing(file + ": its image " + header.image + " is not there");
    return gridOfImage(readImage(header.image), header);
  }
  if (endsWith(file, {".gridmap", ".gridmap.gz"})) return readGridmap(file);
  if (endsWith(file, {".simplemap", ".simplemap.gz"})) return readSimplemap(file, params.simplemap_resolution_m);
  if (isPlainImage(file)) return readPlainImage(file, params.image_resolution_m);
  throw ConfigError(file +
                    ": is no kind of map that is known; allowed .yaml, .gridmap(.gz), .simplemap(.gz), .pgm, .png, "
                    ".bmp");
}

void writeRosMap(const GridMap& map, const std::string& yaml_file) {
  if (!yaml_file.ends_with(".yaml")) throw ConfigError(yaml_file + ": the name of a ROS map must end in .yaml");
  const std::filesystem::path image = std::filesystem::path(yaml_file).replace_extension(".pgm");
  writePgm(greyOf(map), image.string());
  std::ofstream yaml(yaml_file, std::ios::binary);
  const auto T = map.frame().T_map_grid;
  yaml << "image: " << image.filename().string() << "\nresolution: " << shortFloat(map.grid->getResolution())
       << "\norigin: [" << shortFloat(static_cast<float>(T.x)) << ", " << shortFloat(static_cast<float>(T.y)) << ", "
       << shortestNumber(T.phi) << "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n";
  yaml.close();
  if (!yaml) throw DatasetError::missing(yaml_file + ": cannot be written; check folder and disk");
}

void writeGridmap(const GridMap& map, const std::string& file) {
  if (map.T_map_grid != mrpt::math::TPose2D())
    throw ConfigError(file + ": a .gridmap cannot hold a map that is turned; write a .yaml");
  for (const float corner : {map.grid->getXMin(), map.grid->getYMin()}) {
    const double cells = static_cast<double>(corner) / static_cast<double>(map.grid->getResolution());
    if (std::abs(cells - std::round(cells)) > 1e-3)
      throw ConfigError(file + ": a .gridmap cannot hold a map whose corner lies between cells; write a .yaml");
  }
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << *map.grid;
  const bool packed = file.ends_with(".gz");
  gzFile gz = gzopen(file.c_str(), packed ? "wb1" : "wbT");
  const auto size = static_cast<unsigned>(stream.getTotalBytesCount());
  const bool written = gz != nullptr && gzwrite(gz, stream.getRawBufferData(), size) == static_cast<int>(size);
  const bool closed = gz != nullptr && gzclose_w(gz) == Z_OK;
  if (!written || !closed) throw DatasetError::missing(file + ": cannot be written; check folder and disk");
}

}  // namespace sidestep
