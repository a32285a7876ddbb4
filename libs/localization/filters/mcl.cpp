// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/mcl.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "localization/filters/fast_math.h"

namespace sidestep {
namespace {
constexpr size_t kMemorySize = 11;
constexpr double kLooksPerParticle = 2;       // candidates for rivals at a time, while nothing is amiss
constexpr double kComparedAfter = 0.25;       // share of a view that is new when rivals are compared with the estimate
constexpr double kCandidatesPerSecond = 1e5;  // of the log, while places are looked for in earnest for long
constexpr double kWide_m = 0.5;               // a cloud with a larger sd may be several places
constexpr double kMostCandidates = 1e7;
constexpr double kHere_m = 0.5;                     // particles nearer than this stand for the estimate
constexpr double kNewView_m = 0.5, kNewView = 0.5;  // way [m] or turn [rad] after which a view says all anew
constexpr double kLostPrior = 0.1;                  // weight of what is drawn anew
constexpr double kLeastExplained = 0.9;             // below it, other places are looked for in earnest

/// Logistic regression of "off by more than 1 m" on the log-odds of the particles that are farther than that from the
/// estimate, log(1 + evidence for a rival), the root of the share of beams through walls, and exp(-scans / 3). How much
/// a map explains is not among them: it differs from world to world (doc/laser-localization.md).
constexpr double kLost[5] = {-3.73, 0.18, 1.43, 9.97, 4.03};
}  // namespace

MclParams::MclParams() {
  engine.particles = 2000;
  engine.resampling.kld = true;
  engine.resampling.kld_min = 300;
}

void MclParams::visit(ParamVisitor& v) {
  engine.visit(v);
  v.section("scan", "how a scan is weighed", [this](ParamVisitor& w) { scan.visit(w); });
  v.number("min_travel_m", min_travel_m, {0, 100}, "m", "a scan is used after this much travel, or");
  v.angle("min_turn_deg", min_turn, {0, 180}, "this much turning");
  v.number("least_ess_share", least_ess_share, {0, 1}, "",
           "effective share of the particles that a scan must leave; else it counts for less");
  v.number("candidates_per_m2", candidates_per_m2, {1, 10000}, "1/m^2",
           "poses tried on each free square metre where the robot may be anywhere (ten million at most)");
  v.number("travel_noise_scale", travel_noise_scale, {0.01, 100}, "",
           "sd of the travel by odometry.noise: scans correct often, and too little noise costs more than too much");
  v.number("turn_noise_scale", turn_noise_scale, {0.01, 100}, "", "sd of the turns likewise");
  v.number("slip_share", slip_share, {0, 1}, "", "share of the particles that look farther around at each scan");
  v.number("slip_m", slip_m, {0, 10}, "m", "as far as this (sd), for wheels that slip");
  v.angle("slip_turn_deg", slip_turn, {0, 90}, "and turned by this");
  v.number("map_sd_m", map_sd_m, {0, 10}, "m",
           "sd of the map's own errors, which are the same for all particles; added to the covariance");
  v.angle("map_sd_deg", map_sd_turn, {0, 90}, "the same for the heading");
  v.number("average_slow", average_slow, {0.0001, 1}, "", "weight of a scan in the slow average of fit");
  v.number("average_fast", average_fast, {0.0001, 1}, "", "weight of a scan in the fast one");
  v.number("lost_share", recovery_share, {0, 0.9}, "",
           "share of the particles drawn anew when another place fits better");
  v.number("lost_below", recovery_below, {0, 1}, "",
           "places are looked for in earnest: fast average below this part of the slow one");
  v.number("lost_gain", recovery_gain, {0, 30}, "",
           "evidence for another place, as a logarithm of odds, at which particles are drawn anew there");
  v.number("lost_pause_s", recovery_pause_s, {0, 1000}, "s", "other places are looked for not more often than this");
  v.integer("rivals", rivals, {2, 10000}, "other places that are followed along, to tell whether the robot is lost");
}

Mcl::Mcl(const MclParams& params, uint64_t seed, std::shared_ptr<const ScanModel> model, bool global)
    : ParticleFilter(params.engine, seed),
      mcl_(params),
      model_(std::move(model)),
      global_(global),
      hypotheses_(static_cast<size_t>(params.rivals)) {
  log_likelihood_.resize(static_cast<Eigen::Index>(cloud_.capacity()));
}

void Mcl::start(const PoseBelief& belief) {
  estimate_.reset();
  ParticleFilter::start(belief);
  memory_ = Memory();
  hypotheses_.clear();
  if (!global_) return;
  memory_.anywhere = 1;
  cloud_.resize(cloud_.capacity());
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(cloud_.size()); ++i) {
    const auto p = model_->drawFree(random_);
    cloud_.x[i] = p.x;
    cloud_.y[i] = p.y;
    cloud_.yaw[i] = p.phi;
    cloud_.offset[i] = 0;
  }
  cloud_.equalWeights();
}

