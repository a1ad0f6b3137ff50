// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/breakpoints.hpp"

#include <cmath>
#include <cstring>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

struct Criterion {
  float sine_lambda;
  float cosine_lambda;
  float range_noise;    // [m] 3 range_stddev
  float bearing_noise;  // [rad] 3 bearing_stddev
};

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
                      criterion.range_noise * sine_rest;
  const float excess = (dx * dx + dy * dy) * (sine_rest * sine_rest) - limit * limit;
  // NaN, of ranges beyond a thousand kilometres, is a break.
  return !((excess <= 0.0F) & (sine_rest > 0.0F));
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

BreakpointDetector::BreakpointDetector(double lambda)
    : sine_(static_cast<float>(std::sin(lambda))), cosine_(static_cast<float>(std::cos(lambda))) {}

bool BreakpointDetector::find(const CoarsePoints& points, const SensorModel& sensor,
                              std::vector<Segment>& clusters) {
  clusters.clear();
  const std::size_t count = points.size();
  if (count == 0) return true;
  const Criterion criterion{sine_, cosine_, 3.0F * static_cast<float>(sensor.range_stddev),
                            3.0F * static_cast<float>(sensor.bearing_stddev)};
  breaks_.resize(count);
  find_breaks(points.range.data(), points.x.data(), points.y.data(), count, criterion,
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

  const auto point = [&points](std::size_t k) {
    return Point{points.range[k], points.x[k], points.y[k]};
  };
  return is_break(point(count - 1), point(0), criterion);
}

}  // namespace quoin
