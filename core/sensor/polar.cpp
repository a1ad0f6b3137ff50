// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/polar.hpp"

#include <bit>
#include <cstdint>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

// Adding and subtracting it rounds to the nearest integer, and leaves that integer in the low bits
// of the sum: 1.5 * 2^52.
constexpr double rounding = 6755399441055744.0;
constexpr double quarters_per_radian = 0.6366197723675814;  // 2 / pi

// pi / 2 in three parts. The first two have 31 bits, so that their products with the number of
// quarter turns (20 bits for the largest bearing) are exact (reduction of Cody and Waite).
constexpr double quarter_high = 0x1.921fb544p+0;
constexpr double quarter_middle = 0x1.0b4611a4p-34;
constexpr double quarter_low = 0x1.13198a2e03707p-65;

// Taylor series around 0, the argument being at most pi / 4: the first terms left out are below
// x^17 / 17! = 5e-17 and x^18 / 18! = 2e-18.
inline double sine_of_reduced(double x, double z) {
  constexpr double s3 = -1.0 / 6.0;
  constexpr double s5 = 1.0 / 120.0;
  constexpr double s7 = -1.0 / 5040.0;
  constexpr double s9 = 1.0 / 362880.0;
  constexpr double s11 = -1.0 / 39916800.0;
  constexpr double s13 = 1.0 / 6227020800.0;
  constexpr double s15 = -1.0 / 1307674368000.0;
  return x + x * z * (s3 + z * (s5 + z * (s7 + z * (s9 + z * (s11 + z * (s13 + z * s15))))));
}

inline double cosine_of_reduced(double z) {
  constexpr double c4 = 1.0 / 24.0;
  constexpr double c6 = -1.0 / 720.0;
  constexpr double c8 = 1.0 / 40320.0;
  constexpr double c10 = -1.0 / 3628800.0;
  constexpr double c12 = 1.0 / 479001600.0;
  constexpr double c14 = -1.0 / 87178291200.0;
  constexpr double c16 = 1.0 / 20922789888000.0;
  const double tail =
      z * z * (c4 + z * (c6 + z * (c8 + z * (c10 + z * (c12 + z * (c14 + z * c16))))));
  const double half = 0.5 * z;
  const double head = 1.0 - half;
  return head + ((1.0 - head - half) + tail);  // the bracket restores what `head` was rounded by
}

// No branch and no call inside, so that the loop becomes vector instructions.
QUOIN_MULTIVERSION
void fill(const double* __restrict range, const double* __restrict bearing, std::size_t count,
          double* __restrict inverse_range, double* __restrict cosine, double* __restrict sine,
          double* __restrict x, double* __restrict y) {
  for (std::size_t i = 0; i < count; ++i) {
    const double shifted = bearing[i] * quarters_per_radian + rounding;
    const double quarters = shifted - rounding;
    const auto quadrant = std::bit_cast<std::uint64_t>(shifted);
    double reduced = bearing[i] - quarters * quarter_high;
    reduced -= quarters * quarter_middle;
    reduced -= quarters * quarter_low;
    const double z = reduced * reduced;

    auto s = std::bit_cast<std::uint64_t>(sine_of_reduced(reduced, z));
    auto c = std::bit_cast<std::uint64_t>(cosine_of_reduced(z));
    const std::uint64_t swap = (s ^ c) & (0U - (quadrant & 1U));  // odd quadrants swap the two
    s ^= swap;
    c ^= swap;
    s ^= (quadrant & 2U) << 62U;         // sign of the sine: quadrants 2 and 3
    c ^= ((quadrant + 1U) & 2U) << 62U;  // sign of the cosine: quadrants 1 and 2

    inverse_range[i] = 1.0 / range[i];
    sine[i] = std::bit_cast<double>(s);
    cosine[i] = std::bit_cast<double>(c);
    x[i] = range[i] * cosine[i];
    y[i] = range[i] * sine[i];
  }
}

}  // namespace

void compute_cartesian(Points& points) {
  fill(points.range.data(), points.bearing.data(), points.size(), points.inverse_range.data(),
       points.cosine.data(), points.sine.data(), points.x.data(), points.y.data());
}

}  // namespace quoin
