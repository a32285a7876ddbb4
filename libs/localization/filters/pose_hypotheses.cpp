// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/pose_hypotheses.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "localization/filters/fast_math.h"

namespace sidestep {
namespace {

using mrpt::math::TPose2D;

constexpr double kSameSpot_m = 0.5, kSameTurn = 0.35;  // candidates nearer to each other are one place
constexpr double kStep_m = 0.08, kStepTurn = 0.05;     // sd of a rival's step towards a better pose
constexpr double kMostEvidence = 30;                   // so that a rival that fails is soon forgotten
constexpr size_t kPerRival = 10;                       // candidates looked through for each place to fill

double apart(const TPose2D& a, const TPose2D& b) { return std::hypot(a.x - b.x, a.y - b.y); }

bool samePlace(const TPose2D& a, const TPose2D& b) {
  return apart(a, b) < kSameSpot_m && std::abs(wrapAngle(a.phi - b.phi)) < kSameTurn;
}

}  // namespace

Candidates Candidates::draw(const ScanModel& model, const Scan& scan, size_t count, Random& random) {
  const auto total = static_cast<Eigen::Index>(count);
  Candidates c;
  for (auto* a : {&c.x, &c.y, &c.yaw, &c.fit}) a->resize(total);
  for (Eigen::Index i = 0; i < total; ++i) {
    const auto p = model.drawFree(random);
    c.x[i] = p.x;
    c.y[i] = p.y;
    c.yaw[i] = p.phi;
  }
  model.logLikelihoods(scan, c.x.data(), c.y.data(), c.yaw.data(), count, c.fit.data());
  c.best = c.fit.maxCoeff();
  return c;
}

void PoseHypotheses::move(const MotionStep& motion) {
  for (auto& r : hypotheses_) {
    r.pose = moved(r.pose, motion);
    r.pose.phi = wrapAngle(r.pose.phi);
  }
}

void PoseHypotheses::compare(const ScanModel& model, const Scan& scan, double fit, double weight, Random& random) {
  constexpr size_t kTries = 4;
  for (auto& r : hypotheses_) {
    double x[kTries], y[kTries], yaw[kTries], there[kTries];
    for (size_t k = 0; k < kTries; ++k) {  // the first as it is
      x[k] = r.pose.x + (k > 0 ? kStep_m * random.gaussian() : 0);
      y[k] = r.pose.y + (k > 0 ? kStep_m * random.gaussian() : 0);
      yaw[k] = wrapAngle(r.pose.phi + (k > 0 ? kStepTurn * random.gaussian() : 0));
    }
    model.logLikelihoods(scan, x, y, yaw, kTries, there);
    const auto best = static_cast<size_t>(std::max_element(there, there + kTries) - there);
    r.pose = {x[best], y[best], yaw[best]};
    if (!(weight > 0)) continue;
    const double least = fit - r.evidence / weight;  // below it there is no evidence left
    r.evidence = std::max(0.0, r.evidence + weight * (model.judge(scan, r.pose, least).fit - fit));
  }
  double most = 0;
  for (const auto& r : hypotheses_) most = std::max(most, r.evidence);
  if (most <= kMostEvidence) return;
  for (auto& r : hypotheses_) r.evidence = std::max(0.0, r.evidence - (most - kMostEvidence));  // all by the same
}

void PoseHypotheses::renew(const Candidates& from, const TPose2D& estimate) {
  std::stable_sort(hypotheses_.begin(), hypotheses_.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.evidence > b.evidence; });
  std::erase_if(hypotheses_, [&](const Hypothesis& r) { return apart(r.pose, estimate) < kApart_m; });
  for (size_t i = 1; i < hypotheses_.size();) {  // those that met are one
    const bool met = std::any_of(hypotheses_.begin(), hypotheses_.begin() + static_cast<std::ptrdiff_t>(i),
                                 [&](const Hypothesis& r) { return samePlace(r.pose, hypotheses_[i].pose); });
    met ? void(hypotheses_.erase(hypotheses_.begin() + static_cast<std::ptrdiff_t>(i))) : void(++i);
  }
  if (hypotheses_.size() > most_ / 2) hypotheses_.resize(most_ / 2);
  std::vector<uint32_t> order(static_cast<size_t>(from.fit.size()));
  std::iota(order.begin(), order.end(), 0u);
  const size_t looked = std::min(order.size(), kPerRival * most_);
  const auto better = [&](uint32_t a, uint32_t b) {
    return from.fit[a] != from.fit[b] ? from.fit[a] > from.fit[b] : a < b;
  };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(looked), order.end(), better);
  for (size_t k = 0; k < looked && hypotheses_.size() < most_; ++k) {
    const TPose2D p{from.x[order[k]], from.y[order[k]], from.yaw[order[k]]};
    const bool taken =
        std::any_of(hypotheses_.begin(), hypotheses_.end(), [&](const Hypothesis& r) { return samePlace(r.pose, p); });
    if (!taken && apart(p, estimate) >= kApart_m) hypotheses_.push_back({p, 0});
  }
}

double PoseHypotheses::evidence(const TPose2D& estimate) const {
  double out = 0;
  for (const auto& r : hypotheses_)
    if (apart(r.pose, estimate) >= kApart_m) out = std::max(out, r.evidence);
  return out;
}

TPose2D PoseHypotheses::draw(Random& random) const {
  double best = 0, sum = 0;
  for (const auto& r : hypotheses_) best = std::max(best, r.evidence);
  for (const auto& r : hypotheses_) sum += std::exp(r.evidence - best);
  double left = sum * random.uniform();
  TPose2D out;
  for (const auto& r : hypotheses_) {
    out = r.pose;
    if ((left -= std::exp(r.evidence - best)) < 0) break;
  }
  return {out.x + kStep_m * random.gaussian(), out.y + kStep_m * random.gaussian(),
          wrapAngle(out.phi + kStepTurn * random.gaussian())};
}

void PoseHypotheses::save(std::vector<double>& out) const {
  for (const auto& r : hypotheses_)
    for (const double v : {r.pose.x, r.pose.y, r.pose.phi, r.evidence}) out.push_back(v);
  out.push_back(static_cast<double>(hypotheses_.size()));
}

const double* PoseHypotheses::restore(const double* end) {
  hypotheses_.resize(static_cast<size_t>(*--end));
  const double* begin = end - 4 * static_cast<std::ptrdiff_t>(hypotheses_.size());
  const double* p = begin;
  for (auto& r : hypotheses_) {
    r = {{p[0], p[1], p[2]}, p[3]};
    p += 4;
  }
  return begin;
}

}  // namespace sidestep
