// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/breakpoints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/sensor/multiversion.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

using Criterion = BreakpointDetector::Criterion;

constexpr float steps_with_missing_rays = 3.0F;
constexpr std::size_t sampled_steps = 64;
constexpr float largest_lambda = 1.5F;  // [rad]

struct Point {
  float range, x, y;
};

/// Whether two points are farther apart than D_max. Neither root nor division: both sides of
/// distance <= D_max are squared and multiplied by the squares of both ranges and of
/// sin(lambda - dphi), so that products of coordinates stand for the sines.
inline bool is_break(const Point& a, const Point& b, const Criterion& criterion) {
  // Noise may turn neighbours around, so the step counts without its sign.
  const float sine_step = std::abs(a.x * b.y - a.y * b.x);
  const float cosine_step = a.x * b.x + a.y * b.y;
  const float sine_rest = criterion.sine_lambda * cosine_step - criterion.cosine_lambda * sine_step;
  const float range = a.range < b.range ? a.range : b.range;
  const float dx = b.x - a.x;
  const float dy = b.y - a.y;
  const float limit = range * (sine_step + criterion.bearing_noise * (a.range * b.range)) +
                      (criterion.range_noise + criterion.range_growth * range) * sine_rest;
  const float squared = dx * dx + dy * dy;
  const float excess = squared * (sine_rest * sine_rest) - limit * limit;
  const bool no_ray_is_missing = sine_step <= criterion.wide_step * (a.range * b.range);
  // NaN, of ranges beyond a thousand kilometres, is a break.
  return !((excess <= 0.0F) & (sine_rest > 0.0F) &
           (no_ray_is_missing | (squared <= criterion.gap_squared)));
}

Point point_of(const CoarsePoints& points, std::size_t k) {
  return {points.range[k], points.x[k], points.y[k]};
}

/// Sine of the median step of the bearing, of a sample; at least two points.
float typical_step(const CoarsePoints& points) {
  std::array<float, sampled_steps> steps{};
  const std::size_t available = points.size() - 1;
  const std::size_t count = std::min(available, sampled_steps);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k * available / count;
    const Point a = point_of(points, i);
    const Point b = point_of(points, i + 1);
    steps[k] = std::abs(a.x * b.y - a.y * b.x) / (a.range * b.range);
  }
  return approximate_median({steps.data(), count});
}

QUOIN_MULTIVERSION
void find_breaks(const float* __restrict range, const float* __restrict x,
                 const float* __restrict y, std::size_t count, Criterion criterion,
                 std::uint8_t* __restrict out) {
  for (std::size_t i = 1; i < count; ++i) {
    const Point a{range[i - 1], x[i - 1], y[i - 1]};
    const Point b{range[i], x[i], y[i]};
    out[i] = is_break(a, b, criterion) ? 1 : 0;
  }
}

}  // namespace

BreakpointDetector::BreakpointDetector(double lambda, double max_gap)
    : lambda_(static_cast<float>(lambda)), gap_squared_(static_cast<float>(max_gap * max_gap)) {}

bool BreakpointDetector::find(const CoarsePoints& points, const SensorModel& sensor,
                              std::vector<Segment>& clusters) {
  clusters.clear();
  const std::size_t count = points.size();
  if (count == 0) return true;
  const float step = count > 1 ? typical_step(points) : 0.0F;
  const float wide = steps_with_missing_rays * std::asin(std::min(step, 1.0F));
  const float lambda = std::min(std::max(lambda_, wide), largest_lambda);
  criterion_ = {.sine_lambda = std::sin(lambda),
                .cosine_lambda = std::cos(lambda),
                .range_noise = 3.0F * static_cast<float>(sensor.range_stddev),
                .range_growth = 3.0F * static_cast<float>(sensor.range_stddev_per_metre),
                .bearing_noise = 3.0F * static_cast<float>(sensor.bearing_stddev),
                .wide_step = std::sin(std::min(wide, largest_lambda)),
                .gap_squared = gap_squared_};
  breaks_.resize(count);
  find_breaks(points.range.data(), points.x.data(), points.y.data(), count, criterion_,
              breaks_.data());
  for (std::size_t begin = 0; begin < count;) {
    const void* const next = std::memchr(&breaks_[begin] + 1, 1, count - begin - 1);
    const std::size_t end =
        next == nullptr
            ? count
            : static_cast<std::size_t>(static_cast<const std::uint8_t*>(next) - breaks_.data());
    clusters.push_back({begin, end});
    begin = end;
  }

  return is_break(point_of(points, count - 1), point_of(points, 0), criterion_);
}

bool BreakpointDetector::connected(const CoarsePoints& points, std::size_t i, std::size_t j) const {
  return !is_break(point_of(points, i), point_of(points, j), criterion_);
}

}  // namespace quoin
