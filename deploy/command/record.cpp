// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/command/record_ros.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/signals.hpp"
#include "sensor_bridge/message_files/mcap_writer.hpp"
#include "services/keys/key_files.hpp"
#include "services/recorder/heartbeat_feed.hpp"
#include "services/recorder/recorder.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/topics/header.hpp"

namespace quoin::deploy {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

struct RecordOptions {
  std::string file;
  RecorderParameters parameters;
  std::string content = "both";
  std::string compression = "zstd";
  std::vector<std::string> services;
  double duration = 0.0;  // [s] 0: no end
  bool ros = false;
  bool json = false;
};

struct ObservedTopic {
  RecordedTopic described;
  runtime::TopicQos qos;
};

/// The outputs of the services that are named, or of all. Throws std::out_of_range for a name that
/// is none.
std::vector<ObservedTopic> topics_of(const Deployment& deployment,
                                     const std::vector<std::string>& services) {
  for (const std::string& name : services) {
    std::vector<std::string> names;
    for (const ServiceConfig& service : deployment.services) names.push_back(service.name);
    if (std::ranges::find(names, name) == names.end()) {
      throw std::out_of_range("--services: no service '" + name + "'" + suggestion(name, names));
    }
  }
  std::vector<ObservedTopic> topics;
  for (const ServiceConfig& service : deployment.services) {
    if (!services.empty() && std::ranges::find(services, service.name) == services.end()) continue;
    for (const OutputConfig& output : service.outputs) {
      const auto same = [&](const ObservedTopic& topic) {
        return topic.described.topic == output.topic;  // of another instance of the service
      };
      if (std::ranges::any_of(topics, same)) continue;
      topics.push_back(
          {{output.topic, service.name, topics::find_topic_type(output.type), output.qos},
           runtime::observer_qos(service, output)});
    }
  }
  if (topics.empty()) throw std::out_of_range("there is nothing to record: no service publishes");
  return topics;
}

std::string progress_text(const Recorder::Figures& figures, double elapsed) {
  std::string text = std::to_string(figures.recorded) + " messages, " +
                     std::to_string(figures.bytes / 1000) + " kB, " +
                     std::to_string(static_cast<int>(elapsed)) + " s";
  if (figures.missed > 0) text += ", " + std::to_string(figures.missed) + " missed";
  if (figures.dropped > 0) text += ", " + std::to_string(figures.dropped) + " dropped";
  return text;
}

int report(const RecordOptions& options, const Recorder& recorder, const std::string& stopped) {
  const Recorder::Figures figures = recorder.figures();
  if (options.json) {
    nlohmann::ordered_json object;
    auto files = nlohmann::ordered_json::array();
    for (const auto& file : recorder.files()) files.push_back(file.string());
    object["files"] = files;
    object["recorded"] = figures.recorded;
    object["missed"] = figures.missed;
    object["dropped"] = figures.dropped;
    object["bytes"] = figures.bytes;
    if (!stopped.empty()) object["stopped"] = stopped;
    std::cout << object.dump(2) << '\n';
  } else {
    for (const auto& file : recorder.files()) std::cout << file.string() << '\n';
    std::cout << figures.recorded << " messages, " << figures.missed << " missed, "
              << figures.dropped << " dropped\n";
  }
  if (!stopped.empty()) std::cerr << "the recording stopped: " << stopped << '\n';
  return stopped.empty() ? exit_ok : exit_failure;
}

int record(const Deployment& deployment, const RecordOptions& options) {
  const std::vector<ObservedTopic> topics = topics_of(deployment, options.services);
  std::vector<RecordedTopic> described;
  auto config = runtime::participant_config(deployment, "quoin_record", observer_identity);
  for (const ObservedTopic& topic : topics) {
    described.push_back(topic.described);
    config.observes.push_back(topic.described.topic);  // who begins to write waits for us
  }
  Signals signals;
  Recorder recorder(options.parameters.path, options.parameters, described, run_facts(deployment),
                    status_topic(deployment.name_space));
  runtime::Participant participant(config);
  std::optional<HeartbeatFeed> heartbeats;
  heartbeats.emplace(participant, deployment.name_space, recorder);
  std::vector<std::unique_ptr<runtime::RawReader>> readers;
  runtime::WaitSet wait_set;
  for (const ObservedTopic& topic : topics) {
    readers.push_back(std::make_unique<runtime::RawReader>(
        participant, topic.described.topic, std::string(topic.described.type->dds_type),
        topic.qos));
    wait_set.add(*readers.back());
  }
  const bool terminal = ::isatty(STDERR_FILENO) == 1 && !options.json;
  const auto start = Clock::now();
  auto shown = start;
  std::string stopped;
  topics::RawMessage message;
  msg::Header header;
  while (signals.take() == 0) {
    wait_set.wait(milliseconds(100));
    for (std::size_t i = 0; i < readers.size(); ++i) {
      while (readers[i]->take(message)) {
        if (topics::read_header(message, header)) recorder.record(i, message, header);
      }
    }
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - start).count();
    if (options.duration > 0.0 && elapsed >= options.duration) break;
    if (now - shown < milliseconds(500)) continue;
    shown = now;
    const Recorder::Figures figures = recorder.figures();
    if (!figures.stopped.empty()) {
      stopped = figures.stopped;
      break;
    }
    if (terminal) std::cerr << '\r' << progress_text(figures, elapsed) << "\x1b[K" << std::flush;
  }
  if (terminal) std::cerr << "\r\x1b[K";
  heartbeats.reset();
  recorder.finish();
  return report(options, recorder, stopped);
}

