// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// Check for options that last: a time that is more than 0, in seconds or as "500ms", "5m", "1 h".
/// The option gets seconds.
[[nodiscard]] CLI::Validator a_time();

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

/// "quoin 0.1.0 (GNU 12.2.0, Release)"
[[nodiscard]] std::string version_text();

/// Parses the command line; `quoin help [COMMAND]` is `quoin [COMMAND] --help`. Throws
/// CLI::ParseError, and std::out_of_range for an unknown command, with the one that was meant.
void parse(CLI::App& app, int argc, char** argv);

[[nodiscard]] Command add_up(CLI::App& app);
[[nodiscard]] Command add_apply(CLI::App& app);
[[nodiscard]] Command add_bundle(CLI::App& app);
[[nodiscard]] Command add_calibrate(CLI::App& app);
[[nodiscard]] Command add_check(CLI::App& app);
[[nodiscard]] Command add_methods(CLI::App& app);
[[nodiscard]] Command add_status(CLI::App& app);
[[nodiscard]] Command add_echo(CLI::App& app);
[[nodiscard]] Command add_compare(CLI::App& app);
[[nodiscard]] Command add_draw(CLI::App& app);
[[nodiscard]] Command add_evaluate(CLI::App& app);
[[nodiscard]] Command add_explain(CLI::App& app);
[[nodiscard]] Command add_export(CLI::App& app);
[[nodiscard]] Command add_init(CLI::App& app);
[[nodiscard]] Command add_lidar(CLI::App& app);
[[nodiscard]] Command add_man(CLI::App& app);
[[nodiscard]] Command add_map(CLI::App& app);
[[nodiscard]] Command add_playback(CLI::App& app);
[[nodiscard]] Command add_record(CLI::App& app);
[[nodiscard]] Command add_recording(CLI::App& app);
[[nodiscard]] Command add_swap(CLI::App& app);
[[nodiscard]] Command add_set(CLI::App& app);
[[nodiscard]] Command add_discovery(CLI::App& app);
[[nodiscard]] Command add_doctor(CLI::App& app);
[[nodiscard]] Command add_keys(CLI::App& app);
[[nodiscard]] Command add_schema(CLI::App& app);
[[nodiscard]] Command add_completion(CLI::App& app);
[[nodiscard]] Command add_version(CLI::App& app);
[[nodiscard]] Command add_view(CLI::App& app);

/// The exit code of a command that ended with `code`: a failure where its output could not be
/// written, to a full disk or a pipe that was closed.
[[nodiscard]] int whole_output(int code);

}  // namespace quoin::deploy
