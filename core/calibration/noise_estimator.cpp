// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/noise_estimator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/calibration/quantization.hpp"
#include "core/calibration/variance_components.hpp"
#include "core/geometry/angle.hpp"
#include "core/statistics/chi_square.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

constexpr int rounds = 4;  // lines under the last components, components from these lines
constexpr std::size_t groups = 10;
constexpr double t_97_5 = 2.262;  // Student's with a degree of freedom less than there are groups
constexpr std::size_t bands = 12;
constexpr double steepest_band = 80.0 * pi / 180.0;
constexpr std::size_t fewest_points_of_band = 100;

ResidualTable residuals_of(const WallSample& sample, const SensorModel& model) {
  ResidualTable table;
  Points points;
  for (const WallSample::Wall& wall : sample.walls()) {
    sample.points_of(wall, points);
    table.add(points, model);
  }
  return table;
}

/// The jackknife: what the estimate becomes without each group of consecutive walls in turn.
class Jackknife {
 public:
  Jackknife(const ResidualTable& table, const NoiseComponents& all) : all_(all) {
    const std::span<const WallResiduals> walls = table.walls();
    if (walls.size() < 2 * groups) return;
    std::vector<WallResiduals> kept;
    for (std::size_t g = 0; g < groups; ++g) {
      const auto begin = static_cast<std::ptrdiff_t>(walls.size() * g / groups);
      const auto end = static_cast<std::ptrdiff_t>(walls.size() * (g + 1) / groups);
      kept.assign(walls.begin(), walls.begin() + begin);
      kept.insert(kept.end(), walls.begin() + end, walls.end());
      without_.push_back(find_components(table, kept, all.model()));
    }
  }

  /// Of a standard deviation: by its square, which may be 0 as well as not.
  template <class Stddev>
  [[nodiscard]] Interval of_stddev(const Stddev& stddev) const {
    const Interval squared = of([&stddev](const NoiseComponents& components) {
      const double value = std::invoke(stddev, components);
      return value * value;
    });
    return {std::invoke(stddev, all_), std::sqrt(std::max(0.0, squared.low)),
            std::sqrt(squared.high)};
  }

  template <class Figure>
  [[nodiscard]] Interval of(const Figure& figure) const {
    const double value = figure(all_);
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (without_.empty()) return {value, -unknown, unknown};
    double mean = 0.0;
    for (const NoiseComponents& part : without_) mean += figure(part);
    mean /= static_cast<double>(groups);
    double squares = 0.0;
    for (const NoiseComponents& part : without_) {
      squares += (figure(part) - mean) * (figure(part) - mean);
    }
    const auto count = static_cast<double>(groups);
    const double half = t_97_5 * std::sqrt((count - 1.0) / count * squares);
    return {value, value - half, value + half};
  }

 private:
  NoiseComponents all_;
  std::vector<NoiseComponents> without_;
};

/// Sums of the squared residuals of ranges in one band.
struct BandSums {
  double points = 0.0, weight = 0.0, measured = 0.0, modelled = 0.0;
};

template <class Position>
std::vector<NoiseBand> noise_bands(const ResidualTable& table, const SensorModel& model,
                                   double highest, const Position& position) {
  std::array<BandSums, bands> sums;
  for (const WallResiduals& wall : table.walls()) {
    // A wall that is not one has no more weight than it would have as a noisy one.
    const double reduced = chi_square(table, wall, model) / (wall.points - 2.0);
    const double weight = std::min(1.0, 2.0 / std::max(reduced, 1e-300));
    for (const ResidualBlock& block : table.blocks(wall)) {
      const double at = position(block) / highest * static_cast<double>(bands);
      if (!(at < static_cast<double>(bands))) continue;
      BandSums& band = sums[static_cast<std::size_t>(at)];
      const double across = std::max(block.factors[of_range], 1e-6);
      band.points += block.points;
      band.weight += weight * block.points;
      band.measured += weight * block.squared * wall.points / (wall.points - 2.0) / across;
      band.modelled += weight * block.points * variance_of(block, model) / across;
    }
  }
  std::vector<NoiseBand> result;
  const double width = highest / static_cast<double>(bands);
  for (std::size_t b = 0; b < bands; ++b) {
    const BandSums& band = sums[b];
    if (band.points < static_cast<double>(fewest_points_of_band)) continue;
    result.push_back({width * static_cast<double>(b), width * static_cast<double>(b + 1),
                      static_cast<std::size_t>(band.points), std::sqrt(band.measured / band.weight),
                      std::sqrt(band.modelled / band.weight)});
  }
  return result;
}

