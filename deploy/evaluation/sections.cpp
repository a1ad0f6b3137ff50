// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/sections.hpp"

namespace quoin::deploy {

const std::vector<SectionKind>& section_kinds() {
  static const std::vector<SectionKind> kinds{
      {"wctls_paper", "The WCTLS paper's experiment", make_wctls_paper_section},
      {"cwlf_paper", "The CWLF paper's experiment", make_cwlf_paper_section},
      {"pca_paper", "The PCA paper's simulations", make_pca_paper_section},
      {"consistency", "Consistency of fitters", make_consistency_section},
      {"lines", "Lines of any length and distance", make_lines_section},
      {"circles", "Consistency of circles", make_circles_section},
      {"loop", "Coverage with segmentation in the loop", make_loop_section},
      {"worlds", "Rooms, flats and halls", make_worlds_section},
      {"segmenters", "Segmenters", make_segmenters_section},
      {"robustness", "Stray returns, few rays and round things", make_robustness_section},
      {"mapping", "Maps and localization", make_mapping_section},
      {scan_files_section, "Scan files", make_scan_files_section}};
  return kinds;
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const SectionKind& kind : section_kinds()) names.push_back(kind.name);
  return names;
}

}  // namespace quoin::deploy
