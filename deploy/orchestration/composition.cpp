// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/composition.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/checksum.hpp"
#include "deploy/orchestration/host.hpp"
#include "deploy/orchestration/launch.hpp"
#include "services/deployment/graph.hpp"

namespace quoin::deploy {

namespace {

std::vector<ProcessPlan> plans_of(const Deployment& deployment, const std::string& host,
                                  const FrozenFile& copy) {
  // The monitor reads what comes out at the ends.
  const std::vector<Connection> ends = Graph(deployment).ends();
  const auto observers = [&](const ServiceConfig& service) {
    return static_cast<int>(std::count_if(ends.begin(), ends.end(), [&](const Connection& end) {
      return end.writer->name == service.name;
    }));
  };
  return process_plans(deployment, host, observers, copy.path());
}

/// What the other hosts change.
Plan plan_elsewhere(const Deployment& running, const Deployment& wanted, const std::string& host) {
  Plan all;
  std::set<std::string> others;
  for (const Deployment* deployment : {&running, &wanted}) {
    for (const std::string& other : hosts_of(*deployment)) others.insert(other);
  }
  others.erase(host);
  for (const std::string& other : others) {
    const Plan plan = plan_changes(running, wanted, other);
    all.changes.insert(all.changes.end(), plan.changes.begin(), plan.changes.end());
  }
  return all;
}

/// Does one change after the other as instructed. Throws when instructed to withdraw.
void follow(const NextInstruction& next_instruction, Changeover& changeover) {
  for (bool begun = false;; begun = true) {
    const Instruction instruction = next_instruction(begun);
    if (instruction.kind == Instruction::Kind::finish) return;
    if (instruction.kind == Instruction::Kind::withdraw) {
      changeover.roll_back();
      throw std::runtime_error(instruction.text);
    }
    changeover.change(instruction.text);
  }
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "\n") + text;
  return all;
}

}  // namespace

Composition::Composition(const std::filesystem::path& file, const std::string& host) {
  const std::string text = read_deployment(file);
  deployment_ = parse_deployment(text, file);
  host_ = host_to_run(deployment_, host);
  copy_ = std::make_unique<FrozenFile>(text);
  plans_ = plans_of(deployment_, host_, *copy_);
}

std::vector<msg::ControlStep> steps_of(const Plan& plan) {
  std::vector<msg::ControlStep> steps;
  for (const Change& change : plan.changes) {
    msg::ControlStep& step = steps.emplace_back();
    step.action(std::string(action_name(change.action)));
    step.service(change.service);
    step.detail(change.detail);
  }
  return steps;
}

ApplyOutcome Composition::apply(const Changeover::World& world, const ApplyRequest& request,
                                const std::function<void(const Plan&)>& on_plan) {
  ApplyOutcome outcome;
  try {
    carry_out(world, request, on_plan, outcome);
    outcome.accepted = true;
  } catch (const std::exception& error) {
    outcome.detail = error.what();
  }
  return outcome;
}

void Composition::carry_out(const Changeover::World& world, const ApplyRequest& request,
                            const std::function<void(const Plan&)>& on_plan,
                            ApplyOutcome& outcome) {
  const std::string text = read_deployment(request.file);
  if (request.checksum && checksum(text) != *request.checksum) {
    throw std::runtime_error(request.file.string() +
                             ": reads differently here than where it was asked for; apply it again "
                             "on this host when nobody is writing it");
  }
  const Deployment wanted = parse_deployment(text, request.file);
  const Deployment running = world.dialogue.describe(deployment_);
  const Plan plan = plan_changes(running, wanted, host_);
  outcome.steps = steps_of(plan);
  if (!plan.obstacles.empty()) throw std::runtime_error(joined(plan.obstacles));
  on_plan(plan);
  if (request.dry_run) return;

  auto copy = std::make_unique<FrozenFile>(text);
  std::vector<ProcessPlan> plans = plans_of(wanted, host_, *copy);
  const Plan elsewhere = request.next_instruction ? plan_elsewhere(running, wanted, host_) : Plan{};
  Changeover changeover(world, running, wanted, plan, elsewhere, plans, request.timeout);
  outcome.rolled_back = true;
  changeover.prepare();
  if (request.next_instruction) follow(request.next_instruction, changeover);
  outcome.rolled_back = false;
  changeover.finish();
  for (msg::ControlStep& step : outcome.steps) {
    const auto first = changeover.first_scans().find(step.service());
    if (first != changeover.first_scans().end()) step.first_sequence_number(first->second);
  }
  deployment_ = wanted;
  plans_ = std::move(plans);
  previous_copy_ = std::move(copy_);
  copy_ = std::move(copy);
}

}  // namespace quoin::deploy
