// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/papers/pca_paper.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace quoin {
namespace {

constexpr std::size_t trials = 400;

double length(const PcaSimulation& simulation) {
  return simulation.separation * static_cast<double>(simulation.points - 1);
}

TEST(PcaPaper, HasTheRowsOfItsTables) {
  std::array<std::size_t, 4> rows{};
  for (const PcaSimulation& simulation : pca_simulations()) {
    ASSERT_GE(simulation.table, 1);
    ASSERT_LE(simulation.table, 3);
    ++rows.at(static_cast<std::size_t>(simulation.table));
    EXPECT_GE(simulation.points, 10U);
    EXPECT_EQ(simulation.outliers > 0.0, simulation.table == 3);
  }
  EXPECT_EQ(rows, (std::array<std::size_t, 4>{0, 15, 5, 4}));
}

TEST(PcaPaper, ResidualIsTheNoiseButForTwoFittedParameters) {
  for (const PcaSimulation& simulation : pca_simulations()) {
    // With noise as large as the line is long the direction is not a first-order matter any more.
    if (simulation.outliers > 0.0 || simulation.noise > 0.1 * length(simulation)) continue;
    const PcaComparison comparison = compare_pca(simulation, trials, 7);
    const auto n = static_cast<double>(simulation.points);
    // Root of the mean square over n of chi-square with n - 2 degrees of freedom; the mean of the
    // root lies lower by 1 / (4 (n - 2)), and the mean of the trials scatters by
    // 1 / sqrt(2 (n - 2) trials), of which four are allowed.
    const double expected = simulation.noise * std::sqrt((n - 2.0) / n) * (1.0 - 0.25 / (n - 2.0));
    const double scatter = 1.0 / std::sqrt(2.0 * (n - 2.0) * static_cast<double>(trials));
    // Rotation of the line by the noise makes the distances shorter than the displacements.
    const double second_order = std::pow(simulation.noise / length(simulation), 2);
    EXPECT_NEAR(comparison.pca.residual / expected, 1.0, 4.0 * scatter + second_order)
        << simulation.table << " " << simulation.points << " " << simulation.noise;
  }
}

TEST(PcaPaper, DirectionHasTheErrorOfTheory) {
  const PcaSimulation simulation{1, 0.010, 100, 0.005, 0.0};
  const PcaComparison comparison = compare_pca(simulation, 2000, 11);
  const double n = 100.0;
  // Variance of the slope, and of the offset at the mean; 1 / sqrt(2 trials) of scatter.
  const double along = simulation.separation * std::sqrt(n * (n * n - 1.0) / 12.0);
  for (const LineAccuracy* accuracy : {&comparison.pca, &comparison.least_squares}) {
    EXPECT_NEAR(accuracy->angle_rmse * along / simulation.noise, 1.0, 4.0 / std::sqrt(4000.0));
    EXPECT_NEAR(accuracy->offset_rmse * std::sqrt(n) / simulation.noise, 1.0,
                4.0 / std::sqrt(4000.0));
  }
}

TEST(PcaPaper, MethodsDifferLittleOverAMetre) {
  for (const PcaSimulation& simulation : pca_simulations()) {
    if (simulation.table != 1 || std::abs(length(simulation) - 1.0) > 0.15) continue;
    const PcaComparison comparison = compare_pca(simulation, trials, 3);
    EXPECT_NEAR(comparison.least_squares.residual / comparison.pca.residual, 1.0, 0.01);
    // Principal components minimise the very distances that are measured here.
    EXPECT_LE(comparison.pca.residual, comparison.least_squares.residual);
  }
}

TEST(PcaPaper, OutliersRaiseTheResidual) {
  double before = compare_pca({3, 0.025, 200, 0.040, 0.0}, trials, 9).pca.residual;
  for (const PcaSimulation& simulation : pca_simulations()) {
    if (simulation.table != 3) continue;
    const double residual = compare_pca(simulation, trials, 9).pca.residual;
    EXPECT_GT(residual, before);
    before = residual;
  }
}

TEST(PcaPaper, IsTheSameForTheSameSeed) {
  const PcaSimulation simulation = pca_simulations().back();
  const PcaComparison one = compare_pca(simulation, 20, 1);
  const PcaComparison same = compare_pca(simulation, 20, 1);
  EXPECT_EQ(one.pca.angle_rmse, same.pca.angle_rmse);
  EXPECT_EQ(one.least_squares.residual, same.least_squares.residual);
  EXPECT_NE(one.pca.angle_rmse, compare_pca(simulation, 20, 2).pca.angle_rmse);
  EXPECT_EQ(one.pca.seconds, 0.0);
}

}  // namespace
}  // namespace quoin
