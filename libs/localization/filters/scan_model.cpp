// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/scan_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.h"
#include "localization/filters/fast_math.h"

namespace sidestep {
namespace {
constexpr size_t kMostBeams = 2000;
constexpr size_t kExactFloats = size_t{1} << 24;  // integers up to it are floats
constexpr float kShort = 1, kThrough = 6;         // what a beam costs that ends short of the walls, or behind one
constexpr float kGrazing_m = 0.5f;                // so much of a beam may run along a wall
}  // namespace

void ScanModelParams::visit(ParamVisitor& v) {
  v.choice("model", model, {"field", "beam"}, "likelihood field (precomputed), or each beam followed through the map");
  v.number("sd_m", sd_m, {0.005, 5}, "m", "sd of a beam's end, errors of map and motion included");
  v.number("hit_share", hit_share, {0.01, 0.999}, "",
           "share of beams that end at what the map shows; the rest anywhere");
  v.number("short_share", short_share, {0, 0.9}, "", "beam: share of beams that end before it, at people for example");
  v.number("short_m", short_m, {0.1, 100}, "m", "beam: mean length of those");
  v.number("field_reach_m", field_reach_m, {0.1, 20}, "m", "field: farther from any obstacle all places are alike");
  v.number("beam_weight", beam_weight, {0.001, 1}, "",
           "what a beam counts for: beams of one scan err together and are not independent");
}

ScanModel::ScanModel(const GridMap& map, const ScanModelParams& params) : params_(params) {
  ObstacleParams obstacles;
  const auto known = blockedCells(map, obstacles);
  obstacles.unknown_blocks = false;
  DistanceFieldParams reach;
  reach.cap_m = params.model == "beam" ? std::max(5.0, params.field_reach_m) : params.field_reach_m;
  const auto walls = blockedCells(map, obstacles);
  frame_ = map.frame();
  per_m_ = 1 / frame_.resolution_m;
  if (std::count(walls.begin(), walls.end(), 1) == 0)
    throw ConfigError("the map has no occupied cell: nothing to localize by; lower its occupied threshold");
  for (size_t i = 0; i < known.size(); ++i)
    if (known[i] == 0) free_.push_back(static_cast<uint32_t>(i));
  if (free_.empty()) throw ConfigError("the map has no free cell: nowhere for the robot to be");
  const DistanceField distances(frame_, walls, reach);
  cos_ = std::cos(frame_.T_map_grid.phi);
  sin_ = std::sin(frame_.T_map_grid.phi);
  stride_ = frame_.width + 2;
  right_ = static_cast<float>(frame_.width + 1);
  top_ = static_cast<float>(frame_.height + 1);
  const size_t cells = static_cast<size_t>(stride_) * static_cast<size_t>(frame_.height + 2);
  // A beam that ends anywhere has the density 1 / max range; relative to the Gaussian's peak, with 10 m for it.
  const double anywhere = (1 - params.hit_share) * params.sd_m * std::sqrt(2 * M_PI) / 10;
  const auto logOf = [&](double d) {
    return static_cast<float>(
        std::log(params.hit_share * std::exp(-0.5 * d * d / (params.sd_m * params.sd_m)) + anywhere));
  };
  log_likelihood_.assign(cells, logOf(params.field_reach_m));
  distance_.assign(cells, static_cast<float>(reach.cap_m / frame_.resolution_m));
  for (int iy = 0; iy < frame_.height; ++iy)
    for (int ix = 0; ix < frame_.width; ++ix) {
      const size_t at = static_cast<size_t>(iy + 1) * static_cast<size_t>(stride_) + static_cast<size_t>(ix + 1);
      // The raster's rim counts as blocked in the distance field; for a laser there is nothing.
      const double d = std::max(0.0, static_cast<double>(distances.atCell(ix, iy)));
      const int rim = 1 + std::min({ix, iy, frame_.width - 1 - ix, frame_.height - 1 - iy});
      const bool of_rim = rim * frame_.resolution_m <= d + 1e-6;
      if (of_rim) continue;
      log_likelihood_[at] = logOf(std::min(d, params.field_reach_m));
      distance_[at] = static_cast<float>(d / frame_.resolution_m);
    }
}

double ScanModel::freeArea() const {
  return static_cast<double>(free_.size()) * frame_.resolution_m * frame_.resolution_m;
}

mrpt::math::TPose2D ScanModel::drawFree(Random& random) const {
  const uint32_t cell = free_[random.below(free_.size())];
  const auto width = static_cast<uint32_t>(frame_.width);
  const double u = (static_cast<double>(cell % width) + random.uniform()) * frame_.resolution_m;
  const double v = (static_cast<double>(cell / width) + random.uniform()) * frame_.resolution_m;
  return {frame_.T_map_grid.x + cos_ * u - sin_ * v, frame_.T_map_grid.y + sin_ * u + cos_ * v,
          random.uniform(-M_PI, M_PI)};
}

/// Cells of the padded raster: the raster's own begin at 1.
ScanModel::GridPose ScanModel::toGrid(double x, double y, double sine, double cosine) const {
  const double dx = x - frame_.T_map_grid.x, dy = y - frame_.T_map_grid.y;
  return {static_cast<float>((cos_ * dx + sin_ * dy) * per_m_ + 1),
          static_cast<float>((-sin_ * dx + cos_ * dy) * per_m_ + 1), static_cast<float>(cosine * per_m_),
          static_cast<float>(sine * per_m_)};
}

ScanModel::GridPose ScanModel::toGrid(const mrpt::math::TPose2D& pose) const {
  double sine, cosine;
  sineCosine(pose.phi - frame_.T_map_grid.phi, sine, cosine);
  return toGrid(pose.x, pose.y, sine, cosine);
}

/// Cells of the beams' ends, all alike and without branches. @return how many
int ScanModel::ends(const GridPose& p, const Scan& scan, int32_t* __restrict at) const {
  const auto n = static_cast<int>(std::min(scan.size(), kMostBeams));
  const float* __restrict bx = scan.x.data(), * __restrict by = scan.y.data();
  const float px = p.x, py = p.y, c = p.c, s = p.s, right = right_, top = top_;
  const auto each = [&](const auto& row) {
    for (int i = 0; i < n; ++i) {
      float u = px + c * bx[i] - s * by[i], v = py + s * bx[i] + c * by[i];
      u = u < 0 ? 0 : u;
      u = u > right ? right : u;
      v = v < 0 ? 0 : v;
      v = v > top ? top : v;
      at[i] = row(static_cast<int32_t>(v)) + static_cast<int32_t>(u);
    }
  };
  const int32_t stride = stride_;
  const auto wide = static_cast<float>(stride_);
  if (log_likelihood_.size() <= kExactFloats)  // any x86-64 multiplies four floats at once, but not four integers
    each([wide](int32_t v) { return static_cast<int32_t>(static_cast<float>(v) * wide); });
  else
    each([stride](int32_t v) { return v * stride; });
  return n;
}

/// Look-ups at the ends, four sums at a time.
float ScanModel::field(const GridPose& p, const Scan& scan) const {
  std::array<int32_t, kMostBeams> at;
  const int n = ends(p, scan, at.data());
  const float* table = log_likelihood_.data();
  float sum[4] = {0, 0, 0, 0};
  int i = 0;
  for (; i + 4 <= n; i += 4)
    for (int k = 0; k < 4; ++k) sum[k] += table[at[i + k]];
  for (; i < n; ++i) sum[0] += table[at[i]];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Sphere tracing: as far as the nearest obstacle is, the ray is free. Unit direction; all in cells.
float ScanModel::castRay(float x, float y, float dx, float dy, float reach) const {
  float t = 0;
  while (t < reach) {
    const float u = x + t * dx, v = y + t * dy;
    if (!(u >= 0 && v >= 0 && u <= right_ && v <= top_)) return reach;
    const float d = distance_[static_cast<size_t>(static_cast<int>(v) * stride_ + static_cast<int>(u))];
    if (d < 0.5f) return t;
    t += std::max(0.5f, d - 0.75f);  // the cell's centre may be 0.7 cells from here
  }
  return reach;
}

float ScanModel::beams(const GridPose& p, const Scan& scan) const {
  const float per = static_cast<float>(per_m_), sd = static_cast<float>(params_.sd_m) * per;
  const float reach = scan.max_range * per, norm = 1 / (sd * std::sqrt(2 * static_cast<float>(M_PI)));
  const float hit = static_cast<float>(params_.hit_share), early = static_cast<float>(params_.short_share);
  const float rest = std::max(0.01f, 1 - hit - early), rate = 1 / (static_cast<float>(params_.short_m) * per);
  const float lx = p.x + p.c * scan.laser_x - p.s * scan.laser_y, ly = p.y + p.s * scan.laser_x + p.c * scan.laser_y;
  float sum = 0;
  for (size_t i = 0; i < scan.size(); ++i) {
    const float ex = p.x + p.c * scan.x[i] - p.s * scan.y[i] - lx, ey = p.y + p.s * scan.x[i] + p.c * scan.y[i] - ly;
    const float z = std::sqrt(ex * ex + ey * ey);
    if (!(z > 0)) continue;
    const float expected = castRay(lx, ly, ex / z, ey / z, std::min(reach, z + 4 * sd));
    const float e = (z - expected) / sd;
    const float before = z < expected ? early * rate * std::exp(-rate * z) : 0;
    sum += std::log((hit * norm * std::exp(-0.5f * e * e) + before + rest / reach) / norm);
  }
  return sum;
}

/// A beam that does not end at a wall costs kShort or more, whatever is between: the sum without looking is a bound.
ScanModel::Judgement ScanModel::judge(const Scan& scan, const mrpt::math::TPose2D& pose, double least) const {
  const GridPose p = toGrid(pose);
  const float per = static_cast<float>(per_m_), sd = static_cast<float>(params_.sd_m) * per;
  std::array<int32_t, kMostBeams> at;
  std::array<float, kMostBeams> miss;
  const int n = ends(p, scan, at.data());
  float sum = 0;
  for (int i = 0; i < n; ++i) {
    const float off = distance_[static_cast<size_t>(at[i])] / sd;
    miss[i] = 0.5f * off * off;
    sum -= std::min(miss[i], kShort);
  }
  if (static_cast<double>(sum) < least) return {static_cast<double>(sum), 0};
  const float ahead = scan.laser_x, left = scan.laser_y;
  const float lx = p.x + p.c * ahead - p.s * left, ly = p.y + p.s * ahead + p.c * left;
  int through = 0;
  for (int i = 0; i < n; ++i) {
    if (miss[i] < kShort) continue;
    const float bx = scan.x[i] - ahead, by = scan.y[i] - left, dx = p.c * bx - p.s * by, dy = p.s * bx + p.c * by;
    const float z = std::sqrt(dx * dx + dy * dy), most = z - kGrazing_m * per;
    if (!(most > 0) || castRay(lx, ly, dx / z, dy / z, most) >= most) continue;
    ++through;
    sum -= std::min(miss[i], kThrough) - kShort;
  }
  return {static_cast<double>(sum), static_cast<double>(through) / std::max(n, 1)};
}

void ScanModel::logLikelihoods(const Scan& scan, const double* x, const double* y, const double* yaw, size_t n,
                               double* out) const {
  constexpr size_t kAtOnce = 64;
  const bool follow = params_.model == "beam";
  const double turned = frame_.T_map_grid.phi;
  double sine[kAtOnce], cosine[kAtOnce];
  for (size_t first = 0; first < n; first += kAtOnce) {
    const size_t count = std::min(kAtOnce, n - first);
    for (size_t k = 0; k < count; ++k) sineCosine(yaw[first + k] - turned, sine[k], cosine[k]);
    for (size_t k = 0; k < count; ++k) {
      const GridPose p = toGrid(x[first + k], y[first + k], sine[k], cosine[k]);
      out[first + k] = static_cast<double>(follow ? beams(p, scan) : field(p, scan));
    }
  }
}

double ScanModel::explained(const Scan& scan, const mrpt::math::TPose2D& pose) const {
  const GridPose p = toGrid(pose);
  const auto near = static_cast<float>(1.5 * params_.sd_m * per_m_);
  std::array<int32_t, kMostBeams> at;
  const int n = ends(p, scan, at.data());
  int count = 0;
  for (int i = 0; i < n; ++i) count += distance_[static_cast<size_t>(at[i])] < near;
  return n > 0 ? static_cast<double>(count) / n : 0;
}

}  // namespace sidestep
