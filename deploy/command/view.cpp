// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>
#include <poll.h>
#include <string>
#include <vector>

#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/signals.hpp"
#include "services/deployment/deployment.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/viewer/feed.hpp"
#include "services/viewer/playback_remote.hpp"
#include "services/viewer/settings.hpp"

namespace quoin::deploy {

namespace {

struct ViewOptions {
  std::string file;
  viewer::ViewerParameters parameters;
};

int run(const ViewOptions& options) {
  const Deployment deployment = load_deployment(options.file);
  Signals signals;
  viewer::LiveView view(deployment, options.parameters, "",
                        [](const std::string& text) { std::cerr << text << '\n'; });
  auto config = runtime::participant_config(deployment, "quoin_view", observer_identity);
  std::vector<viewer::Feed::Observed> observed;
  for (const ServiceConfig& service : deployment.services) {
    for (const OutputConfig& output : service.outputs) {
      if (std::ranges::find(config.observes, output.topic) != config.observes.end()) continue;
      config.observes.push_back(output.topic);
      observed.push_back({output, runtime::observer_qos(service, output)});
    }
  }
  runtime::Participant participant(config);
  const viewer::PlaybackAnswers answers(view, participant, deployment);
  const viewer::Feed feed(participant, view, deployment.name_space, observed);
  std::cout << view.url() << "\nCtrl-C ends the page, not what it shows" << std::endl;
  pollfd wait_for{signals.descriptor(), POLLIN, 0};
  while (signals.take() == 0) (void)::poll(&wait_for, 1, -1);
  return exit_ok;
}

}  // namespace

Command add_view(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("view", "A page in the browser that shows a running deployment");
  const auto options = std::make_shared<ViewOptions>();
  viewer::ViewerParameters& parameters = options->parameters;
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option("--port", parameters.port, "TCP port; 0 is any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  line->add_option("--address", parameters.address,
                   "IP address to listen at; for any but 127.0.0.1 the page has a token")
      ->capture_default_str();
  line->add_option("--token", parameters.token,
                   "What clients have to know; else one is made and printed where it is needed")
      ->envname("QUOIN_TOKEN");
  line->add_option("--hosts", parameters.hosts, "Names of this host for browsers, with commas");
  line->add_option("--origins", parameters.origins,
                   "Pages of others that may connect, such as https://app.foxglove.dev");
  line->add_option("--certificate", parameters.certificate,
                   "PEM file; with --key the page uses TLS");
  line->add_option("--key", parameters.key, "PEM file of the private key");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
