// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "localization/filters/particle_filter.h"
#include "localization/filters/pose_hypotheses.h"
#include "localization/filters/scan_model.h"

namespace sidestep {

/// Parameters of Monte Carlo localization.
struct MclParams {
  PfParams engine;
  ScanModelParams scan;
  double min_travel_m = 0.05;
  double min_turn = 0.02;  // rad
  double least_ess_share = 0.1;
  double candidates_per_m2 = 300;
  double travel_noise_scale = 1.5;
  double turn_noise_scale = 2.25;
  double slip_share = 0.1;
  double slip_m = 0.2;
  double slip_turn = 0.0872664625997164788;                    // rad
  double map_sd_m = 0.04, map_sd_turn = 0.008726646259971648;  // m, rad
  double average_slow = 0.02;
  double average_fast = 0.3;
  double recovery_share = 0.2;
  double recovery_below = 0.8;
  double recovery_gain = 12;
  double recovery_pause_s = 2;
  int rivals = 32;

  MclParams();
  void visit(ParamVisitor& v);
};

/// Monte Carlo localization (Dellaert et al. 1999; Thrun, Burgard & Fox 2005, chapter 8) on the engine of the particle
/// filter: whatever that takes, and laser scans against a map.
///
/// Where the start is unknown, a dense lattice of poses drawn over all free space is weighed by the first scan and the
/// particles are drawn from it. A scan that would leave fewer than `least_ess_share` effective particles is taken with
/// a smaller exponent, so that no single scan decides among many places. Other places are followed along
/// (PoseHypotheses); when one of them fits better over some way, a share of the particles is drawn anew from there. A
/// scan is used only once the robot has moved: the same view again says nothing new.
class Mcl final : public ParticleFilter {
 public:
  /// @param global  `start`'s belief is not to be trusted: the robot may be anywhere on the map
  Mcl(const MclParams& params, uint64_t seed, std::shared_ptr<const ScanModel> model, bool global);
  void start(const PoseBelief& belief) override;
  void predict(const MotionStep& motion) override;
  Correction correct(const Measurement& measurement) override;
  /// Of the heaviest mode; the covariance is of all particles about it, and of the map's errors.
  PoseBelief estimate() const override;
  std::optional<double> lostProbability() const override;
  /// What that probability rests on.
  struct Signs {
    double beyond = 0;     ///< weight of the particles farther than 1 m from the estimate
    double explained = 0;  ///< share of the beams that end near an obstacle, averaged over the last scans
    double evidence = 0;   ///< for the best rival, as a logarithm of odds
    double through = 0;    ///< share of the beams that went through walls, averaged likewise
    double scans = 0;      ///< used since the start
  };
  Signs signs() const;
  void save(std::vector<double>& out) const override;
  void restore(const std::vector<double>& state) override;

 private:
  PoseBelief heaviest() const;
  Correction correctScan(const Measurement& m);
  void jitter();
  double temper() const;
  size_t candidateCount(double per_m2, size_t least, double most) const;
  void drawFrom(const Candidates& c, size_t first, size_t count);
  void watch(const Measurement& m, double fit, double news);
  bool inEarnest(double time_s, size_t count);
  ScanModel::Judgement judgeHere(const mrpt::math::TPose2D& here, const Scan& scan) const;
  void recover(size_t count);
  double shareBeyond(const mrpt::math::TPose2D& mean, double distance_m) const;

  struct Memory {                 // all of it plain numbers: they are saved
    double anywhere = 0;          // 1: the robot may be anywhere, no scan has come yet
    double travel = 0, turn = 0;  // since the last scan in use
    double slow = 0, fast = 0;    // averages of the beams' mean likelihood
    double explained = 1;         // average share of beams that the map explains
    double scans = 0;
    double looked_s = 0;    // when other places were last looked for
    double through = 0;     // average share of beams that the map forbids
    double news = 0;        // what has been new in the views since the rivals were compared
    double searched_s = 0;  // when all the map was searched
  };
  MclParams mcl_;
  std::shared_ptr<const ScanModel> model_;
  bool global_;
  Memory memory_;
  PoseHypotheses hypotheses_;
  mutable std::optional<PoseBelief> estimate_;  // until something changes
  Eigen::ArrayXd log_likelihood_;
};

std::unique_ptr<PoseFilter> makeMcl(const MclParams& params, uint64_t seed, std::shared_ptr<const ScanModel> model,
                                    bool global);

}  // namespace sidestep
