// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/obstacles.h"
#include "simulation/world_params.h"

namespace sidestep {

/// What is wrong with a world before it runs.
struct WorldProblem {
  std::string key;   ///< where it stands in the scenario: "robots.robot.goal_x_m"
  std::string what;  ///< a plain sentence
};

/// Looks for who overlaps whom or a wall at the start, and for goals to which no way leads. What chance decides (spread
/// starts and goals, routes) is not looked at, nor are people who walk straight whatever is in the way.
/// @param map_walls  of the world's map, besides those of the parameters
std::vector<WorldProblem> findProblems(const WorldParams& world, std::span<const Segment> map_walls);

/// A line a problem, "file:line: key: what"; the line is that of the key or of the nearest group around it.
std::string describe(const std::vector<WorldProblem>& problems, const std::string& file, const std::string& yaml);

/// Names of walls, robots and people in `set` must be those of the scenario, or plainly new ones.
/// @param set   YAML laid over `known`
/// @param name  stands for the text in messages
/// @throws ConfigError with line and the name that was probably meant
void checkNewNames(const std::string& set, const std::string& name, const WorldParams& known);

/// A file with walls, robots or people but without a kind.
/// @throws ConfigError with line
void checkKind(const std::string& yaml, const std::string& file);

}  // namespace sidestep
