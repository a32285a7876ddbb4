// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/mcl.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/errors.h"
#include "localization/filters/ekf.h"
#include "support/room.h"

namespace sidestep {
namespace {

using Reason = Correction::Reason;

std::shared_ptr<const ScanModel> modelOf(const GridMap& map, const std::string& kind = "field") {
  ScanModelParams params;
  params.model = kind;
  return std::make_shared<ScanModel>(map, params);
}

double likelihoodAt(const ScanModel& model, const Scan& scan, const mrpt::math::TPose2D& p) {
  double out;
  model.logLikelihoods(scan, &p.x, &p.y, &p.phi, 1, &out);
  return out;
}

Measurement scanAt(double time_s, const GridMap& map, const mrpt::math::TPose2D& pose, Random& random) {
  Measurement m;
  m.kind = Measurement::Kind::kScan;
  m.time_s = time_s;
  m.scan = readScan(ScanParams(), support::scanIn(map, pose, 0.02, random));
  return m;
}

// ---- reading a scan ----

TEST(ReadScan, EndsOfBeamsAreWhereTheLaserOnTheRobotSeesThem) {
  // Three beams at -90, 0, 90 degrees from a laser 0.5 m ahead that is turned left by 90 degrees.
  mrpt::obs::CObservation2DRangeScan o;
  o.aperture = static_cast<float>(M_PI);
  o.maxRange = 10;
  o.resizeScanAndAssign(3, 2, true);
  o.setSensorPose(mrpt::poses::CPose3D(0.5, 0, 0.3, M_PI / 2, 0, 0));
  const auto scan = readScan(ScanParams(), o);
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->size(), 3u);
  const float expected[3][2] = {{2.5f, 0}, {0.5f, 2}, {-1.5f, 0}};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(scan->x[i], expected[i][0], 1e-5f);
    EXPECT_NEAR(scan->y[i], expected[i][1], 1e-5f);
  }
}

TEST(ReadScan, AnUpsideDownLaserIsMirrored) {
  mrpt::obs::CObservation2DRangeScan o;
  o.aperture = static_cast<float>(M_PI);
  o.maxRange = 10;
  o.resizeScanAndAssign(3, 2, true);
  o.setSensorPose(mrpt::poses::CPose3D(0, 0, 0.3, 0, 0, M_PI));
  const auto scan = readScan(ScanParams(), o);
  EXPECT_NEAR(scan->y[0], 2, 1e-5);  // the first beam, to the right, comes out left
}

