// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>

#include "planning/band/band_optimizer.h"
#include "planning/band/band_start.h"
#include "planning/band/evasion.h"
#include "planning/band/field_islands.h"
#include "planning/band/gap_graph.h"
#include "planning/band/local_goal.h"
#include "planning/band/signature.h"
#include "planning/band/space_time_search.h"
#include "planning/band/trajectory_check.h"
#include "planning/local_planner.h"
#include "planning/velocity/hrvo.h"

namespace sidestep {

/// How moving obstacles are seen, and which candidate is chosen: what tells TEB, PTEB and ETEB apart.
struct BandViewParams {
  std::string obstacles = "now";   ///< now: TEB, PTEB; as_printed, in_time: ETEB
  double predicted_after_s = 1.0;  ///< as_printed: how far ahead the one predicted position lies
  double prediction_horizon_s = 30;
  double sigmas = 0.5;
  double widening_max_m = 0.15;
  bool heading_of_hrvo = false;  ///< PTEB: candidates pay for leaving the direction of the HRVO model (4.10)

  void visit(ParamVisitor& v);
  MovingView movingView() const;
};

struct SelectionParams {
  double hysteresis = 0.1;          ///< share by which another class must be cheaper than the last one
  double clearance_share = 0.05;    ///< of the band's clearance cost that counts in the choice (2.40)
  double delta_hrvo = 15;           ///< of (4.10); table 4.4 has 0.5, for costs of another size
  bool hrvo_speed = true;           ///< PTEB: no faster than the HRVO model
  double goal_tolerance_m = 0.1;    ///< the goal is reached
  double goal_tolerance_rad = 0.1;  ///< where its heading matters
  double horizon_m = 8;             ///< of a band along a global path
  double oscillation_s = 4;         ///< in which class and turning direction are watched

  void visit(ParamVisitor& v);
};

struct BandPlannerParams {
  BandWeights weights;
  BandParams band;
  ExplorationParams exploration;
  BandViewParams view;
  SelectionParams selection;
  CheckParams check;
  EvasionParams evasion;
  FootprintParams footprint;
  HrvoParams hrvo;

  void visit(ParamVisitor& v);
};

/// Parameters of `teb`, `pteb`, `eteb`, `eteb-printed`, `pteb+eteb`.
/// @throws ConfigError for another word
BandPlannerParams bandPlannerParams(const std::string& planner);
const std::vector<std::string>& bandPlannerNames();
/// One of them: the name says how moving obstacles are seen and whether the HRVO model has a say; the rest is common to
/// all bands.
std::unique_ptr<LocalPlanner> makeBandPlanner(BandPlannerParams params, const std::string& planner);

/// Runs f(0) .. f(n - 1), in any order, at the same time if it can.
using ParallelFor = std::function<void(int n, const std::function<void(int)>& f)>;

/// One band of the pool: a class.
struct BandCandidate {
  Band band;
  BandEnds ends;
  uint64_t signature = 0;
  mrpt::math::TPoint2D beside;  ///< zeta_p of (4.8)
  std::array<double, kBandTerms> shares{};
  double heading = 0;  ///< share of (4.10)
  double total = 0;    ///< what is compared: (2.40), or (4.10)
  BandOptimizer::Result result;
  CheckResult whole;
  const char* rejected = "";
  int touching = 0;  ///< plans in a row in which the band touches something
  bool alive = false, fresh = false, chosen = false;
};

/// The timed elastic band planner: algorithms 2 (TEB), 6 (PTEB) and 7 (ETEB).
///
/// A pool of bands, one a class, is kept from plan to plan. Each plan prunes them to where the robot is, adds classes
/// that the gap graph finds and the pool lacks, optimizes all, and chooses the cheapest, the last choice having an
/// advantage. What leaves is checked: the first second of the chosen band and braking after it must be clear, else
/// the next band is tried, and if none is left the robot brakes along the last checked band and says why.
class BandPlanner final : public LocalPlanner {
 public:
  explicit BandPlanner(const BandPlannerParams& params);

  void plan(const PlanInput& input, PlanOutput& out) override;
  void reset() override;
  /// The bands of a plan may be optimized side by side; the result is the same. Empty: one after the other.
  void useThreads(ParallelFor run) { run_ = std::move(run); }

