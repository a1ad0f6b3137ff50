// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/papers/pca_paper.hpp"

#include <cmath>

#include "core/evaluation/fit_timing.hpp"
#include "core/fitting/axis_regression.hpp"
#include "core/fitting/orthogonal.hpp"
#include "core/geometry/angle.hpp"
#include "core/simulation/random.hpp"

namespace quoin {
namespace {

constexpr double line_distance = 2.0;     // [m] of the line from the sensor; neither method minds
constexpr double outlier_distance = 3.0;  // [standard deviations]

/// Points about the line y = `line_distance`, their middle at x = 0.
void simulate(const PcaSimulation& simulation, Random& random, Points& points) {
  points.resize(simulation.points);
  const double first = -0.5 * simulation.separation * static_cast<double>(simulation.points - 1);
  for (std::size_t i = 0; i < simulation.points; ++i) {
    points.x[i] = first + simulation.separation * static_cast<double>(i);
    points.y[i] = line_distance + simulation.noise * random.normal();
  }
  const auto outliers = static_cast<std::size_t>(
      std::lround(simulation.outliers * static_cast<double>(simulation.points)));
  for (std::size_t k = 0; k < outliers; ++k) {
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    points.y[random.index(simulation.points)] =
        line_distance + side * outlier_distance * simulation.noise;
  }
  for (std::size_t i = 0; i < simulation.points; ++i) {
    points.range[i] = std::hypot(points.x[i], points.y[i]);
    points.bearing[i] = std::atan2(points.y[i], points.x[i]);
    points.inverse_range[i] = 1.0 / points.range[i];
    points.cosine[i] = points.x[i] * points.inverse_range[i];
    points.sine[i] = points.y[i] * points.inverse_range[i];
  }
}

/// Sums over the trials.
struct Sums {
  double residual = 0.0;
  double angle_squares = 0.0;
  double offset_squares = 0.0;
  std::size_t count = 0;

  void add(const FitResult& fit, const Points& points) {
    if (!fit.ok()) return;
    const Line& line = fit.estimate.line;
    const Eigen::Vector2d normal = line.normal();
    double squares = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double d = normal.x() * points.x[i] + normal.y() * points.y[i] - line.r;
      squares += d * d;
    }
    residual += std::sqrt(squares / static_cast<double>(points.size()));
    const double angle = normalized_angle(line.alpha - 0.5 * pi);
    angle_squares += angle * angle;
    const double offset = normal.y() * line_distance - line.r;
    offset_squares += offset * offset;
    ++count;
  }

  [[nodiscard]] LineAccuracy accuracy() const {
    if (count == 0) return {};
    const auto n = static_cast<double>(count);
    return {residual / n, std::sqrt(angle_squares / n), std::sqrt(offset_squares / n), 0.0};
  }
};

}  // namespace

std::vector<PcaSimulation> pca_simulations() {
  std::vector<PcaSimulation> rows;
  for (const double separation : {0.005, 0.010, 0.025, 0.050, 0.100}) {
    for (const double length : {1.0, 5.0, 10.0}) {
      rows.push_back(
          {1, separation, static_cast<std::size_t>(std::lround(length / separation)), 0.040, 0.0});
    }
  }
  for (const double noise : {0.005, 0.010, 0.050, 0.100, 0.200}) {
    rows.push_back({2, 0.050, 20, noise, 0.0});
  }
  for (const double outliers : {0.01, 0.05, 0.10, 0.20}) {
    rows.push_back({3, 0.025, 200, 0.040, outliers});
  }
  return rows;
}

PcaComparison compare_pca(const PcaSimulation& simulation, std::size_t trials, std::uint64_t seed) {
  Random random(seed);
  const Pca pca;
  const LeastSquares least_squares;
  const SensorModel sensor{simulation.noise, 0.0, 0.0};
  Points points;
  Sums pca_sums;
  Sums least_squares_sums;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    simulate(simulation, random, points);
    pca_sums.add(pca(points, sensor), points);
    least_squares_sums.add(least_squares(points, sensor), points);
  }
  return {simulation, pca_sums.accuracy(), least_squares_sums.accuracy()};
}

void time_pca(PcaComparison& comparison, std::uint64_t seed) {
  Random random(seed);
  Points points;
  simulate(comparison.simulation, random, points);
  const SensorModel sensor{comparison.simulation.noise, 0.0, 0.0};
  volatile double sink = 0.0;
  const auto time = [&](const auto& fitter) {
    return seconds_per_call([&] { sink = fitter(points, sensor).estimate.line.r; });
  };
  comparison.pca.seconds = time(Pca{});
  comparison.least_squares.seconds = time(LeastSquares{});
}

}  // namespace quoin
