// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fitting/fit.hpp"
#include "core/geometry/angle.hpp"
#include "core/geometry/corner.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// The sensor model of the CWLF and WCTLS papers: the data sheet's accuracy and resolution of the
/// RPLIDAR S1 taken for standard deviations (50 mm, 0.391 deg).
[[nodiscard]] inline SensorModel data_sheet_model() { return {0.05, 0.391 * pi / 180.0, 0.0}; }

/// A fitter in one covariance mode, under the name it has in the results.
struct NamedFitter {
  std::string name;
  CovarianceMode covariance = CovarianceMode::propagated;
  Fitter fitter;
};

/// What a fitter gave for each true corner of one scan; nothing where it was not found.
struct PaperCorners {
  std::string fitter;
  CovarianceMode covariance = CovarianceMode::propagated;
  std::vector<std::optional<CornerEstimate>> corners;
};

}  // namespace quoin
