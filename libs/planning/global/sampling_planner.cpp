// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/sampling_planner.h"

#include <ompl/base/goals/GoalState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/samplers/informed/RejectionInfSampler.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.h"
#include "planning/global/planning_grid.h"
#include "planning/global/taut_path.h"

namespace sidestep {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

struct Kind {
  ob::PlannerPtr (*make)(const ob::SpaceInformationPtr&);
  bool improves;  ///< goes on after the first path
};

template <typename Planner>
ob::PlannerPtr make(const ob::SpaceInformationPtr& space) {
  return std::make_shared<Planner>(space);
}

const std::map<std::string, Kind>& kinds() {
  static const std::map<std::string, Kind> table = {{"rrtconnect", {make<og::RRTConnect>, false}},
                                                    {"rrtstar", {make<og::RRTstar>, true}},
                                                    {"informed-rrtstar", {make<og::InformedRRTstar>, true}},
                                                    {"bitstar", {make<og::BITstar>, true}},
                                                    {"prmstar", {make<og::PRMstar>, true}},
                                                    {"kpiece", {make<og::KPIECE1>, false}}};
  return table;
}

TPose2D poseOf(const ob::State* state) {
  const auto* s = state->as<ob::SE2StateSpace::StateType>();
  return {s->getX(), s->getY(), s->getYaw()};
}

ob::StateSpacePtr makeSpace(const SamplingParams& params, const GridFrame& frame) {
  std::shared_ptr<ob::SE2StateSpace> space;
  if (params.space == "dubins")
    space = std::make_shared<ob::DubinsStateSpace>(params.turning_radius_m);
  else if (params.space == "reeds-shepp")
    space = std::make_shared<ob::ReedsSheppStateSpace>(params.turning_radius_m);
  else
    space = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds bounds(2);
  for (unsigned axis = 0; axis < 2; ++axis) bounds.low[axis] = 1e300, bounds.high[axis] = -1e300;
  for (const int ix : {-1, frame.width})
    for (const int iy : {-1, frame.height}) {
      const auto corner = frame.centre(ix, iy);
      for (unsigned axis = 0; axis < 2; ++axis) {
        bounds.low[axis] = std::min(bounds.low[axis], axis == 0 ? corner.x : corner.y);
        bounds.high[axis] = std::max(bounds.high[axis], axis == 0 ? corner.x : corner.y);
      }
    }
  space->setBounds(bounds);
  return space;
}

/// A motion is cut into chords, each of which must keep the clearance; the path that is handed out has the same chords.
class Chords final : public ob::MotionValidator {
 public:
  Chords(const ob::SpaceInformationPtr& si, const DistanceField& field, double clearance_m, bool arcs)
      : ob::MotionValidator(si), field_(field), clearance_m_(clearance_m), arcs_(arcs), state_(si->allocState()) {}
  ~Chords() override { si_->freeState(state_); }

  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    if (!arcs_) return sees(poseOf(a), poseOf(b));
    return free(a, b, count(a, b)) == count(a, b);
  }
  bool checkMotion(const ob::State* a, const ob::State* b, std::pair<ob::State*, double>& last) const override {
    const int n = count(a, b), good = free(a, b, n);
    if (good == n) return true;
    last.second = static_cast<double>(good) / n;
    if (last.first != nullptr) si_->getStateSpace()->interpolate(a, b, last.second, last.first);
    return false;
  }
  /// Ends of the chords after `a`.
  void append(const ob::State* a, const ob::State* b, std::vector<TPose2D>& out) const {
    const int n = arcs_ ? count(a, b) : 1;
    for (int i = 1; i <= n; ++i) out.push_back(at(a, b, i, n));
  }

 private:
  int count(const ob::State* a, const ob::State* b) const {
    const auto p = poseOf(a), q = poseOf(b);
    const double length = arcs_ ? si_->getStateSpace()->distance(a, b) : std::hypot(p.x - q.x, p.y - q.y);
    return std::max(1, static_cast<int>(std::ceil(length / field_.frame().resolution_m)));
  }
  TPose2D at(const ob::State* a, const ob::State* b, int i, int n) const {
    if (i == n) return poseOf(b);
    si_->getStateSpace()->interpolate(a, b, static_cast<double>(i) / n, state_);
    return poseOf(state_);
  }
  int free(const ob::State* a, const ob::State* b, int n) const {
    TPose2D before = poseOf(a);
    for (int i = 1; i <= n; ++i) {
      const TPose2D next = at(a, b, i, n);
      if (!sees(before, next)) return i - 1;
      before = next;
    }
    return n;
  }
  bool sees(const TPose2D& a, const TPose2D& b) const { return field_.visible({a.x, a.y}, {b.x, b.y}, clearance_m_); }

  const DistanceField& field_;
  double clearance_m_;
  bool arcs_;
  ob::State* state_;
};

/// Path length, with informed samples also in spaces that OMPL knows no ellipse for.
class Length final : public ob::PathLengthOptimizationObjective {
 public:
  using PathLengthOptimizationObjective::PathLengthOptimizationObjective;
  ob::InformedSamplerPtr allocInformedStateSampler(const ob::ProblemDefinitionPtr& problem,
                                                   unsigned int max_calls) const override {
    if (si_->getStateSpace()->getType() == ob::STATE_SPACE_SE2)
      return PathLengthOptimizationObjective::allocInformedStateSampler(problem, max_calls);
    return std::make_shared<ob::RejectionInfSampler>(problem, max_calls);
  }
};

