// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "core/parameters/parameter.hpp"
#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/signals.hpp"
#include "services/deployment/deployment.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/cdr_json.hpp"
#include "services/topics/header.hpp"
#include "services/topics/message_text.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::deploy {

namespace {

using std::chrono::milliseconds;

struct EchoOptions {
  std::string file;
  std::string service;
  std::string type;         // "": the only one
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

/// Reports what an observer missed: it never slows a writer down, so a burst may be too much for
/// it.
class Missed {
 public:
  /// `from_the_start`: it was there before the first message.
  explicit Missed(bool from_the_start) : from_the_start_(from_the_start) {}

  /// Takes note of a message; false when it came before.
  bool note(const msg::Header& header) {
    const bool first = accounting_.received() == 0;
    std::uint64_t count = 0;
    for (const runtime::Loss& loss : accounting_.receive(header)) {
      if (loss.site.place == runtime::LossPlace::link) count += loss.count;
    }
    if (accounting_.verdict() != runtime::ScanAccounting::Verdict::received) return false;
    if (first && from_the_start_ && !header.trace().empty()) count = header.trace().back().index();
    if (count > 0) {
      std::cerr << "missed " << count << " messages before #" << topics::sequence_number(header)
                << '\n';
    }
    return true;
  }

 private:
  bool from_the_start_;
  runtime::ScanAccounting accounting_;
};

int echo(const Deployment& deployment, const EchoTopic& topic, const EchoOptions& options) {
  Signals signals;
  signals.end_when_stuck();
  auto config = runtime::participant_config(deployment, "quoin_echo", observer_identity);
  config.observes = {topic.name};  // who begins to write waits for us
  runtime::Participant participant(config);
  runtime::RawReader reader(participant, topic.name, std::string(topic.type.dds_type), topic.qos);
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  const bool there = reader.wait_for_writers(1, milliseconds(1500));
  if (!there) {
    std::cerr << "nobody publishes " << topic.name
              << " yet; waiting (quoin up starts a deployment)\n";
  }
  Missed missed(!there);
  topics::RawMessage message;
  msg::Header header;
  std::uint64_t count = 0;
  while (signals.take() == 0) {
    wait_set.wait(milliseconds(100));
    while (!signals.pending() && reader.take(message)) {
      try {
        const std::string line = printed(topic.type, message, options.json);
        // Two instances of a service may both have handled a scan when one takes over.
        if (topics::read_header(message, header) && !missed.note(header)) continue;
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

/// The output that is asked for. Throws std::out_of_range when there is none, or several.
const OutputConfig& output_of(const ServiceConfig& service, const std::string& type) {
  std::vector<std::string> types;
  for (const OutputConfig& output : service.outputs) types.push_back(output.type);
  if (types.empty()) throw std::out_of_range("service '" + service.name + "' publishes nothing");
  if (type.empty() && types.size() == 1) return service.outputs.front();
  if (const OutputConfig* output = service.output(type)) return *output;
  std::string all;
  for (const std::string& name : types) all += (all.empty() ? "" : ", ") + name;
  throw std::out_of_range("service '" + service.name + "' gives " + all + "; " +
                          (type.empty() ? "say which one with --type"
                                        : "not '" + type + "'" + suggestion(type, types)));
}

int run(const EchoOptions& options) {
  const Deployment deployment = load_deployment(options.file);
  const ServiceConfig& service = deployment.service(options.service);
  const OutputConfig& output = output_of(service, options.type);
  return echo(
      deployment,
      {output.topic, *topics::find_topic_type(output.type), runtime::observer_qos(service, output)},
      options);
}

}  // namespace

Command add_echo(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("echo", "Print what a service of a running deployment publishes");
  const auto options = std::make_shared<EchoOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option("service", options->service, "Name of the service")->required();
  line->add_option("--type", options->type, "Which of its outputs, where it has several");
  line->add_option("--count", options->count, "End after this many messages")
      ->check(more_than_zero());
  line->add_flag("--json", options->json, "All fields, as one JSON object a line");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
