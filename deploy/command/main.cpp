// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "core/text/printable.hpp"
#include "deploy/command/commands.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/process/log.hpp"

namespace {

using namespace quoin;
using namespace quoin::deploy;

/// What is wrong with the first word of the command line; "" when it may name a command.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  const std::string word = argv[1];
  std::vector<std::string> names{"help"};
  for (const CLI::App* line : app.get_subcommands({})) names.push_back(line->get_name());
  if (std::ranges::find(names, word) != names.end()) return "";
  const std::string near = nearest_name(word, names);
  return "unknown command '" + printable(word) + "'" +
         (near.empty() ? "" : "; did you mean '" + near + "'?") + " (quoin --help lists them)";
}

/// `quoin help [COMMAND]` as `quoin [COMMAND] --help`.
std::vector<std::string> arguments_of(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty() && arguments[0] == "help") {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  std::ranges::reverse(arguments);  // as CLI11 takes them
  return arguments;
}

int run(int argc, char** argv) {
  CLI::App app{"Quoin: lines and corners with trustworthy covariances from 2D LiDAR scans"};
  app.name("quoin");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text());
  app.footer(
      "Exit codes: 0 ok, 1 failure, 2 wrong usage or configuration, 3 input of a source unusable, "
      "4 scans that do not show what calibrate wants to know");
  const std::vector<Command> commands{
      add_up(app),       add_apply(app),      add_check(app),   add_methods(app),
      add_status(app),   add_echo(app),       add_compare(app), add_draw(app),
      add_evaluate(app), add_export(app),     add_record(app),  add_recording(app),
      add_lidar(app),    add_map(app),        add_swap(app),    add_set(app),
      add_keys(app),     add_discovery(app),  add_doctor(app),  add_calibrate(app),
      add_schema(app),   add_completion(app), add_version(app), add_view(app),
      add_explain(app)};
  try {
    if (const std::string error = unknown_command(app, argc, argv); !error.empty()) {
      std::cerr << error << '\n';
      return exit_configuration;
    }
    app.parse(arguments_of(argc, argv));
    for (const Command& command : commands) {
      if (command.line->parsed()) return command.run();
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_configuration;
  } catch (const DeploymentError& error) {
    std::cerr << printable(error.what(), Lines::many) << '\n';
    return exit_configuration;
  } catch (const std::out_of_range& error) {
    std::cerr << printable(error.what(), Lines::many) << '\n';
    return exit_configuration;
  } catch (const std::bad_alloc&) {
    std::cerr << "quoin: out of memory\n";
    return exit_failure;
  } catch (const std::exception& error) {
    std::cerr << "quoin: " << printable(error.what(), Lines::many) << '\n';
  }
  return exit_failure;
}

}  // namespace

int main(int argc, char** argv) {
  runtime::report_uncaught_exceptions();
  return whole_output(run(argc, argv));
}
