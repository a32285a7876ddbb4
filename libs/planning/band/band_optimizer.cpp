// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/band_optimizer.h"

#include <algorithm>
#include <cmath>

#include "planning/band/costs/forward_cost.h"
#include "planning/band/costs/nonholonomic_cost.h"
#include "planning/band/costs/shortest_path_cost.h"
#include "planning/band/costs/time_cost.h"
#include "planning/band/costs/via_point_cost.h"

namespace sidestep {
namespace {

using Row = BlockBandedSystem::Row;
constexpr int kB = BlockBandedSystem::kBlock;

/// Sums weight * r^2.
struct CostSink {
  double total = 0;
  void interval(BandTerm, size_t, const Interval&, double weight, double r, const MotionGradient&) {
    total += weight * r * r;
  }
  void pair(BandTerm, size_t, const Interval*, double weight, double r, const MotionGradient&, const MotionGradient&) {
    total += weight * r * r;
  }
  void pose(BandTerm, size_t, double weight, double r, const PoseGradient&) { total += weight * r * r; }
};

/// The same term by term.
struct ShareSink {
  std::array<double, kBandTerms> shares{};
  void add(BandTerm term, double cost) { shares[static_cast<size_t>(term)] += cost; }
  void interval(BandTerm term, size_t, const Interval&, double weight, double r, const MotionGradient&) {
    add(term, weight * r * r);
  }
  void pair(BandTerm term, size_t, const Interval*, double weight, double r, const MotionGradient&,
            const MotionGradient&) {
    add(term, weight * r * r);
  }
  void pose(BandTerm term, size_t, double weight, double r, const PoseGradient&) { add(term, weight * r * r); }
};

/// Sums weight * r^2, J^T W J and -J^T W r; pose k is block k - 1, pose 0 is no variable.
struct SystemSink {
  explicit SystemSink(BlockBandedSystem& s) : system(s) {}
  BlockBandedSystem& system;
  double total = 0;

