// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace mrpt::serialization {
class CSerializable;
}

namespace sidestep {

/// The comments that open and close the logs we write, so that a log that was cut between two entries, which MRPT takes
/// for whole, is known as cut.
std::string headerText(const std::string& header);
std::string endText(uint64_t observations);

/// The text of a comment, or nothing for any other object.
std::optional<std::string> commentText(const mrpt::serialization::CSerializable& object);
bool isHeader(const std::string& text);
/// The count that an end marker states, or nothing if the text is none.
std::optional<uint64_t> endCount(const std::string& text);

/// Watches a log go by and says at its end whether one of ours was cut short.
class MarkerCheck {
 public:
  /// To be told of every object (null as nullptr). @return whether it is one of the two comments.
  bool see(const mrpt::serialization::CSerializable* object);
  /// What is wrong with the end of the log; empty if it is whole, or not one of ours.
  std::string verdict() const;
  bool isOurs() const { return ours_; }
  /// The first comment's text; empty if the log is not ours.
  const std::string& header() const { return header_; }

 private:
  bool ours_ = false;
  bool first_ = true;
  uint64_t count_ = 0;  ///< objects since the header
  std::optional<uint64_t> stated_;
  uint64_t after_end_ = 0;
  std::string header_;
};

}  // namespace sidestep