TEST(ReadScan, LeavesOutWhatIsNoRangeAndSaysWhenNothingIsLeft) {
  mrpt::obs::CObservation2DRangeScan o;
  o.aperture = 1;
  o.maxRange = 10;
  o.resizeScanAndAssign(4, 2, true);
  o.setScanRange(0, 0);
  o.setScanRange(1, 10);
  o.setScanRange(2, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(readScan(ScanParams(), o)->size(), 1u);
  o.setScanRangeValidity(3, false);
  EXPECT_EQ(readScan(ScanParams(), o), nullptr);
}

// ---- likelihood ----

TEST(ScanModel, IsHighestWhereTheScanWasTaken) {
  const auto map = support::room();
  Random random(1);
  const mrpt::math::TPose2D truth{4.2, 2.1, 0.7};
  const auto scan = readScan(ScanParams(), support::scanIn(map, truth, 0, random));
  for (const char* kind : {"field", "beam"}) {
    const auto model = modelOf(map, kind);
    const double best = likelihoodAt(*model, *scan, truth);
    for (const auto& d : {mrpt::math::TPose2D{0.3, 0, 0},
                          {-0.3, 0, 0},
                          {0, 0.3, 0},
                          {0, -0.3, 0},
                          {0, 0, 0.15},
                          {0, 0, -0.15},
                          {2, 1, 0},
                          {0, 0, 3}})
      EXPECT_LT(likelihoodAt(*model, *scan, {truth.x + d.x, truth.y + d.y, truth.phi + d.phi}), best - 1) << kind;
    EXPECT_GT(model->explained(*scan, truth), 0.95);
    EXPECT_LT(model->explained(*scan, {truth.x, truth.y, truth.phi + 2}), 0.7);
  }
}

TEST(ScanModel, ABeamsEndWeighsAsItsDistanceSays) {
  // One beam that ends 0.2 m before a wall: log(0.5 exp(-(0.2 / 0.12)^2 / 2) + 0.5 * 0.12 sqrt(2 pi) / 10), up to a
  // cell.
  const auto map = support::room();
  Scan scan;
  scan.x = {1.0f};
  scan.y = {0.0f};
  const auto model = modelOf(map);
  const auto logOf = [](double d) {
    return std::log(0.5 * std::exp(-0.5 * d * d / 0.0144) + 0.5 * 0.12 * std::sqrt(2 * M_PI) / 10);
  };
  const double l = likelihoodAt(*model, scan, {8.8, 4.5, 0});  // the wall's first cell is centred at 10.025
  EXPECT_LE(l, logOf(0.2) + 1e-4);
  EXPECT_GE(l, logOf(0.25));
  EXPECT_NEAR(likelihoodAt(*model, scan, {100, 100, 0}), logOf(1), 1e-5);  // far outside there is nothing
}

TEST(ScanModel, ExcusesBeamsThatEndShortAndNoneThatGoThroughWalls) {
  // From (5, 2) looking along +x the wall is 5 m away; of three beams one ends at it, one 3 m before, one 3 m behind.
  const auto map = support::room();
  const auto model = modelOf(map);
  const auto judged = [&](float range) {
    Scan scan;
    scan.x = {range};
    scan.y = {0};
    return model->judge(scan, {5, 2, 0});
  };
  const auto hit = judged(5.02f), early = judged(2), late = judged(8);
  EXPECT_GT(hit.fit, -0.2);
  EXPECT_LT(early.fit, hit.fit);
  EXPECT_LT(late.fit, early.fit - 2);
  EXPECT_EQ(hit.through, 0);
  EXPECT_EQ(early.through, 0);
  EXPECT_EQ(late.through, 1);
}

TEST(ScanModel, JudgesAsUsualWhereAPlaceFitsAsWellAsAskedAndElseSaysThatItDoesNot) {
  const auto map = support::room();
  const auto model = modelOf(map);
  Random random(5);
  const auto scan = readScan(ScanParams(), support::scanIn(map, {4.2, 2.1, 0.7}, 0.02, random));
  for (int k = 0; k < 300; ++k) {
    const auto pose = model->drawFree(random);
    const auto full = model->judge(*scan, pose), enough = model->judge(*scan, pose, full.fit);
    EXPECT_EQ(enough.fit, full.fit);
    EXPECT_EQ(enough.through, full.through);
    const auto spared = model->judge(*scan, pose, -5);
    EXPECT_GE(spared.fit, full.fit);
    if (full.fit >= -5) continue;
    EXPECT_LT(spared.fit, -5);
    EXPECT_EQ(spared.through, 0);
  }
}

TEST(ScanModel, FindsItsCellsInARasterOfMoreThanSixteenMillion) {
  GridMap map;
  map.grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>(0.0f, 4500.0f, 0.0f, 4000.0f, 1.0f);
  map.grid->fill(0.98f);
  map.grid->setCell(4001, 3999, 0.02f);
  const auto model = modelOf(map);
  Scan scan;
  scan.x = {1.0f};
  scan.y = {0.0f};
  for (const double off : {-2, -1, 1, 2}) {
    EXPECT_GT(likelihoodAt(*model, scan, {4000.5, 3999.5, 0}), likelihoodAt(*model, scan, {4000.5 + off, 3999.5, 0}));
    EXPECT_GT(likelihoodAt(*model, scan, {4000.5, 3999.5, 0}), likelihoodAt(*model, scan, {4000.5, 3999.5 + off, 0}));
  }
}

TEST(ScanModel, KnowsAMapThatIsTurnedInItsFrame) {
  auto map = support::room();
  const auto straight = modelOf(map);
  Random random(2);
  const mrpt::math::TPose2D truth{4.2, 2.1, 0.7};
  const auto scan = readScan(ScanParams(), support::scanIn(map, truth, 0, random));
  map.T_map_grid = {3, -2, 0.5};
  const auto turned = modelOf(map);
  const double c = std::cos(0.5), s = std::sin(0.5);
  const mrpt::math::TPose2D there{3 + c * truth.x - s * truth.y, -2 + s * truth.x + c * truth.y, truth.phi + 0.5};
  EXPECT_NEAR(likelihoodAt(*turned, *scan, there), likelihoodAt(*straight, *scan, truth), 1.5);
  for (int k = 0; k < 100; ++k) {
    const auto p = turned->drawFree(random);
    const double u = c * (p.x - 3) + s * (p.y + 2), v = -s * (p.x - 3) + c * (p.y + 2);
    EXPECT_GT(map.grid->getPos(static_cast<float>(u), static_cast<float>(v)), 0.6f);
  }
}

TEST(ScanModel, AMapWithoutWallsOrWithoutRoomIsAConfigError) {
  auto map = support::room();
  map.grid->fill(0.99f);
  EXPECT_THROW(modelOf(map), ConfigError);
  map.grid->fill(0.01f);
  EXPECT_THROW(modelOf(map), ConfigError);
}

// ---- localization ----

/// Drives round the room; the robot's odometry slips by a few percent.
struct Drive {
  GridMap map = support::room();
  Random random{3};
  mrpt::math::TPose2D truth{1.5, 1.5, 0};

  /// One step of 0.1 s, and a scan each third of them.
  void step(PoseFilter& filter, int k) {
    MotionStep s;
    s.dt_s = 0.1;
    s.distance_m = 0.06;
    s.turn_rad = 0.03;
    s.distance_var = 1e-5;
    s.turn_var = 1e-5;
    filter.predict(s);
    s.distance_m *= 0.95;
    s.turn_rad += 0.003 * random.gaussian();
    truth = moved(truth, s);
    if (k % 3 == 0) last = filter.correct(scanAt(0.1 * k, map, truth, random));
  }
  double error(const PoseFilter& f) const {
    const auto p = f.estimate().mean;
    return std::hypot(p.x - truth.x, p.y - truth.y);
  }
  double headingError(const PoseFilter& f) const {
    return std::abs(std::remainder(f.estimate().mean.phi - truth.phi, 2 * M_PI));
  }
  Correction last;
};

PoseBelief around(const mrpt::math::TPose2D& p) {
  PoseBelief b;
  b.mean = p;
  b.covariance.diagonal() << 0.04, 0.04, 0.01;
  return b;
}

TEST(Mcl, TracksARobotWhoseWheelsSlip) {
  for (const char* kind : {"field", "beam"}) {
    Drive drive;
    Mcl mcl(MclParams(), 4, modelOf(drive.map, kind), false);
    mcl.start(around(drive.truth));
    double sum = 0, turned = 0;
    for (int k = 1; k <= 300; ++k) {
      drive.step(mcl, k);
      sum += drive.error(mcl) / 300;
      turned += drive.headingError(mcl) / 300;
    }
    EXPECT_LT(sum, 0.1) << kind;
    EXPECT_LT(turned, 0.035) << kind;
    EXPECT_LT(*mcl.lostProbability(), 0.05) << kind;
  }
}

TEST(Mcl, FindsTheRobotAnywhereInTheRoomFromEverySeed) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    Drive drive;
    drive.random = Random(5, seed);
    const auto model = modelOf(drive.map);
    do drive.truth = model->drawFree(drive.random);
    while (std::hypot(drive.truth.x - 5, drive.truth.y - 2.5) > 1.2);  // the circle must fit between the walls
    Mcl mcl(MclParams(), seed, model, true);
    mcl.start(PoseBelief());
    for (int k = 1; k <= 120; ++k) drive.step(mcl, k);
    EXPECT_LT(drive.error(mcl), 0.3) << seed;
    EXPECT_LT(mcl.cloud().size(), 5000u) << seed;  // and the number of particles has come down
  }
}

