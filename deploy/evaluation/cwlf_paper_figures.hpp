// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/evaluation/papers/cwlf_paper.hpp"
#include "core/evaluation/papers/published_figures.hpp"
#include "deploy/evaluation/html.hpp"

namespace quoin::deploy {

/// Angles [rad] of the corners in the paper's Fig. 4 (and 3) and in Fig. 5.
inline constexpr double figure_4_angle = 130.0 * pi / 180.0;
inline constexpr double figure_5_angle = 90.0 * pi / 180.0;

/// The corner of that angle, or nothing.
[[nodiscard]] const CwlfPaperCorner* find_corner(const std::vector<CwlfPaperCorner>& corners,
                                                 double angle, std::size_t points, CornerForm form,
                                                 CovarianceMode mode);

/// Time of that form over the time of cwlf; nothing when one was not measured.
[[nodiscard]] std::optional<double> time_over_cwlf(const std::vector<CwlfPaperCorner>& corners,
                                                   double angle, std::size_t points,
                                                   CornerForm form, CovarianceMode mode);

/// Tables I and II and Fig. 2.
void write_environment(HtmlPage& page, const PublishedTable& published,
                       const CwlfPaperEnvironment& result);

/// Fig. 3; nothing when no time was measured.
void write_times(HtmlPage& page, const std::vector<CwlfPaperCorner>& corners);

/// Figs. 4 and 5. Without times the standard deviations remain.
void write_steps(HtmlPage& page, const std::vector<CwlfPaperCorner>& corners);

}  // namespace quoin::deploy