  /// The bands of the last plan, for pictures and tests; those that are `alive`.
  const std::vector<BandCandidate>& candidates() const { return pool_; }
  const BandCandidate* chosen() const;

 private:
  struct Worker {
    explicit Worker(const BandPlannerParams& p) : optimizer(p.weights, p.band) {}
    void reserve(size_t poses) {
      spare.reserve(poses);
      optimizer.reserve(poses);
    }
    BandOptimizer optimizer;
    SignatureReader signature;
    Band spare;
  };

  /// A band that waits, lets pass or goes round, before it is optimized.
  struct TimedBand {
    Band band;
    mrpt::math::TPoint2D beside;
  };
  static constexpr size_t kTimedMost = 32;

  bool answeredAtDoor(const PlanInput& input, PlanOutput& out);
  void look(const PlanInput& input);
  void carryOver(const PlanInput& input);
  bool prune(const PlanInput& input, double elapsed, BandCandidate& c);
  void explore(const PlanInput& input);
  void exploreAt(double pace, int most, const PlanInput& input);
  void addAlong(std::span<const mrpt::math::TPoint2D> way, const mrpt::math::TPoint2D& beside, double pace,
                const PlanInput& input);
  BandCandidate* freeSlot();
  void optimizeAll(const PlanInput& input);
  void optimizeOne(const PlanInput& input, Worker& worker, BandCandidate& c);
  void examine(Worker& worker, BandCandidate& c);
  void rescue(const PlanInput& input);
  bool keepToTheGraph(const PlanInput& input);
  bool letPass(const PlanInput& input);
  void timeWays(const PlanInput& input, double keep_out);
  void timeWay(std::span<const mrpt::math::TPoint2D> way, const mrpt::math::TPoint2D& beside, double keep_out,
               const PlanInput& input);
  bool searchInTime(const PlanInput& input);
  bool place(BandCandidate& c);
  bool goalIsFree() const;
  bool becomesClear(const PlanInput& input, const TimedBand& timed);
  void tryQuickest(const PlanInput& input, Worker& worker, BandCandidate& c);
  void judge(const PlanInput& input);
  void dropTwins();
  std::optional<mrpt::math::TPoint2D> hrvoVelocity(const PlanInput& input);
  double angleToAdvice(const PlanInput& input, const BandCandidate& c) const;
  mrpt::math::TTwist2D slowedByAdvice(const TrajectorySpeed& wanted) const;
  void choose(const PlanInput& input, PlanOutput& out);
  void follow(const PlanInput& input, BandCandidate& c, PlanOutput& out);
  bool evade(const PlanInput& input, bool only_if_clear, PlanOutput& out);
  void brake(const PlanInput& input, PlanOutput& out);
  void watchOscillation(const PlanInput& input, const BandCandidate& c, PlanOutput& out);
  void explainTo(PlanOutput& out) const;
  uint64_t classOf(SignatureReader& reader, const Band& band) const;

  BandPlannerParams params_;
  ObstacleView view_;
  GapGraph graph_;
  FieldIslands islands_;
  SpaceTimeSearch search_;
  GridBounds bounds_;
  BandMaker maker_;
  Evasion evasion_;
  Hrvo hrvo_;
  std::optional<mrpt::math::TPoint2D> advice_;  ///< of the HRVO model in this plan [m/s, map axes]
  std::vector<Worker> workers_;
  std::vector<BandCandidate> pool_;
  std::vector<TimedBand> timed_;
  size_t timed_count_ = 0;
  std::vector<mrpt::math::TPoint2D> bow_;
  BandCandidate passing_;
  double rescue_again_ = -1e9, rescue_wait_s_ = 0.25;  ///< when it is worth trying again
  std::vector<size_t> order_;
  std::vector<TrajectoryPoint> driven_;
  LocalGoal goal_;
  GoalFrame frame_;
  double reach_m_ = 0;  ///< farthest that the view is asked
  BandProblem problem_;
  Band fresh_, checked_;
  BandEnds checked_ends_;
  double checked_time_ = 0, last_time_ = 0;
  mrpt::math::TPose2D last_goal_;
  bool started_ = false;
  double sign_changed_[4] = {-1e9, -1e9, -1e9, -1e9}, class_changed_[4] = {-1e9, -1e9, -1e9, -1e9};
  double last_turn_ = 0, steady_until_ = -1e9;
  ParallelFor run_;
};

}  // namespace sidestep
