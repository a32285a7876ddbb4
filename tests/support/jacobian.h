// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

namespace sidestep::support {

/// df/dx by central differences; the error is of order step^2 f'''.
template <class Function>
Eigen::MatrixXd centralDifferences(const Function& f, const Eigen::VectorXd& x, double step = 1e-5) {
  const Eigen::VectorXd at = f(x);
  Eigen::MatrixXd J(at.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Eigen::VectorXd ahead = x, behind = x;
    ahead(i) += step;
    behind(i) -= step;
    J.col(i) = (f(ahead) - f(behind)) / (2 * step);
  }
  return J;
}

}  // namespace sidestep::support