TEST(Mcl, FindsARobotThatWasCarriedAway) {
  Drive drive;
  Mcl mcl(MclParams(), 6, modelOf(drive.map), false);
  mcl.start(around(drive.truth));
  for (int k = 1; k <= 100; ++k) drive.step(mcl, k);
  EXPECT_LT(drive.error(mcl), 0.2);
  drive.truth = {6, 3.5, 2.5};
  for (int k = 101; k <= 300; ++k) drive.step(mcl, k);
  EXPECT_LT(drive.error(mcl), 0.3);
}

/// Told a right or a wrong start, half of each: how often the filter says that it is lost, and how often it is.
TEST(Mcl, SaysHowLikelyItIsLost) {
  double told = 0, lost = 0, told_when_lost = 0, told_when_not = 0, all = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    Drive drive;
    drive.random = Random(12, seed);
    Mcl mcl(MclParams(), seed, modelOf(drive.map), false);
    mcl.start(around(seed % 2 ? drive.truth : mrpt::math::TPose2D{8, 2, 2}));
    for (int k = 1; k <= 60; ++k) {
      drive.step(mcl, k);
      if (k % 3 != 0 || k < 6) continue;
      const bool is_lost = drive.error(mcl) > 1;
      const double p = *mcl.lostProbability();
      ASSERT_GE(p, 0);
      ASSERT_LE(p, 1);
      ++all;
      told += p;
      lost += is_lost;
      (is_lost ? told_when_lost : told_when_not) += p;
    }
  }
  EXPECT_GT(lost / all, 0.02);
  EXPECT_NEAR(told / all, lost / all, 0.1);
  EXPECT_GT(told_when_lost / lost, 3 * told_when_not / (all - lost));
}

