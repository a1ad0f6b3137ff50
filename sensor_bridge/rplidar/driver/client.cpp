// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/client.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "sensor_bridge/rplidar/driver/reply_reading.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// How soon a request to stop is heeded while nothing arrives.
constexpr std::chrono::milliseconds slice = 100ms;
/// While bytes arrive it is not asked for with each of them: to ask has its price, too.
constexpr std::chrono::milliseconds shortest_question = 20ms;
constexpr std::size_t largest_heard = 512;
/// Answers to earlier questions that may stand before the one that is waited for.
constexpr int most_other_answers = 16;

}  // namespace

Client::Client(Transport& transport, const Interruption& interruption, const TimeOuts& time_outs,
               std::string name)
    : transport_(transport),
      interruption_(interruption),
      time_outs_(time_outs),
      name_(std::move(name)) {}

std::span<const std::uint8_t> Client::read(Deadline deadline) {
  if (!rest_.empty()) return std::exchange(rest_, {});
  while (true) {
    const Deadline now = Clock::now();
    if (now >= next_question_) {
      wait_until(interruption_, now);
      next_question_ = now + shortest_question;
    }
    if (now >= deadline) return {};  // though there may be bytes: a device may never be quiet
    const Deadline end = std::min(deadline, now + slice);
    const std::size_t size = transport_.read(buffer_, end);
    received_bytes_ += size;
    if (size > 0) return {buffer_.data(), size};
    if (end >= deadline) return {};
  }
}

void Client::send(const Request& request) {
  wait_until(interruption_, Clock::now());
  rest_ = {};
  heard_.clear();
  transport_.write(request.bytes(), Clock::now() + time_outs_.answer);
}

bool Client::stop() {
  // A device that is deaf while it sends, or a lost byte: once more.
  for (int attempt = 0; attempt < 2; ++attempt) {
    send(Request(Command::stop));
    const Deadline deadline = Clock::now() + time_outs_.draining;
    while (Clock::now() < deadline) {
      // Quiet for that long, the device also takes requests again, which it does not at once.
      if (read(Clock::now() + time_outs_.quiet).empty()) return true;
    }
  }
  return false;
}

void Client::reset() {
  send(Request(Command::reset));
  wait_until(interruption_, Clock::now() + time_outs_.reset);
  transport_.discard_input();  // some models greet with lines of text
}

std::vector<std::uint8_t> Client::read_payload(std::size_t length, Deadline deadline) {
  std::vector<std::uint8_t> payload;
  while (payload.size() < length) {
    const std::span<const std::uint8_t> bytes = read(deadline);
    if (bytes.empty()) break;
    const std::size_t count = std::min(bytes.size(), length - payload.size());
    payload.insert(payload.end(), bytes.begin(), bytes.begin() + static_cast<long>(count));
    rest_ = bytes.subspan(count);
  }
  return payload;
}

std::vector<std::uint8_t> Client::ask(const Request& request, AnswerType type,
                                      TimeOuts::Time time_out) {
  send(request);
  const Deadline deadline = Clock::now() + time_out;
  DescriptorScanner scanner;
  for (int others = 0; others < most_other_answers;) {
    std::span<const std::uint8_t> bytes = read(deadline);
    if (bytes.empty()) throw DeviceError(no_answer(request, type));
    const std::size_t room = largest_heard - std::min(largest_heard, heard_.size());
    heard_.insert(heard_.end(), bytes.begin(),
                  bytes.begin() + static_cast<long>(std::min(room, bytes.size())));
    const std::optional<Descriptor> descriptor = scanner.next(bytes);
    rest_ = bytes;
    if (!descriptor || descriptor->repeated) continue;
    std::vector<std::uint8_t> payload = read_payload(descriptor->length, deadline);
    if (payload.size() < descriptor->length) throw DeviceError(no_answer(request, type));
    if (descriptor->type == static_cast<std::uint8_t>(type) && answers(request, payload)) {
      return payload;
    }
    ++others;
  }
  throw DeviceError(no_answer(request, type));
}

Diagnosis Client::no_answer(const Request& request, AnswerType type) const {
  Diagnosis diagnosis = diagnose_reply(request, type, heard_, received_bytes_ > 0);
  diagnosis.text = name_ + ": " + diagnosis.text;
  return diagnosis;
}

DeviceInfo Client::info(TimeOuts::Time time_out) {
  const Request request(Command::info);
  const auto info = parse_info(ask(request, AnswerType::info, time_out));
  if (!info) throw DeviceError(wrong_value(name_, "its identity"));
  return *info;
}

DeviceHealth Client::health() {
  const Request request(Command::health);
  return parse_health(ask(request, AnswerType::health, time_outs_.answer)).value_or(DeviceHealth{});
}

SampleTimes Client::sample_times() {
  const Request request(Command::sample_rate);
  return parse_sample_times(ask(request, AnswerType::sample_rate, time_outs_.answer))
      .value_or(SampleTimes{});
}

bool Client::has_motor_pwm() {
  const auto flags =
      parse_number(ask(accessory_board_request(), AnswerType::accessory_board, time_outs_.answer));
  return flags && (*flags & 1) != 0;
}

void Client::set_motor_pwm(std::uint16_t pwm) { send(motor_pwm_request(pwm)); }

std::vector<std::uint8_t> Client::configuration(ConfigurationKey key,
                                                std::optional<std::uint16_t> mode) {
  const std::vector<std::uint8_t> payload =
      ask(configuration_request(key, mode), AnswerType::configuration, time_outs_.answer);
  const auto value = configuration_value(key, payload).value_or(std::span<const std::uint8_t>{});
  return {value.begin(), value.end()};
}

void Client::set_motor_speed(std::uint16_t speed) { send(motor_speed_request(speed)); }

Descriptor Client::start_scan(const ScanMode& mode) {
  const Request request = mode.format == SampleFormat::standard
                              ? Request(Command::scan)
                              : express_scan_request(static_cast<std::uint8_t>(mode.id));
  send(request);
  const Deadline deadline = Clock::now() + time_outs_.answer;
  DescriptorScanner scanner;
  while (true) {
    std::span<const std::uint8_t> bytes = read(deadline);
    if (bytes.empty()) {
      throw DeviceError({.finding = Finding::scan_not_started,
                         .text = name_ + ": does not start to scan",
                         .advice = "it may be in protection stop: switch it off and on"});
    }
    const std::optional<Descriptor> descriptor = scanner.next(bytes);
    rest_ = bytes;
    if (descriptor && descriptor->repeated) return *descriptor;
  }
}

}  // namespace quoin::sensor_bridge::rplidar
