// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/node.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include <spdlog/spdlog.h>

#include "services/runtime/node/clock.hpp"
#include "services/topics/header.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::runtime {

namespace {

// Messages that a held node keeps between two steps of the succession, which take milliseconds.
constexpr std::size_t most_kept = 1024;
// For what has been received when a service is asked to stop.
constexpr std::chrono::milliseconds longest_drain{1500};
// Messages that wait for what is joined to them; more stay with DDS.
constexpr std::size_t most_waiting = 256;

std::uint64_t number_of(const msg::Header& header) { return topics::sequence_number(header); }
std::uint64_t number_of(const Message& message) { return number_of(*message.header); }

/// Whether this is of another process than that of `known`, which did not go on with its numbers.
bool numbers_anew(const msg::Header& header, std::uint64_t known) {
  return known != 0 && topics::origin(header).incarnation() > known && !header.trace().empty() &&
         header.trace().front().index() == topics::sequence_number(header);
}

}  // namespace

Node::Node(Settings settings, MethodFactory make, std::vector<OutputPart> outputs,
           DataThread thread)
    : settings_(std::move(settings)),
      thread_(std::move(thread)),
      exchange_(settings_.method, settings_.parameters, std::move(make),
                settings_.longest_exchange),
      succession_(settings_.held, settings_.longest_handover),
      outputs_(std::move(outputs)),
      next_index_(outputs_.size(), 0),
      next_number_(outputs_.size(), 0) {
  for (const OutputPart& part : outputs_) {
    thread_.record.add_output(part.topic);
    results_.push_back({part.output.get(), false});
  }
}

void Node::open(std::vector<InputPart> inputs) {
  for (InputPart& part : inputs) {
    thread_.record.add_input(part.port.name, part.topic);
    joins_by_time_ = joins_by_time_ || part.port.join == Join::by_time;
    ports_.push_back(std::make_unique<Port>());
    const topics::TopicType* const type = topics::find_topic_type(part.port.type);
    ports_.back()->newest_counts = type != nullptr && type->qos == "state";
    ports_.back()->part = std::move(part);
  }
}

std::size_t Node::matched_readers() const {
  std::size_t sum = 0;
  for (const OutputPart& part : outputs_) sum += part.output->matched();
  return sum;
}

std::size_t Node::matched_writers() const {
  std::size_t sum = 0;
  for (const auto& port : ports_) sum += port->part.input->matched();
  return sum;
}

std::vector<std::string> report_outputs(const std::vector<Node::OutputPart>& outputs,
                                        msg::ServiceStatus& status) {
  std::vector<std::string> mismatches;
  for (std::size_t i = 0; i < outputs.size() && i < status.outputs().size(); ++i) {
    status.outputs()[i].readers(static_cast<std::uint32_t>(outputs[i].output->matched()));
    for (std::string& text : outputs[i].output->incompatible_qos()) {
      mismatches.push_back(std::move(text));
    }
  }
  return mismatches;
}

void Node::report_endpoints(msg::ServiceStatus& status) const {
  std::vector<std::string> mismatches = report_outputs(outputs_, status);
  for (std::size_t i = 0; i < ports_.size() && i < status.inputs().size(); ++i) {
    status.inputs()[i].writers(static_cast<std::uint32_t>(ports_[i]->part.input->matched()));
    for (const auto& [reason, count] : ports_[i]->part.input->refused()) {
      add_refused(status.inputs()[i], reason, count);
    }
    for (std::string& text : ports_[i]->part.input->incompatible_qos()) {
      mismatches.push_back(std::move(text));
    }
  }
  status.incompatible_qos(std::move(mismatches));
}

void Node::assert_liveliness() {
  for (const OutputPart& part : outputs_) part.output->assert_liveliness();
}