TEST(PoseHypotheses, GatherEvidenceOnlyWhereTheEstimateIsWrong) {
  const auto map = support::room();
  const auto model = modelOf(map);
  const mrpt::math::TPose2D truth{4, 2, 0.3}, wrong{8, 5, -2};
  for (const bool right : {true, false}) {
    Random random(21);
    PoseHypotheses rivals(64);
    const auto estimate = right ? truth : wrong;
    for (int k = 0; k < 8; ++k) {
      const auto scan = readScan(ScanParams(), support::scanIn(map, truth, 0.02, random));
      rivals.compare(*model, *scan, model->judge(*scan, estimate).fit, 0.15, random);
      rivals.renew(Candidates::draw(*model, *scan, 20000, random), estimate);
    }
    EXPECT_GT(rivals.size(), 10u);
    if (right) {
      EXPECT_LT(rivals.evidence(estimate), 3);
    } else {
      EXPECT_GT(rivals.evidence(estimate), 20);
      int near = 0;
      for (int k = 0; k < 100; ++k) {
        const auto p = rivals.draw(random);
        near += std::hypot(p.x - truth.x, p.y - truth.y) < 0.5;
      }
      EXPECT_GT(near, 80);
    }
    std::vector<double> state, again;
    rivals.save(state);
    PoseHypotheses copy(64);
    copy.restore(state.data() + state.size());
    copy.save(again);
    EXPECT_EQ(state, again);
  }
}

