// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace quoin {

/// One row of the numerical simulations of the PCA paper (section 3): points in equal steps along a
/// straight line, displaced across it by normal noise; some of them outliers.
struct PcaSimulation {
  int table = 0;            ///< of the paper: 1 separation and length, 2 noise, 3 outliers
  double separation = 0.0;  ///< [m] of neighbouring points
  std::size_t points = 0;
  double noise = 0.0;     ///< [m]
  double outliers = 0.0;  ///< fraction of the points
};

/// The rows. Those of Table 1 span the range that the text gives, since our copy of the paper has
/// no tables; those of Tables 2 and 3 are the text's.
[[nodiscard]] std::vector<PcaSimulation> pca_simulations();

/// Accuracy of one method: what the paper measures, and what it cannot know without the truth.
struct LineAccuracy {
  double residual = 0.0;     ///< [m] standard deviation of the points from the line, mean of all
  double angle_rmse = 0.0;   ///< [rad] from the true direction
  double offset_rmse = 0.0;  ///< [m] from the true line, at the middle of the points
  double seconds = 0.0;      ///< of one fit with covariance; 0 when not measured
};

struct PcaComparison {
  PcaSimulation simulation;
  LineAccuracy pca;
  LineAccuracy least_squares;
};

/// Repeats one simulation `trials` times (10000 in the paper) for both methods. Outliers lie three
/// standard deviations aside, on one side or the other: our copy of the paper does not show how far
/// the paper's did.
[[nodiscard]] PcaComparison compare_pca(const PcaSimulation& simulation, std::size_t trials,
                                        std::uint64_t seed);

/// Fills the times. They differ from run to run; nothing else does.
void time_pca(PcaComparison& comparison, std::uint64_t seed);

}  // namespace quoin
