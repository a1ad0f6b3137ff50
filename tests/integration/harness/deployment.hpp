// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <idl/Corners.h>
#include <idl/Status.h>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "tests/integration/harness/process.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::runtime {

/// For GoogleTest's messages.
inline void PrintTo(const LossSite& site, std::ostream* out) { *out << to_text(site); }

}  // namespace quoin::runtime

namespace quoin::tests {

/// A deployment file in a folder of its own, on a domain and namespace of its own.
class TestDeployment {
 public:
  /// `services`: the text behind "services:", two spaces in. `head`: more lines before it. `tool`:
  /// the program that knows their kinds. `suffix` of the namespace, for several in one test.
  explicit TestDeployment(const std::string& services, const std::string& head = "",
                          std::string tool = "quoin", const std::string& suffix = "");

  /// Another deployment file for the same domain and namespace, in the same folder.
  [[nodiscard]] std::filesystem::path write(const std::string& name,
                                            const std::string& services) const;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const TemporaryFolder& directory() const { return directory_; }
  [[nodiscard]] const Deployment& deployment() const { return deployment_; }
  [[nodiscard]] std::string topic(const std::string& service) const {
    return output(service).topic;
  }
  /// The first one of a service.
  [[nodiscard]] const OutputConfig& output(const std::string& service) const {
    return deployment_.service(service).outputs.front();
  }
  [[nodiscard]] runtime::ParticipantConfig participant(const std::string& name) const {
    return runtime::participant_config(deployment_, name);
  }

  /// Starts the process of one service; `observers` readers of this test are waited for.
  [[nodiscard]] Process start(const std::string& service, int observers = 0) const;
  /// The tool with arguments; "FILE" stands for the deployment file.
  [[nodiscard]] Process quoin(std::vector<std::string> arguments) const;

 private:
  TemporaryFolder directory_;
  std::string tool_;
  std::string head_;
  std::filesystem::path file_;
  Deployment deployment_;
};

/// All messages of one service, as they come.
template <class T>
class Recorder {
 public:
  Recorder(runtime::Participant& participant, const TestDeployment& deployment,
           const std::string& service)
      : reader_(participant, deployment.topic(service),
                runtime::output_qos(deployment.deployment().service(service),
                                    deployment.output(service))) {}

  /// Takes what is there; returns the number of messages so far.
  std::size_t poll() {
    T message;
    while (reader_.take(message)) {
      accounting_.receive(message.header());
      if (accounting_.verdict() == runtime::ScanAccounting::Verdict::received) {
        messages_.push_back(message);
      }
    }
    return messages_.size();
  }
  /// True once `condition` holds. Reads on meanwhile, since the reader keeps the last few only.
  template <class Condition>
  bool poll_until(Condition condition,
                  std::chrono::milliseconds timeout = std::chrono::seconds(20)) {
    return eventually(
        [&] {
          poll();
          return condition();
        },
        timeout);
  }
  /// True once `count` messages came.
  bool wait_for(std::size_t count, std::chrono::milliseconds timeout = std::chrono::seconds(30)) {
    return poll_until([&] { return messages_.size() >= count; }, timeout);
  }
  /// True once the service's writer is there.
  [[nodiscard]] bool wait_for_writer() const {
    return reader_.wait_for_writers(1, std::chrono::seconds(30));
  }
  [[nodiscard]] const std::vector<T>& messages() const { return messages_; }
  [[nodiscard]] const runtime::ScanAccounting& accounting() const { return accounting_; }

 private:
  runtime::Reader<T> reader_;
  runtime::ScanAccounting accounting_;
  std::vector<T> messages_;
};

using CornerRecorder = Recorder<msg::Corners>;

/// The latest heartbeat of every service.
class StatusRecorder {
 public:
  StatusRecorder(runtime::Participant& participant, const TestDeployment& deployment);

  /// True once the latest heartbeat of `service` fulfils `condition`.
  template <class Condition>
  bool wait_for(const std::string& service, Condition condition,
                std::chrono::milliseconds timeout = std::chrono::seconds(20)) {
    return eventually(
        [&] {
          poll();
          const auto found = latest_.find(service);
          return found != latest_.end() && condition(found->second);
        },
        timeout);
  }
  [[nodiscard]] const msg::ServiceStatus& latest(const std::string& service) {
    return latest_[service];
  }

 private:
  void poll();

  runtime::Reader<msg::ServiceStatus> reader_;
  std::map<std::string, msg::ServiceStatus> latest_;
};

}  // namespace quoin::tests
