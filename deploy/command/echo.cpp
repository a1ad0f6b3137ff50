// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "services/deployment/deployment.hpp"
#include "deploy/kinds/kinds.hpp"
#include "services/keys/key_files.hpp"
#include "deploy/command/commands.hpp"
#include "services/topics/message_json.hpp"
#include "services/topics/message_text.hpp"
#include "deploy/orchestration/signals.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/reader.hpp"

namespace quoin::deploy {

namespace {

using std::chrono::milliseconds;

struct EchoOptions {
  std::string file;
  std::string service;
  std::uint64_t count = 0;  // 0: no end
  bool json = false;
};

template <class T>
int echo(const Deployment& deployment, const ServiceConfig& service, const EchoOptions& options) {
  Signals signals;
  runtime::Participant participant(
      runtime::participant_config(deployment, "quoin_echo", observer_identity));
  const std::string topic = output_topic(deployment, service);
  runtime::Reader<T> reader(participant, topic, runtime::onlooker_qos(service));
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  if (!reader.wait_for_writers(1, milliseconds(1500))) {
    std::cerr << "nobody publishes " << topic << " yet; waiting (quoin up starts a deployment)\n";
  }
  runtime::ScanAccounting accounting;
  T message;
  std::uint64_t printed = 0;
  while (signals.take() == 0) {
    wait_set.wait(milliseconds(100));
    while (reader.take(message)) {
      // Two instances of a service may both have handled a scan when one takes over.
      accounting.receive(message.header());
      if (accounting.last_was_duplicate()) continue;
      if (options.json) {
        std::cout << topics::to_json(message).dump(-1, ' ', false,
                                           nlohmann::ordered_json::error_handler_t::replace)
                  << std::endl;
      } else {
        std::cout << topics::to_text(message) << std::endl;
      }
      if (!std::cout) return exit_failure;  // nobody reads any more
      if (++printed == options.count) return exit_ok;
    }
  }
  return options.count == 0 ? exit_ok : exit_failure;
}

int run(const EchoOptions& options) {
  const Deployment deployment = load_deployment(options.file);
  const ServiceConfig& service = deployment.service(options.service);
  switch (find_kind(service.kind)->output) {
    case MessageType::scan:
      return echo<msg::Scan>(deployment, service, options);
    case MessageType::segments:
      return echo<msg::Segments>(deployment, service, options);
    case MessageType::lines:
      return echo<msg::Lines>(deployment, service, options);
    case MessageType::corners:
      return echo<msg::Corners>(deployment, service, options);
    case MessageType::none:
      break;
  }
  std::cerr << "service '" << service.name << "' publishes nothing\n";
  return exit_configuration;
}

}  // namespace

Command add_echo(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("echo", "Print what a service of a running deployment publishes");
  const auto options = std::make_shared<EchoOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option("service", options->service, "Name of the service")->required();
  line->add_option("--count", options->count, "End after this many messages")
      ->check(more_than_zero());
  line->add_flag("--json", options->json, "All fields, as one JSON object a line");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
