// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/ekf_smoothing.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>

namespace sidestep {
namespace {

constexpr int kMaxStates = 8;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxStates, kMaxStates>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxStates, 1>;

/// A P^-1 of a covariance that may have rows of zeros (what is known for sure), for which the result has zeros.
Square timesInverse(const Square& A, const Square& P) {
  const Column scale = P.diagonal().unaryExpr([](double v) { return v > 0 ? 1 / std::sqrt(v) : 0.0; });
  Square R = scale.asDiagonal() * P * scale.asDiagonal();
  R.diagonal() += scale.unaryExpr([](double v) { return v > 0 ? 1e-12 : 1.0; });
  const Square B = (A * scale.asDiagonal()).transpose();
  const Square X = R.ldlt().solve(B);
  return X.transpose() * scale.asDiagonal();
}

struct Belief {
  Column x;
  Square P;
  Belief(int n, const std::vector<double>& state)
      : x(Eigen::Map<const Eigen::VectorXd>(state.data(), n)),
        P(Eigen::Map<const Eigen::MatrixXd>(state.data() + n, n, n)) {}
  void into(std::vector<double>& state) const {
    Eigen::Map<Eigen::VectorXd>(state.data(), x.size()) = x;
    Eigen::Map<Eigen::MatrixXd>(state.data() + x.size(), x.size(), x.size()) = P;
  }
};

Column difference(const Column& a, const Column& b) {
  Column d = a - b;
  d(2) = mrpt::math::wrapToPi(d(2));
  return d;
}

}  // namespace

bool smoothStep(const Eigen::Map<const Eigen::MatrixXd>& F, const std::vector<double>& before,
                const std::vector<double>& after, std::vector<double>& smoothed) {
  const int n = static_cast<int>(F.cols());
  const Belief a(n, before), b(n, after);
  Belief s(n, smoothed);
  Square cross = a.P;  // P F'
  cross.leftCols(3).noalias() = a.P * F.transpose();
  const Square C = timesInverse(cross, b.P);
  const Column ahead = difference(s.x, b.x);
  s.x = a.x + C * ahead;
  s.x(2) = mrpt::math::wrapToPi(s.x(2));
  const Square gained = C * (s.P - b.P);
  s.P = a.P + gained * C.transpose();
  s.P = (0.5 * (s.P + s.P.transpose())).eval();
  if (!s.x.allFinite() || !s.P.allFinite()) return false;
  s.into(smoothed);
  return true;
}

void smoothReset(int n, const std::vector<double>& before, double opened, std::vector<double>& smoothed) {
  const Belief a(n, before);
  Belief s(n, smoothed);
  const Column ahead = difference(s.x, a.x);
  s.x = a.x + ahead / opened;
  s.x(2) = mrpt::math::wrapToPi(s.x(2));
  s.P = a.P + (s.P - opened * a.P) / (opened * opened);
  s.into(smoothed);
}

}  // namespace sidestep
