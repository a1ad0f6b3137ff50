// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/evaluation/methods/description.hpp"
#include "deploy/evaluation/methods/measured_figures.hpp"
#include "deploy/evaluation/methods/methods_page.hpp"
#include "deploy/evaluation/methods/schema.hpp"
#include "deploy/kinds/kinds.hpp"

namespace quoin::deploy {

namespace {

struct MethodsOptions {
  std::string kind;
  bool json = false;
  bool markdown = false;
  std::string report;
};

/// The kind of this name, or all.
std::vector<const KindInfo*> chosen(const std::string& name) {
  if (name.empty()) return kinds().kinds;
  std::vector<std::string> names;
  for (const KindInfo* kind : kinds().kinds) {
    if (kind->name == name) return {kind};
    names.push_back(kind->name);
  }
  throw ParameterError("kind", "unknown kind '" + name + "'" + suggestion(name, names));
}

void print_json(const std::vector<const KindInfo*>& kinds) {
  auto list = nlohmann::ordered_json::array();
  for (const KindInfo* kind : kinds) list.push_back(description_json(*kind));
  std::cout << list.dump(2) << '\n';
}

void print_text(const std::vector<const KindInfo*>& kinds) {
  for (const KindInfo* kind : kinds) {
    std::cout << (kind == kinds.front() ? "" : "\n") << description_text(*kind);
  }
}

void print_markdown(const std::vector<const KindInfo*>& kinds, const std::string& report) {
  if (kinds.size() == 1 && kinds.front()->methods.empty()) {
    throw ParameterError("kind", "kind '" + kinds.front()->name + "' has no methods");
  }
  std::optional<MeasuredFigures> figures;
  if (!report.empty()) figures = read_figures(report);
  std::cout << methods_page(kinds, figures ? &*figures : nullptr);
}

int run(const MethodsOptions& options) {
  try {
    const std::vector<const KindInfo*> kinds = chosen(options.kind);
    if (options.json) {
      print_json(kinds);
    } else if (options.markdown) {
      print_markdown(kinds, options.report);
    } else {
      print_text(kinds);
    }
    return exit_ok;
  } catch (const ParameterError& error) {
    std::cerr << error.what() << '\n';
  } catch (const ReportError& error) {
    std::cerr << error.what() << '\n';
  }
  return exit_configuration;
}

}  // namespace

Command add_methods(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("methods", "List the kinds of services, their methods and parameters");
  const auto options = std::make_shared<MethodsOptions>();
  line->add_option("kind", options->kind, "Only this kind");
  CLI::Option* json = line->add_flag("--json", options->json, "As a JSON array");
  CLI::Option* markdown =
      line->add_flag("--markdown", options->markdown, "The methods as a page in Markdown")
          ->excludes(json);
  line->add_option("--report", options->report,
                   "With the figures of this report.json of quoin evaluate")
      ->needs(markdown);
  return {line, [options] { return run(*options); }};
}

Command add_schema(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "schema", "Print the JSON Schema of the deployment file, with which editors complete it");
  return {line, [] {
            std::cout << deployment_schema(kinds()).dump(2) << '\n';
            return std::cout.flush() ? exit_ok : exit_failure;
          }};
}

}  // namespace quoin::deploy
