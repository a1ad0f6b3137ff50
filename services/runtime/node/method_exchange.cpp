// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/method_exchange.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace quoin::runtime {

namespace {

constexpr std::chrono::seconds longest_wait_for_a_scan{2};

ParameterSettings settings_of(const msg::ControlRequest& request) {
  ParameterSettings settings;
  for (const msg::ParameterSetting& setting : request.parameters()) {
    settings.push_back({setting.name(), setting.value()});
  }
  return settings;
}

}  // namespace

MethodExchange::MethodExchange(std::string method, ParameterSettings parameters,
                               MethodFactory make)
    : make_(std::move(make)),
      name_(std::move(method)),
      current_(make_(name_, parameters)),
      wanted_name_(name_),
      wanted_form_(current_.state_form),
      parameters_(std::move(parameters)) {}

bool MethodExchange::apply(std::uint64_t sequence_number) {
  if (!pending_.load(std::memory_order_acquire)) return false;
  const std::lock_guard lock(mutex_);
  if (!next_) return false;
  try {
    if (next_->state_form == current_.state_form && next_->restore && current_.save) {
      next_->restore(current_.save());
    }
    current_ = std::move(*next_);
    name_ = next_name_;
    refusal_.clear();
  } catch (const std::exception& error) {
    refusal_ = std::string("the state of the method cannot be carried over: ") + error.what();
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
    case msg::ControlAction::CONTROL_SET_PARAMETERS:
      exchange(wanted_name_, merged(settings_of(request)), request.drop_state(), reply);
      break;
    default:  // the wire may carry any number
      throw std::invalid_argument("unknown action");
  }
  reply.accepted(true);
  reply.method(wanted_name_);
  for (const ParameterSetting& setting : parameters_) {
    msg::ParameterSetting& out = reply.parameters().emplace_back();
    out.name(setting.name);
    out.value(setting.text);
  }
}

ParameterSettings MethodExchange::merged(const ParameterSettings& changes) const {
  ParameterSettings result = parameters_;
  for (const ParameterSetting& change : changes) {
    const auto same =
        std::find_if(result.begin(), result.end(), [&](const ParameterSetting& setting) {
          return setting.name == change.name;
        });
    if (same == result.end()) {
      result.push_back(change);
    } else {
      same->text = change.text;
    }
  }
  return result;
}

void MethodExchange::exchange(const std::string& method, const ParameterSettings& parameters,
                              bool drop_state, msg::ControlReply& reply) {
  Method next = make_(method, parameters);  // throws, and then nothing has changed
  const std::string form = next.state_form;
  if (!wanted_form_.empty() && form != wanted_form_ && !drop_state) {
    throw std::invalid_argument("method " + method + " cannot go on with the state (" +
                                wanted_form_ + ") of " + wanted_name_ +
                                ", which would be dropped; ask with --drop-state to do so");
  }
  std::unique_lock lock(mutex_);
  next_ = std::move(next);
  next_name_ = method;
  pending_.store(true, std::memory_order_release);
  const bool applied =
      applied_.wait_for(lock, longest_wait_for_a_scan, [this] { return !pending_.load(); });
  if (applied && !refusal_.empty()) throw std::runtime_error(refusal_);
  wanted_name_ = method;
  wanted_form_ = form;
  parameters_ = parameters;
  if (applied) {
    reply.first_sequence_number(first_sequence_number_);
  } else {
    reply.detail("no scan has come since; the next one is handled as requested");
  }
}

}  // namespace quoin::runtime
