// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/observation/display.hpp"
#include "deploy/observation/summary.hpp"
#include "deploy/orchestration/run.hpp"

namespace quoin::deploy {

namespace {

struct UpOptions {
  RunOptions run;
  bool json = false;
  bool quiet = false;
};

Display::Mode display_mode(const UpOptions& options) {
  if (options.quiet) return Display::Mode::quiet;
  return options.json ? Display::Mode::errors : Display::Mode::automatic;
}

int run(const UpOptions& options) {
  Display display(display_mode(options));
  Run deployment(
      options.run,
      {.log = [&](const std::string& name, const std::string& line) { display.log(name, line); },
       .progress = [&](const DeploymentFigures& figures) { display.show(figures); }});
  const RunOutcome outcome = deployment.run();
  display.finish(outcome.figures);
  if (options.json) {
    std::cout << summary(outcome.figures)
                     .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
              << std::endl;
  }
  return outcome.exit_code;
}

}  // namespace

Command add_up(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("up", "Start a deployment and watch over it until it ends or Ctrl-C");
  const auto options = std::make_shared<UpOptions>();
  line->add_option("file", options->run.file, "Deployment file (YAML)")->required();
  line->add_option("--host", options->run.host,
                   "Start the share of this host; else of the one called like this machine");
  line->add_option("--duration", options->run.duration,
                   "Stop after this time [s], counted from when all are active")
      ->transform(a_time());
  line->add_flag("--json", options->json,
                 "Print the final figures as a JSON object; progress goes to standard error");
  line->add_flag("--watch", options->run.watch,
                 "Apply the file whenever it changes; with errors in it nothing changes");
  line->add_flag("--quiet", options->quiet, "Show log lines only");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