class SamplingPlanner final : public GlobalPlanner {
 public:
  SamplingPlanner(const Kind& kind, std::shared_ptr<const PlanningGrid> grid, const SamplingParams& params)
      : kind_(kind), grid_(std::move(grid)), params_(params), arcs_(params.space != "se2") {}

  GlobalPath plan(const TPose2D& start, const TPose2D& goal) override {
    const auto ends = grid_->ends(start, goal);
    if (!ends.ok) return ends.refusal;
    ompl::msg::noOutputHandler();
    ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(params_.seed) + 1);
    const auto space = makeSpace(params_, grid_->field().frame());
    const auto si = std::make_shared<ob::SpaceInformation>(space);
    const auto chords = std::make_shared<Chords>(si, grid_->field(), grid_->clearance(), arcs_);
    si->setStateValidityChecker([this](const ob::State* s) {
      const auto p = poseOf(s);
      return grid_->field().clearance(p.x, p.y) >= grid_->clearance() - 1e-9;
    });
    si->setMotionValidator(chords);
    si->setup();
    const auto problem = makeProblem(si, start, goal);
    const auto planner = kind_.make(si);
    planner->setProblemDefinition(problem);
    planner->setup();
    planner->solve(termination());
    return result(*problem, si, *chords, goal);
  }

 private:
  ob::PlannerTerminationCondition termination() const {
    const auto timed = ob::timedPlannerTerminationCondition(params_.time_s);
    if (params_.iterations <= 0) return timed;
    const auto counted = std::make_shared<ob::IterationTerminationCondition>(static_cast<unsigned>(params_.iterations));
    return ob::PlannerTerminationCondition([timed, counted] { return counted->eval() || timed(); });
  }
  ob::ProblemDefinitionPtr makeProblem(const ob::SpaceInformationPtr& si, const TPose2D& start,
                                       const TPose2D& goal) const {
    const auto problem = std::make_shared<ob::ProblemDefinition>(si);
    ob::ScopedState<ob::SE2StateSpace> from(si), to(si);
    from->setXY(start.x, start.y), from->setYaw(start.phi);
    to->setXY(goal.x, goal.y), to->setYaw(goal.phi);
    problem->setStartAndGoalStates(from, to);
    problem->setOptimizationObjective(std::make_shared<Length>(si));
    return problem;
  }
  GlobalPath result(const ob::ProblemDefinition& problem, const ob::SpaceInformationPtr& si, const Chords& chords,
                    const TPose2D& goal) const {
    GlobalPath out;
    if (!problem.hasExactSolution()) {
      out.status = GlobalPath::Status::kTimeOver;
      out.reason = "no path was found in the time allowed; give more, or another planner";
      return out;
    }
    auto& path = *problem.getSolutionPath()->as<og::PathGeometric>();
    if (arcs_ && !kind_.improves) og::PathSimplifier(si).reduceVertices(path);
    out.status = GlobalPath::Status::kFound;
    out.poses = {poseOf(path.getState(0))};
    for (unsigned i = 1; i < path.getStateCount(); ++i)
      chords.append(path.getState(i - 1), path.getState(i), out.poses);
    if (!arcs_) straighten(out, goal);
    out.cost = pathLength(out.poses);
    return out;
  }
  void straighten(GlobalPath& out, const TPose2D& goal) const {
    std::vector<TPoint2D> points;
    for (const auto& p : out.poses) points.emplace_back(p.x, p.y);
    if (!kind_.improves) pullTaut(grid_->field(), grid_->clearance(), points);
    out.poses = posesAlong(points, goal.phi);
  }

  Kind kind_;
  std::shared_ptr<const PlanningGrid> grid_;
  SamplingParams params_;
  bool arcs_;
};

}  // namespace

void SamplingParams::visit(ParamVisitor& v) {
  v.choice("space", space, {"se2", "dubins", "reeds-shepp"},
           "straight lines with turns on the spot, or arcs: forwards only, or also backwards");
  v.number("turning_radius_m", turning_radius_m, {0.01, 100}, "m", "of dubins and reeds-shepp");
  v.number("time_s", time_s, {0.001, 3600}, "s", "allowed for a path; planners that improve their path use all of it");
  v.integer("iterations", iterations, {0, 2e9},
            "end after so many looks at the clock instead; 0: only the time counts");
  v.integer("seed", seed, {0, 2e9}, "of the random numbers");
}

const std::vector<std::string>& samplingPlanners() {
  static const std::vector<std::string> words = {"rrtconnect", "rrtstar", "informed-rrtstar",
                                                 "bitstar",    "prmstar", "kpiece"};
  return words;
}

std::string refusesSpace(const std::string& word, const std::string& space) {
  if (space != "dubins") return "";
  if (word == "prmstar")
    return "prmstar cannot plan in the space dubins, as its roadmap knows no directions; take reeds-shepp";
  if (word == "bitstar" || word == "informed-rrtstar")  // OMPL 1.5.2 ends by an assertion
    return word + " cannot plan in the space dubins, as its samples know no directions; take reeds-shepp";
  return "";
}

std::unique_ptr<GlobalPlanner> makeSamplingPlanner(const std::string& word, std::shared_ptr<const PlanningGrid> grid,
                                                   const SamplingParams& params) {
  const auto kind = kinds().find(word);
  if (kind == kinds().end()) {
    const auto near = nearestWord(word, samplingPlanners());
    throw ConfigError("'" + word + "' is no planner" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  if (const auto why = refusesSpace(word, params.space); !why.empty()) throw ConfigError(why);
  return std::make_unique<SamplingPlanner>(kind->second, std::move(grid), params);
}

}  // namespace sidestep
