// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "sensor_bridge/rplidar/driver/diagnosis.hpp"
#include "sensor_bridge/rplidar/protocol/configuration.hpp"
#include "sensor_bridge/rplidar/protocol/descriptor.hpp"
#include "sensor_bridge/rplidar/protocol/device_info.hpp"
#include "sensor_bridge/rplidar/protocol/request.hpp"
#include "sensor_bridge/transport/transport.hpp"

namespace quoin::sensor_bridge::rplidar {

using Bytes = std::vector<std::uint8_t>;

[[nodiscard]] inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

[[nodiscard]] inline Bytes answer(AnswerType type, std::span<const std::uint8_t> payload) {
  const auto head = encode(Descriptor{static_cast<std::uint32_t>(payload.size()), false,
                                      static_cast<std::uint8_t>(type)});
  return Bytes(head.begin(), head.end()) + Bytes(payload.begin(), payload.end());
}

[[nodiscard]] inline Bytes configuration_answer(ConfigurationKey key, const Bytes& value) {
  return answer(AnswerType::configuration, encode_configuration(key, value));
}

/// What a scripted device was told and how it answers; outlives its transports.
struct Script {
  std::function<Bytes(const Request&)> answer = [](const Request&) { return Bytes(); };
  /// What comes without being asked for, each time that there is nothing else to read.
  std::function<Bytes()> stream = [] { return Bytes(); };

  std::vector<Command> commands;
  std::vector<Request> requests;
  std::optional<bool> motor_held;
  std::optional<TransportError> failure;  ///< of every further operation
};

/// A device that says what the test wants.
class ScriptedTransport : public Transport {
 public:
  explicit ScriptedTransport(Script& script) : script_(script) {}

  std::size_t read(std::span<std::uint8_t> bytes, Deadline deadline) override {
    if (script_.failure) throw *script_.failure;
    if (input_.empty()) say(script_.stream());
    if (input_.empty()) std::this_thread::sleep_until(deadline);
    const std::size_t count = std::min(bytes.size(), input_.size());
    std::copy_n(input_.begin(), count, bytes.begin());
    input_.erase(input_.begin(), input_.begin() + static_cast<long>(count));
    return count;
  }

  void write(std::span<const std::uint8_t> bytes, Deadline) override {
    if (script_.failure) throw *script_.failure;
    while (const std::optional<Request> request = scanner_.next(bytes)) {
      script_.commands.push_back(request->command());
      script_.requests.push_back(*request);
      say(script_.answer(*request));
    }
  }

  void discard_input() override { input_.clear(); }
  void hold_motor(bool hold) override { script_.motor_held = hold; }

  void say(const Bytes& bytes) { input_.insert(input_.end(), bytes.begin(), bytes.end()); }

 private:
  Script& script_;
  RequestScanner scanner_;
  std::deque<std::uint8_t> input_;
};

/// Who the scripted devices are.
[[nodiscard]] inline DeviceInfo s1_info() {
  return {.model = 0x61,
          .firmware_major = 1,
          .firmware_minor = 28,
          .hardware = 18,
          .serial_number = {0x7E, 0x11, 0xEA, 0xF2}};
}
[[nodiscard]] inline DeviceInfo a1_info() {
  return {
      .model = 0x18, .firmware_major = 1, .firmware_minor = 20, .hardware = 5, .serial_number = {}};
}

[[nodiscard]] inline Bytes info_answer(const DeviceInfo& info) {
  return answer(AnswerType::info, encode(info));
}
[[nodiscard]] inline Bytes health_answer(Health health) {
  return answer(AnswerType::health, encode(DeviceHealth{health, 0}));
}

/// Of the DeviceError that `call` throws; fine when it throws none.
template <class Call>
[[nodiscard]] Diagnosis thrown_diagnosis(Call&& call) {
  try {
    call();
  } catch (const DeviceError& error) {
    return error.diagnosis();
  }
  return {};
}

}  // namespace quoin::sensor_bridge::rplidar
