// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deploy/orchestration/requester.hpp"
#include "deploy/orchestration/supervised_processes.hpp"

namespace quoin::deploy {

/// Requests that a test answers, at a time that passes only where somebody waits.
class FakeRequester : public Requester {
 public:
  /// Called with each request; may answer it, or another one, with `reply`.
  std::function<void(const msg::ControlRequest&)> on_request = [](const auto&) {};
  std::vector<msg::ControlRequest> sent;

  void reply(std::uint64_t number, const msg::ControlReply& reply) {
    replies_[number].push_back(reply);
  }
  void accept(const msg::ControlRequest& request) {
    msg::ControlReply accepted;
    accepted.service(request.service());
    accepted.accepted(true);
    reply(request.request(), accepted);
  }
  [[nodiscard]] std::size_t count(msg::ControlAction action) const {
    return static_cast<std::size_t>(
        std::count_if(sent.begin(), sent.end(),
                      [&](const msg::ControlRequest& each) { return each.action() == action; }));
  }

  std::uint64_t send(msg::ControlRequest& request) override {
    request.request(++number_);
    sent.push_back(request);
    on_request(request);
    return number_;
  }
  std::optional<msg::ControlReply> take(std::uint64_t number) override {
    std::deque<msg::ControlReply>& replies = replies_[number];
    if (replies.empty()) return std::nullopt;
    msg::ControlReply reply = replies.front();
    replies.pop_front();
    return reply;
  }
  [[nodiscard]] Clock::time_point now() const override { return now_; }
  void wait_for_any(std::chrono::milliseconds timeout) override { now_ += timeout; }

 private:
  Clock::time_point now_{};
  std::uint64_t number_ = 0;
  std::map<std::uint64_t, std::deque<msg::ControlReply>> replies_;
};

/// Processes that only exist in a table. They end at once when they are told to.
class FakeProcesses : public SupervisedProcesses {
 public:
  struct Process {
    ProcessPlan plan;
    bool trial = false;
    bool running = true;
    bool retired = false;
    std::optional<ProcessEnd> end;
  };
  /// Told what is done: "start fit", "adopt fit", "replan fit", "stop fit", "retire fit", "kill
  /// fit".
  std::function<void(const std::string&)> log = [](const auto&) {};
  std::map<int, Process> table;
  std::map<std::string, ProcessFigures> phases;  ///< of services that are not simply running
  bool stop = false;

  /// A process that was there before.
  int insert(const ProcessPlan& plan) {
    table[++last_key_].plan = plan;
    return last_key_;
  }
  int insert(const std::string& service) {
    ProcessPlan plan;
    plan.name = service;
    return insert(plan);
  }
  [[nodiscard]] int id(int key) const { return 1000 + key; }

  int add(ProcessPlan plan) override {
    log("start " + plan.name);
    const int key = insert(plan);
    table.at(key).trial = true;
    return key;
  }
  void adopt(int key, ProcessPlan plan) override {
    log("adopt " + plan.name);
    table.at(key).trial = false;
    table.at(key).plan = std::move(plan);
  }
  void replan(ProcessPlan plan) override {
    log("replan " + plan.name);
    for (auto& [key, process] : table) {
      if (process.plan.name == plan.name && !process.trial && !process.retired) process.plan = plan;
    }
  }
  /// It has died, and its services are those of others.
  void forget(int key) { table.erase(key); }
  void retire(int key, bool terminate, std::size_t) override {
    if (!table.contains(key)) return;
    Process& process = table.at(key);
    log((terminate ? "stop " : "retire ") + process.plan.name);
    process.retired = true;
    if (terminate) process.running = false;
  }
  void kill(int key) override {
    if (!table.contains(key)) return;
    log("kill " + table.at(key).plan.name);
    table.at(key).running = false;
  }
  [[nodiscard]] bool running(int key) const override {
    return table.contains(key) && table.at(key).running;
  }
  [[nodiscard]] int process_id(int key) const override { return id(key); }
  [[nodiscard]] const ProcessPlan& plan(int key) const override { return table.at(key).plan; }
  [[nodiscard]] std::optional<ProcessEnd> end_of_trial(int key) const override {
    return table.at(key).end;
  }
  [[nodiscard]] std::optional<int> key_of(const std::string& name) const override {
    for (const auto& [key, process] : table) {
      if (process.plan.runs(name) && !process.trial && !process.retired) return key;
    }
    return std::nullopt;
  }
  [[nodiscard]] ProcessFigures figures(const std::string& name) const override {
    if (const auto found = phases.find(name); found != phases.end()) return found->second;
    return {ProcessPhase::running, id(key_of(name).value()), 0};
  }
  [[nodiscard]] bool ended() const override {
    return stop && std::none_of(table.begin(), table.end(),
                                [](const auto& entry) { return entry.second.running; });
  }
  [[nodiscard]] bool stopping() const override { return stop; }

 private:
  int last_key_ = 0;
};

}  // namespace quoin::deploy
