// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "deploy/evaluation/methods/measured_figures.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::deploy {

/// The methods of all `kinds` that have any, as a page in Markdown: what they do, where they come
/// from, when to choose them and what can be set; with the figures of `figures` unless it is null.
[[nodiscard]] std::string methods_page(const std::vector<const KindInfo*>& kinds,
                                       const MeasuredFigures* figures);

}  // namespace quoin::deploy
