// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "deploy/deployment/exit_code.hpp"

namespace quoin::deploy {

/// A subcommand: its command line, and what to do once that has been parsed. Returns the exit code.
struct Command {
  CLI::App* line;
  std::function<int()> run;
};

/// Check for options that count or last.
[[nodiscard]] inline CLI::Validator more_than_zero() {
  const auto check = [](std::string& text) -> std::string {
    return std::strtod(text.c_str(), nullptr) > 0.0 ? "" : "'" + text + "' is not more than 0";
  };
  return {check, "> 0"};
}

/// Where the services of a running deployment are found without its file.
struct NetworkOptions {
  int domain = 0;
  std::string name_space = "quoin";
};

/// `file` is the option of the deployment file, which says both.
inline void add_network_options(CLI::App& line, NetworkOptions& options, CLI::Option* file) {
  line.add_option("--domain", options.domain, "DDS domain")
      ->check(CLI::Range(0, 232))
      ->excludes(file);
  line.add_option("--namespace", options.name_space, "Namespace of the topics")->excludes(file);
}

[[nodiscard]] Command add_up(CLI::App& app);
[[nodiscard]] Command add_apply(CLI::App& app);
[[nodiscard]] Command add_check(CLI::App& app);
[[nodiscard]] Command add_methods(CLI::App& app);
[[nodiscard]] Command add_status(CLI::App& app);
[[nodiscard]] Command add_echo(CLI::App& app);
[[nodiscard]] Command add_draw(CLI::App& app);
[[nodiscard]] Command add_evaluate(CLI::App& app);
[[nodiscard]] Command add_lidar(CLI::App& app);
[[nodiscard]] Command add_swap(CLI::App& app);
[[nodiscard]] Command add_set(CLI::App& app);
[[nodiscard]] Command add_version(CLI::App& app);

}  // namespace quoin::deploy
