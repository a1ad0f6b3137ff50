// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <csignal>
#include <optional>
#include <stdexcept>
#include <string>
#include <sys/types.h>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/deployment/graph.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin::tests {

/// A deployment with kinds of tests/kinds, run by quoin_test_tool.
class TestRun {
 public:
  explicit TestRun(const std::string& services, const std::string& head = "")
      : deployment_(services, head, "quoin_test_tool"),
        participant_(deployment_.participant("test")),
        status_(participant_, deployment_) {}

  [[nodiscard]] const TestDeployment& deployment() const { return deployment_; }
  [[nodiscard]] runtime::Participant& participant() { return participant_; }
  [[nodiscard]] StatusRecorder& status() { return status_; }
  [[nodiscard]] const msg::ServiceStatus& latest(const std::string& service) {
    return status_.latest(service);
  }

  /// `quoin` with arguments; "FILE" stands for the deployment file.
  [[nodiscard]] Process tool(std::vector<std::string> arguments) const {
    return deployment_.quoin(std::move(arguments));
  }

  void up() { up_.emplace(tool({"up", "FILE", "--json"})); }
  [[nodiscard]] pid_t pid() const { return up_->pid(); }
  /// Of the present process of `service`. Throws std::runtime_error when nothing is heard of it: 0
  /// would be all processes of this test.
  [[nodiscard]] pid_t pid_of(const std::string& service) {
    if (!status_.wait_for(service, [](const auto& status) { return status.pid() != 0; })) {
      throw std::runtime_error("nothing was heard of " + service + "\n" + log());
    }
    return static_cast<pid_t>(latest(service).pid());
  }
  [[nodiscard]] std::string log() const { return up_->errors(); }

  /// Takes the heartbeats that have come.
  void poll() {
    (void)status_.wait_for(
        "", [](const auto&) { return false; }, std::chrono::milliseconds(0));
  }

  /// Messages that a service has published, or handled where it gives none.
  [[nodiscard]] static std::uint64_t handled(const msg::ServiceStatus& status) {
    return status.outputs().empty() ? status.received() : status.published();
  }
  /// True once the present process of `service` has published that many, or handled them when it
  /// has no output.
  [[nodiscard]] bool has_published(const std::string& service, std::uint64_t count,
                                   std::chrono::milliseconds timeout = std::chrono::seconds(40)) {
    return status_.wait_for(
        service, [&](const auto& status) { return handled(status) >= count; }, timeout);
  }
  /// The same, counted from now on and with the process that is there then.
  [[nodiscard]] bool goes_on(const std::string& service, std::uint64_t count,
                             std::chrono::milliseconds timeout = std::chrono::seconds(40)) {
    const auto before = latest(service);
    return status_.wait_for(
        service,
        [&](const auto& status) {
          const std::uint64_t begin =
              status.incarnation() == before.incarnation() ? handled(before) : 0;
          return handled(status) >= begin + count;
        },
        timeout);
  }
  /// Kills the present process of `service`; true once another one is at work.
  [[nodiscard]] bool kill_and_wait(const std::string& service,
                                   std::chrono::milliseconds timeout = std::chrono::seconds(40)) {
    if (::kill(pid_of(service), SIGKILL) != 0) return false;
    const auto before = latest(service);
    return status_.wait_for(
        service,
        [&](const auto& status) {
          return status.incarnation() != before.incarnation() &&
                 status.state() == msg::ServiceState::STATE_ACTIVE;
        },
        timeout);
  }

  /// Stops it; the figures, of which those of all ends have been checked.
  nlohmann::json end() {
    up_->signal(SIGINT);
    EXPECT_EQ(up_->wait(std::chrono::seconds(40)), 0) << log();
    const auto figures = nlohmann::json::parse(up_->output(), nullptr, false);
    EXPECT_TRUE(figures.is_object()) << log();
    if (figures.is_object()) expect_exact(figures);
    return figures;
  }

  /// What an end was delivered and what is lost is all that its source has published.
  void expect_exact(const nlohmann::json& figures) const {
    const Graph graph(deployment_.deployment());
    for (const Connection& end : graph.ends()) {
      const Connection source = graph.path_to(*end.writer, end.output).front();
      if (source.writer->external()) continue;  // tells nobody how many there were
      const auto& seen = figures["ends"][end.writer->name];
      ASSERT_TRUE(seen.is_object()) << "no end " << end.writer->name << " in " << figures;
      EXPECT_EQ(
          seen["scans_delivered"].get<std::uint64_t>() + seen["scans_lost"].get<std::uint64_t>(),
          seen["scans_expected"].get<std::uint64_t>());
      EXPECT_EQ(seen["scans_expected"],
                figures["services"][source.writer->name]["numbered"][source.output.type])
          << end.writer->name << ": " << seen << log();
    }
  }

 private:
  TestDeployment deployment_;
  runtime::Participant participant_;
  StatusRecorder status_;
  std::optional<Process> up_;
};

}  // namespace quoin::tests
