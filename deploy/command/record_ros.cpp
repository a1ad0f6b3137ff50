// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/command/record_ros.hpp"

#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/orchestration/signals.hpp"
#include "sensor_bridge/message_files/mcap_writer.hpp"
#include "services/keys/key_files.hpp"
#include "services/ros2/definitions.hpp"
#include "services/ros2/topics.hpp"
#include "services/runtime/dds/endpoints.hpp"

namespace quoin::deploy {

namespace {

using sensor_bridge::mcap::WriteError;
using sensor_bridge::mcap::Writer;
using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

// Messages that may wait: those of a scan at 100 Hz for 40 s.
constexpr int most_waiting = 4096;
constexpr milliseconds flush_period{500};

/// Every message of any writer is taken, as far as DDS gives it.
runtime::TopicQos qos_for(const runtime::WrittenTopic& topic) {
  runtime::TopicQos qos = runtime::QosPreset::best_effort;
  if (topic.reliable) qos = runtime::QosPreset::observer;
  if (topic.reliable && topic.transient_local) qos = runtime::QosPreset::state;
  qos.depth = topic.transient_local ? 100 : most_waiting;
  return qos;
}

/// The file, with a reader for each topic of it.
class RosTape {
 public:
  RosTape(runtime::Participant& participant, const RosRecordOptions& options)
      : participant_(participant),
        options_(options),
        writer_(options.file, {.compression = options.compression, .profile = "ros2"}) {}

  /// Reads the topics that are written now, too.
  void look() {
    for (const runtime::WrittenTopic& topic : participant_.written()) {
      const std::string type = ros2::ros_type_name(topic.type);
      if (!topic.topic.starts_with("rt/") || type.empty() || known_.contains(topic.topic)) continue;
      known_.insert(topic.topic);
      const std::string definition = ros2::definition(type);
      if (definition.empty()) {
        std::cerr << topic.topic.substr(2) << ": not recorded, " << type
                  << " is no type that Quoin knows\n";
        continue;
      }
      auto& schema = schemas_[type];
      if (schema == 0) schema = writer_.add_schema(type, "ros2msg", definition);
      Topic& added = topics_.emplace_back();
      added.name = topic.topic.substr(2);
      added.channel = writer_.add_channel(schema, added.name, "cdr");
      added.reader = std::make_unique<runtime::RawReader>(participant_, topic.topic, topic.type,
                                                          qos_for(topic));
      wait_set_.add(*added.reader);
    }
  }

  void record(milliseconds timeout) {
    (void)wait_set_.wait(timeout);
    for (Topic& topic : topics_) {
      while (topic.reader->take(message_)) write(topic);
    }
  }

  void flush() {
    if (writer_.chunk_empty()) return;
    const auto folder = options_.file.parent_path();
    const auto space = std::filesystem::space(folder.empty() ? "." : folder);
    if (static_cast<double>(space.available) < options_.keep_free * 1e6) {
      throw WriteError("the disk has less room left than --keep-free leaves to others");
    }
    writer_.flush();
  }

  /// Closes the file, and says what is in it.
  void finish() {
    writer_.finish();
    std::uint64_t recorded = 0;
    std::uint64_t missed = 0;
    nlohmann::ordered_json counts = nlohmann::ordered_json::object();
    for (const Topic& topic : topics_) {
      recorded += topic.recorded;
      missed += topic.missed;
      counts[topic.name] = {{"recorded", topic.recorded}, {"missed", topic.missed}};
    }
    if (options_.json) {
      nlohmann::ordered_json object;
      object["files"] = {options_.file.string()};
      object["recorded"] = recorded;
      object["missed"] = missed;
      object["topics"] = counts;
      std::cout << object.dump(2) << '\n';
      return;
    }
    std::cout << options_.file.string() << '\n';
    for (const Topic& topic : topics_) {
      std::cout << topic.name << ": " << topic.recorded << " messages, " << topic.missed
                << " missed\n";
    }
  }

 private:
  struct Topic {
    std::string name;
    std::uint16_t channel = 0;
    std::unique_ptr<runtime::RawReader> reader;
    std::map<std::uint64_t, std::uint64_t> newest;  // number by writer
    std::uint64_t recorded = 0;
    std::uint64_t missed = 0;
  };

  void write(Topic& topic) {
    const runtime::ReaderBase::Sample& sample = topic.reader->last_sample();
    const auto [newest, first] = topic.newest.emplace(sample.writer, sample.sequence_number);
    if (!first && sample.sequence_number > newest->second) {
      topic.missed += sample.sequence_number - newest->second - 1;
      newest->second = sample.sequence_number;
    }
    const auto received = static_cast<std::uint64_t>(message_.received);
    writer_.write(
        {topic.channel,
         static_cast<std::uint32_t>(sample.sequence_number),
         received,
         message_.published > 0 ? static_cast<std::uint64_t>(message_.published) : received,
         {{reinterpret_cast<const char*>(message_.cdr.data()), message_.cdr.size()}}});
    ++topic.recorded;
  }

  runtime::Participant& participant_;
  const RosRecordOptions options_;
  Writer writer_;
  std::map<std::string, std::uint16_t> schemas_;  // by type
  std::set<std::string> known_;                   // topics, whether they are recorded or not
  std::vector<Topic> topics_;
  runtime::WaitSet wait_set_;  // ends before the readers
  topics::RawMessage message_;
};

}  // namespace

int record_ros(const Deployment& deployment, const RosRecordOptions& options) {
  if (deployment.security) {
    std::cerr << "--ros: ROS 2 has no keys of this deployment's security; nothing of it is heard\n";
    return exit_configuration;
  }
  auto config = runtime::participant_config(deployment, "quoin_record", observer_identity);
  config.strangers = true;
  Signals signals;
  runtime::Participant participant(config);
  RosTape tape(participant, options);
  const auto start = SteadyClock::now();
  auto flushed = start;
  while (signals.take() == 0) {
    tape.look();
    tape.record(milliseconds(100));
    const auto now = SteadyClock::now();
    if (options.duration > 0.0 &&
        std::chrono::duration<double>(now - start).count() >= options.duration) {
      break;
    }
    if (now - flushed < flush_period) continue;
    flushed = now;
    try {
      tape.flush();
    } catch (const WriteError& error) {
      tape.finish();
      std::cerr << "the recording stopped: " << error.what() << '\n';
      return exit_failure;
    }
  }
  tape.finish();
  return exit_ok;
}

}  // namespace quoin::deploy