void Mcl::predict(const MotionStep& motion) {
  estimate_.reset();
  MotionStep wider = motion;
  wider.distance_var *= mcl_.travel_noise_scale * mcl_.travel_noise_scale;
  wider.turn_var *= mcl_.turn_noise_scale * mcl_.turn_noise_scale;
  ParticleFilter::predict(wider);
  if (motion.still || !std::isfinite(motion.distance_m) || !std::isfinite(motion.turn_rad)) return;
  hypotheses_.move(motion);
  memory_.travel += std::abs(motion.distance_m);
  memory_.turn += std::abs(motion.turn_rad);
}

Correction Mcl::correct(const Measurement& m) {
  estimate_.reset();
  return m.kind == Measurement::Kind::kScan ? correctScan(m) : ParticleFilter::correct(m);
}

Correction Mcl::correctScan(const Measurement& m) {
  if (!m.scan || m.scan->size() == 0) return {Correction::Reason::kNotFinite, 0, 0};
  const bool moved = memory_.travel >= mcl_.min_travel_m || memory_.turn >= mcl_.min_turn;
  // Where the robot may be anywhere, the first view counts again until it has counted once in full.
  const bool settling = global_ && memory_.scans * model_->weight() < 1;
  if (!moved && memory_.scans > 0 && !settling) return {Correction::Reason::kNothingNew, 0, 0};
  const double news = std::min(1.0, memory_.travel / kNewView_m + memory_.turn / kNewView);
  memory_.travel = memory_.turn = 0;
  ++memory_.scans;
  if (memory_.anywhere > 0) {
    memory_.anywhere = 0;
    const size_t count = candidateCount(mcl_.candidates_per_m2, cloud_.size(), kMostCandidates);
    drawFrom(Candidates::draw(*model_, *m.scan, count, random_), 0, cloud_.size());
    cloud_.equalWeights();
    return {};
  }
  jitter();
  model_->logLikelihoods(*m.scan, cloud_.x.data(), cloud_.y.data(), cloud_.yaw.data(), cloud_.size(),
                         log_likelihood_.data());
  const auto n = static_cast<Eigen::Index>(cloud_.size());
  const auto l = log_likelihood_.head(n);
  const double fit = (cloud_.weights() * l).sum();
  const double alpha = temper();
  likelihoods() = (alpha * (l - l.maxCoeff())).max(-700.0).exp();
  multiplyWeights(0);
  watch(m, fit, news);
  if (params_.resampling.each_step || degenerate()) resample();
  estimate_.reset();
  return {};
}

/// Wheels that slip and stamps that are off are no Gaussian noise: a few particles, spread evenly, look farther around.
void Mcl::jitter() {
  const auto every = static_cast<size_t>(mcl_.slip_share > 0 ? std::ceil(1 / mcl_.slip_share) : 0);
  if (every == 0) return;
  for (size_t k = random_.below(every); k < cloud_.size(); k += every) {
    const auto i = static_cast<Eigen::Index>(k);
    double g[3];
    random_.gaussians(g, 3);
    cloud_.x[i] += mcl_.slip_m * g[0];
    cloud_.y[i] += mcl_.slip_m * g[1];
    cloud_.yaw[i] = wrapAngle(cloud_.yaw[i] + mcl_.slip_turn * g[2]);
  }
}

