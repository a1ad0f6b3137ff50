// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/driver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>

#include "sensor_bridge/rplidar/driver/client.hpp"
#include "sensor_bridge/rplidar/driver/scan_stream.hpp"
#include "sensor_bridge/rplidar/driver/stream_watch.hpp"
#include "sensor_bridge/rplidar/protocol/frame_angles.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int most_resets = 3;  // in a row
/// Then one at another baud rate: it may be another device that does not answer.
constexpr int attempts_at_known_rate = 7;

/// Of an accessory board, as the vendor's software sets it.
constexpr std::uint16_t usual_pwm = 660;

std::string fixed(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
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
    case Finding::mixed_frames:
      diagnosis.text += "measurements arrive that cannot be of one device";
      diagnosis.advice = "starting anew; if it lasts, see that one device alone is on the line";
      break;
    default:
      diagnosis.text += "it measures, but does not turn";
      diagnosis.advice = "starting anew; if it lasts, see that it can turn freely";
      break;
  }
  return diagnosis;
}

Diagnosis impossible_rotation(double rotation, const std::string& name) {
  const std::string speed =
      rotation > 0.0 ? "turns at " + fixed(rotation, "%.2f") + " Hz, which no RPLIDAR does"
                     : "its angles and its times contradict each other";
  return {.finding = Finding::impossible_rotation,
          .text = name + ": " + speed + "; nothing of it is published",
          .advice =
              "starting anew; if it lasts, see that it turns freely, that one device alone is "
              "on the line, and that the line is fast enough for the scan mode"};
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
  Connection connection = find(interruption);
  known_baud_rate_ = connection.baud_rate;
  attempts_ = 0;
  Client client(connection.guard.transport(), interruption, time_outs, name_);
  DeviceHealth health = client.health();
  leave_protection_stop(client, health);
  DeviceFacts facts = ask_facts(client, name_, connection.baud_rate, connection.info);
  facts.health = health;
  connection.guard.driven_by(facts.motor);
  const ScanPlan plan = plan_scan(facts, settings_.scan_mode, settings_.scan_frequency);
  connected_ = true;
  settings_errors_ = 0;
  ++counts_.connections;
  listener_.connected(facts, plan);
  if (health.status == Health::warning) {
    listener_.problem(
        {.finding = Finding::health_warning,
         .text = name_ + ": warns of its health, " + health_text(health),
         .advice = "it measures all the same; clean it and see that it turns freely"});
  }
  if (plan.warning) listener_.problem(*plan.warning);
  // Ever stronger means, until there are measurements for a while: start the scan anew, connect
  // anew, reset the device and connect anew.
  while (true) {
    const Diagnosis end = scan(client, facts, plan, interruption);
    if (end.finding == Finding::fine) {
      stand_by(connection, client, facts.motor);
      continue;
    }
    recover_from(end);
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
        .text = name_ + ": in protection stop, " + health_text(health),
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
  start_motor(client, facts.motor, plan, interruption);
  try {
    const auto format = sample_format(client.start_scan(plan.mode).type);
    return measure(client, facts, plan,
                   mode_of(format.value_or(plan.mode.format), facts, plan.mode));
  } catch (const DeviceError& error) {
    return error.diagnosis();
  }
}

void Driver::stand_by(const Connection& connection, Client& client, MotorControl motor) {
  enter(DriverState::standby);
  stop_motor(connection.guard.transport(), motor);
  // An unplugged device is noticed while it is read from.
  while (!listener_.is_wanted()) (void)client.read(Clock::now() + 100ms);
}

void Driver::start_motor(Client& client, MotorControl motor, const ScanPlan& plan,
                         const Interruption& interruption) {
  client.hold_motor(false);
  if (motor == MotorControl::pwm) client.set_motor_pwm(usual_pwm);
  if (plan.speed) client.set_motor_speed(*plan.speed);
  // As the vendor's software does.
  if (motor == MotorControl::pwm || plan.speed) wait_until(interruption, Clock::now() + 10ms);
}

ScanMode Driver::mode_of(SampleFormat format, const DeviceFacts& facts, const ScanMode& wanted) {
  if (format == wanted.format) return wanted;
  report({.finding = Finding::other_format,
          .text = name_ + ": sends " + format_name(format) + " in scan mode " + wanted.name +
                  ", not " + format_name(wanted.format),
          .advice = "read all the same"});
  const auto other = std::ranges::find(facts.modes, format, &ScanMode::format);
  if (other != facts.modes.end()) return *other;
  ScanMode mode = wanted;
  mode.format = format;
  return mode;
}

void Driver::warn_of_line(const DeviceFacts& facts, const ScanMode& mode) {
  if (facts.baud_rate == 0 || mode.sample_period <= 0.0) return;
  const FrameLayout layout = layout_of(mode.format);
  const double needed = 10.0 * static_cast<double>(layout.bytes) /
                        (static_cast<double>(layout.samples) * mode.sample_period);
  if (needed <= facts.baud_rate) return;
  listener_.problem(
      {.finding = Finding::line_too_slow,
       .text = name_ + ": the line carries " + std::to_string(facts.baud_rate) +
               " bits a second, and scan mode " + mode.name + " sends " + fixed(needed, "%.0f") +
               ": measurements get lost",
       .advice = "choose a scan mode that sends less, or an adapter with a higher baud rate"});
}

Diagnosis Driver::measure(Client& client, const DeviceFacts& facts, const ScanPlan& plan,
                          const ScanMode& announced) {
  const TimePoint start = Clock::now();
  const TimePoint spun_up = start + settings_.time_outs.spin_up;
  std::optional<ScanStream> stream(std::in_place, announced, line_rate(facts), plan.mode.format);
  StreamWatch watch(settings_.time_outs, start);
  RotationWatch rotation(plan.speed, spun_up);
  DecoderCounts counted;
  std::uint64_t lost = 0;
  warn_of_line(facts, announced);
  TimePoint wanted = start;
  while (true) {
    const std::span<const std::uint8_t> bytes = client.read(Clock::now() + 100ms);
    const TimePoint now = Clock::now();
    stream->take(bytes, now, [&](const Revolution& revolution) {
      watch.note_revolution(now);
      note_revolution(revolution, stream->mode());
      if (const auto measured = rotation.note(revolution)) {
        listener_.problem({.finding = Finding::wrong_rotation,
                           .text = name_ + ": turns at " + std::to_string(std::lround(*measured)) +
                                   " rev/min, not at " + std::to_string(*plan.speed),
                           .advice = "see that it can turn freely, and that its power suffices"});
      }
    });
    if (const auto format = stream->other_format()) {
      stream.emplace(mode_of(*format, facts, stream->mode()), line_rate(facts), *format);
      watch = StreamWatch(settings_.time_outs, now);
      counted = {};
      lost = 0;
      continue;
    }
    const DecoderCounts& counts = stream->counts();
    counts_.checksum_errors += counts.checksum_errors - counted.checksum_errors;
    counts_.skipped_bytes += counts.skipped_bytes - counted.skipped_bytes;
    counts_.out_of_line += counts.out_of_line - counted.out_of_line;
    counts_.repeated += counts.repeated - counted.repeated;
    counts_.lost_samples += stream->lost_samples() - std::exchange(lost, stream->lost_samples());
    counted = counts;
    if (const auto finding = watch.judge(now, counted, stream->bytes())) {
      return diagnosis_of(*finding, name_);
    }
    const auto impossible = stream->impossible_rotation();
    if (impossible && (*impossible > fastest_rotation || now > spun_up)) {
      return impossible_rotation(*impossible, name_);
    }
    if (settings_.idle_stop.count() > 0) {
      if (listener_.is_wanted()) wanted = now;
      if (now - wanted >= settings_.idle_stop) return {};
    }
    if (watch.stable(now)) failures_ = resets_ = 0;
    counts_.sample_period = stream->measured_period().value_or(counts_.sample_period);
  }
}

void Driver::note_revolution(const Revolution& revolution, const ScanMode& mode) {
  if (state_ != DriverState::measuring) {
    enter(DriverState::measuring);
    reported_.reset();
    pause_ = settings_.time_outs.shortest_pause;
  }
  ++counts_.revolutions;
  counts_.samples += revolution.angle_q16.size();
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

/// Where nothing answers at the baud rate that is set, the others are tried for a better word.
Connection Driver::find(const Interruption& interruption) {
  const std::vector<unsigned> rates = baud_rates();
  const TimeOuts& time_outs = settings_.time_outs;
  try {
    return find_device(open_, name_, rates, interruption, time_outs);
  } catch (const DeviceError&) {
    const bool set = settings_.endpoint.kind == Endpoint::Kind::serial && settings_.baud_rate != 0;
    if (!set || attempts_ % (attempts_at_known_rate + 1) != 0) throw;
    std::vector<unsigned> others = baud_rates_for(settings_.endpoint, settings_.baud_rate);
    others.erase(others.begin());
    unsigned answers_at = 0;
    try {
      answers_at = find_device(open_, name_, others, interruption, time_outs).baud_rate;
    } catch (const DeviceError&) {
      // Then what was seen at the rate that is set says more.
    }
    if (answers_at == 0) throw;
    throw DeviceError({.finding = Finding::other_baud_rate,
                       .text = name_ + ": answers at " + std::to_string(answers_at) +
                               " baud, not at the " + std::to_string(settings_.baud_rate) +
                               " that are set",
                       .advice = "set serial_baudrate to " + std::to_string(answers_at) +
                                 ", or to 0 to have it found"});
  }
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
