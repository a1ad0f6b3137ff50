// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/methods_page.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "core/geometry/angle.hpp"
#include "deploy/evaluation/drawing/svg.hpp"
#include "deploy/evaluation/methods/description.hpp"
#include "deploy/evaluation/methods/figure_tables.hpp"
#include "deploy/evaluation/methods/markdown.hpp"
#include "deploy/evaluation/methods/parameter_text.hpp"

namespace quoin::deploy {

namespace {

std::string sentence(std::string text) {
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (text.back() != '.') text += '.';
  return text;
}

/// Nobody thinks in radians.
std::string default_cell(const ParameterInfo& info) {
  if (info.required) return "required";
  if (info.unit != "rad") return default_text(info);
  const double radians = std::strtod(info.default_value.c_str(), nullptr);
  return number(radians, 4) + " (" + number(radians * 180.0 / pi, 2) + " deg)";
}

std::string parameter_table(const std::vector<ParameterInfo>& parameters) {
  std::vector<std::vector<std::string>> rows{{"parameter", "default", "unit", "range", "meaning"}};
  for (const ParameterInfo& info : parameters) {
    rows.push_back({info.name, default_cell(info), info.unit, range_text(info), info.description});
  }
  return markdown_table(rows, rows.front().size());
}

bool contains(const std::vector<ParameterInfo>& parameters, const ParameterInfo& info) {
  return std::find(parameters.begin(), parameters.end(), info) != parameters.end();
}

/// What all of several methods have in common, to be listed once.
std::vector<ParameterInfo> shared_parameters(const std::vector<MethodInfo>& methods) {
  std::vector<ParameterInfo> shared;
  if (methods.size() < 2) return shared;
  for (const ParameterInfo& info : methods.front().parameters) {
    if (std::all_of(methods.begin(), methods.end(),
                    [&](const MethodInfo& method) { return contains(method.parameters, info); })) {
      shared.push_back(info);
    }
  }
  return shared;
}

std::string method_text(const MethodInfo& method, bool is_default,
                        const std::vector<ParameterInfo>& shared) {
  std::string text = "### " + method.name + (is_default ? " (default)" : "") + "\n\n" +
                     markdown_paragraph(sentence(method.description)) +
                     markdown_paragraph("Source: " + sentence(method.source)) +
                     markdown_paragraph("When to choose it: " + sentence(method.choose));
  std::vector<ParameterInfo> own;
  for (const ParameterInfo& info : method.parameters) {
    if (!contains(shared, info)) own.push_back(info);
  }
  return own.empty() ? text : text + parameter_table(own);
}

std::string figures_of(const KindInfo& kind, const MeasuredFigures& figures) {
  if (kind.output("segments") != nullptr) return segmenter_tables(figures);
  if (kind.output("lines") != nullptr) return fitter_tables(figures);
  return "";
}

std::string kind_text(const KindInfo& kind, const MeasuredFigures* figures) {
  const std::vector<ParameterInfo> shared = shared_parameters(kind.methods);
  std::string text =
      "## " + kind.name + "\n\n" +
      markdown_paragraph(sentence(kind.description) + " " + sentence(ports_text(kind)));
  if (!shared.empty()) {
    text +=
        markdown_paragraph("All of its methods have these parameters, and those listed below:") +
        parameter_table(shared);
  }
  for (const MethodInfo& method : kind.methods) {
    text += method_text(method, &method == &kind.methods.front(), shared);
  }
  const std::string tables = figures ? figures_of(kind, *figures) : "";
  return tables.empty() ? text : text + "### Figures of " + kind.name + "\n\n" + tables;
}

}  // namespace

std::string methods_page(const std::vector<const KindInfo*>& kinds,
                         const MeasuredFigures* figures) {
  std::string text =
      "# Methods\n\n" +
      markdown_paragraph(
          "Quoin writes this page from its own descriptions of the methods and "
          "from what it measures of them. Do not edit it; write it anew with") +
      "    build/bin/quoin evaluate -o report\n"
      "    build/bin/quoin methods --markdown --report report/report.json > docs/methods.md\n\n" +
      markdown_paragraph(
          "The first method of each kind of service is its default. In a deployment "
          "file a value may carry a unit, such as `10 deg` or `5 cm`; without one "
          "it is in the unit of the table.");
  for (const KindInfo* kind : kinds) {
    if (!kind->methods.empty()) text += kind_text(*kind, figures);
  }
  text.pop_back();  // the last of two ends of lines
  return text;
}

}  // namespace quoin::deploy
