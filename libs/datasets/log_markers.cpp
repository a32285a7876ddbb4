// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_markers.h"

#include <mrpt/obs/CObservationComment.h>

#include <charconv>
#include <utility>

namespace sidestep {
namespace {
const std::string kHeader = "sidestep:";
const std::string kEnd = "end: {n: ";
}  // namespace

std::string headerText(const std::string& header) {
  return header.starts_with(kHeader) ? header : kHeader + " {rawlog: 1}\n" + header;
}

std::string endText(uint64_t observations) { return kEnd + std::to_string(observations) + "}"; }

std::optional<std::string> commentText(const mrpt::serialization::CSerializable& object) {
  const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&object);
  if (comment == nullptr) return {};
  return comment->text;
}

bool isHeader(const std::string& text) { return text.starts_with(kHeader); }

std::optional<uint64_t> endCount(const std::string& text) {
  if (!text.starts_with(kEnd)) return {};
  uint64_t n = 0;
  const auto [end, error] = std::from_chars(text.data() + kEnd.size(), text.data() + text.size(), n);
  if (error != std::errc() || std::string(end) != "}") return {};
  return n;
}

bool MarkerCheck::see(const mrpt::serialization::CSerializable* object) {
  const auto text = object ? commentText(*object) : std::nullopt;
  const bool first = std::exchange(first_, false);
  if (first && text && isHeader(*text)) {
    ours_ = true;
    header_ = *text;
    return true;
  }
  if (stated_) ++after_end_;
  if (const auto n = text && ours_ ? endCount(*text) : std::nullopt; n && !stated_) {
    stated_ = n;
    return true;
  }
  ++count_;
  return false;
}

std::string MarkerCheck::verdict() const {
  if (!ours_) return "";
  if (!stated_) return "cut short: no end marker";
  if (after_end_ > 0) return std::to_string(after_end_) + " entries after the end marker";
  if (*stated_ == count_) return "";
  return "the end marker says " + std::to_string(*stated_) + " entries, there are " + std::to_string(count_);
}

}  // namespace sidestep
