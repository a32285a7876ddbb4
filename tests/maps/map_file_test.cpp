// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_file.h"

#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <zlib.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "core/errors.h"
#include "support/run_program.h"

namespace sidestep::testing {
namespace {

const std::string kDatasets = "/usr/share/mrpt/datasets/";

class MapFile : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& bytes) const { writeFile(folder_ / name, bytes); }
  /// A pgm of 3 x 2 pixels, the upper row first.
  void writeImage(const std::string& name, const std::vector<int>& pixels) const {
    std::string bytes = "P5\n# by hand\n3 2\n255\n";
    for (const int p : pixels) bytes += static_cast<char>(p);
    write(name, bytes);
  }
  void writeYaml(const std::string& more) const {
    write("m.yaml",
          "image: m.pgm\nresolution: 0.1\norigin: [1, 2, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.2\n" + more);
  }
  /// Probability of being occupied.
  static double occupied(const GridMap& map, int ix, int iy) {
    return 1 - static_cast<double>(map.grid->getCell(ix, iy));
  }
  std::pair<ExitCode, std::string> failure(const std::string& name, const MapReadParams& params = {}) const {
    try {
      readMap(file(name), params);
    } catch (const Error& e) {
      std::string line = e.what();
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
      for (size_t at; (at = line.find(folder_.path().string() + "/")) != std::string::npos;)
        line.erase(at, folder_.path().string().size() + 1);
      return {e.code(), line};
    }
    return {ExitCode::kDone, ""};
  }
  void expectFailure(const std::string& name, ExitCode code, const std::string& line) const {
    const auto [c, text] = failure(name);
    EXPECT_EQ(static_cast<int>(c), static_cast<int>(code)) << text;
    EXPECT_EQ(text, line);
  }
  void pack(const std::string& name, const std::string& bytes) const {
    gzFile gz = gzopen(file(name).c_str(), "wb");
    gzwrite(gz, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(gz);
  }
  TemporaryFolder folder_;
};

TEST_F(MapFile, TrinaryCellsAreFreeOccupiedOrUnknownAndTheLowerRowIsFirst) {
  writeImage("m.pgm", {254, 0, 205, 100, 255, 60});  // p = 0.004, 1, 0.196 | 0.608, 0, 0.765
  writeYaml("negate: 0\n");
  const auto map = readMap(file("m.yaml"));
  const auto frame = map.frame();
  EXPECT_EQ(frame.width, 3);
  EXPECT_EQ(frame.height, 2);
  EXPECT_NEAR(frame.T_map_grid.x, 1, 1e-6);
  EXPECT_NEAR(frame.T_map_grid.y, 2, 1e-6);
  EXPECT_EQ(map.T_map_grid, mrpt::math::TPose2D());
  const double expected[2][3] = {{0.5, 0, 1}, {0, 1, 0}};
  for (int iy = 0; iy < 2; ++iy)
    for (int ix = 0; ix < 3; ++ix) EXPECT_NEAR(occupied(map, ix, iy), expected[iy][ix], 0.02) << ix << " " << iy;
  EXPECT_EQ(blockedCells(map), (std::vector<uint8_t>{1, 0, 1, 0, 1, 0}));
  EXPECT_EQ(blockedCells(map, {.unknown_blocks = false}), (std::vector<uint8_t>{0, 0, 1, 0, 1, 0}));
}

TEST_F(MapFile, NegateTurnsBlackIntoFree) {
  writeImage("m.pgm", {0, 255, 0, 0, 0, 0});
  writeYaml("negate: 1\n");
  EXPECT_EQ(blockedCells(readMap(file("m.yaml"))), (std::vector<uint8_t>{0, 0, 0, 0, 1, 0}));
}

TEST_F(MapFile, ScaleSpreadsWhatLiesBetweenTheThresholds) {
  writeImage("m.pgm", {255, 0, 147, 204, 147, 147});  // 147: p = 0.4235, (0.4235 - 0.2) / 0.45 = 0.497; 204: p = 0.2
  writeYaml("mode: scale\n");
  const auto map = readMap(file("m.yaml"));
  EXPECT_NEAR(occupied(map, 0, 1), 0, 0.02);
  EXPECT_NEAR(occupied(map, 1, 1), 1, 0.02);
  EXPECT_NEAR(occupied(map, 2, 1), 0.497, 0.02);
  EXPECT_NEAR(occupied(map, 0, 0), 0, 0.02);
}

TEST_F(MapFile, RawPixelsArePercentAndAboveAHundredUnknown) {
  writeImage("m.pgm", {0, 100, 30, 101, 255, 80});
  writeYaml("mode: raw\n");
  const auto map = readMap(file("m.yaml"));
  const double expected[2][3] = {{0.5, 0.5, 0.8}, {0, 1, 0.3}};
  for (int iy = 0; iy < 2; ++iy)
    for (int ix = 0; ix < 3; ++ix) EXPECT_NEAR(occupied(map, ix, iy), expected[iy][ix], 0.02) << ix << " " << iy;
}

TEST_F(MapFile, TheTurnOfTheOriginIsKept) {
  writeImage("m.pgm", {255, 255, 255, 255, 0, 255});
  write("m.yaml", "image: m.pgm\nresolution: 0.1\norigin: [1.02, 2, 1.5707963267948966]\n");
  const auto map = readMap(file("m.yaml"));
  const auto field = distanceField(map);
  // The blocked cell's centre is (0.15, 0.05) from the corner, a quarter turn makes it (-0.05, 0.15).
  EXPECT_NEAR(field.clearance(0.97, 2.15), 0, 1e-6);
  EXPECT_NEAR(field.clearance(0.97, 2.05), 0.1, 1e-6);
  EXPECT_NEAR(map.T_map_grid.phi, M_PI / 2, 1e-12);
}

TEST_F(MapFile, AnOriginThatIsNoWholeNumberOfCellsStaysWhereItIs) {
  writeImage("m.pgm", {255, 255, 255, 255, 255, 255});
  write("m.yaml", "image: m.pgm\nresolution: 0.05\norigin: [-51.224998, -51.224998, 0.0]\n");
  EXPECT_NEAR(readMap(file("m.yaml")).frame().T_map_grid.x, -51.224998, 4e-6);
  EXPECT_EQ(readMap(file("m.yaml")).frame().width, 3);
}

TEST_F(MapFile, APngWithColoursAndTransparencyIsAveraged) {
  cv::Mat image(2, 3, CV_8UC4, cv::Scalar(255, 255, 255, 255));
  image.at<cv::Vec4b>(0, 0) = {0, 0, 0, 255};
  image.at<cv::Vec4b>(0, 1) = {255, 255, 255, 0};
  cv::imwrite(file("m.png"), image);
  write("m.yaml", "image: " + file("m.png") + "\nresolution: 0.1\norigin: [0, 0, 0]\nmode: scale\n");
  EXPECT_EQ(blockedCells(readMap(file("m.yaml"))), (std::vector<uint8_t>{0, 0, 0, 1, 1, 0}));
  EXPECT_EQ(blockedCells(readMap(file("m.png"), {.image_resolution_m = 0.2})),
            (std::vector<uint8_t>{0, 0, 0, 1, 0, 0}));
}

TEST_F(MapFile, WhatIsWrittenReadsBackTheSame) {
  writeImage("m.pgm", {254, 0, 205, 205, 254, 0});
  for (const char* origin : {"-1.25, 2.05, 0", "-1.225, 2.05, 0", "-1.225, 2.01, 0.3"}) {
    write("m.yaml", std::string("image: m.pgm\nresolution: 0.05\norigin: [") + origin + "]\n");
    const auto map = readMap(file("m.yaml"));
    writeRosMap(map, file("copy.yaml"));
    const auto copy = readMap(file("copy.yaml"));
    EXPECT_EQ(copy.grid->getRawMap(), map.grid->getRawMap());
    EXPECT_NEAR(copy.frame().T_map_grid.x, map.frame().T_map_grid.x, 1e-7);
    EXPECT_EQ(copy.frame().T_map_grid.phi, map.frame().T_map_grid.phi);
    EXPECT_EQ(copy.frame().resolution_m, map.frame().resolution_m);
    if (std::string(origin) != "-1.25, 2.05, 0") {
      EXPECT_THROW(writeGridmap(map, file("copy.gridmap")), ConfigError);
      continue;
    }
    for (const char* name : {"copy.gridmap", "copy.gridmap.gz"}) {
      writeGridmap(map, file(name));
      const auto again = readMap(file(name));
      EXPECT_EQ(again.grid->getRawMap(), map.grid->getRawMap());
      EXPECT_EQ(again.frame().T_map_grid, map.frame().T_map_grid);
    }
  }
}

TEST_F(MapFile, MrptsGridsAndScansAreRead) {
  const auto grid = readMap(kDatasets + "2006-MalagaCampus.gridmap.gz").frame();
  EXPECT_EQ(grid.width, 1888);
  EXPECT_EQ(grid.height, 2738);
  EXPECT_NEAR(grid.resolution_m, 0.08, 1e-8);
  const auto scans = readMap(kDatasets + "localization_demo.simplemap.gz", {.simplemap_resolution_m = 0.1});
  EXPECT_NEAR(scans.frame().resolution_m, 0.1, 1e-8);
  const auto blocked = blockedCells(scans);
  EXPECT_GT(std::count(blocked.begin(), blocked.end(), 0), 10000);
}

TEST_F(MapFile, WhatIsMissingIsNamed) {
  expectFailure("none.yaml", ExitCode::kInputMissing, "none.yaml: a map cannot be read; check the name");
  write("m.yaml", "image: none.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n");
  expectFailure("m.yaml", ExitCode::kInputMissing, "m.yaml: its image none.pgm is not there");
  write("m.yaml", "image: m.pgm\nresolutoin: 0.1\norigin: [0, 0, 0]\n");
  expectFailure("m.yaml", ExitCode::kInputCorrupt, "m.yaml: lacks resolution (is 'resolutoin' meant?)");
  expectFailure(
      "map.tif", ExitCode::kUsage,
      "map.tif: is no kind of map that is known; allowed .yaml, .gridmap(.gz), .simplemap(.gz), .pgm, .png, .bmp");
}

TEST_F(MapFile, BadValuesInTheYamlAreNamed) {
  writeImage("m.pgm", {0, 0, 0, 0, 0, 0});
  const auto bad = [&](const std::string& text, const std::string& line) {
    write("m.yaml", text);
    expectFailure("m.yaml", ExitCode::kInputCorrupt, "m.yaml: " + line);
  };
  const std::string head = "image: m.pgm\norigin: [0, 0, 0]\n", whole = head + "resolution: 0.1\n";
  bad(head + "resolution: 0\n", "resolution = 0, must be a positive number of metres a pixel");
  bad(head + "resolution: .nan\n", "resolution = nan, must be a positive number of metres a pixel");
  bad(head + "resolution: fine\n", "resolution must be a number");
  bad(whole + "occupied_thresh: 0.2\nfree_thresh: 0.6\n",
      "free_thresh = 0.6 lies above occupied_thresh = 0.2; exchange them");
  bad(whole + "occupied_thresh: 65\n", "occupied_thresh and free_thresh must be between 0 and 1");
  bad(whole + "negate: maybe\n", "negate = maybe, allowed 0, 1");
  bad(whole + "mode: trinery\n", "mode = trinery, allowed trinary, scale, raw; did you mean 'trinary'?");
  bad("image: m.pgm\nresolution: 0.1\norigin: [0, 0]\n", "origin must be three numbers [x, y, yaw]");
  bad("just words\n", "holds no keys; a map needs image, resolution and origin");
  write("m.yaml", "image: [\n");
  EXPECT_EQ(failure("m.yaml").first, ExitCode::kInputCorrupt);
}

TEST_F(MapFile, AHeaderThatPromisesMoreThanTheFileHoldsIsNotBelieved) {
  const MapReadParams params{.image_resolution_m = 0.1};
  write("big.pgm", "P5\n46000 46000\n255\nabc");
  EXPECT_EQ(failure("big.pgm", params).second,
            "big.pgm: its header claims 46000 x 46000 pixels, more than the 268 million that are allowed");
  write("big.pgm", "P5\n10000 10000\n255\nabc");
  EXPECT_EQ(
      failure("big.pgm", params).second,
      "big.pgm: its header claims 10000 x 10000 pixels, which its 22 bytes cannot hold; it is cut short or damaged");
  cv::imwrite(file("cut.png"), cv::Mat::zeros(40, 40, CV_8U));
  std::string png = readFile(folder_ / "cut.png");
  png[18] = 0x20, png[22] = 0x20;  // 8232 x 8232
  write("big.png", png);
  EXPECT_EQ(failure("big.png", params).first, ExitCode::kInputCorrupt);
  EXPECT_NE(failure("big.png", params).second.find("header claims 8232 x 8232 pixels"), std::string::npos);
  write("half.png", readFile(folder_ / "cut.png").substr(0, 40));
  EXPECT_EQ(failure("half.png", params).first, ExitCode::kInputCorrupt);
  write("words.pgm", "these are words");
  EXPECT_EQ(failure("words.pgm", params).second,
            "words.pgm: is no pgm, png or bmp image with any pixels; convert it to one of these");
}

TEST_F(MapFile, AGridThatPromisesTwoGigabytesInATinyFileIsOneLine) {
  writeImage("m.pgm", {0, 0, 0, 0, 0, 0});
  const auto map = readMap(file("m.pgm"), {.image_resolution_m = 0.1});
  writeGridmap(map, file("m.gridmap"));
  std::string bytes = readFile(folder_ / "m.gridmap");
  const size_t at = bytes.find("COccupancyGridMap2D") + 19 + 2;  // the name, the version, bits a cell
  ASSERT_EQ(bytes[at], 3);
  bytes.replace(at, 8, std::string("\x00\xb5\x00\x00\x00\xb5\x00\x00", 8));  // 46336 x 46336
  write("big.gridmap", bytes);
  EXPECT_EQ(failure("big.gridmap").second, "big.gridmap: its header claims 46336 x 46336 cells, which its " +
                                               std::to_string(bytes.size()) +
                                               " bytes cannot hold; it is cut short or damaged");
  pack("big.gridmap.gz", bytes);
  EXPECT_EQ(failure("big.gridmap.gz").first, ExitCode::kInputCorrupt);
}

TEST_F(MapFile, DamagedArchivesAreOneLine) {
  const std::string scans = readFile(kDatasets + "localization_demo.simplemap.gz");
  write("cut.simplemap.gz", scans.substr(0, scans.size() / 2));
  expectFailure("cut.simplemap.gz", ExitCode::kInputCorrupt,
                "cut.simplemap.gz: its compression is damaged or cut short");
  write("empty.gridmap", "");
  expectFailure("empty.gridmap", ExitCode::kInputCorrupt, "empty.gridmap: is empty");
  write("words.gridmap", "these are words and no grid at all");
  expectFailure("words.gridmap", ExitCode::kInputCorrupt, "words.gridmap: is no occupancy grid of MRPT's");
  write("words.simplemap", "these are words and no scans at all");
  expectFailure("words.simplemap", ExitCode::kInputCorrupt, "words.simplemap: is no simplemap of MRPT's");
  writeImage("m.pgm", {0, 0, 0, 0, 0, 0});
  writeGridmap(readMap(file("m.pgm"), {.image_resolution_m = 0.1}), file("m.gridmap"));
  const std::string grid = readFile(folder_ / "m.gridmap");
  for (size_t n = 1; n < grid.size(); n += 3) {
    write("cut.gridmap", grid.substr(0, n));
    const auto code = failure("cut.gridmap").first;
    EXPECT_TRUE(code == ExitCode::kInputCorrupt || code == ExitCode::kDone) << n;
  }
}

TEST_F(MapFile, CrossedThresholdsOfObstaclesAreAnError) {
  writeImage("m.pgm", {0, 0, 0, 0, 0, 0});
  const auto map = readMap(file("m.pgm"), {.image_resolution_m = 0.1});
  EXPECT_THROW(blockedCells(map, {.occupied_above = 0.3, .free_below = 0.5}), ConfigError);
  EXPECT_EQ(failure("m.pgm").second,
            "m.pgm: a plain image does not say how large a pixel is; give its resolution in metres");
}

}  // namespace
}  // namespace sidestep::testing
