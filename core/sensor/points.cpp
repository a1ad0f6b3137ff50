// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/points.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

// Adding and subtracting it rounds to the nearest integer, and leaves that integer in the low bits
// of the sum: 1.5 * 2^52.
constexpr double to_nearest = 6755399441055744.0;
constexpr double quarters_per_radian = 0.6366197723675814;  // 2 / pi

// pi / 2 in two parts. The first has 33 bits, so that its product with the number of quarter turns
// (20 bits for the largest bearing) is exact (reduction of Cody and Waite).
constexpr double quarter_high = 0x1.921fb54400000p+0;
constexpr double quarter_low = 0x1.0b4611a626331p-34;

// Polynomials of least largest error (Remez) for arguments up to pi / 4. Of (sin(x) - x) / x^3 in
// z = x^2, which makes the sine exact to 4e-18 relative to x:
inline double sine_of_reduced(double x, double z) {
  constexpr double s3 = -0x1.5555555555549p-3;
  constexpr double s5 = 0x1.111111110f87ap-7;
  constexpr double s7 = -0x1.a01a019c11992p-13;
  constexpr double s9 = 0x1.71de3577b673fp-19;
  constexpr double s11 = -0x1.ae5e663a73a9dp-26;
  constexpr double s13 = 0x1.5d9300f45e3e5p-33;
  return x + x * z * (s3 + z * (s5 + z * (s7 + z * (s9 + z * (s11 + z * s13)))));
}

// Of (cos(x) - 1 + z / 2) / z^2, which makes the cosine exact to 5e-20.
inline double cosine_of_reduced(double z) {
  constexpr double c4 = 0x1.555555555554cp-5;
  constexpr double c6 = -0x1.6c16c16c1517ep-10;
  constexpr double c8 = 0x1.a01a019cb1bddp-16;
  constexpr double c10 = -0x1.27e4f809f0b82p-22;
  constexpr double c12 = 0x1.1ee9ebe93e759p-29;
  constexpr double c14 = -0x1.8fae9c8034ed0p-37;
  return 1.0 - z * (0.5 - z * (c4 + z * (c6 + z * (c8 + z * (c10 + z * (c12 + z * c14))))));
}

/// No branch and no call inside, so that the loop becomes vector instructions. Fills range and
/// bearing too when they come in single precision.
template <class Number>
[[gnu::always_inline]] inline void fill(const Number* __restrict from_range,
                                        const Number* __restrict from_bearing, std::size_t count,
                                        double* __restrict to_range, double* __restrict to_bearing,
                                        double* __restrict inverse_range, double* __restrict cosine,
                                        double* __restrict sine, double* __restrict x,
                                        double* __restrict y) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto range = static_cast<double>(from_range[i]);
    const auto bearing = static_cast<double>(from_bearing[i]);
    const double shifted = bearing * quarters_per_radian + to_nearest;
    const double quarters = shifted - to_nearest;
    const auto quadrant = std::bit_cast<std::uint64_t>(shifted);
    double reduced = bearing - quarters * quarter_high;
    reduced -= quarters * quarter_low;
    const double z = reduced * reduced;

    auto s = std::bit_cast<std::uint64_t>(sine_of_reduced(reduced, z));
    auto c = std::bit_cast<std::uint64_t>(cosine_of_reduced(z));
    const std::uint64_t swap = (s ^ c) & (0U - (quadrant & 1U));  // odd quadrants swap the two
    s ^= swap;
    c ^= swap;
    s ^= (quadrant & 2U) << 62U;         // sign of the sine: quadrants 2 and 3
    c ^= ((quadrant + 1U) & 2U) << 62U;  // sign of the cosine: quadrants 1 and 2

    if constexpr (std::is_same_v<Number, float>) {
      to_range[i] = range;
      to_bearing[i] = bearing;
    }
    inverse_range[i] = 1.0 / range;
    sine[i] = std::bit_cast<double>(s);
    cosine[i] = std::bit_cast<double>(c);
    x[i] = range * cosine[i];
    y[i] = range * sine[i];
  }
}

