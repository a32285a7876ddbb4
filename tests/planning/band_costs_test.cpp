// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Each cost term's derivatives against central differences, and those of the whole objective.
#include <gtest/gtest.h>

#include "core/random.h"
#include "planning/band/band_optimizer.h"
#include "planning/band/costs/forward_cost.h"
#include "planning/band/costs/nonholonomic_cost.h"
#include "planning/band/costs/shortest_path_cost.h"
#include "planning/band/costs/time_cost.h"
#include "planning/band/costs/via_point_cost.h"
#include "support/jacobian.h"

namespace sidestep {
namespace {

using Vector = Eigen::VectorXd;

BandPose poseIn(const Vector& x, Eigen::Index at) { return {x(at), x(at + 1), x(at + 2), x(at + 3)}; }

/// Residuals of a term at three poses, one after the other in `x`, and the rows of its Jacobian.
struct Rows {
  std::vector<double> r;
  std::vector<Vector> J;
  void add(double residual, std::initializer_list<std::pair<int, PoseGradient>> parts) {
    r.push_back(residual);
    Vector row = Vector::Zero(12);
    for (const auto& [pose, g] : parts) row.segment<4>(4 * pose) += Eigen::Vector4d(g.x, g.y, g.theta, g.t);
    J.push_back(row);
  }
  Vector values() const { return Eigen::Map<const Vector>(r.data(), static_cast<Eigen::Index>(r.size())); }
};

using Term = std::function<Rows(const Vector&)>;

/// A term of one interval as a function of the poses.
template <class Cost>
Term ofInterval(const Cost& cost) {
  return [cost](const Vector& x) {
    Rows rows;
    const Interval i = intervalBetween(poseIn(x, 0), poseIn(x, 4));
    cost.evaluate(i, [&](double r, const MotionGradient& g) {
      PoseGradient a, b;
      byPoses(i, g, a, b);
      rows.add(r, {{0, a}, {1, b}});
    });
    return rows;
  };
}

/// How many residuals were compared.
int expectDerivatives(const Term& term, const Vector& x) {
  const Rows rows = term(x);
  if (rows.r.empty()) return 0;
  const auto f = [&](const Vector& at) { return term(at).values(); };
  for (Eigen::Index i = 0; i < x.size(); ++i)  // not across a kink, where residuals appear or go
    for (double step : {-1e-5, 1e-5}) {
      Vector y = x;
      y(i) += step;
      if (term(y).r.size() != rows.r.size()) return 0;
    }
  const Eigen::MatrixXd J = support::centralDifferences(f, x);
  for (size_t k = 0; k < rows.J.size(); ++k)
    EXPECT_LT((J.row(static_cast<Eigen::Index>(k)).transpose() - rows.J[k]).cwiseAbs().maxCoeff(),
              1e-5 * (1 + rows.J[k].cwiseAbs().maxCoeff()))
        << "residual " << k << " = " << rows.r[k];
  return static_cast<int>(rows.r.size());
}

/// Three poses in any relation, speeds beyond the limits among them.
Vector anyPoses(Random& random) {
  Vector x(12);
  double t = 0;
  for (int k = 0; k < 3; ++k) {
    t += random.uniform(0.1, 0.6);
    x.segment<4>(4 * k) << random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-1.5, 1.5), t;
  }
  return x;
}

void expectDerivativesEverywhere(const Term& term) {
  Random random(7);
  int compared = 0;
  for (int n = 0; n < 300; ++n) compared += expectDerivatives(term, anyPoses(random));
  EXPECT_GT(compared, 20) << "the term was hardly ever active";
}

RobotLimits lowLimits() {
  RobotLimits limits;
  limits.v_max = 0.5;
  limits.w_max = 1;
  limits.wheel_speed_max = 0.6;
  return limits;
}

TEST(BandCosts, TimeHasTheDerivativesItSays) { expectDerivativesEverywhere(ofInterval(TimeCost{})); }
TEST(BandCosts, NonholonomicHasTheDerivativesItSays) { expectDerivativesEverywhere(ofInterval(NonholonomicCost{})); }
TEST(BandCosts, VelocityHasTheDerivativesItSays) {
  for (double soft : {0.0, 0.3}) expectDerivativesEverywhere(ofInterval(VelocityCost(lowLimits(), 0.9, soft)));
}
TEST(BandCosts, ShortestPathHasTheDerivativesItSays) { expectDerivativesEverywhere(ofInterval(ShortestPathCost{})); }
TEST(BandCosts, ForwardHasTheDerivativesItSays) { expectDerivativesEverywhere(ofInterval(ForwardCost{})); }

TEST(BandCosts, AccelerationHasTheDerivativesItSays) {
  const AccelerationCost cost(lowLimits(), 0.9, 0.2);
  expectDerivativesEverywhere([cost](const Vector& x) {
    Rows rows;
    const Interval i = intervalBetween(poseIn(x, 0), poseIn(x, 4)), j = intervalBetween(poseIn(x, 4), poseIn(x, 8));
    cost.evaluate(i, j, [&](double r, const MotionGradient& g, const MotionGradient& h) {
      PoseGradient a, b, b2, c;
      byPoses(i, g, a, b);
      byPoses(j, h, b2, c);
      rows.add(r, {{0, a}, {1, b}, {1, b2}, {2, c}});
    });
    return rows;
  });
}

TEST(BandCosts, AccelerationAtBothEndsHasTheDerivativesItSays) {
  const AccelerationCost cost(lowLimits(), 0.9, 0.2);
  for (double sign : {1.0, -1.0})
    expectDerivativesEverywhere([cost, sign](const Vector& x) {
      Rows rows;
      const Interval i = intervalBetween(poseIn(x, 0), poseIn(x, 4));
      cost.evaluateEnd(i, 0.2, -0.3, sign, [&](double r, const MotionGradient& g) {
        PoseGradient a, b;
        byPoses(i, g, a, b);
        rows.add(r, {{0, a}, {1, b}});
      });
      return rows;
    });
}

TEST(BandCosts, ClearanceOfStillAndMovingObstaclesHasTheDerivativesItSays) {
  const std::vector<mrpt::math::TPoint2D> points = {{0.9, 0.2}, {-0.8, 0.3}};
  const std::vector<Segment> walls = {{{-1, -1}, {1, -0.8}}};
  std::vector<MovingObstacle> moving(1);
  moving[0].position = {0.5, 0.9};
  moving[0].velocity = {-0.7, 0.2};
  MovingView view;
  view.kind = MovingView::Kind::kInTime;
  ObstacleView obstacles;
  obstacles.build({points, walls, moving, nullptr}, view, {-3, -3, 3, 3}, 0.8);
  const ClearanceCost cost{Footprint(0.3), 0.5, 0.4};
  expectDerivativesEverywhere([&](const Vector& x) {
    Rows rows;
    const BandPose pose = poseIn(x, 0);
    cost.evaluate(pose, obstacles, [&](double r, const PoseGradient& g) { rows.add(r, {{0, g}}); });
    return rows;
  });
}

TEST(BandCosts, ViaPointsHaveTheDerivativesTheySay) {
  expectDerivativesEverywhere([](const Vector& x) {
    Rows rows;
    ViaPointCost{}.evaluate(poseIn(x, 0), {0.3, -0.2}, [&](double r, const PoseGradient& g) { rows.add(r, {{0, g}}); });
    return rows;
  });
}

TEST(BandOptimizer, TheRightSideIsMinusHalfTheGradientOfTheCost) {
  // cost = sum w r^2, right side = -sum w r dr/dx = -1/2 d cost/dx
  const std::vector<mrpt::math::TPoint2D> points = {{1.0, 0.3}, {2.0, -0.2}};
  ObstacleView obstacles;
  obstacles.build({points, {}, {}, nullptr}, {}, {-2, -3, 5, 3}, 0.8);
  BandProblem problem;
  problem.limits = lowLimits();
  problem.obstacles = &obstacles;
  BandOptimizer optimizer({}, {});
  Band band;
  Random random(3);
  for (int k = 0; k < 7; ++k)
    band.push_back(
        {0.5 * k + random.uniform(-0.1, 0.1), random.uniform(-0.2, 0.2), random.uniform(-0.3, 0.3), 0.6 * k});
  optimizer.assemble(problem, band);
  const BlockBandedSystem system = optimizer.system();
  for (int k = 1; k < 6; ++k)
    for (int i = 0; i < 4; ++i) {
      const auto costAt = [&](double off) {
        Band moved = band;
        BandPose& p = moved[static_cast<size_t>(k)];
        (i == 0 ? p.x : i == 1 ? p.y : i == 2 ? p.theta : p.t) += off;
        return optimizer.assemble(problem, moved);
      };
      const double gradient = (costAt(1e-6) - costAt(-1e-6)) / 2e-6;
      EXPECT_NEAR(system.rhs(k - 1)[static_cast<size_t>(i)], -gradient / 2, 1e-3 * (1 + std::abs(gradient)))
          << "pose " << k << " variable " << i;
    }
}

}  // namespace
}  // namespace sidestep