int run(const RecordOptions& given) {
  RecordOptions options = given;
  const Deployment deployment = load_deployment(options.file);
  const auto& path = options.parameters.path;
  if (std::filesystem::exists(path) && !std::filesystem::is_directory(path)) {
    std::cerr << "-o: '" << path << "' is there already; name a new file, or a folder\n";
    return exit_configuration;
  }
  try {
    options.parameters = make_parameters<RecorderParameters>(
        {{"path", path},
         {"content", options.content},
         {"compression", options.compression},
         {"split", options.parameters.split},
         {"keep_free", std::to_string(options.parameters.keep_free)}});
    if (options.ros) {
      const std::string file = recording_file(path).string();
      return record_ros(deployment, {.file = file,
                                     .compression = options.parameters.compression,
                                     .keep_free = options.parameters.keep_free,
                                     .duration = options.duration,
                                     .json = options.json});
    }
    return record(deployment, options);
  } catch (const ParameterError& error) {
    std::cerr << error.what() << '\n';
    return exit_configuration;
  } catch (const sensor_bridge::mcap::WriteError& error) {
    std::cerr << error.what() << '\n';
    return exit_failure;
  }
}

}  // namespace

Command add_record(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "record", "Record what the services of a running deployment publish (MCAP)");
  const auto options = std::make_shared<RecordOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option("-o,--output", options->parameters.path,
                   "File to write (.mcap), or a folder for a file of the present time")
      ->required();
  line->add_option("--services", options->services, "Only these, separated by commas")
      ->delimiter(',');
  line->add_flag("--ros", options->ros,
                 "In place of what services publish: the topics of ROS 2 in the domain, as ROS 2 "
                 "records them")
      ->excludes("--services");
  line->add_option("--duration", options->duration, "End after this many seconds")
      ->check(more_than_zero());
  line->add_option("--split", options->parameters.split,
                   "Begin a new file after a time (10min) or a size (1GB)");
  line->add_option("--content", options->content,
                   "Messages as they were sent (cdr), for viewers (protobuf), or both")
      ->check(CLI::IsMember({"cdr", "protobuf", "both"}))
      ->capture_default_str();
  line->add_option("--compression", options->compression, "Of the chunks: none, zstd, lz4")
      ->check(CLI::IsMember({"none", "zstd", "lz4"}))
      ->capture_default_str();
  line->add_option("--keep-free", options->parameters.keep_free,
                   "Stop when the disk has less than this many megabytes left")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  line->add_flag("--json", options->json, "What was recorded as one JSON object");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
