// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/laser_trial.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/CPose2D.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.h"
#include "datasets/log_degrader.h"

namespace sidestep {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostGap_s = 1.5, kElsewhere_m = 3;
constexpr int kMostDraws = 1000;

double distance(const TPose2D& a, const TPose2D& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The first truth at or after a time; null if there is none.
const StampedPose* truthAt(const RecordedDrive& drive, double time_s) {
  const auto it = std::lower_bound(drive.truth.begin(), drive.truth.end(), time_s,
                                   [](const StampedPose& p, double t) { return p.time_s < t; });
  return it == drive.truth.end() ? nullptr : &*it;
}

RecordedDrive pieceOf(const RecordedDrive& drive, double from_s, double to_s) {
  RecordedDrive out;
  out.file = drive.file;
  out.start_s = from_s;
  out.duration_s = to_s - from_s;
  for (const auto& e : drive.entries)
    if (e.time_s >= from_s && e.time_s < to_s) out.entries.push_back(e);
  for (const auto& p : drive.truth)
    if (p.time_s >= from_s && p.time_s < to_s) out.truth.push_back(p);
  return out;
}

/// Cuts from_s to to_s out, as `sidestep-rawlog degrade` does with `do: jump`.
void splice(RecordedDrive& drive, double from_s, double to_s) {
  if (drive.entries.empty()) return;
  DegradeScript script;
  script.event_names = {"carried"};
  auto& event = script.events["carried"];
  event.action = "jump";
  event.from_s = from_s - drive.entries.front().time_s;
  event.to_s = to_s - drive.entries.front().time_s;
  std::vector<Reading> spliced;
  LogDegrader degrader(script, [&](const Reading& e) { spliced.push_back(e); });
  for (const auto& e : drive.entries) degrader.push(e);
  degrader.finish();
  drive.entries = std::move(spliced);
  std::erase_if(drive.truth, [&](const auto& p) { return p.time_s >= from_s && p.time_s < to_s; });
  for (auto& p : drive.truth)
    if (p.time_s >= to_s) p.time_s -= to_s - from_s;
  drive.duration_s -= to_s - from_s;
}

/// A time of the drive at which the robot is elsewhere than at `here`.
const StampedPose& elsewhere(const RecordedDrive& drive, const TPose2D& here, double first_s, double last_s,
                             Random& random) {
  for (int k = 0; k < kMostDraws; ++k) {
    const auto* p = truthAt(drive, random.uniform(first_s, last_s));
    if (p != nullptr && p->time_s <= last_s && distance(p->pose, here) > kElsewhere_m) return *p;
  }
  throw DatasetError::missing(drive.file + ": the robot is never more than 3 m from where the piece begins");
}

}  // namespace

void LaserTrialParams::visit(ParamVisitor& v) {
  v.choice("start", start, {"anywhere", "truth", "off", "wrong"},
           "what the localizer is told: nothing, the true pose, one that is off, one of another place of the drive");
  v.number("length_s", length_s, {0, 1e6}, "s", "of the piece, which the run's seed chooses; 0: the whole drive");
  v.number("off_m", off_m, {0, 100}, "m", "start off: by so much, to a random side");
  v.angle("off_turn_deg", off_turn, {0, 180}, "and turned by this");
  v.number("carried_after_s", carried_after_s, {0, 1e6}, "s",
           "so long after its start the piece is spliced to another place of the drive; 0: it is not");
  v.number("settle_s", settle_s, {0, 1e6}, "s", "errors before this time do not count");
}

LaserTrial makeTrial(const RecordedDrive& drive, const LaserTrialParams& params, uint64_t seed) {
  Random random(seed, 1);
  const double end_s = drive.start_s + drive.duration_s,
               length = params.length_s > 0 ? params.length_s : drive.duration_s;
  if (length > drive.duration_s + 1e-9)
    throw DatasetError::missing(drive.file + ": lasts " + shortestNumber(drive.duration_s) + " s, shorter than " +
                                "trial.length_s = " + shortestNumber(length) + " s");
  const bool carried = params.carried_after_s > 0;
  LaserTrial out;
  const double before = carried ? params.carried_after_s : length, after = length - before;
  for (int k = 0;; ++k) {
    const double from_s = random.uniform(drive.start_s, end_s - length), cut_s = from_s + before;
    const auto* at_cut = truthAt(drive, cut_s);
    double to_s = cut_s;
    if (carried && at_cut != nullptr) {
      const auto* there = truthAt(drive, random.uniform(cut_s, end_s - after));
      if (there != nullptr && distance(there->pose, at_cut->pose) > kElsewhere_m) to_s = there->time_s;
    }
    if (carried && to_s == cut_s && k < kMostDraws) continue;
    if (carried && to_s == cut_s) throw DatasetError::missing(drive.file + ": no other place to splice the piece to");
    out.drive = pieceOf(drive, from_s, std::min(to_s + after, end_s + 1));
    if (carried) splice(out.drive, cut_s, to_s);
    break;
  }
  if (out.drive.truth.empty()) throw DatasetError::missing(drive.file + ": no truth within the piece");
  if (params.start == "anywhere") return out;
  TPose2D start = out.drive.truth.front().pose;
  if (params.start == "wrong") start = elsewhere(drive, start, drive.start_s, end_s, random).pose;
  if (params.start == "off") {
    const double side = random.uniform(-M_PI, M_PI);
    start = {start.x + params.off_m * std::cos(side), start.y + params.off_m * std::sin(side),
             start.phi + std::copysign(params.off_turn, random.uniform(-1, 1))};
  }
  out.start = start;
  return out;
}

std::vector<LaserSample> localizeTrial(const LaserTrial& trial, const LocalizeConfig& given, uint64_t filter_seed) {
  LocalizeConfig config = given;
  if (trial.start) {
    config.robot.start.pose_given = true;
    config.robot.start.x_m = trial.start->x;
    config.robot.start.y_m = trial.start->y;
    config.robot.start.yaw = trial.start->phi;
  }
  Localizer localizer = makeLocalizer(config, filter_seed);
  std::vector<LaserSample> out;
  auto truth = trial.drive.truth.begin();
  std::optional<Estimate> before;
  const auto take = [&] {
    for (const auto& e : localizer.takeEstimates()) {
      for (; truth != trial.drive.truth.end() && truth->time_s <= e.time_s; ++truth) {
        if (!before && truth->time_s < e.time_s) continue;
        const double gap = before ? e.time_s - before->time_s : 0;
        if (gap > kMostGap_s) continue;
        const double s = gap > 0 ? (truth->time_s - before->time_s) / gap : 1;
        const TPose2D a = before ? before->belief.mean : e.belief.mean, b = e.belief.mean;
        const auto& near = s < 0.5 && before ? *before : e;
        const TPose2D here{a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), wrapToPi(a.phi + s * wrapToPi(b.phi - a.phi))};
        out.push_back(
            {{truth->time_s - trial.drive.start_s, here, truth->pose, near.belief.covariance, truth->has_heading},
             near.lost_probability.value_or(kNaN)});
      }
      before = e;
    }
  };
  for (const auto& e : trial.drive.entries) {
    localizer.observe(e);
    take();
  }
  localizer.finish();
  take();
  return out;
}

}  // namespace sidestep
