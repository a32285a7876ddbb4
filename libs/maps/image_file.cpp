// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/image_file.h"

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "core/errors.h"

namespace sidestep {
namespace {

constexpr uint64_t kMostPixels = 1u << 28;
constexpr uint64_t kMostBytes = 1u << 30;
constexpr uint64_t kDeflateRatio = 1032;  // no byte of a png can stand for more

/// What a header promises: pixels, and the fewest bytes that a file with them has.
struct Promise {
  uint64_t width = 0, height = 0, bytes = 0;
};

uint32_t bigEndian(const std::string& b, size_t at) {
  uint32_t out = 0;
  for (size_t i = 0; i < 4; ++i) out = (out << 8) | static_cast<uint8_t>(b[at + i]);
  return out;
}

uint32_t littleEndian(const std::string& b, size_t at) {
  uint32_t out = 0;
  for (size_t i = 4; i-- > 0;) out = (out << 8) | static_cast<uint8_t>(b[at + i]);
  return out;
}

/// The next number of a pgm header; blanks and comments come before it.
uint64_t pgmNumber(const std::string& b, size_t& at) {
  while (at < b.size() && (std::isspace(static_cast<unsigned char>(b[at])) != 0 || b[at] == '#')) {
    if (b[at] == '#') at = std::min(b.find('\n', at), b.size() - 1);
    ++at;
  }
  uint64_t out = 0;
  while (at < b.size() && b[at] >= '0' && b[at] <= '9' && out < kMostPixels * 10)
    out = 10 * out + static_cast<uint64_t>(b[at++] - '0');
  return out;
}

Promise promiseOf(const std::string& b) {
  if (b.size() > 33 && b.starts_with("\x89PNG\r\n\x1a\n")) {
    const uint64_t w = bigEndian(b, 16), h = bigEndian(b, 20), bits = static_cast<uint8_t>(b[24]);
    return {w, h, w * h / 8 * std::max<uint64_t>(1, bits) / kDeflateRatio};
  }
  if (b.size() > 30 && b.starts_with("BM")) {
    const auto w = static_cast<int32_t>(littleEndian(b, 18)), h = static_cast<int32_t>(littleEndian(b, 22));
    const uint64_t columns = static_cast<uint64_t>(std::abs(int64_t{w})),
                   rows = static_cast<uint64_t>(std::abs(int64_t{h}));
    const bool packed = littleEndian(b, 30) != 0;
    return {columns, rows, packed ? columns * rows / 255 : columns * rows / 8};
  }
  if (b.size() > 2 && b[0] == 'P' && b[1] >= '1' && b[1] <= '6') {
    size_t at = 2;
    const uint64_t w = pgmNumber(b, at), h = pgmNumber(b, at);
    const bool bits = b[1] == '1' || b[1] == '4';
    return {w, h, bits ? w * h / 8 : w * h};
  }
  return {};
}

void checkPromise(const std::string& file, const std::string& bytes) {
  const Promise p = promiseOf(bytes);
  if (p.width == 0 || p.height == 0)
    throw DatasetError::corrupt(file + ": is no pgm, png or bmp image with any pixels; convert it to one of these");
  const std::string size = std::to_string(p.width) + " x " + std::to_string(p.height) + " pixels";
  if (p.width > kMostPixels || p.height > kMostPixels || p.width * p.height > kMostPixels)
    throw DatasetError::corrupt(file + ": its header claims " + size + ", more than the 268 million that are allowed");
  if (p.bytes > bytes.size())
    throw DatasetError::corrupt(file + ": its header claims " + size + ", which its " + std::to_string(bytes.size()) +
                                " bytes cannot hold; it is cut short or damaged");
}

GreyImage toGrey(const cv::Mat& image) {
  GreyImage out{image.cols, image.rows, {}, {}};
  const int channels = image.channels(), colours = channels >= 3 ? 3 : 1;
  out.grey.resize(image.total());
  if (channels == 4 || channels == 2) out.transparent.resize(image.total());
  size_t i = 0;
  for (int row = 0; row < image.rows; ++row) {
    const uint8_t* p = image.ptr<uint8_t>(row);
    for (int column = 0; column < image.cols; ++column, p += channels, ++i) {
      int sum = 0;
      for (int c = 0; c < colours; ++c) sum += p[c];
      out.grey[i] = static_cast<uint8_t>((sum + colours / 2) / colours);
      if (!out.transparent.empty()) out.transparent[i] = p[channels - 1] == 0;
    }
  }
  return out;
}

}  // namespace

std::string readBytes(const std::string& file, const std::string& what) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw DatasetError::missing(file + ": is a folder, not " + what);
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) throw DatasetError::missing(file + ": " + what + " cannot be read; check the name");
  const auto size = static_cast<int64_t>(in.tellg());
  if (size < 0 || static_cast<uint64_t>(size) > kMostBytes)
    throw DatasetError::corrupt(file + ": is larger than 1 GiB, too large for " + what);
  std::string out(static_cast<size_t>(size), '\0');
  in.seekg(0);
  if (!in.read(out.data(), size)) throw DatasetError::missing(file + ": " + what + " cannot be read");
  return out;
}

GreyImage readImage(const std::string& file) {
  const std::string bytes = readBytes(file, "an image");
  checkPromise(file, bytes);
  cv::Mat image;
  try {
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    image = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const std::exception&) {
    image.release();
  }
  if (image.empty()) throw DatasetError::corrupt(file + ": the image does not decode; it is cut short or damaged");
  if (image.depth() == CV_16U) image.convertTo(image, CV_8U, 1 / 257.0);
  if (image.depth() != CV_8U)
    throw DatasetError::corrupt(file + ": pixels are neither 8 nor 16 bit; convert the image");
  return toGrey(image);
}

void writePgm(const GreyImage& image, const std::string& file) {
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << image.width << " " << image.height << "\n255\n";
  out.write(reinterpret_cast<const char*>(image.grey.data()), static_cast<std::streamsize>(image.grey.size()));
  out.close();
  if (!out) throw DatasetError::missing(file + ": cannot be written; check folder and disk");
}

}  // namespace sidestep
