// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <idl/Control.h>
#include <idl/Corners.h>
#include <idl/Status.h>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <sys/types.h>
#include <vector>

#include "services/runtime/dds/endpoints.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/integration/harness/hostile_neighbour.hpp"
#include "tests/soak/composition.hpp"

namespace quoin::soak {

/// A process of the deployment, as it last reported.
struct Member {
  std::string service;  ///< label
  pid_t process = 0;
  bool alive = false;
};

/// Does what can happen to a running deployment, one thing after the other, as a seed says.
class Chaos {
 public:
  using Clock = std::chrono::steady_clock;

  Chaos(const tests::TestDeployment& deployment, const Scenario& scenario,
        std::vector<std::filesystem::path> compositions, std::uint64_t seed);
  ~Chaos();
  Chaos(const Chaos&) = delete;
  Chaos& operator=(const Chaos&) = delete;

  /// Reads heartbeats and replies, ends pauses and visits, and begins something new when it is
  /// time.
  void step();
  /// Ends what is under way: paused processes go on, visitors leave, the last apply is waited for.
  void end_disturbances();

  /// From now on these are not killed, so that their memory tells something.
  void spare(std::set<std::string> services) { spared_ = std::move(services); }

  /// What was done, and how often.
  [[nodiscard]] const std::map<std::string, int>& counts() const { return counts_; }
  /// Every process that ever reported.
  [[nodiscard]] const std::map<pid_t, std::string>& processes() const { return processes_; }
  /// Services whose last heartbeat says that they work.
  [[nodiscard]] std::vector<Member> members() const;

 private:
  struct Visitor {
    Visitor(const runtime::ParticipantConfig& config, const std::string& topic,
            Clock::time_point end)
        : participant(config),
          reader(participant, topic, runtime::QosPreset::feature),
          leaves(end) {}

    runtime::Participant participant;
    runtime::Reader<msg::Corners> reader;
    Clock::time_point leaves;
  };
  struct Pause {
    pid_t process = 0;
    Clock::time_point ends;
  };

  void listen();
  void end_what_is_over(Clock::time_point now);
  void act();
  void kill_one();
  void pause_one();
  void swap_one();
  void ask_nonsense();
  void apply_another();
  void invite();
  void attack();
  [[nodiscard]] std::optional<Member> any_member();
  [[nodiscard]] std::string nonsense();
  [[nodiscard]] double uniform(double from, double to);
  [[nodiscard]] std::size_t below(std::size_t count);

  const tests::TestDeployment& deployment_;
  const Scenario& scenario_;
  std::vector<std::filesystem::path> compositions_;
  std::mt19937_64 random_;
  runtime::Participant participant_;
  runtime::Reader<msg::ServiceStatus> statuses_;
  runtime::Writer<msg::ControlRequest> requests_;
  runtime::Reader<msg::ControlReply> replies_;
  std::map<std::string, msg::ServiceStatus> latest_;
  std::map<pid_t, std::string> processes_;
  std::map<std::string, int> counts_;
  std::set<std::string> spared_;
  std::vector<Pause> pauses_;
  std::vector<std::unique_ptr<Visitor>> visitors_;
  std::optional<tests::Process> apply_;
  std::optional<tests::HostileNeighbour> neighbour_;
  Clock::time_point next_;
  std::uint64_t request_ = 0;
};

}  // namespace quoin::soak