/// The scan's exponent: `beam_weight`, or less if too few particles would be left.
double Mcl::temper() const {
  const auto n = static_cast<Eigen::Index>(cloud_.size());
  const auto l = log_likelihood_.head(n);
  const auto w = cloud_.weights();
  const double best = l.maxCoeff(), least = mcl_.least_ess_share * static_cast<double>(n);
  const auto ess = [&](double alpha) {
    double sum = 0, squares = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double v = w[i] * weightExp(alpha * (l[i] - best));
      sum += v;
      squares += v * v;
    }
    return squares > 0 ? sum * sum / squares : 0;
  };
  double high = model_->weight();
  if (ess(high) >= std::min(least, 0.5 * effectiveSampleSize(cloud_.weight.data(), cloud_.size()))) return high;
  double low = 0;
  for (int k = 0; k < 8; ++k) {
    const double middle = 0.5 * (low + high);
    (ess(middle) < least ? high : low) = middle;
  }
  return low;
}

size_t Mcl::candidateCount(double per_m2, size_t least, double most) const {
  return std::max(least, static_cast<size_t>(std::min(per_m2 * model_->freeArea(), most)));
}

/// Sets particles [first, first + count) to draws from the candidates by their fit, with an exponent that leaves some
/// of them for each.
void Mcl::drawFrom(const Candidates& c, size_t first, size_t count) {
  const auto total = c.fit.size();
  const double least = 0.5 * static_cast<double>(std::min(static_cast<size_t>(total), count));
  double low = 0, high = model_->weight();
  Eigen::ArrayXd w(total);
  const auto ess = [&](double alpha) {
    for (Eigen::Index i = 0; i < total; ++i) w[i] = weightExp(alpha * (c.fit[i] - c.best));
    w /= w.sum();
    return 1 / w.square().sum();
  };
  if (ess(high) < least) {
    for (int k = 0; k < 10; ++k) {
      const double middle = 0.5 * (low + high);
      (ess(middle) < least ? high : low) = middle;
    }
    ess(low);
  }
  Resampler resampler;
  std::vector<uint32_t> index(count);
  resampler.draw(ResamplingScheme::kSystematic, w.data(), static_cast<size_t>(total), count, random_, index.data());
  for (size_t k = 0; k < count; ++k) {
    const auto i = static_cast<Eigen::Index>(first + k), j = static_cast<Eigen::Index>(index[k]);
    cloud_.x[i] = c.x[j];
    cloud_.y[i] = c.y[j];
    cloud_.yaw[i] = c.yaw[j];
  }
}

/// How the scan goes with the estimate, or with a particle beside it that fits it better.
ScanModel::Judgement Mcl::judgeHere(const mrpt::math::TPose2D& here, const Scan& scan) const {
  Eigen::Index best = -1;
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(cloud_.size()); ++i)
    if (std::abs(cloud_.x[i] - here.x) < kHere_m && std::abs(cloud_.y[i] - here.y) < kHere_m &&
        (best < 0 || log_likelihood_[i] > log_likelihood_[best]))
      best = i;
  const auto mean = model_->judge(scan, here);
  if (best < 0) return mean;
  const auto other = model_->judge(scan, {cloud_.x[best], cloud_.y[best], cloud_.yaw[best]});
  return other.fit > mean.fit ? other : mean;
}

/// Is there a place that fits better, scan after scan? Then a share of the particles is drawn anew from there, as in
/// augmented MCL (Thrun, Burgard & Fox 2005, table 8.3), and what comes next decides. If none does, the map is at
/// fault.
/// @param fit   mean log-likelihood of the scan over the cloud
/// @param news  how much of the view is new, 0 .. 1
void Mcl::watch(const Measurement& m, double fit, double news) {
  auto& a = memory_;
  const double likelihood = std::exp(fit / static_cast<double>(m.scan->size()));
  const bool first = a.slow == 0;
  a.slow += (first ? 1 : mcl_.average_slow) * (likelihood - a.slow);
  a.fast += (first ? 1 : mcl_.average_fast) * (likelihood - a.fast);
  const auto here = estimate().mean;
  a.explained += mcl_.average_fast * (model_->explained(*m.scan, here) - a.explained);
  const auto judged = judgeHere(here, *m.scan);
  a.through += mcl_.average_fast * (judged.through - a.through);
  a.news += news;
  if (a.news >= kComparedAfter) {
    hypotheses_.compare(*model_, *m.scan, judged.fit, std::min(1.0, a.news) * model_->weight(), random_);
    a.news = 0;
  }
  if (m.time_s - a.looked_s < mcl_.recovery_pause_s) return;
  a.looked_s = m.time_s;
  const auto count = static_cast<size_t>(mcl_.recovery_share * static_cast<double>(cloud_.size()));
  if (count > 0 && hypotheses_.evidence(here) >= mcl_.recovery_gain) recover(count);
  const size_t thorough = candidateCount(mcl_.candidates_per_m2 / 10, 1, kMostCandidates);
  const auto light = static_cast<size_t>(kLooksPerParticle * params_.particles);
  const size_t looks = inEarnest(m.time_s, thorough) ? thorough : std::min(thorough, light);
  hypotheses_.renew(Candidates::draw(*model_, *m.scan, looks, random_), here);
}

