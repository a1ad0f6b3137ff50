// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "deploy/calibration/calibration.hpp"

namespace quoin::deploy {

/// What is missing, each as a sentence with what to do; none when the calibration can be used.
[[nodiscard]] std::vector<std::string> shortcomings(const Calibration& calibration);

/// A table of components with their 95 % intervals, and what they rest on.
[[nodiscard]] std::vector<std::string> calibration_lines(const Calibration& calibration);

/// How the block begins; a file that begins so may be replaced.
inline constexpr const char* calibration_marker = "# Measured by quoin calibrate";

/// The block for the source in a deployment file. `origin` names the scans, for a comment.
[[nodiscard]] std::string sensor_block(const Calibration& calibration, const std::string& origin);

[[nodiscard]] nlohmann::ordered_json calibration_json(const Calibration& calibration);

/// A page with the table and plots of the noise over range and incidence.
[[nodiscard]] std::string calibration_page(const Calibration& calibration,
                                           const std::string& origin);

}  // namespace quoin::deploy
