// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "deploy/evaluation/methods/measured_figures.hpp"

namespace quoin::deploy {

/// The figures of the fitters and their times in Markdown; "" when there are none.
[[nodiscard]] std::string fitter_tables(const MeasuredFigures& figures);

/// The figures of the segmenters in Markdown; "" when there are none.
[[nodiscard]] std::string segmenter_tables(const MeasuredFigures& figures);

}  // namespace quoin::deploy
