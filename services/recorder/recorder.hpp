// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <idl/Status.h>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/recorder/recording.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/topics/cdr_codec.hpp"

namespace quoin {

/// Records what it is given in a thread of its own: who gives it never waits for the disk. What
/// does not fit into the queue is left out and counted.
class Recorder {
 public:
  struct Figures {
    std::uint64_t recorded = 0;  ///< messages that were given to the file
    std::uint64_t missed = 0;    ///< that were sent, but never came here
    std::uint64_t dropped = 0;   ///< that came, and are not in the file
    std::uint64_t bytes = 0;     ///< of all files
    std::string file;            ///< that is being written, or was last
    std::string stopped;         ///< why nothing more is recorded; "" while it is
  };

  /// [byte] of messages that wait for the disk at most.
  static constexpr std::size_t most_waiting = std::size_t{64} << 20U;

  /// As Recording. `heartbeats`: the topic of heartbeats, where those are recorded, too.
  Recorder(const std::filesystem::path& path, const RecorderParameters& parameters,
           const std::vector<RecordedTopic>& topics, RunFacts facts,
           const std::string& heartbeats = "");
  /// Finishes, as far as that was not done.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// A message of the topic of that index; one that came before is left out. Copies its bytes, and
  /// does not wait. One thread calls it.
  void record(std::size_t topic, const topics::RawMessage& raw, const msg::Header& header);
  /// Any one thread may call it. What does not fit is left out, as everything else.
  void record_heartbeat(const msg::ServiceStatus& status);
  /// Writes what waits, and closes the file. Nothing may be recorded any more.
  void finish();

  [[nodiscard]] Figures figures() const;
  /// What has changed of them since the last call, at most once a second, for a heartbeat: name and
  /// value. For the thread that records.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> diagnostics();
  [[nodiscard]] std::vector<std::filesystem::path> files() const;

 private:
  struct Account {
    std::string topic;
    runtime::ScanAccounting accounting;
    std::uint64_t missed = 0;
    std::uint64_t recorded = 0;
  };

  [[nodiscard]] bool enqueue(std::size_t topic, const topics::RawMessage& raw,
                             MessageToRecord message);
  void run();
  void write(std::deque<MessageToRecord>& messages);
  void stop_recording(const std::string& why);

  std::chrono::steady_clock::time_point diagnosed_{};
  std::vector<Account> accounts_;  // by topic; of the thread that records
  Recording recording_;            // of the thread that writes
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<MessageToRecord> queue_;
  std::size_t waiting_ = 0;  // [byte] in the queue
  bool ending_ = false;
  Figures figures_;
  std::vector<std::vector<std::byte>> spare_;  // memory of messages that are written
  std::thread thread_;
};

/// What a recording says of the run, the host and the program.
[[nodiscard]] RunFacts run_facts(const Deployment& deployment);

}  // namespace quoin
