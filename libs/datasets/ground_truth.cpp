// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/ground_truth.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/errors.h"
#include "datasets/pose_file.h"

namespace sidestep {
namespace {

constexpr size_t kMaxWaiting = 100000;
constexpr double kSidewaysLimit_m = 0.1;

/// What one reading of a whole file tells.
struct FileSurvey {
  uint64_t poses = 0;
  bool row_indexed = false, has_heading = true;
};

FileSurvey survey(const std::string& name) {
  PoseFile file(name);
  FileSurvey result;
  bool counts_rows = true, all_identity = true;
  double y_min = std::numeric_limits<double>::infinity(), y_max = -y_min;
  while (const auto pose = file.next()) {
    counts_rows = counts_rows && pose->time_s == static_cast<double>(result.poses);
    all_identity = all_identity && file.lastWasIdentity();
    y_min = std::min(y_min, pose->pose.y);
    y_max = std::max(y_max, pose->pose.y);
    ++result.poses;
  }
  if (result.poses == 0) throw DatasetError::corrupt(name + ": holds no poses");
  result.row_indexed = !file.isTum() && counts_rows && result.poses > 1;
  result.has_heading = !(file.isTum() && all_identity && y_max - y_min > kSidewaysLimit_m);
  return result;
}

StampedPose interpolate(const StampedPose& a, const StampedPose& b, double time_s) {
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  const double turn = mrpt::math::wrapToPi(b.pose.phi - a.pose.phi);
  StampedPose out{time_s, {}, a.has_heading && b.has_heading};
  out.pose.x = a.pose.x + share * (b.pose.x - a.pose.x);
  out.pose.y = a.pose.y + share * (b.pose.y - a.pose.y);
  out.pose.phi = mrpt::math::wrapToPi(a.pose.phi + share * turn);
  return out;
}

bool isFinite(const StampedPose& pose) {
  return std::isfinite(pose.time_s) && std::isfinite(pose.pose.x) && std::isfinite(pose.pose.y) &&
         std::isfinite(pose.pose.phi);
}

}  // namespace

struct GroundTruth::Impl {
  double max_gap_s = 0;
  std::deque<StampedPose> waiting;
  std::unique_ptr<PoseFile> file;
  FileSurvey facts;
  uint64_t rows_read = 0;

  bool readNext() {
    if (!file) return false;
    auto pose = file->next();
    if (!pose) return false;
    pose->has_heading = facts.has_heading;
    waiting.push_back(*pose);
    ++rows_read;
    return true;
  }

  /// Afterwards the first waiting pose is the last one at or before the time, and the second the first one after it.
  void advanceTo(double time_s) {
    do {
      while (waiting.size() >= 2 && waiting[1].time_s <= time_s) waiting.pop_front();
    } while (waiting.size() < 2 && readNext());
    while (waiting.size() >= 2 && waiting[1].time_s <= time_s) waiting.pop_front();
  }
};

GroundTruth::GroundTruth(double max_gap_s) : impl_(std::make_unique<Impl>()) { impl_->max_gap_s = max_gap_s; }
GroundTruth::~GroundTruth() = default;

std::unique_ptr<GroundTruth> GroundTruth::fromFile(const std::string& file, double max_gap_s) {
  auto truth = std::make_unique<GroundTruth>(max_gap_s);
  truth->impl_->facts = survey(file);
  truth->impl_->file = std::make_unique<PoseFile>(file);
  return truth;
}

bool GroundTruth::push(const StampedPose& pose) {
  auto& waiting = impl_->waiting;
  if (!isFinite(pose) || (!waiting.empty() && pose.time_s < waiting.back().time_s)) return false;
  waiting.push_back(pose);
  if (waiting.size() > kMaxWaiting) waiting.pop_front();
  return true;
}

bool GroundTruth::isRowIndexed() const { return impl_->facts.row_indexed; }

std::optional<StampedPose> GroundTruth::at(double time_s) {
  if (isRowIndexed() || !std::isfinite(time_s)) return std::nullopt;
  impl_->advanceTo(time_s);
  const auto& waiting = impl_->waiting;
  if (waiting.empty() || time_s < waiting[0].time_s) return std::nullopt;
  if (time_s == waiting[0].time_s) return waiting[0];
  if (waiting.size() < 2 || waiting[1].time_s - waiting[0].time_s > impl_->max_gap_s) return std::nullopt;
  return interpolate(waiting[0], waiting[1], time_s);
}

std::optional<StampedPose> GroundTruth::row(uint64_t index) {
  if (!isRowIndexed() || index >= impl_->facts.poses) return std::nullopt;
  while (impl_->rows_read <= index) {
    impl_->waiting.clear();
    if (!impl_->readNext()) return std::nullopt;
  }
  if (impl_->rows_read != index + 1) return std::nullopt;
  return impl_->waiting.back();
}

}  // namespace sidestep
