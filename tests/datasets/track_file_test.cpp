// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/track_file.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "support/log_worlds.h"

namespace sidestep {
namespace {

std::string errorOf(const std::string& text) {
  const worlds::TemporaryFolder folder;
  worlds::store(folder / "people.csv", text);
  try {
    readTracks(folder / "people.csv");
  } catch (const DatasetError& e) {
    const std::string line = e.what();
    return line.substr(line.find("people.csv"));
  }
  return "";
}

TEST(TrackFile, GivesEachPersonsPlacesInTimeOrder) {
  const worlds::TemporaryFolder folder;
  worlds::store(folder / "people.csv", "t,id,x,y\n0.4,2,1,-1.5\r\n0,1,5,6\n0, 2, 0.5, -1\n# nobody\n");
  const auto tracks = readTracks(folder / "people.csv");
  ASSERT_EQ(tracks.size(), 2u);
  ASSERT_EQ(tracks.at(2).size(), 2u);
  EXPECT_EQ(tracks.at(2)[0].x, 0.5);
  EXPECT_EQ(tracks.at(2)[1].y, -1.5);
  EXPECT_EQ(tracks.at(1)[0].time_s, 0);
}

TEST(TrackFile, SaysWhereItIsWrong) {
  EXPECT_EQ(errorOf("t,id,x,y\n0,1,2\n"), "people.csv:2: wants t,id,x,y: four numbers, id a whole one");
  EXPECT_EQ(errorOf("0,1,2,nan\n0,1,2,3\n5,1.5,2,3"), "people.csv:3: wants t,id,x,y: four numbers, id a whole one");
  EXPECT_NE(errorOf("0,1,2,3\n0,1,2,4\n").find("id 1 is at two places"), std::string::npos);
  EXPECT_THROW(readTracks("/no/such/file.csv"), DatasetError);
}

}  // namespace
}  // namespace sidestep
