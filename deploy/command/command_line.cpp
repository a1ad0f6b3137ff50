// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "deploy/command/commands.hpp"

namespace quoin::deploy {

namespace {

/// What is wrong with the first word of the command line; "" when it may name a command.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  const std::string word = argv[1];
  std::vector<std::string> names{"help"};
  for (const CLI::App* line : app.get_subcommands({})) names.push_back(line->get_name());
  if (std::ranges::find(names, word) != names.end()) return "";
  const std::string near = nearest_name(word, names);
  return "unknown command '" + word + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?") +
         " (quoin --help lists them)";
}

std::vector<std::string> arguments_of(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty() && arguments[0] == "help") {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  std::ranges::reverse(arguments);  // as CLI11 takes them
  return arguments;
}

}  // namespace

void parse(CLI::App& app, int argc, char** argv) {
  if (const std::string error = unknown_command(app, argc, argv); !error.empty()) {
    throw std::out_of_range(error);
  }
  app.set_version_flag("--version", version_text());
  app.parse(arguments_of(argc, argv));
}

CLI::Validator a_time() {
  const auto to_seconds = [](std::string& text) -> std::string {
    ParameterInfo info;
    info.unit = "s";
    // Nobody means metres.
    std::string written = text;
    if (written.ends_with('m')) written += "in";
    try {
      const double seconds = detail::parse_real(info, written);
      if (!(seconds > 0.0)) return "'" + text + "' is not more than 0";
      text = std::to_string(seconds);
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  };
  return {to_seconds, "TIME"};
}

}  // namespace quoin::deploy
