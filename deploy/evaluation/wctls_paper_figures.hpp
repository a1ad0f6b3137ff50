// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/evaluation/papers/published_figures.hpp"
#include "core/evaluation/papers/wctls_paper.hpp"
#include "deploy/evaluation/html.hpp"

namespace quoin::deploy {

inline constexpr std::array<const char*, 3> wctls_paper_fitters{"utls", "wtls", "wctls"};

/// Median over the scans of the median ellipse area of a scan [mm^2].
[[nodiscard]] std::optional<double> area_of(const WctlsPaperEnvironment& result,
                                            const std::string& fitter, CovarianceMode mode);

/// That of utls over that of wctls.
[[nodiscard]] std::optional<double> area_ratio(const WctlsPaperEnvironment& result,
                                               CovarianceMode mode);
[[nodiscard]] double published_area_ratio(const std::string& world);

/// Tables and pictures of one environment.
void write_environment(HtmlPage& page, const PublishedTable& published,
                       const WctlsPaperEnvironment& result);

}  // namespace quoin::deploy
