// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/social_force.h"

#include <algorithm>
#include <cmath>

namespace sidestep {

void SocialForceParams::visit(ParamVisitor& v) {
  v.number("relax_s", relax_s, {0.01, 10}, "s", "time to reach the desired velocity");
  v.number("people_v0", people_v0, {0, 1000}, "m^2/s^2", "repulsion of people");
  v.number("people_sigma_m", people_sigma_m, {0.01, 10}, "m", "its range");
  v.number("look_ahead_s", look_ahead_s, {0, 10}, "s", "how far ahead others' steps are kept clear");
  v.number("walls_u0", walls_u0, {0, 1000}, "m^2/s^2", "repulsion of walls");
  v.number("walls_range_m", walls_range_m, {0.01, 10}, "m", "its range");
  v.angle("view_deg", view, {0, 180}, "half of the field of view");
  v.number("behind", behind, {0, 1}, "", "weight of what is not seen");
  v.number("speed_limit", speed_limit, {1, 5}, "", "largest speed by the desired one");
  v.number("group_pull", group_pull, {0, 100}, "m/s^2", "pull towards the centre of one's group");
  v.number("fluctuation", fluctuation, {0, 10}, "m/s^2", "sd of a random acceleration");
}

mrpt::math::TPoint2D repulsion(const SocialForceParams& p, const mrpt::math::TPoint2D& r, const mrpt::math::TPoint2D& u,
                               double wider_m) {
  const double sx = u.x * p.look_ahead_s, sy = u.y * p.look_ahead_s;
  const double d1 = std::sqrt(r.x * r.x + r.y * r.y), qx = r.x - sx, qy = r.y - sy;
  const double d2 = std::sqrt(qx * qx + qy * qy), sum = d1 + d2;
  const double b = 0.5 * std::sqrt(std::max(0.0, sum * sum - sx * sx - sy * sy));
  if (d1 < 1e-9 || d2 < 1e-9 || b < 1e-6) return {0, 0};  // on the line between the foci no side is better
  // grad b = (d1 + d2) / (4 b) (r / d1 + (r - s) / d2)
  const double size = p.people_v0 / p.people_sigma_m * std::exp((wider_m - b) / p.people_sigma_m) * sum / (4 * b);
  return {size * (r.x / d1 + qx / d2), size * (r.y / d1 + qy / d2)};
}

mrpt::math::TPoint2D wallRepulsion(const SocialForceParams& p, const mrpt::math::TPoint2D& r) {
  const double d = std::hypot(r.x, r.y);
  if (d < 1e-9) return {0, 0};
  const double size = p.walls_u0 / p.walls_range_m * std::exp(-d / p.walls_range_m) / d;
  return {size * r.x, size * r.y};
}

double viewWeight(const SocialForceParams& p, const mrpt::math::TPoint2D& heading, const mrpt::math::TPoint2D& f) {
  // What pushes along -f stands in that direction.
  const double along = -(heading.x * f.x + heading.y * f.y);
  return along >= std::hypot(f.x, f.y) * std::cos(p.view) ? 1 : p.behind;
}

}  // namespace sidestep