bool Node::step() {
  if (left_) return false;
  bool any = take_partners();
  if (succession_.held()) return hold() || any;
  const bool asked = succession_.asked();
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (!ports_[i]->each()) continue;
    ports_[i]->left = ports_[i]->left && asked;  // the successor may have been refused
    any = take_each(i) || any;
    any = handle_next(i) || any;
  }
  if (asked) look_whether_left();
  return any && !left_;
}

void Node::drain() {
  draining_ = true;
  const Clock::time_point deadline = thread_.now() + longest_drain;
  while (step()) {
    if (thread_.now() < deadline) continue;
    spdlog::warn("what has been received is too much to be handled before the end");
    return;
  }
}

void Node::leave() {
  Positions next;
  for (const auto& port : ports_) {
    if (port->each()) next[port->part.port.name] = port->next;
  }
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (outputs_[i].port.rate != Rate::own_rate) continue;
    next[output_key(outputs_[i].port.type)] = next_number_[i];
  }
  succession_.left(next, exchange_.save());
}

std::optional<Node::Clock::time_point> Node::due() const {
  std::optional<Clock::time_point> first;
  for (const auto& port : ports_) {
    if (port->queue.empty() || port->left || succession_.held()) continue;
    if (!first || port->queue.front().deadline < *first) first = port->queue.front().deadline;
  }
  return first;
}

bool Node::full() const {
  const std::size_t room = succession_.held() ? most_kept : most_waiting;
  return std::any_of(ports_.begin(), ports_.end(),
                     [&](const auto& port) { return port->queue.size() >= room; });
}

bool Node::take_partners() {
  bool any = false;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    Port& port = *ports_[i];
    if (port.each()) continue;
    while (auto message = port.part.input->take()) {
      any = true;
      if (account(i, *message->header)) port.partners.add(std::move(*message));
      if (port.part.port.join == Join::latest) port.partners.keep_latest();
    }
  }
  return any;
}

/// Receives without publishing until this node is to begin.
bool Node::hold() {
  bool any = false;
  for (const auto& entry : ports_) {
    Port& port = *entry;
    if (!port.each()) continue;
    while (port.queue.size() < most_kept) {
      auto message = port.part.input->take();
      if (!message) break;
      any = true;
      if (!succession_.keep(port.part.port.name, number_of(*message))) port.queue.clear();
      port.incarnation = topics::origin(*message->header).incarnation();
      port.queue.push_back({std::move(*message), now_ns(), thread_.now() + settings_.join_timeout});
    }
  }
  if (const auto from = succession_.begin()) {
    begin(*from);
    return true;  // what it holds can be handled
  }
  return any;
}

void Node::begin(const Succession::Begin& from) {
  try {
    exchange_.restore(from.state);
  } catch (const std::exception& error) {
    spdlog::error("what the process before knew is dropped: {}", error.what());
  }
  for (const auto& port : ports_) {
    const auto position = from.positions.find(port->part.port.name);
    if (position == from.positions.end()) continue;
    port->begin_with = position->second;
    port->next = position->second;  // should it be asked to leave before that has come
  }
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const auto position = from.positions.find(output_key(outputs_[i].port.type));
    if (position != from.positions.end()) next_number_[i] = position->second;
  }
  thread_.record.set_state(msg::ServiceState::STATE_ACTIVE);
}

/// What cannot be handled at once stays with DDS, whose QoS says what happens to it, unless it
/// waits for what is joined to it.
bool Node::take_each(std::size_t index) {
  Port& port = *ports_[index];
  bool any = false;
  while (port.queue.size() < (joins_by_time_ ? most_waiting : 1)) {
    auto message = port.part.input->take();
    if (!message) break;
    any = true;
    port.queue.push_back({std::move(*message), now_ns(), thread_.now() + settings_.join_timeout});
  }
  return any;
}

