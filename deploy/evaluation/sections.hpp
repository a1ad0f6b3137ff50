// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "deploy/evaluation/html.hpp"
#include "deploy/evaluation/jobs.hpp"
#include "deploy/evaluation/options.hpp"

namespace quoin::deploy {

/// Rows of a table for the terminal; the first is its head, the first column has the names.
using SummaryTable = std::vector<std::vector<std::string>>;

/// One part of the report: what is computed, and how it is shown.
class Section {
 public:
  virtual ~Section() = default;
  /// Jobs that write into the section, which must live until they are done.
  [[nodiscard]] virtual std::vector<Job> jobs() = 0;
  /// Measurements of time, to be run one after the other when nothing else runs.
  [[nodiscard]] virtual std::vector<Job> timing_jobs() { return {}; }
  /// Adds members to the report, and entries to its array `published`.
  virtual void write_json(nlohmann::ordered_json& report) const = 0;
  virtual void write_html(HtmlPage& page) const = 0;
  /// The main figures; empty when there is nothing to say.
  [[nodiscard]] virtual SummaryTable summary() const = 0;
};

/// A section before it has been asked for.
struct SectionKind {
  std::string name;   ///< as --only knows it
  std::string title;  ///< heading in the report
  std::unique_ptr<Section> (*make)(const EvaluationSetup&);
};

inline constexpr const char* scan_files_section = "scans";

/// All sections in the order of the report. A new one is one file, one declaration below and one
/// entry in the list.
[[nodiscard]] const std::vector<SectionKind>& section_kinds();
[[nodiscard]] std::vector<std::string> section_names();

[[nodiscard]] std::unique_ptr<Section> make_wctls_paper_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_cwlf_paper_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_pca_paper_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_consistency_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_lines_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_circles_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_loop_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_worlds_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_segmenters_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_robustness_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_mapping_section(const EvaluationSetup& setup);
[[nodiscard]] std::unique_ptr<Section> make_scan_files_section(const EvaluationSetup& setup);

}  // namespace quoin::deploy
