// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/driver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "sensor_bridge/rplidar/driver/client.hpp"
#include "sensor_bridge/rplidar/driver/stream_watch.hpp"
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int most_resets = 3;  // in a row
/// Then one at another baud rate: it may be another device that does not answer.
constexpr int attempts_at_known_rate = 7;

/// [s] What a serial line takes for a frame.
double line_time(SampleFormat format, unsigned baud_rate) {
  constexpr double bits = 10;  // of a byte, with start and stop
  if (baud_rate == 0) return 0.0;
  return static_cast<double>(layout_of(format).bytes) * bits / baud_rate;
}

Diagnosis diagnosis_of(Finding finding, const std::string& name) {
  Diagnosis diagnosis{.finding = finding, .text = name + ": ", .advice = {}};
  switch (finding) {
    case Finding::silence:
      diagnosis.text += "no measurements arrive";
      diagnosis.advice = "starting anew; if it lasts, check that it turns, its power and the cable";
      break;
    case Finding::damaged_frames:
      diagnosis.text += "more than half of the measurements arrive damaged";
      diagnosis.advice = "starting anew; if it lasts, check the cable and the adapter";
      break;
    case Finding::no_frames:
      diagnosis.text += "bytes arrive that are no measurements";
      diagnosis.advice = "starting anew; if it lasts, check the baud rate and the cable";
      break;
    default:
      diagnosis.text += "it measures, but does not turn";
      diagnosis.advice = "starting anew; if it lasts, see that it can turn freely";
      break;
  }
  return diagnosis;
}

}  // namespace

Driver::Driver(DriverSettings settings, DriverListener& listener, Opener open)
    : settings_(std::move(settings)),
      listener_(listener),
      open_(open ? std::move(open) : opener_of(settings_)),
      name_(to_text(settings_.endpoint)),
      pause_(settings_.time_outs.shortest_pause) {}

void Driver::run(const Interruption& interruption) {
  try {
    while (true) {
      wait_before_next_attempt(attempt(interruption), interruption);
    }
  } catch (const Stopped&) {
    connected_ = false;
    enter(DriverState::stopped);
  }
}

Finding Driver::attempt(const Interruption& interruption) {
  Diagnosis diagnosis;
  try {
    run_connection(interruption);
    connected_ = false;
    return Finding::fine;
  } catch (const SettingsError& error) {
    // Answers have no checksum: a damaged one shall not end the run.
    if (++settings_errors_ > 1) throw;
    diagnosis = error.diagnosis();
  } catch (const DeviceError& error) {
    ++attempts_;
    diagnosis = error.diagnosis();
  } catch (const TransportError& error) {
    attempts_ = 0;
    diagnosis = rplidar::diagnosis_of(error);
  }
  recover_from(diagnosis);
  connected_ = false;
  return diagnosis.finding;
}

void Driver::run_connection(const Interruption& interruption) {
  enter(DriverState::connecting);
  attempt_begin_ = Clock::now();
  const TimeOuts& time_outs = settings_.time_outs;
  const Connection connection = find_device(open_, name_, baud_rates(), interruption, time_outs);
  known_baud_rate_ = connection.baud_rate;
  attempts_ = 0;
  Client client(connection.guard.transport(), interruption, time_outs, name_);
  DeviceHealth health = client.health();
  leave_protection_stop(client, health);
  DeviceFacts facts = ask_facts(client, name_, connection.baud_rate, connection.info);
  facts.health = health;
  const ScanPlan plan = plan_scan(facts, settings_.scan_mode, settings_.scan_frequency);
  connected_ = true;
  settings_errors_ = 0;
  ++counts_.connections;
  listener_.connected(facts, plan);
  // Ever stronger means, until there are measurements for a while: start the scan anew, connect
  // anew, reset the device and connect anew.
  while (true) {
    recover_from(scan(client, facts, plan, interruption));
    ++failures_;
    if (failures_ > 1) break;
    (void)client.stop();
  }
  if (failures_ > 2) (void)reset(client);
}

void Driver::leave_protection_stop(Client& client, DeviceHealth& health) {
  while (health.status == Health::error) {
    const Diagnosis diagnosis{
        .finding = Finding::protection_stop,
        .text = name_ + ": in protection stop, error code " + std::to_string(health.error_code),
        .advice = "it is reset a few times; see that it can turn freely, or switch it off and on"};
    ++counts_.recoveries[static_cast<std::size_t>(diagnosis.finding)];
    report(diagnosis);
    if (!reset(client)) throw DeviceError(diagnosis);
    (void)client.stop();
    health = client.health();
  }
}

bool Driver::reset(Client& client) {
  const bool rested = Clock::now() - last_reset_ > settings_.time_outs.between_resets;
  if (resets_ >= most_resets && !rested) return false;
  ++resets_;
  ++counts_.resets;
  enter(DriverState::recovering);
  client.reset();
  last_reset_ = Clock::now();
  return true;
}

Diagnosis Driver::scan(Client& client, const DeviceFacts& facts, const ScanPlan& plan,
                       const Interruption& interruption) {
  enter(DriverState::starting);
  client.hold_motor(false);
  if (plan.speed) {
    client.set_motor_speed(*plan.speed);
    wait_until(interruption, Clock::now() + 10ms);  // as the vendor's software does
  }
  try {
    const ScanMode mode = mode_of(client.start_scan(plan.mode), facts, plan.mode);
    return diagnosis_of(measure(client, facts, plan, mode), name_);
  } catch (const DeviceError& error) {
    return error.diagnosis();
  }
}

