// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/sensor/points.hpp"

namespace quoin::deploy {

/// A report that cannot be used: which, where in it, what is wrong.
class ReportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One fitter in one covariance mode; no figures where there was no corner.
struct FitterFigures {
  std::string name;
  std::string covariance;
  std::string environment;
  SensorModel noise;
  std::optional<double> nees;
  std::optional<double> coverage95;
  std::optional<double> rmse_over_crb;
};

struct SegmenterFigures {
  std::string name;
  SensorModel noise;
  std::uint64_t scans = 0;
  double true_positive_rate = 0.0;
  double false_positive_rate = 0.0;
  std::optional<double> scans_per_second;  ///< nothing without timing
};

struct FitTimeFigures {
  std::string name;
  std::uint64_t points = 0;
  std::optional<double> seconds;          ///< nothing without timing
  std::optional<double> over_covariance;  ///< over the time of a plain covariance
};

/// What `quoin evaluate` found out of the methods.
struct MeasuredFigures {
  std::string version;  ///< of the program that measured
  std::uint64_t seed = 0;
  std::uint64_t trials = 0;  ///< of each fitter
  std::vector<FitterFigures> fitters;
  std::vector<SegmenterFigures> segmenters;
  std::vector<FitTimeFigures> fit_times;
};

/// From the text of a report.json; `name` is what errors call it. Throws ReportError.
[[nodiscard]] MeasuredFigures parse_figures(std::string_view text, const std::string& name);
/// From a report.json. Throws ReportError.
[[nodiscard]] MeasuredFigures read_figures(const std::filesystem::path& file);

}  // namespace quoin::deploy
