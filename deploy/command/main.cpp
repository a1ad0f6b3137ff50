// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <stdexcept>
#include <vector>

#include "core/text/printable.hpp"
#include "deploy/command/commands.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/process/log.hpp"

namespace {

using namespace quoin;
using namespace quoin::deploy;

int run(int argc, char** argv) {
  CLI::App app{"Quoin: lines and corners with trustworthy covariances from 2D LiDAR scans"};
  app.name("quoin");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 ok, 1 failure, 2 wrong usage or configuration, 3 input of a source unusable, "
      "4 scans that do not show what calibrate wants to know");
  const std::vector<Command> commands{
      add_up(app),        add_apply(app),   add_check(app),      add_methods(app),
      add_status(app),    add_echo(app),    add_compare(app),    add_draw(app),
      add_evaluate(app),  add_export(app),  add_record(app),     add_recording(app),
      add_lidar(app),     add_map(app),     add_playback(app),   add_swap(app),
      add_set(app),       add_keys(app),    add_discovery(app),  add_doctor(app),
      add_calibrate(app), add_schema(app),  add_completion(app), add_version(app),
      add_view(app),      add_explain(app), add_init(app),       add_man(app),
      add_bundle(app)};
  try {
    parse(app, argc, argv);
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
  } catch (const std::exception& error) {
    std::cerr << "quoin: " << printable(runtime::failure_text(error), Lines::many) << '\n';
  }
  return exit_failure;
}

}  // namespace

int main(int argc, char** argv) {
  runtime::report_uncaught_exceptions();
  return whole_output(run(argc, argv));
}