double incidence_of(const ResidualBlock& block) { return std::acos(std::min(1.0, block.cosine)); }

void describe(const ResidualTable& table, NoiseEstimate& estimate) {
  const SensorModel model = estimate.components.model();
  std::vector<double> ranges;
  std::vector<double> incidences;
  std::vector<double> reduced;
  std::size_t refuted = 0;
  for (const WallResiduals& wall : table.walls()) {
    estimate.points += static_cast<std::size_t>(wall.points);
    estimate.long_walls += wall.halves ? 1 : 0;
    const double squares = chi_square(table, wall, model);
    reduced.push_back(squares / median_chi_square(wall.points - 2.0));
    if (residual_scale(squares, wall.points - 2.0) > 1.0) ++refuted;
    for (const ResidualBlock& block : table.blocks(wall)) {
      ranges.push_back(block.range);
      incidences.push_back(incidence_of(block));
    }
  }
  estimate.walls = table.walls().size();
  if (estimate.walls == 0) return;
  estimate.reduced_chi_square = median(std::move(reduced));
  estimate.refuted = static_cast<double>(refuted) / static_cast<double>(estimate.walls);
  estimate.nearest = quantile(ranges, 0.05);
  estimate.middle_range = median(ranges);
  estimate.farthest = quantile(std::move(ranges), 0.95);
  estimate.steepest = quantile(std::move(incidences), 0.95);
  estimate.by_range = noise_bands(table, model, estimate.farthest,
                                  [](const ResidualBlock& block) { return block.range; });
  estimate.by_incidence = noise_bands(table, model, steepest_band, incidence_of);
}

}  // namespace

void NoiseEstimator::add(const PointsView& points, std::span<const Segment> walls) {
  const std::size_t scan = scans_++;
  if (scan % stride_ != 0) return;
  sample_.add(scan, points, walls);
  while (sample_.ranges().size() > capacity_ && stride_ < scans_) {
    stride_ *= 2;
    sample_.thin(stride_);
  }
}

NoiseComponents NoiseEstimator::components(const SensorModel& start) const {
  NoiseComponents components;
  SensorModel model = start;
  for (int round = 0; round < rounds; ++round) {
    const ResidualTable table = residuals_of(sample_, model);
    components = find_components(table, table.walls(), model);
    model = components.model();
  }
  return components;
}

NoiseEstimate NoiseEstimator::estimate(const SensorModel& start) const {
  NoiseEstimate estimate;
  estimate.scans = scans_;
  estimate.components = components(start);
  const ResidualTable table = residuals_of(sample_, estimate.components.model());
  const Jackknife jackknife(table, estimate.components);
  using C = NoiseComponents;
  estimate.range_stddev = jackknife.of_stddev(&C::range_stddev);
  estimate.range_stddev_per_metre = jackknife.of_stddev(&C::range_stddev_per_metre);
  estimate.bearing_stddev = jackknife.of_stddev(&C::bearing_stddev);
  estimate.flatness_stddev = jackknife.of_stddev(&C::flatness_stddev);
  estimate.interlace_stddev = jackknife.of_stddev(&C::interlace_stddev);
  estimate.neighbour_correlation =
      jackknife.of([](const C& components) { return components.neighbour_correlation; });
  // The jackknife needs the middle range, which the residuals show.
  describe(table, estimate);
  estimate.middle_range_stddev = jackknife.of_stddev([&estimate](const C& components) {
    return std::hypot(components.range_stddev,
                      components.range_stddev_per_metre * estimate.middle_range);
  });
  estimate.quantization = quantization_step(sample_.ranges());
  return estimate;
}

}  // namespace quoin
