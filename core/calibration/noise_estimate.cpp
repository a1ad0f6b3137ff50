// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/noise_estimate.hpp"

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

// Ten walls in each group of the jackknife.
constexpr std::size_t enough_walls = 100;
// A 95 % quantile of fewer hangs on one or two of them.
constexpr std::size_t enough_long_walls = 100;
constexpr double certain = 0.25;  // half the interval over the value
constexpr double spread_of_ranges = 1.5;
constexpr double steep = 35.0 * pi / 180.0;  // the tangent is 0.7
constexpr double most_refuted = 1.0 / 3.0;

}  // namespace

std::vector<NoiseGap> gaps_of(const NoiseEstimate& estimate) {
  std::vector<NoiseGap> gaps;
  if (estimate.walls < enough_walls) gaps.push_back(NoiseGap::few_walls);
  if (estimate.long_walls < enough_long_walls) gaps.push_back(NoiseGap::few_long_walls);
  if (estimate.walls == 0) return gaps;
  const Interval& noise = estimate.middle_range_stddev;
  if (!(noise.high - noise.low <= 2.0 * certain * noise.value)) {
    gaps.push_back(NoiseGap::wide_interval);
  }
  if (!(estimate.farthest >= spread_of_ranges * estimate.nearest)) {
    gaps.push_back(NoiseGap::uniform_range);
  }
  if (!(estimate.steepest >= steep)) gaps.push_back(NoiseGap::uniform_incidence);
  if (estimate.refuted > most_refuted) gaps.push_back(NoiseGap::no_walls);
  return gaps;
}

}  // namespace quoin
