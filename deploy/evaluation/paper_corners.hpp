// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/corners/corner_finder.hpp"
#include "core/evaluation/papers/paper_corners.hpp"
#include "core/evaluation/papers/published_figures.hpp"
#include "deploy/evaluation/drawing/drawing.hpp"
#include "deploy/evaluation/html.hpp"

namespace quoin::deploy {

inline constexpr std::array paper_modes{CovarianceMode::as_published, CovarianceMode::propagated};

/// Ellipses of the corners are drawn enlarged as in the WCTLS paper's Fig. 3.
inline constexpr double ellipse_expansion = 10.0;

/// The results of one fitter in one mode, which must be there.
template <class Method>
const Method& method_of(const std::vector<Method>& methods, const std::string& fitter,
                        CovarianceMode mode) {
  return *std::find_if(methods.begin(), methods.end(), [&](const Method& method) {
    return method.fitter == fitter && method.covariance == mode;
  });
}

using CornersOf = std::function<const PaperCorners&(const std::string& fitter, CovarianceMode)>;

/// Refers to `methods`, which must outlive it.
template <class Method>
CornersOf corners_in(const std::vector<Method>& methods) {
  return [&methods](const std::string& fitter, CovarianceMode mode) -> const PaperCorners& {
    return method_of(methods, fitter, mode);
  };
}

/// Standard deviations [m] of the corners that were found; NaN for the others.
struct CornerSigmas {
  std::vector<double> x, y;
};

[[nodiscard]] CornerSigmas sigmas_of(const PaperCorners& method);

/// One figure for a column of values: of those that are numbers; nothing without any.
struct ColumnSummary {
  const char* name;
  std::optional<double> (*of)(std::vector<double>);
};

[[nodiscard]] std::optional<double> median_of(std::vector<double> values);
[[nodiscard]] std::optional<double> mean_of(std::vector<double> values);

/// "-" for nothing and for what is not finite.
[[nodiscard]] std::string text(const std::optional<double>& value, int digits);

/// fitter, covariance, sigma_x and sigma_y; null for a corner that was not found.
[[nodiscard]] nlohmann::ordered_json sigmas_json(const PaperCorners& method);

/// Position [m] of each corner.
[[nodiscard]] nlohmann::ordered_json positions_json(const std::vector<Eigen::Vector2d>& corners);

/// Adds the summaries of the published sigmas and of ours in both modes to the report.
void add_published_sigmas(nlohmann::ordered_json& report, const PublishedTable& published,
                          const CornersOf& corners_of, const ColumnSummary& summary);

/// Our sigmas [mm] in both modes beside the published ones; a row for each corner, then a summary.
[[nodiscard]] HtmlTable sigma_table(const PublishedTable& published, const CornersOf& corners_of,
                                    const ColumnSummary& summary);

/// Points, lines and the one-sigma ellipses of up to three fitters in one mode, those first that
/// shall lie below the others.
[[nodiscard]] Drawing ellipse_drawing(const std::string& world,
                                      const std::vector<Eigen::Vector2d>& points,
                                      const std::vector<LineSegment>& lines,
                                      const std::vector<std::string>& fitters, CovarianceMode mode,
                                      const CornersOf& corners_of);

}  // namespace quoin::deploy