/// Counts a message; false when it is one that came before.
bool Node::account(std::size_t index, const msg::Header& header) {
  Port& port = *ports_[index];
  if (port.newest_counts) port.accounting.interrupt();
  for (const Loss& loss : port.accounting.receive(header)) {
    spdlog::warn("{} scans of {}..{} lost by {}", loss.count, loss.first_sequence,
                 loss.last_sequence, to_text(loss.site));
  }
  switch (port.accounting.verdict()) {
    case ScanAccounting::Verdict::duplicate:
      thread_.record.count_duplicate(index);
      return false;
    case ScanAccounting::Verdict::implausible:
      spdlog::warn("refused scan {} of {}: no sensor can have got so far", number_of(header),
                   topics::source(header));
      thread_.record.count_refused(index, "header.origins.sequence_number: implausible");
      return false;
    case ScanAccounting::Verdict::received:
      break;
  }
  if (port.accounting.rejoined()) {
    spdlog::warn(
        "port {} goes on with scan {} of {}, which looked like a repetition: what came "
        "before it was false",
        port.part.port.name, number_of(header), topics::source(header));
  }
  std::uint64_t link_lost = 0;
  std::uint64_t upstream_lost = 0;
  for (const auto& [site, count] : port.accounting.lost_by_site()) {
    (site.place == LossPlace::link ? link_lost : upstream_lost) += count;
  }
  thread_.record.count_received(index, port.each(), upstream_lost, link_lost);
  return true;
}

/// Whether nothing more can come for it, or it has waited for long enough.
bool Node::complete(const Pending& pending) const {
  if (!joins_by_time_ || draining_ || thread_.stopping() || succession_.asked()) return true;
  const std::int64_t stamp = last_stamp(pending.message);
  const bool all = std::all_of(ports_.begin(), ports_.end(), [&](const auto& port) {
    return port->part.port.join != Join::by_time || port->partners.after(stamp) != nullptr;
  });
  return all || thread_.now() >= pending.deadline;
}

std::int64_t Node::last_stamp(const Message& message) const {
  const auto& of_method = exchange_.method().last_stamp;
  const std::int64_t stamp = message.header->stamp();
  return of_method ? std::max(stamp, of_method(message)) : stamp;
}

bool Node::handle_next(std::size_t index) {
  Port& port = *ports_[index];
  if (port.queue.empty() || port.left || !complete(port.queue.front())) return false;
  const std::uint64_t number = number_of(port.queue.front().message);
  if (succession_.leaves(port.part.port.name, number)) {
    port.left = true;
    return false;
  }
  const Pending pending = std::move(port.queue.front());
  port.queue.pop_front();
  thread_.pulse.beat();
  // The predecessor has handled these; with another input they may come late.
  const msg::Header& header = *pending.message.header;
  if (port.begin_with && number < *port.begin_with && !numbers_anew(header, port.incarnation)) {
    port.incarnation = topics::origin(header).incarnation();
    return true;
  }
  port.begin_with.reset();
  if (!account(index, header)) return true;
  port.next = number + 1;
  if (exchange_.apply(number)) thread_.record.set_method(exchange_.name());
  handle(index, pending);
  return true;
}

void Node::join(const Message& message, std::vector<Work::Partner>& partners) {
  partners.clear();
  const std::int64_t stamp = message.header->stamp();
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    Port& port = *ports_[i];
    if (port.each()) continue;
    Work::Partner& partner = partners.emplace_back();
    partner.port = port.part.port.name;
    if (port.part.port.join == Join::latest) {
      partner.before = port.partners.latest();
      note_missing(i, partner.before == nullptr);
    } else {
      port.partners.forget_before(stamp);
      partner.before = port.partners.before(stamp);
      partner.after = port.partners.after(stamp);
      partner.all = &port.partners;
      note_missing(i, port.partners.after(last_stamp(message)) == nullptr);
    }
  }
}

