// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/coordinated_apply.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <utility>

#include "deploy/orchestration/plan.hpp"

namespace quoin::deploy {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr Seconds first_answer{5.0};
// What the change of one service may take: to hand over, and to be killed when it does not.
constexpr Seconds longest_change{25.0};

/// One supervisor while it changes its share.
struct Part {
  std::string host;
  std::uint64_t number = 0;  // of the request
  msg::ControlReply reply;   // the newest
  bool ended = false;        // that was the last one
  bool answered = true;
  bool silent = false;  // left a change unanswered

  [[nodiscard]] bool ready() const { return !ended && reply.ready(); }
  [[nodiscard]] bool plans(ChangeAction action, const std::string& service) const {
    return std::any_of(reply.steps().begin(), reply.steps().end(),
                       [&](const msg::ControlStep& step) {
                         return step.service() == service && step.action() == action_name(action);
                       });
  }
};

class Concert {
 public:
  Concert(Requester& requester, const msg::ControlRequest& request,
          const std::function<bool()>& interrupted)
      : requester_(requester),
        request_(request),
        interrupted_(interrupted),
        timeout_(request.wait()) {}

  std::vector<HostOutcome> apply(const std::vector<std::string>& hosts, const Deployment& wanted) {
    request_.coordinated(hosts.size() > 1);
    for (const std::string& host : hosts) {
      request_.service(supervisor_name(host));
      Part& part = parts_.emplace_back();
      part.host = host;
      part.number = requester_.send(request_);
    }
    wait_until_ready();
    if (!interrupted_() &&
        std::all_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.ready(); })) {
      change_all(wanted);
    } else {
      withdraw();
    }
    std::vector<HostOutcome> outcomes;
    for (Part& part : parts_) outcomes.push_back({part.host, std::move(part.reply), part.answered});
    return outcomes;
  }

 private:
  [[nodiscard]] Clock::time_point from_now(Seconds time) const {
    return requester_.now() + std::chrono::duration_cast<Clock::duration>(time);
  }

  // Takes the next answer; without one it has ended.
  void listen(Part& part, Seconds timeout) {
    if (const auto reply = requester_.wait(part.number, from_now(timeout))) {
      take(part, *reply);
      return;
    }
    part.reply.accepted(false);
    part.reply.detail("no answer from quoin up; its output tells what it is doing");
    part.ended = true;
    part.answered = false;
  }

  static void take(Part& part, const msg::ControlReply& reply) {
    const auto plan = part.reply.steps();
    part.reply = reply;
    part.ended = !reply.pending();
    // The plan is reported at first, and in the end with the scans.
    if (reply.steps().empty()) part.reply.steps(plan);
  }

  // Until all are, or one will not be.
  void wait_until_ready() {
    const auto begin = requester_.now();
    // Alone it goes on by itself.
    const bool alone = parts_.size() == 1;
    const auto timeout = [&](const Part& part) {
      if (part.reply.service().empty()) return first_answer;
      return timeout_ + Seconds(10.0) + (alone ? time_to_change(part) : Seconds(0.0));
    };
    const auto is_done = [](const Part& part) { return part.ended || part.ready(); };
    const auto failed = [](const Part& part) { return part.ended && !part.reply.accepted(); };
    while (!std::all_of(parts_.begin(), parts_.end(), is_done) &&
           std::none_of(parts_.begin(), parts_.end(), failed) && !interrupted_()) {
      for (Part& part : parts_) {
        if (is_done(part)) continue;
        if (const auto reply = requester_.wait(part.number, from_now(Seconds(0.02)))) {
          take(part, *reply);
        } else if (requester_.now() - begin > timeout(part)) {
          listen(part, Seconds(0.0));
        }
      }
    }
  }

  static Seconds time_to_change(const Part& part) {
    return longest_change * static_cast<double>(1 + part.reply.steps().size());
  }

  void instruct(Part& part, msg::ControlAction action, const std::string& change) {
    msg::ControlRequest instruction;
    instruction.service(supervisor_name(part.host));
    instruction.action(action);
    instruction.change(change);
    const std::uint64_t number = requester_.send(instruction);
    if (!change.empty()) part.silent = !requester_.wait(number, from_now(longest_change));
  }

  void end(msg::ControlAction action) {
    std::vector<Part*> waiting;
    for (Part& part : parts_) {
      if (part.ended) continue;
      instruct(part, action, "");
      waiting.push_back(&part);
    }
    for (Part* part : waiting) {
      // The plan and the readiness may still be on their way.
      const auto deadline = from_now(timeout_ + time_to_change(*part));
      while (!part->ended) listen(*part, deadline - requester_.now());
    }
  }

  void withdraw() { end(msg::ControlAction::CONTROL_WITHDRAW); }

  void change_all(const Deployment& wanted) {
    // As one host does it, see Changeover::finish: new readers before new sources, then those that
    // take over from the sources on. Where a service moves to another host, the old one ends first.
    for (auto service = wanted.services.rbegin(); service != wanted.services.rend(); ++service) {
      if (!moves(label(*service))) change(ChangeAction::start, label(*service));
    }
    for (const ServiceConfig& service : wanted.services) {
      change(ChangeAction::replace, label(service));
      if (!moves(label(service))) continue;
      change(ChangeAction::stop, label(service));
      change(ChangeAction::start, label(service));
    }
    end(msg::ControlAction::CONTROL_PROCEED);
  }

  void change(ChangeAction action, const std::string& service) {
    for (Part& part : parts_) {
      if (part.silent) continue;  // it would hold up the others again
      if (part.plans(action, service)) instruct(part, msg::ControlAction::CONTROL_PROCEED, service);
    }
  }

  [[nodiscard]] bool moves(const std::string& service) const {
    const auto planned = [&](ChangeAction action) {
      return std::any_of(parts_.begin(), parts_.end(),
                         [&](const Part& part) { return part.plans(action, service); });
    };
    return planned(ChangeAction::start) && planned(ChangeAction::stop);
  }

  Requester& requester_;
  msg::ControlRequest request_;
  const std::function<bool()>& interrupted_;
  Seconds timeout_;
  std::vector<Part> parts_;
};

}  // namespace

std::vector<HostOutcome> apply_on(const std::vector<std::string>& hosts, const Deployment& wanted,
                                  Requester& requester, const msg::ControlRequest& request,
                                  const std::function<bool()>& interrupted) {
  return Concert(requester, request, interrupted).apply(hosts, wanted);
}

}  // namespace quoin::deploy
