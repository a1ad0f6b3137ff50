// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/method_exchange.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <spdlog/spdlog.h>

namespace quoin::runtime {

namespace {

ParameterSettings settings_of(const msg::ControlRequest& request) {
  ParameterSettings settings;
  for (const msg::ParameterSetting& setting : request.parameters()) {
    settings.push_back({setting.name(), setting.value()});
  }
  return settings;
}

ParameterSettings merged(ParameterSettings settings, const ParameterSettings& changes) {
  for (const ParameterSetting& change : changes) {
    const auto same = std::ranges::find(settings, change.name, &ParameterSetting::name);
    if (same == settings.end()) {
      settings.push_back(change);
    } else {
      same->text = change.text;
    }
  }
  return settings;
}

}  // namespace

MethodExchange::MethodExchange(std::string method, ParameterSettings parameters, MethodFactory make,
                               std::chrono::milliseconds longest_wait)
    : make_(std::move(make)),
      longest_wait_(longest_wait),
      name_(std::move(method)),
      current_(make_(name_, parameters)),
      in_force_{name_, current_.state_form, std::move(parameters)},
      wanted_(in_force_) {}

bool MethodExchange::apply(std::uint64_t sequence_number) {
  if (!pending_.load(std::memory_order_acquire)) return false;
  const std::lock_guard lock(mutex_);
  if (!next_) return false;
  try {
    if (next_->state_form == current_.state_form && next_->restore && current_.save) {
      next_->restore(current_.save());
    }
    current_ = std::move(*next_);
    in_force_ = wanted_;
    name_ = in_force_.name;
    refusal_.clear();
  } catch (const std::exception& error) {
    refusal_ = std::string("the state of the method cannot be carried over: ") + error.what();
    wanted_ = in_force_;
    spdlog::error("{}", refusal_);  // who asked may not wait any more
  }
  next_.reset();
  first_sequence_number_ = sequence_number;
  pending_.store(false, std::memory_order_release);
  applied_.notify_all();
  return refusal_.empty();
}

State MethodExchange::save() const { return current_.save ? current_.save() : State(); }

void MethodExchange::restore(const State& state) {
  if (state.empty()) return;
  if (!current_.restore) throw std::invalid_argument("method " + name_ + " keeps no state");
  current_.restore(state);
}

void MethodExchange::handle(const msg::ControlRequest& request, msg::ControlReply& reply) {
  switch (request.action()) {
    case msg::ControlAction::CONTROL_DESCRIBE:
      break;
    case msg::ControlAction::CONTROL_SWAP_METHOD:
      exchange(request.method(), settings_of(request), request.drop_state(), reply);
      break;
    case msg::ControlAction::CONTROL_SET_PARAMETERS: {
      const Version before = wanted();
      exchange(before.name, merged(before.parameters, settings_of(request)), request.drop_state(),
               reply);
      break;
    }
    default:  // the wire may carry any number
      throw std::invalid_argument("unknown action");
  }
  const Version version = wanted();
  reply.accepted(true);
  reply.method(version.name);
  for (const ParameterSetting& setting : version.parameters) {
    msg::ParameterSetting& out = reply.parameters().emplace_back();
    out.name(setting.name);
    out.value(setting.text);
  }
}

MethodExchange::Version MethodExchange::wanted() const {
  const std::lock_guard lock(mutex_);
  return wanted_;
}

void MethodExchange::exchange(const std::string& method, const ParameterSettings& parameters,
                              bool drop_state, msg::ControlReply& reply) {
  Method next = make_(method, parameters);  // throws, and then nothing has changed
  const std::string form = next.state_form;
  std::unique_lock lock(mutex_);
  if (!wanted_.state_form.empty() && form != wanted_.state_form && !drop_state) {
    throw std::invalid_argument("method " + method + " cannot go on with the state (" +
                                wanted_.state_form + ") of " + wanted_.name +
                                ", which would be dropped; ask with --drop-state to do so");
  }
  next_ = std::move(next);
  wanted_ = {method, form, parameters};
  pending_.store(true, std::memory_order_release);
  if (!applied_.wait_for(lock, longest_wait_, [this] { return !pending_.load(); })) {
    reply.detail("no scan has come since; the next one is handled as requested");
    return;
  }
  if (!refusal_.empty()) throw std::runtime_error(refusal_);
  reply.first_sequence_number(first_sequence_number_);
}

}  // namespace quoin::runtime
