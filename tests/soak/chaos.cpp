// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/soak/chaos.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <signal.h>
#include <unistd.h>

namespace quoin::soak {

namespace {

using std::chrono::milliseconds;

Chaos::Clock::duration seconds(double time) {
  return std::chrono::duration_cast<Chaos::Clock::duration>(std::chrono::duration<double>(time));
}

}  // namespace

Chaos::Chaos(const tests::TestDeployment& deployment, const Scenario& scenario,
             std::vector<std::filesystem::path> compositions, std::uint64_t seed)
    : deployment_(deployment),
      scenario_(scenario),
      compositions_(std::move(compositions)),
      random_(seed),
      participant_(deployment.participant("chaos")),
      statuses_(participant_, status_topic(deployment.deployment().name_space),
                runtime::QosPreset::state),
      requests_(participant_, control_request_topic(deployment.deployment().name_space),
                runtime::QosPreset::control),
      replies_(participant_, control_reply_topic(deployment.deployment().name_space),
               runtime::QosPreset::control),
      next_(Clock::now() + seconds(5.0)) {
  if (scenario.attacked.size() == 3) {
    neighbour_.emplace(deployment, scenario.attacked[0], scenario.attacked[1], scenario.attacked[2],
                       seed + 1);
  }
}

Chaos::~Chaos() {
  for (const Pause& pause : pauses_) ::kill(pause.process, SIGCONT);
}

double Chaos::uniform(double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random_);
}

std::size_t Chaos::below(std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
}

void Chaos::step() {
  const auto now = Clock::now();
  listen();
  end_what_is_over(now);
  if (now < next_) return;
  act();
  next_ = now + seconds(uniform(0.3, 3.0));
}

void Chaos::listen() {
  msg::ServiceStatus status;
  while (statuses_.take(status)) {
    msg::ServiceStatus& newest = latest_[status.service()];
    if (status.stamp() < newest.stamp()) continue;
    newest = status;
    processes_[static_cast<pid_t>(status.pid())] = status.service();
  }
  if (neighbour_) neighbour_->listen();
  msg::ControlReply reply;
  while (replies_.take(reply)) {
    if (reply.requester() == "chaos") ++counts_[reply.accepted() ? "accepted" : "refused"];
  }
}

void Chaos::end_what_is_over(Clock::time_point now) {
  std::erase_if(pauses_, [&](const Pause& pause) {
    if (now < pause.ends) return false;
    ::kill(pause.process, SIGCONT);
    return true;
  });
  std::erase_if(visitors_, [&](const auto& visitor) { return now >= visitor->leaves; });
  if (apply_) {
    if (const auto code = apply_->wait(milliseconds(0))) {
      ++counts_["apply ended with " + std::to_string(*code)];
      apply_.reset();
    }
  }
}

void Chaos::end_disturbances() {
  for (Pause& pause : pauses_) pause.ends = Clock::now();
  for (const auto& visitor : visitors_) visitor->leaves = Clock::now();
  const auto deadline = Clock::now() + std::chrono::seconds(60);
  do {
    listen();
    end_what_is_over(Clock::now());
  } while (apply_ && Clock::now() < deadline);
}

void Chaos::act() {
  using Action = void (Chaos::*)();
  // An action stands here as often as it is meant to be likely.
  static constexpr std::array<Action, 12> actions{
      &Chaos::kill_one, &Chaos::kill_one,      &Chaos::pause_one,    &Chaos::pause_one,
      &Chaos::swap_one, &Chaos::swap_one,      &Chaos::ask_nonsense, &Chaos::apply_another,
      &Chaos::invite,   &Chaos::apply_another, &Chaos::attack,       &Chaos::attack};
  (this->*actions[below(actions.size())])();
}

std::vector<Member> Chaos::members() const {
  std::vector<Member> members;
  for (const auto& [name, status] : latest_) {
    const auto process = static_cast<pid_t>(status.pid());
    // Whatever a neighbour invents: nobody but processes of this test may be signalled.
    const bool ours = process > 1 && ::getpgid(process) == process && ::getpgid(0) != process &&
                      !name.starts_with("ghost_");
    const bool works = ours && status.state() == msg::STATE_ACTIVE && ::kill(process, 0) == 0;
    if (works) members.push_back({name, process, true});
  }
  return members;
}

std::optional<Member> Chaos::any_member() {
  const std::vector<Member> all = members();
  if (all.empty()) return std::nullopt;
  return all[below(all.size())];
}

void Chaos::kill_one() {
  const auto member = any_member();
  if (!member || spared_.contains(member->service)) return;
  ::kill(member->process, SIGKILL);
  ++counts_["killed"];
}

void Chaos::pause_one() {
  const auto member = any_member();
  if (!member) return;
  ::kill(member->process, SIGSTOP);
  pauses_.push_back({member->process, Clock::now() + seconds(uniform(0.05, 2.0))});
  ++counts_["paused"];
}

void Chaos::swap_one() {
  const Swap& swap = scenario_.swaps[below(scenario_.swaps.size())];
  msg::ControlRequest request;
  request.service(swap.service);
  request.requester("chaos");
  request.request(++request_);
  request.action(msg::ControlAction::CONTROL_SWAP_METHOD);
  request.method(swap.method);
  requests_.write(request);
  ++counts_["swaps asked for"];
}

std::string Chaos::nonsense() {
  std::string text(below(8) == 0 ? 100'000 : below(40), ' ');
  for (char& character : text) character = static_cast<char>(1 + below(255));
  return text;
}

void Chaos::ask_nonsense() {
  msg::ControlRequest request;
  for (int k = 0; k < 200; ++k) {
    request.service(below(2) == 0 ? scenario_.swaps.front().service : nonsense());
    request.requester("chaos");
    request.request(++request_);
    request.action(below(2) == 0 ? static_cast<msg::ControlAction>(99)
                                 : msg::ControlAction::CONTROL_SET_PARAMETERS);
    request.method(nonsense());
    request.parameters().resize(below(3));
    for (msg::ParameterSetting& setting : request.parameters()) {
      setting.name(nonsense());
      setting.value(nonsense());
    }
    requests_.write(request);
  }
  ++counts_["bursts of nonsense"];
}

void Chaos::apply_another() {
  if (apply_) return;
  const auto& file = compositions_[below(compositions_.size())];
  apply_.emplace(deployment_.quoin({"apply", file.string()}));
  ++counts_["applied"];
}

void Chaos::attack() {
  if (!neighbour_ || !neighbour_->informed()) return;
  for (int i = 0; i < 3; ++i) neighbour_->attack();
  ++counts_["attacks"];
}

void Chaos::invite() {
  visitors_.push_back(std::make_unique<Visitor>(deployment_.participant("visitor"),
                                                deployment_.topic(scenario_.visited),
                                                Clock::now() + seconds(uniform(0.5, 5.0))));
  ++counts_["visitors"];
}

}  // namespace quoin::soak