  /// Adds g g_i^T for block row i of the `n` poses from `first` on; g holds their gradients one after the other.
  template <int N>
  void outer(size_t first, double weight, double r, const double (&g)[N * kB]) {
    total += weight * r * r;
    for (int i = 0; i < N; ++i) {
      const int block = static_cast<int>(first) + i - 1;
      if (block < 0) continue;
      Row& row = system.row(block);
      auto& rhs = system.rhs(block);
      const int at = (BlockBandedSystem::kReach - i) * kB;
      for (int a = 0; a < kB; ++a) {
        const double wg = weight * g[i * kB + a];
        for (int b = 0; b < (i + 1) * kB; ++b) row[static_cast<size_t>(a)][static_cast<size_t>(at + b)] += wg * g[b];
        rhs[static_cast<size_t>(a)] -= wg * r;
      }
    }
  }
  void interval(BandTerm, size_t k, const Interval& i, double weight, double r, const MotionGradient& g) {
    PoseGradient a, b;
    byPoses(i, g, a, b);
    outer<2>(k, weight, r, {a.x, a.y, a.theta, a.t, b.x, b.y, b.theta, b.t});
  }
  void pair(BandTerm, size_t k, const Interval* i, double weight, double r, const MotionGradient& g,
            const MotionGradient& h) {
    PoseGradient a, b, b2, c;
    byPoses(i[0], g, a, b);
    byPoses(i[1], h, b2, c);
    outer<3>(k, weight, r,
             {a.x, a.y, a.theta, a.t, b.x + b2.x, b.y + b2.y, b.theta + b2.theta, b.t + b2.t, c.x, c.y, c.theta, c.t});
  }
  void pose(BandTerm, size_t k, double weight, double r, const PoseGradient& g) {
    outer<1>(k, weight, r, {g.x, g.y, g.theta, g.t});
  }
};

bool finite(const Band& band) {
  double sum = 0;
  for (const auto& p : band) sum += p.x + p.y + p.theta + p.t;
  return std::isfinite(sum);
}

}  // namespace

const char* bandTermName(BandTerm term) {
  static constexpr const char* kNames[kBandTerms] = {"time",          "nonholonomic", "velocity",
                                                     "acceleration",  "clearance",    "contact",
                                                     "shortest_path", "forward",      "via_points"};
  return kNames[static_cast<int>(term)];
}

template <class Sink>
void BandOptimizer::visitIntervals(const BandProblem& problem, const Band& band, Sink& sink) {
  const VelocityCost velocity(problem.limits, params_.limit_share, soft_);
  const AccelerationCost acceleration(problem.limits, params_.limit_share, soft_);
  const size_t n = band.size() - 1;
  intervals_.resize(n);
  for (size_t k = 0; k < n; ++k) intervals_[k] = intervalBetween(band[k], band[k + 1]);
  for (size_t k = 0; k < n; ++k) {
    const Interval& i = intervals_[k];
    const auto to = [&](BandTerm term, double weight) {
      return
          [&sink, &i, k, term, weight](double r, const MotionGradient& g) { sink.interval(term, k, i, weight, r, g); };
    };
    TimeCost{}.evaluate(i, to(BandTerm::kTime, weights_.time));
    NonholonomicCost{}.evaluate(i, to(BandTerm::kNonholonomic, weights_.nonholonomic));
    velocity.evaluate(i, to(BandTerm::kVelocity, weights_.velocity));
    if (weights_.shortest_path > 0) ShortestPathCost{}.evaluate(i, to(BandTerm::kShortest, weights_.shortest_path));
    ForwardCost{}.evaluate(i, to(BandTerm::kForward, weights_.forward));
    if (k + 1 < n)
      acceleration.evaluate(i, intervals_[k + 1], [&](double r, const MotionGradient& g, const MotionGradient& h) {
        sink.pair(BandTerm::kAcceleration, k, &intervals_[k], weights_.acceleration, r, g, h);
      });
  }
  const auto end = [&](size_t k) {
    return [&sink, this, k](double r, const MotionGradient& g) {
      sink.interval(BandTerm::kAcceleration, k, intervals_[k], weights_.acceleration, r, g);
    };
  };
  acceleration.evaluateEnd(intervals_[0], problem.ends.v, problem.ends.w, 1, end(0));
  if (problem.ends.goal_stops) acceleration.evaluateEnd(intervals_[n - 1], 0, 0, -1, end(n - 1));
}

template <class Sink>
void BandOptimizer::visitPoses(const BandProblem& problem, const Band& band, Sink& sink) {
  const ClearanceCost wished{problem.robot, params_.distance_m, params_.distance_moving_m};
  const ClearanceCost contact{problem.robot, params_.distance_least_m, params_.distance_least_m};
  const double inner = std::min(params_.distance_m, params_.distance_moving_m) - params_.distance_least_m;
  for (size_t k = 1; problem.obstacles != nullptr && k < band.size(); ++k) {
    bool near = false;
    wished.evaluate(band[k], *problem.obstacles, [&](double r, const PoseGradient& g) {
      sink.pose(BandTerm::kClearance, k, weights_.clearance, r, g);
      near = near || r > inner;
    });
    if (near)
      contact.evaluate(band[k], *problem.obstacles, [&](double r, const PoseGradient& g) {
        sink.pose(BandTerm::kContact, k, weights_.contact, r, g);
      });
  }
  for (size_t v = 0; v < via_pose_.size(); ++v) {
    const auto k = static_cast<size_t>(via_pose_[v]);
    ViaPointCost{}.evaluate(band[k], problem.via_points[v], [&](double r, const PoseGradient& g) {
      sink.pose(BandTerm::kVia, k, weights_.via_points, r, g);
    });
  }
}

template <class Sink>
void BandOptimizer::visitTerms(const BandProblem& problem, const Band& band, Sink& sink) {
  visitIntervals(problem, band, sink);
  visitPoses(problem, band, sink);
}

void BandOptimizer::assignViaPoints(const BandProblem& problem, const Band& band) {
  via_pose_.clear();
  if (weights_.via_points <= 0 || band.size() < 3) return;
  int k = 1;
  const auto distance2 = [&](int pose, const mrpt::math::TPoint2D& p) {
    const auto& q = band[static_cast<size_t>(pose)];
    return (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
  };
  const int last = static_cast<int>(band.size()) - 2;
  for (const auto& via : problem.via_points) {
    for (int next = k; next <= last; ++next)
      if (distance2(next, via) < distance2(k, via)) k = next;
    via_pose_.push_back(k);
  }
}

double BandOptimizer::assemble(const BandProblem& problem, const Band& band) {
  assignViaPoints(problem, band);
  const int blocks = static_cast<int>(band.size()) - 1;
  system_.clear(blocks);
  SystemSink sink(system_);
  visitTerms(problem, band, sink);
  system_.fix(blocks - 1, 0);
  system_.fix(blocks - 1, 1);
  if (!problem.goal_heading_free) system_.fix(blocks - 1, 2);
  return sink.total;
}

double BandOptimizer::cost(const BandProblem& problem, const Band& band) {
  CostSink sink;
  visitTerms(problem, band, sink);
  return sink.total;
}

std::array<double, kBandTerms> BandOptimizer::shares(const BandProblem& problem, const Band& band) {
  assignViaPoints(problem, band);
  soft_ = 0;
  ShareSink sink;
  visitTerms(problem, band, sink);
  return sink.shares;
}

double BandOptimizer::stepScale(const Band& band) const {
  constexpr double kKeep = 0.3;  // no interval shrinks below this part of itself in one step
  double scale = 1;
  for (size_t k = 1; k < band.size(); ++k) {
    const double dt = band[k].t - band[k - 1].t;
    const double change =
        system_.solution(static_cast<int>(k) - 1)[3] - (k > 1 ? system_.solution(static_cast<int>(k) - 2)[3] : 0);
    if (change < -(1 - kKeep) * dt) scale = std::min(scale, -(1 - kKeep) * dt / change);
  }
  return scale;
}

void BandOptimizer::applyStep(const Band& band, double scale, Band& out) const {
  out = band;
  for (size_t k = 1; k < band.size(); ++k) {
    const auto& step = system_.solution(static_cast<int>(k) - 1);
    out[k].x += scale * step[0];
    out[k].y += scale * step[1];
    out[k].theta += scale * step[2];
    out[k].t += scale * step[3];
  }
}

BandOptimizer::Result BandOptimizer::optimize(const BandProblem& problem, bool warm, const std::function<bool()>& stop,
                                              Band& band) {
  Result out;
  // rounded-off limits first: hard ones are met only by steps too small to get anywhere
  static constexpr double kSoft[] = {0.05};
  const int all = warm ? params_.iterations_warm : params_.iterations_cold;
  double lambda = warm ? params_.damping_warm : params_.damping;
  for (size_t stage = warm ? std::size(kSoft) - 1 : 0; stage < std::size(kSoft); ++stage) {
    soft_ = kSoft[stage];
    const int left = static_cast<int>(std::size(kSoft) - stage), iterations = (all - out.iterations + left - 1) / left;
    descend(problem, iterations, stop, lambda, band, out);
  }
  return out;
}

void BandOptimizer::descend(const BandProblem& problem, int iterations, const std::function<bool()>& stop,
                            double& lambda, Band& band, Result& out) {
  constexpr double kDampingMost = 1e7;
  const int last = out.iterations + iterations;
  out.converged = false;
  out.cost = assemble(problem, band);
  out.diverged = !std::isfinite(out.cost);
  while (!out.diverged && !out.converged && out.iterations < last && !(stop && stop())) {
    ++out.iterations;
    const bool solved = system_.solve(lambda);
    if (solved) applyStep(band, stepScale(band), trial_);
    const double now = solved && finite(trial_) ? cost(problem, trial_) : out.cost;
    if (now < out.cost) {
      out.converged = out.cost - now < params_.tolerance * out.cost;
      std::swap(band, trial_);
      lambda = std::max(lambda * 0.2, 1e-9);
      out.cost = now;
      if (!out.converged && out.iterations < last) assemble(problem, band);
    } else {
      lambda *= 6;
      out.converged = lambda > kDampingMost;
    }
  }
  lambda = std::min(lambda, 1.0);
}

}  // namespace sidestep