/// Counts each result without a partner, and says so when that begins and when it ends.
void Node::note_missing(std::size_t index, bool missing) {
  Port& port = *ports_[index];
  if (missing) thread_.record.count_unjoined(index);
  if (std::exchange(port.missed, missing) == missing) return;
  const auto text_of = [](const Port& missed) {
    return "nothing comes by port " + missed.part.port.name + " from '" + missed.part.writer +
           "' in time; going on without it";
  };
  if (missing) {
    spdlog::warn("{}", text_of(port));
  } else {
    spdlog::info("port {} is joined again", port.part.port.name);
  }
  std::string detail;
  for (const auto& other : ports_) {
    if (other->missed) detail += (detail.empty() ? "" : "; ") + text_of(*other);
  }
  thread_.record.set_detail(detail);
}

void Node::handle(std::size_t index, const Pending& pending) {
  join(pending.message, joined_);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    results_[i].publish = outputs_[i].port.rate == Rate::per_input;
    results_[i].next = nullptr;
  }
  Work work(pending.message, ports_[index]->part.port.name, joined_, results_);
  try {
    exchange_.method().handle(work);
  } catch (const std::exception& error) {
    thread_.record.count_loss(LossCause::processing);
    spdlog::error("scan {}: {}", number_of(pending.message), error.what());
    return;
  }
  for (const auto& [name, value] : work.diagnostics()) thread_.record.set_diagnostic(name, value);
  publish(index, pending, work);
}

void Node::publish(std::size_t index, const Pending& pending, const Work& work) {
  bool delivered = true;
  std::int64_t published = 0;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const auto& next = results_[i].next;
    if (!next && !results_[i].publish) continue;
    while (!next || next(outputs_[i].output->message())) {
      published = write(i, index, pending, work.frame());
      delivered = delivered && published > 0;
      if (!next) break;
    }
  }
  if (!delivered) {
    thread_.record.count_loss(LossCause::publishing);
    return;
  }
  const auto& first = pending.message.header->trace();
  thread_.record.count_result(first.empty() ? pending.received : first.front().published(),
                              pending.received, published, work.failures());
}

std::int64_t Node::write(std::size_t output, std::size_t index, const Pending& pending,
                         std::string_view frame) {
  OutputPart& part = outputs_[output];
  write_header(output, index, pending, frame);
  msg::StageTrace& trace = part.output->header().trace().back();
  const bool written = deliver(*part.output, trace, part.lossless, thread_);
  thread_.record.count_output(output, written);
  ++next_number_[output];
  if (!written) return 0;
  ++next_index_[output];
  return trace.published();
}

/// A result per input goes by the name of what it was made from. What has a rate of its own is
/// numbered by this node, as a source numbers its scans.
void Node::write_header(std::size_t output, std::size_t index, const Pending& pending,
                        std::string_view frame) {
  const msg::Header& in = *pending.message.header;
  msg::Header& out = outputs_[output].output->header();
  if (outputs_[output].port.rate == Rate::per_input) {
    out = in;
  } else {
    topics::set_origin(out, settings_.service, thread_.record.incarnation(), next_number_[output]);
    out.origins().insert(out.origins().end(), in.origins().begin(), in.origins().end());
    out.stamp(in.stamp());
    out.frame(in.frame());
    out.trace().clear();
  }
  if (!frame.empty()) out.frame(std::string(frame));
  for (const Work::Partner& partner : joined_) {
    const Message* const after = partner.after == partner.before ? nullptr : partner.after;
    for (const Message* message : {partner.before, after}) {
      if (message == nullptr || message->header->origins().empty()) continue;
      out.origins().push_back(message->header->origins().front());
    }
  }
  msg::StageTrace& trace = out.trace().emplace_back();
  trace.service(settings_.service);
  trace.input(ports_[index]->part.port.name);
  trace.method(exchange_.name());
  trace.incarnation(thread_.record.incarnation());
  trace.index(next_index_[output]);
  trace.received(pending.received);
}

void Node::look_whether_left() {
  bool all = true;
  for (const auto& port : ports_) {
    if (!port->each()) continue;
    port->left = port->left || succession_.leaves(port->part.port.name, port->next);
    all = all && port->left;
  }
  left_ = all;
}

}  // namespace quoin::runtime