QUOIN_MULTIVERSION
void fill_from_double(const double* range, const double* bearing, std::size_t count,
                      double* inverse_range, double* cosine, double* sine, double* x, double* y) {
  fill(range, bearing, count, nullptr, nullptr, inverse_range, cosine, sine, x, y);
}

QUOIN_MULTIVERSION
void fill_from_float(const float* from_range, const float* from_bearing, std::size_t count,
                     double* range, double* bearing, double* inverse_range, double* cosine,
                     double* sine, double* x, double* y) {
  fill(from_range, from_bearing, count, range, bearing, inverse_range, cosine, sine, x, y);
}

QUOIN_MULTIVERSION
void round_to_single(const double* __restrict range, const double* __restrict x,
                     const double* __restrict y, std::size_t count, float* __restrict to_range,
                     float* __restrict to_x, float* __restrict to_y) {
  for (std::size_t i = 0; i < count; ++i) {
    to_range[i] = static_cast<float>(range[i]);
    to_x[i] = static_cast<float>(x[i]);
    to_y[i] = static_cast<float>(y[i]);
  }
}

}  // namespace

void Points::resize(std::size_t count) {
  range.resize(count);
  bearing.resize(count);
  inverse_range.resize(count);
  cosine.resize(count);
  sine.resize(count);
  x.resize(count);
  y.resize(count);
}

void compute_cartesian(Points& points) {
  fill_from_double(points.range.data(), points.bearing.data(), points.size(),
                   points.inverse_range.data(), points.cosine.data(), points.sine.data(),
                   points.x.data(), points.y.data());
}

void compute_cartesian(std::span<const float> bearings, std::span<const float> ranges,
                       std::size_t at, Points& points) {
  fill_from_float(ranges.data(), bearings.data(), ranges.size(), points.range.data() + at,
                  points.bearing.data() + at, points.inverse_range.data() + at,
                  points.cosine.data() + at, points.sine.data() + at, points.x.data() + at,
                  points.y.data() + at);
}

void Points::assign_without(std::span<const std::size_t> left_out, const PointsView& points) {
  const auto copy = [&](std::span<const double> from, std::vector<double>& to) {
    to.resize(from.size() - left_out.size());
    double* next = to.data();
    std::size_t begin = 0;
    for (const std::size_t end : left_out) {
      next = std::copy(from.data() + begin, from.data() + end, next);
      begin = end + 1;
    }
    std::copy(from.data() + begin, from.data() + from.size(), next);
  };
  copy(points.range, range);
  copy(points.bearing, bearing);
  copy(points.inverse_range, inverse_range);
  copy(points.cosine, cosine);
  copy(points.sine, sine);
  copy(points.x, x);
  copy(points.y, y);
}

void Points::erase(std::span<const std::size_t> left_out) {
  for (std::vector<double>* values : {&range, &bearing, &inverse_range, &cosine, &sine, &x, &y}) {
    erase_at(left_out, *values);
  }
}

void CoarsePoints::erase(std::span<const std::size_t> left_out) {
  for (std::vector<float>* values : {&range, &x, &y}) erase_at(left_out, *values);
}

void CoarsePoints::assign(const PointsView& points) {
  range.resize(points.size());
  x.resize(points.size());
  y.resize(points.size());
  round_to_single(points.range.data(), points.x.data(), points.y.data(), points.size(),
                  range.data(), x.data(), y.data());
}

void convert_ordered(std::span<const float> bearings, std::span<const float> ranges,
                     Points& points) {
  const std::size_t count = std::min(bearings.size(), ranges.size());
  points.resize(count);
  compute_cartesian(bearings.first(count), ranges.first(count), 0, points);
}

}  // namespace quoin
