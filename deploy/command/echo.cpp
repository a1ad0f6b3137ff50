// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/orchestration/signals.hpp"
#include "services/deployment/deployment.hpp"
#include "services/deployment/kinds.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/reader.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/cdr_json.hpp"
#include "services/topics/message_text.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::deploy {

namespace {

using std::chrono::milliseconds;

struct EchoOptions {
  std::string file;
  std::string service;
  std::uint64_t count = 0;  // 0: no end
  bool json = false;
};

/// A topic of a deployment, and how to read it.
struct EchoTopic {
  std::string name;
  topics::TopicType type;
  runtime::TopicQos qos;
};

/// Throws topics::CdrError for bytes that are no message of the type.
std::string printed(const topics::TopicType& type, const topics::RawMessage& message, bool json) {
  const nlohmann::ordered_json fields = topics::cdr_to_json(type.dds_type, message.cdr);
  return json ? fields.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
              : topics::to_text(type.dds_type, fields);
}

int echo(const Deployment& deployment, const EchoTopic& topic, const EchoOptions& options) {
  Signals signals;
  runtime::Participant participant(
      runtime::participant_config(deployment, "quoin_echo", observer_identity));
  runtime::RawReader reader(participant, topic.name, std::string(topic.type.dds_type), topic.qos);
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  if (!reader.wait_for_writers(1, milliseconds(1500))) {
    std::cerr << "nobody publishes " << topic.name
              << " yet; waiting (quoin up starts a deployment)\n";
  }
  runtime::ScanAccounting accounting;
  topics::RawMessage message;
  msg::Header header;
  std::uint64_t count = 0;
  while (signals.take() == 0) {
    wait_set.wait(milliseconds(100));
    while (reader.take(message)) {
      try {
        const std::string line = printed(topic.type, message, options.json);
        // Two instances of a service may both have handled a scan when one takes over.
        if (topics::read_header(message, header)) {
          accounting.receive(header);
          if (accounting.last_was_duplicate()) continue;
        }
        std::cout << line << std::endl;
      } catch (const topics::CdrError& error) {
        std::cerr << topic.name << ": discarded a message: " << error.what() << '\n';
        continue;
      }
      if (!std::cout) return exit_failure;  // nobody reads any more
      if (++count == options.count) return exit_ok;
    }
  }
  return options.count == 0 ? exit_ok : exit_failure;
}

int run(const EchoOptions& options) {
  const Deployment deployment = load_deployment(options.file);
  const ServiceConfig& service = deployment.service(options.service);
  const topics::TopicType* type =
      topics::find_topic_type(message_name(find_kind(service.kind)->output));
  if (type == nullptr) {
    std::cerr << "service '" << service.name << "' publishes nothing\n";
    return exit_configuration;
  }
  return echo(deployment,
              {output_topic(deployment, service), *type, runtime::onlooker_qos(service)}, options);
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