/// Is it time to look for other places all over the map? Whenever the fit has become worse; and while the map explains
/// little, which may be the map's fault and last, less often the larger it is.
/// @param count  candidates that it would take
bool Mcl::inEarnest(double time_s, size_t count) {
  auto& a = memory_;
  const bool sudden = a.fast < mcl_.recovery_below * a.slow;
  const double pause_s = static_cast<double>(count) / kCandidatesPerSecond;
  if (!sudden && (a.explained >= kLeastExplained || time_s - a.searched_s < pause_s)) return false;
  a.searched_s = time_s;
  return true;
}

void Mcl::recover(size_t count) {
  makeRoom(count, kLostPrior);
  for (size_t k = cloud_.size() - count; k < cloud_.size(); ++k) {
    const auto p = hypotheses_.draw(random_);
    const auto i = static_cast<Eigen::Index>(k);
    cloud_.x[i] = p.x;
    cloud_.y[i] = p.y;
    cloud_.yaw[i] = p.phi;
  }
  estimate_.reset();
}

PoseBelief Mcl::estimate() const {
  if (!estimate_) estimate_ = heaviest();
  return *estimate_;
}

PoseBelief Mcl::heaviest() const {
  PoseBelief all = cloud_.belief();
  const double spread = all.covariance.topLeftCorner<2, 2>().trace();
  all.covariance.diagonal() += Eigen::Vector3d(mcl_.map_sd_m, mcl_.map_sd_m, mcl_.map_sd_turn).cwiseAbs2();
  if (spread < kWide_m * kWide_m) return all;
  const PoseMode mode = cloud_.densest(0.5, 0.35);
  const Eigen::Vector3d d(all.mean.x - mode.belief.mean.x, all.mean.y - mode.belief.mean.y,
                          wrapAngle(all.mean.phi - mode.belief.mean.phi));
  all.mean = mode.belief.mean;
  all.covariance += d * d.transpose();
  return all;
}

double Mcl::shareBeyond(const mrpt::math::TPose2D& mean, double distance_m) const {
  const auto n = static_cast<Eigen::Index>(cloud_.size());
  double share = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double dx = cloud_.x[i] - mean.x, dy = cloud_.y[i] - mean.y;
    if (dx * dx + dy * dy > distance_m * distance_m) share += cloud_.weight[i];
  }
  return share;
}

Mcl::Signs Mcl::signs() const {
  const auto here = estimate().mean;
  return {shareBeyond(here, 1), memory_.explained, hypotheses_.evidence(here), memory_.through, memory_.scans};
}

std::optional<double> Mcl::lostProbability() const {
  const Signs s = signs();
  const double beyond = std::clamp(s.beyond, 0.001, 0.999);
  const double z = kLost[0] + kLost[1] * std::log(beyond / (1 - beyond)) + kLost[2] * std::log1p(s.evidence) +
                   kLost[3] * std::sqrt(std::max(0.0, s.through)) + kLost[4] * std::exp(-s.scans / 3);
  return 1 / (1 + std::exp(-z));
}

void Mcl::save(std::vector<double>& out) const {
  ParticleFilter::save(out);
  hypotheses_.save(out);
  const auto& a = memory_;
  for (double v : {a.anywhere, a.travel, a.turn, a.slow, a.fast, a.explained, a.scans, a.looked_s, a.through, a.news,
                   a.searched_s})
    out.push_back(v);
}

void Mcl::restore(const std::vector<double>& state) {
  estimate_.reset();
  ParticleFilter::restore(state);
  const double* p = state.data() + state.size() - kMemorySize;
  memory_ = {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9], p[10]};
  hypotheses_.restore(p);
}

std::unique_ptr<PoseFilter> makeMcl(const MclParams& params, uint64_t seed, std::shared_ptr<const ScanModel> model,
                                    bool global) {
  return std::make_unique<Mcl>(params, seed, std::move(model), global);
}

}  // namespace sidestep
