// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/breakpoints.hpp"

#include <cmath>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

struct Criterion {
  double sine_lambda;
  double cosine_lambda;
  double range_noise;    // [m] 3 range_stddev
  double bearing_noise;  // [rad] 3 bearing_stddev
};

struct Point {
  double range, cosine, sine, x, y;
};

/// Positive when the two points are farther apart than D_max. Neither root nor division: both sides
/// of distance > D_max are squared and multiplied by sin(lambda - dphi)^2.
inline double excess(const Point& a, const Point& b, const Criterion& criterion) {
  // Noise may turn neighbours around, so the step counts without its sign.
  const double sine_step = std::abs(a.cosine * b.sine - a.sine * b.cosine);
  const double cosine_step = a.cosine * b.cosine + a.sine * b.sine;
  const double sine_rest =
      criterion.sine_lambda * cosine_step - criterion.cosine_lambda * sine_step;
  const double range = a.range < b.range ? a.range : b.range;
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double limit =
      range * (sine_step + criterion.bearing_noise) + criterion.range_noise * sine_rest;
  const double value = (dx * dx + dy * dy) * sine_rest * sine_rest - limit * limit;
  return sine_rest > 0.0 ? value : 1.0;
}

QUOIN_MULTIVERSION
void compute_excess(const double* __restrict range, const double* __restrict cosine,
                    const double* __restrict sine, const double* __restrict x,
                    const double* __restrict y, std::size_t count, Criterion criterion,
                    double* __restrict out) {
  for (std::size_t i = 1; i < count; ++i) {
    const Point a{range[i - 1], cosine[i - 1], sine[i - 1], x[i - 1], y[i - 1]};
    const Point b{range[i], cosine[i], sine[i], x[i], y[i]};
    out[i] = excess(a, b, criterion);
  }
}

/// The first place from `begin` on whose value is positive, or `count`. Breaks are rare: blocks
/// without one are passed over by vector instructions.
QUOIN_MULTIVERSION
std::size_t next_positive(const double* __restrict values, std::size_t begin, std::size_t count) {
  constexpr std::size_t block = 64;
  while (begin + block <= count) {
    double largest = 0.0;
    for (std::size_t i = begin; i < begin + block; ++i) {
      largest = values[i] > largest ? values[i] : largest;
    }
    if (largest > 0.0) break;
    begin += block;
  }
  while (begin < count && !(values[begin] > 0.0)) ++begin;
  return begin;
}

}  // namespace

BreakpointDetector::BreakpointDetector(double lambda)
    : sine_(std::sin(lambda)), cosine_(std::cos(lambda)) {}

bool BreakpointDetector::find(const PointsView& points, const SensorModel& sensor,
                              std::vector<Segment>& clusters) {
  clusters.clear();
  const std::size_t count = points.size();
  if (count == 0) return true;
  const Criterion criterion{sine_, cosine_, 3.0 * sensor.range_stddev, 3.0 * sensor.bearing_stddev};
  excess_.resize(count);
  compute_excess(points.range.data(), points.cosine.data(), points.sine.data(), points.x.data(),
                 points.y.data(), count, criterion, excess_.data());
  for (std::size_t begin = 0; begin < count;) {
    const std::size_t end = next_positive(excess_.data(), begin + 1, count);
    clusters.push_back({begin, end});
    begin = end;
  }

  const auto point = [&points](std::size_t k) {
    return Point{points.range[k], points.cosine[k], points.sine[k], points.x[k], points.y[k]};
  };
  return excess(point(count - 1), point(0), criterion) > 0.0;
}

}  // namespace quoin
