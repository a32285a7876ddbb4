// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include "core/params.h"

namespace sidestep {

/// The social force model (Helbing & Molnar 1995); the defaults are its own values.
struct SocialForceParams {
  double relax_s = 0.5;              ///< tau of (2)
  double people_v0 = 2.1;            ///< V0 of (13) [m^2/s^2]
  double people_sigma_m = 0.3;       ///< sigma of (13)
  double look_ahead_s = 2;           ///< Delta t of (4)
  double walls_u0 = 10;              ///< U0 of (13) [m^2/s^2]
  double walls_range_m = 0.2;        ///< R of (13)
  double view = 1.7453292519943295;  ///< phi of (8), half of the field of view [rad]
  double behind = 0.5;               ///< c of (8), weight of what is not seen
  double speed_limit = 1.3;          ///< by the desired speed, (10)
  double group_pull = 1;     ///< pull of the group's centre [m/s^2] (Moussaid 2010, beta_2 of his (5), which is 3)
  double fluctuation = 0.1;  ///< sd of a random acceleration that stays alike for relax_s [m/s^2]

  void visit(ParamVisitor& v);
  /// Farther away nobody is felt [m].
  double reach(double speed) const { return speed * look_ahead_s + 6 * people_sigma_m; }
};

/// Repulsion -grad V(b) of a person by another (3)-(4), b the small half-axis of the ellipse through the person whose
/// foci are the other and where the other will be after `look_ahead_s`. [m/s^2]
/// @param r  from the other to the person [m]
/// @param u  velocity of the other [m/s]
/// @param wider_m  by which the two are wider together than two persons [m]
mrpt::math::TPoint2D repulsion(const SocialForceParams& p, const mrpt::math::TPoint2D& r, const mrpt::math::TPoint2D& u,
                               double wider_m = 0);

/// Repulsion by a wall whose nearest point is `r` away, pointing from there to the person (5). [m/s^2]
mrpt::math::TPoint2D wallRepulsion(const SocialForceParams& p, const mrpt::math::TPoint2D& r);

/// Weight (8) of a force f on somebody who walks towards `heading` (a unit vector).
double viewWeight(const SocialForceParams& p, const mrpt::math::TPoint2D& heading, const mrpt::math::TPoint2D& f);

}  // namespace sidestep
