// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/degrade_script.h"

#include "core/errors.h"

namespace sidestep {

void DegradeEvent::visit(ParamVisitor& v) {
  v.text("label", label, "of the observations that suffer, or a kind (gps, imu, ...): all of that kind");
  v.choice(
      "do", action, {"drop", "thin", "delay", "freeze", "bias", "spike", "noise", "jump"},
      "lose, keep every n-th, stamp late, repeat the last value, add a constant, add outliers, add noise; jump: cut "
      "from_s to to_s out of the whole log and close the gap, as if the robot had been carried");
  v.choice("components", components, {"all", "xy", "theta", "rate"}, "which part of the reading");
  v.number("from_s", from_s, {0, 1e9}, "s", "begins so long after the log's first stamp");
  v.number("to_s", to_s, {0, 1e9}, "s", "and ends");
  v.text("zone", zone, "only while the robot is in this zone; empty: everywhere");
  v.number("probability", probability, {0, 1}, "", "drop, spike: of each observation");
  v.integer("keep_every", keep_every, {1, 1e6}, "thin: one of so many stays");
  v.number("delay_s", delay_s, {0, 3600}, "s", "delay: stamps are so much later than what was sensed");
  v.number("x_m", x_m, {-1e6, 1e6}, "m", "bias");
  v.number("y_m", y_m, {-1e6, 1e6}, "m", "bias");
  v.angle("theta_deg", theta, {-360, 360}, "bias");
  v.angle("rate_deg", rate, {-1000, 1000}, "bias of the yaw rate (deg/s)");
  v.number("spike_m", spike_m, {0, 1e6}, "m", "spike: how far off, in a random direction");
  v.angle("spike_deg", spike_theta, {0, 180}, "spike: how far off, to a random side");
  v.number("sd_m", sd_m, {0, 1e6}, "m", "noise: sd of x and of y as it is");
  v.angle("sd_deg", sd_theta, {0, 180}, "noise: sd of the heading as it is");
  v.angle("sd_rate_deg", sd_rate, {0, 1000}, "noise: sd of the yaw rate as it is (deg/s)");
  v.number("noise_scale", noise_scale, {1, 1000}, "", "noise: sd becomes so many times that");
}

/// By the crossings of a ray to the right.
bool Zone::contains(const mrpt::math::TPoint2D& p) const {
  bool inside = false;
  for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const auto &a = corners[i], &b = corners[j];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

void DegradeScript::visit(ParamVisitor& v) {
  v.integer("seed", seed, {0, 2e9}, "of the random numbers");
  v.choice("pose_from", pose_from, {"auto", "truth", "odometry"},
           "where the robot is, for zones; auto: truth once the log has shown some");
  v.number("start_x_m", start_x_m, {-1e7, 1e7}, "m", "odometry's origin in the map, for zones");
  v.number("start_y_m", start_y_m, {-1e7, 1e7}, "m", "odometry's origin in the map, for zones");
  v.angle("start_yaw_deg", start_yaw, {-360, 360}, "odometry's origin in the map, for zones");
  v.groups("zones", zone_names, "places, by name", [this](const std::string& name, ParamVisitor& w) {
    Zone& zone = zones[name];
    Table rows;
    for (const auto& c : zone.corners) rows.push_back({c.x, c.y});
    w.table("polygon", {"x", "y"}, rows, "corners in the map [m]");
    zone.corners.clear();
    for (const auto& row : rows) zone.corners.emplace_back(row[0], row[1]);
  });
  v.groups("events", event_names, "what goes wrong, by name, done in this order",
           [this](const std::string& name, ParamVisitor& w) { events[name].visit(w); });
}

void DegradeScript::check() const {
  for (const auto& name : zone_names)
    if (zones.at(name).corners.size() < 3)
      throw ConfigError("zones." + name + ".polygon: has fewer than three corners");
  for (const auto& name : event_names) {
    const DegradeEvent& e = events.at(name);
    if (e.action == "jump") {
      if (!e.label.empty() || !e.zone.empty())
        throw ConfigError("events." + name + ": jump cuts the whole log; leave out label and zone");
      if (!(e.from_s < e.to_s && e.to_s < 1e9)) throw ConfigError("events." + name + ": jump needs from_s < to_s");
      continue;
    }
    if (e.label.empty()) throw ConfigError("events." + name + ".label: is missing; name the observations that suffer");
    if (e.to_s < e.from_s) throw ConfigError("events." + name + ".to_s: lies before from_s");
    if (e.zone.empty() || zones.contains(e.zone)) continue;
    const auto near = nearestWord(e.zone, zone_names);
    throw ConfigError("events." + name + ".zone = " + e.zone + ": no such zone" +
                      (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
}

}  // namespace sidestep