TEST(Mcl, TheMapsOwnErrorsAreInTheCovariance) {
  Drive drive;
  MclParams exact, rough;
  exact.map_sd_m = exact.map_sd_turn = 0;
  rough.map_sd_m = 0.3;
  rough.map_sd_turn = 0.1;
  Mcl a(exact, 4, modelOf(drive.map), false), b(rough, 4, modelOf(drive.map), false);
  a.start(around(drive.truth));
  b.start(around(drive.truth));
  EXPECT_EQ(a.estimate().mean.x, b.estimate().mean.x);
  const Eigen::Matrix3d more = b.estimate().covariance - a.estimate().covariance;
  EXPECT_NEAR(more(0, 0), 0.09, 1e-9);
  EXPECT_NEAR(more(1, 1), 0.09, 1e-9);
  EXPECT_NEAR(more(2, 2), 0.01, 1e-9);
  EXPECT_NEAR(more(0, 1), 0, 1e-9);
}

TEST(Mcl, AScanFromWhereTheLastOneWasTakenSaysNothingNew) {
  Drive drive;
  Mcl mcl(MclParams(), 7, modelOf(drive.map), false);
  mcl.start(around(drive.truth));
  EXPECT_TRUE(mcl.correct(scanAt(1, drive.map, drive.truth, drive.random)).accepted());
  const auto before = mcl.estimate().mean;
  EXPECT_EQ(mcl.correct(scanAt(2, drive.map, drive.truth, drive.random)).reason, Reason::kNothingNew);
  EXPECT_EQ(mcl.estimate().mean.x, before.x);
}

TEST(Mcl, TakesFixesAndHeadingsBesideScans) {
  Drive drive;
  Mcl mcl(MclParams(), 8, modelOf(drive.map), true);
  mcl.start(PoseBelief());
  Measurement fix;
  fix.z << 1.5, 1.5, 0;
  fix.R(0, 0) = fix.R(1, 1) = 0.25;
  EXPECT_TRUE(mcl.correct(fix).accepted());
  EXPECT_NEAR(mcl.estimate().mean.x, 1.5, 0.3);
  EXPECT_NEAR(mcl.estimate().mean.y, 1.5, 0.3);
}

TEST(Mcl, StaysFiniteAndSaysSoForScansOfAnotherWorld) {
  Drive drive;
  Mcl mcl(MclParams(), 9, modelOf(drive.map), false);
  mcl.start(around(drive.truth));
  Measurement none;
  none.kind = Measurement::Kind::kScan;
  EXPECT_EQ(mcl.correct(none).reason, Reason::kNotFinite);
  auto scan = std::make_shared<Scan>();
  for (int i = 0; i < 60; ++i) {
    scan->x.push_back(0.3f);
    scan->y.push_back(1e6f);
  }
  for (int k = 1; k <= 60; ++k) {
    drive.step(mcl, 3 * k + 1);
    none.scan = scan;
    none.time_s = k;
    mcl.correct(none);
    const auto b = mcl.estimate();
    ASSERT_TRUE(std::isfinite(b.mean.x) && b.covariance.allFinite());
  }
}

TEST(Mcl, ContinuesBitForBitAfterSaveAndRestore) {
  for (const bool global : {false, true}) {
    Drive drive;
    const auto model = modelOf(drive.map);
    Mcl a(MclParams(), 10, model, global), b(MclParams(), 11, model, global);
    a.start(around(drive.truth));
    for (int k = 1; k <= (global ? 1 : 20); ++k) drive.step(a, k);
    std::vector<double> state, again;
    a.save(state);
    b.restore(state);
    Drive other = drive;
    for (int k = 21; k <= 60; ++k) drive.step(a, k);
    for (int k = 21; k <= 60; ++k) other.step(b, k);
    a.save(state);
    b.save(again);
    EXPECT_EQ(state, again);
  }
}

TEST(Mcl, AFilterWithoutAMapRefusesAScan) {
  Drive drive;
  const auto scan = scanAt(1, drive.map, drive.truth, drive.random);
  ParticleFilter pf(PfParams(), 1);
  EXPECT_EQ(pf.correct(scan).reason, Reason::kNotObservable);
  EXPECT_EQ(makeEkf(EkfParams())->correct(scan).reason, Reason::kNotObservable);
}

}  // namespace
}  // namespace sidestep
