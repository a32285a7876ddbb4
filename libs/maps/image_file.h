// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sidestep {

/// A grey image, rows from top to bottom.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<uint8_t> grey;      ///< mean of the colours, 0 = black
  std::vector<bool> transparent;  ///< empty if the image knows no transparency
};

/// Whole content of a file. @throws DatasetError "`what` cannot be read" if it is missing, too large or no file.
std::string readBytes(const std::string& file, const std::string& what);

/// Reads pgm, png, bmp. Before anything is decoded, the size in the header is compared with what the file can hold.
/// @throws DatasetError, one line that starts with the file.
GreyImage readImage(const std::string& file);

/// @throws DatasetError if it did not reach the disk.
void writePgm(const GreyImage& image, const std::string& file);

}  // namespace sidestep