ScanMode Driver::mode_of(const Descriptor& descriptor, const DeviceFacts& facts,
                         const ScanMode& wanted) {
  const SampleFormat format = sample_format(descriptor.type).value_or(wanted.format);
  if (format == wanted.format) return wanted;
  report({.finding = Finding::other_format,
          .text = name_ + ": sends " + format_name(format) + " in scan mode " + wanted.name +
                  ", not " + format_name(wanted.format),
          .advice = "read all the same"});
  const auto other = std::ranges::find(facts.modes, format, &ScanMode::format);
  if (other != facts.modes.end() && other->sample_period > 0.0) return *other;
  ScanMode mode = wanted;
  mode.format = format;
  return mode;
}

Finding Driver::measure(Client& client, const DeviceFacts& facts, const ScanPlan& plan,
                        const ScanMode& mode) {
  const TimePoint start = Clock::now();
  SampleDecoder decoder(mode.format, mode.sample_period);
  RevolutionAssembler assembler(mode.sample_period, line_time(mode.format, facts.baud_rate));
  StreamWatch watch(settings_.time_outs, start);
  RotationWatch rotation(plan.speed, start + settings_.time_outs.spin_up);
  SampleBlock block;
  Revolution revolution;
  DecoderCounts counted;
  std::uint64_t stream_bytes = 0;
  while (true) {
    std::span<const std::uint8_t> bytes = client.read(Clock::now() + 100ms);
    const TimePoint now = Clock::now();
    stream_bytes += bytes.size();
    while (decoder.next(bytes, block)) {
      if (!assembler.add(block, now, revolution)) continue;
      watch.note_revolution(now);
      hand_over(revolution, mode);
      if (const auto measured = rotation.note(revolution)) {
        listener_.problem({.finding = Finding::wrong_rotation,
                           .text = name_ + ": turns at " + std::to_string(std::lround(*measured)) +
                                   " rev/min, not at " + std::to_string(*plan.speed),
                           .advice = "see that it can turn freely, and that its power suffices"});
      }
    }
    counts_.checksum_errors += decoder.counts().checksum_errors - counted.checksum_errors;
    counts_.skipped_bytes += decoder.counts().skipped_bytes - counted.skipped_bytes;
    counted = decoder.counts();
    if (const auto finding = watch.judge(now, counted, stream_bytes)) return *finding;
    if (watch.stable(now)) failures_ = resets_ = 0;
  }
}

void Driver::hand_over(const Revolution& revolution, const ScanMode& mode) {
  if (state_ != DriverState::measuring) {
    enter(DriverState::measuring);
    reported_.reset();
    pause_ = settings_.time_outs.shortest_pause;
  }
  ++counts_.revolutions;
  counts_.samples += revolution.angle_q16.size();
  if (revolution.gaps > 0) {
    const double time = std::chrono::duration<double>(revolution.end - revolution.begin).count();
    const double due = std::round(time / mode.sample_period);
    const auto samples = static_cast<double>(revolution.angle_q16.size());
    counts_.lost_samples += static_cast<std::uint64_t>(std::max(0.0, due - samples));
  }
  listener_.revolution(revolution, mode);
}

void Driver::wait_before_next_attempt(Finding failure, const Interruption& interruption) {
  enter(DriverState::waiting);
  const TimeOuts& time_outs = settings_.time_outs;
  const TimeOuts::Time pause = failure == Finding::busy ? time_outs.busy_pause : pause_;
  // Counted from the begin of the attempt, which takes its time where a port is there but silent.
  wait_until(interruption,
             std::max(attempt_begin_ + pause, Clock::now() + time_outs.shortest_pause));
  pause_ = std::min(2 * pause_, time_outs.longest_pause);
}

std::vector<unsigned> Driver::baud_rates() const {
  const bool serial = settings_.endpoint.kind == Endpoint::Kind::serial;
  if (serial && settings_.baud_rate != 0) return {settings_.baud_rate};
  const std::vector<unsigned> all = baud_rates_for(settings_.endpoint, known_baud_rate_);
  if (!serial || known_baud_rate_ == 0) return all;
  const int turn = attempts_ % (attempts_at_known_rate + 1);
  if (turn < attempts_at_known_rate) return {known_baud_rate_};
  const std::size_t others = all.size() - 1;
  const auto round = static_cast<std::size_t>(attempts_ / (attempts_at_known_rate + 1));
  return {all[1 + round % others]};
}

void Driver::enter(DriverState state) {
  if (state_ == state) return;
  state_ = state;
  listener_.state_changed(state);
}

void Driver::report(const Diagnosis& diagnosis) {
  if (reported_ == diagnosis.finding) return;
  reported_ = diagnosis.finding;
  listener_.problem(diagnosis);
}

void Driver::recover_from(const Diagnosis& diagnosis) {
  if (connected_) {
    enter(DriverState::recovering);
    ++counts_.recoveries[static_cast<std::size_t>(diagnosis.finding)];
  }
  report(diagnosis);
}

}  // namespace quoin::sensor_bridge::rplidar
