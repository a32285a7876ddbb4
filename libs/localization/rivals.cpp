// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/rivals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "localization/fast_math.h"

namespace sidestep {
namespace {

using mrpt::math::TPose2D;

constexpr double kSameSpot_m = 0.5, kSameTurn = 0.35;  // candidates nearer to each other are one place
constexpr double kStep_m = 0.08, kStepTurn = 0.05;     // sd of a rival's step towards a better pose
constexpr double kRecent = 0.2;                        // weight of a scan in the mean advantage, once there are some
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

void Rivals::move(const MotionStep& motion) {
  for (auto& r : rivals_) {
    r.pose = moved(r.pose, motion);
    r.pose.phi = wrapAngle(r.pose.phi);
  }
}

void Rivals::compare(const ScanModel& model, const Scan& scan, double fit, Random& random) {
  for (auto& r : rivals_) {
    const TPose2D step{r.pose.x + kStep_m * random.gaussian(), r.pose.y + kStep_m * random.gaussian(),
                       wrapAngle(r.pose.phi + kStepTurn * random.gaussian())};
    const double x[2] = {r.pose.x, step.x}, y[2] = {r.pose.y, step.y}, yaw[2] = {r.pose.phi, step.phi};
    double there[2];
    model.logLikelihoods(scan, x, y, yaw, 2, there);
    if (there[1] > there[0]) r.pose = step;
    ++r.scans;
    r.advantage += std::max(kRecent, 1 / r.scans) * (std::max(there[0], there[1]) - fit - r.advantage);
  }
}

void Rivals::renew(const Candidates& from, const TPose2D& estimate) {
  std::stable_sort(rivals_.begin(), rivals_.end(),
                   [](const Rival& a, const Rival& b) { return a.advantage > b.advantage; });
  std::erase_if(rivals_, [&](const Rival& r) { return apart(r.pose, estimate) < kApart_m; });
  for (size_t i = 1; i < rivals_.size();) {  // those that met are one
    const bool met = std::any_of(rivals_.begin(), rivals_.begin() + static_cast<std::ptrdiff_t>(i),
                                 [&](const Rival& r) { return samePlace(r.pose, rivals_[i].pose); });
    met ? void(rivals_.erase(rivals_.begin() + static_cast<std::ptrdiff_t>(i))) : void(++i);
  }
  if (rivals_.size() > most_ / 2) rivals_.resize(most_ / 2);
  std::vector<uint32_t> order(static_cast<size_t>(from.fit.size()));
  std::iota(order.begin(), order.end(), 0u);
  const size_t looked = std::min(order.size(), kPerRival * most_);
  const auto better = [&](uint32_t a, uint32_t b) {
    return from.fit[a] != from.fit[b] ? from.fit[a] > from.fit[b] : a < b;
  };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(looked), order.end(), better);
  for (size_t k = 0; k < looked && rivals_.size() < most_; ++k) {
    const TPose2D p{from.x[order[k]], from.y[order[k]], from.yaw[order[k]]};
    const bool taken = std::any_of(rivals_.begin(), rivals_.end(), [&](const Rival& r) { return samePlace(r.pose, p); });
    if (!taken && apart(p, estimate) >= kApart_m) rivals_.push_back({p, 0, 0});
  }
}

std::optional<double> Rivals::advantage(const TPose2D& estimate) const {
  std::optional<double> out;
  for (const auto& r : rivals_)
    if (r.scans >= 2 && apart(r.pose, estimate) >= kApart_m && (!out || r.advantage > *out)) out = r.advantage;
  return out;
}

void Rivals::save(std::vector<double>& out) const {
  for (const auto& r : rivals_)
    for (const double v : {r.pose.x, r.pose.y, r.pose.phi, r.advantage, r.scans}) out.push_back(v);
  out.push_back(static_cast<double>(rivals_.size()));
}

const double* Rivals::restore(const double* end) {
  rivals_.resize(static_cast<size_t>(*--end));
  const double* begin = end - 5 * static_cast<std::ptrdiff_t>(rivals_.size());
  const double* p = begin;
  for (auto& r : rivals_) {
    r = {{p[0], p[1], p[2]}, p[3], p[4]};
    p += 5;
  }
  return begin;
}

}  // namespace sidestep
