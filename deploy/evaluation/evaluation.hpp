// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "deploy/evaluation/options.hpp"

namespace quoin::deploy {

struct EvaluationProgress {
  std::size_t done = 0;  ///< jobs
  std::size_t total = 0;
  std::string section;                ///< that the job last begun belongs to
  std::string job;                    ///< last begun
  std::vector<std::string> finished;  ///< sections that are complete
};

/// The report in all its forms.
struct EvaluationReport {
  std::string json;
  std::string html;
  std::vector<std::string> summary;  ///< lines for the terminal
};

/// Computes the sections that were asked for. `proceed` is called several times a second; when it
/// returns false, Interrupted is thrown. Same options and seed, same report, whatever the number of
/// threads, but for the figures of time.
[[nodiscard]] EvaluationReport evaluate(
    const EvaluationSetup& setup, const std::function<bool(const EvaluationProgress&)>& proceed);

/// Writes report.json and report.html into `folder`, which is made if it is absent. A file is
/// complete or it is not there. Throws std::runtime_error.
void write_report(const EvaluationReport& report, const std::filesystem::path& folder);

}  // namespace quoin::deploy
