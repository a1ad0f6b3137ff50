// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/emulated_device.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "sensor_bridge/rplidar/emulator/seconds.hpp"
#include "sensor_bridge/rplidar/protocol/sample_block.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::uint8_t quality_of_return = 47 << 2;
constexpr std::uint16_t error_of_protection_stop = 1;
constexpr std::uint8_t unheard_model = 0x0F;
constexpr auto unheard_format = static_cast<SampleFormat>(0x99);

EmulatorSettings checked(const EmulatorSettings& settings) {
  try {
    check_parameters(describe_parameters<EmulatorSettings>(), parameter_settings(settings));
  } catch (const ParameterError& error) {
    throw std::invalid_argument(error.parameter() + ": " + error.what());
  }
  return settings;
}

}  // namespace

std::string_view state_name(DeviceState state) {
  switch (state) {
    case DeviceState::unplugged:
      return "unplugged";
    case DeviceState::resetting:
      return "resetting";
    case DeviceState::idle:
      return "idle";
    case DeviceState::spinning_up:
      return "spinning up";
    case DeviceState::scanning:
      return "scanning";
    case DeviceState::protection_stop:
      return "protection stop";
  }
  return "unknown";
}

EmulatedDevice::EmulatedDevice(const EmulatorSettings& settings, World world, TimePoint now,
                               Report report)
    : settings_(checked(settings)),
      identity_(identity_of(settings)),
      range_finder_(std::move(world), settings, now),
      motor_(now),
      transmitter_(identity_.baud_rate),
      damage_(static_cast<std::uint64_t>(settings.seed) + 1),
      report_(std::move(report)),
      advanced_to_(now),
      reset_until_(now),
      speed_(identity_.usual_speed / 60.0) {
  for (const Fault& fault : parse_faults(settings.faults)) faults_.add(fault, now);
  change_faults(now);
}

void EmulatedDevice::receive(std::span<const std::uint8_t> bytes, TimePoint now) {
  advance(now);
  if (state_ == DeviceState::unplugged || state_ == DeviceState::resetting) return;
  while (const std::optional<Request> request = requests_.next(bytes)) {
    ++counts_.requests;
    report(now, request_text(*request));
    carry_out(*request, now);
    if (state_ == DeviceState::resetting) return;
  }
}

void EmulatedDevice::send(TimePoint now, std::vector<std::uint8_t>& out) {
  advance(now);
  transmitter_.pop(now, out);
}

std::optional<EmulatedDevice::TimePoint> EmulatedDevice::next_event() const {
  std::optional<TimePoint> next = next_change();
  const auto consider = [&](TimePoint time) {
    if (!next || time < *next) next = time;
  };
  if (const std::optional<TimePoint> sent = transmitter_.next()) {
    consider(*sent);
  } else if (encoder_) {
    const FrameLayout layout = layout_of(identity_.modes[mode_].format);
    const double on_line =
        10.0 * static_cast<double>(layout.bytes) / static_cast<double>(identity_.baud_rate);
    consider(sample_time(samples_ - frame_.size() + samples_for_frame() - 1) +
             duration_of(on_line));
  }
  return next;
}

void EmulatedDevice::apply(const Fault& fault, TimePoint now) {
  advance(now);
  faults_.add(fault, now);
  change_faults(now);
}

void EmulatedDevice::clear_faults(TimePoint now) {
  advance(now);
  faults_.clear();
  resets_to_go_ = std::min<std::int64_t>(resets_to_go_, 1);
  change_faults(now);
}

DeviceCounts EmulatedDevice::counts() const {
  DeviceCounts counts = counts_;
  counts.checksum_errors = requests_.checksum_errors();
  counts.lost_bytes = transmitter_.lost_bytes();
  return counts;
}

EmulatedDevice::TimePoint EmulatedDevice::sample_time(std::uint64_t index) const {
  const double period = identity_.modes[mode_].sample_period * (1.0 + settings_.clock_error);
  return first_sample_ + duration_of(period * static_cast<double>(index));
}

void EmulatedDevice::advance(TimePoint now) {
  for (std::optional<TimePoint> next = next_change(); next && *next <= now; next = next_change()) {
    sample_until(*next);
    advanced_to_ = *next;
    change(*next);
  }
  sample_until(now);
  advanced_to_ = std::max(advanced_to_, now);
}

// Changes at advanced_to_ have been made, but for those that come from the state itself.
std::optional<EmulatedDevice::TimePoint> EmulatedDevice::next_change() const {
  std::optional<TimePoint> next = faults_.next_change(advanced_to_);
  std::optional<TimePoint> own;
  if (state_ == DeviceState::resetting) own = reset_until_;
  if (state_ == DeviceState::spinning_up && motor_.target() > 0.0) own = motor_.stable_at();
  if (own && (!next || *own < *next)) next = own;
  return next;
}

void EmulatedDevice::change(TimePoint now) {
  if (state_ == DeviceState::resetting && now >= reset_until_) {
    const FaultSchedule::Entry* error = faults_.find(FaultKind::health_error, now);
    const bool lasts = resets_to_go_ > 0 || (error != nullptr && error->end);
    if (!lasts) faults_.end(FaultKind::health_error, now);
    enter(lasts ? DeviceState::protection_stop : DeviceState::idle, now);
  }
  if (state_ == DeviceState::spinning_up && motor_.target() > 0.0 && now >= motor_.stable_at()) {
    begin_samples(now);
  }
  change_faults(now);
}

void EmulatedDevice::change_faults(TimePoint now) {
  for (const Fault& fault : faults_.take_begun(now)) {
    report(now, "fault begins: " + fault_text(fault));
    if (fault.kind != FaultKind::health_error) continue;
    stop_scan(now);
    resets_to_go_ = std::llround(fault.value);
    if (state_ == DeviceState::idle) enter(DeviceState::protection_stop, now);
  }
  for (const Fault& fault : faults_.take_ended(now)) {
    report(now, "fault ends: " + fault_text(fault));
  }
  const bool unplugged = misbehaves(FaultKind::unplug, now);
  if (unplugged && state_ != DeviceState::unplugged) {
    stop_scan(now);
    transmitter_.clear();
    enter(DeviceState::unplugged, now);
  } else if (!unplugged && state_ == DeviceState::unplugged) {
    reset(now);
  }
  drive_motor(now);
}

void EmulatedDevice::carry_out(const Request& request, TimePoint now) {
  const std::span<const std::uint8_t> payload = request.payload();
  switch (request.command()) {
    case Command::motor_speed:  // needs no answer, so measuring may go on
      return set_speed(payload, now);
    case Command::motor_pwm:
      return set_pwm(payload, now);
    case Command::confirm_baud_rate:
      return;
    default:
      break;
  }
  // All other requests end the scan under way.
  stop_scan(now);
  switch (request.command()) {
    case Command::reset:
      return reset(now);
    case Command::scan:
      return start_scan(0, true, now);
    case Command::force_scan:
      return start_scan(0, false, now);
    case Command::express_scan:
      // Mode 0 asks for the express format of old devices, in place of which newer ones send dense.
      if (payload.size() == 5) start_scan(payload[0] == 0 ? 1 : payload[0], true, now);
      return;
    case Command::hq_scan:
      return start_scan(3, true, now);
    case Command::info: {
      DeviceInfo info = identity_.info;
      if (misbehaves(FaultKind::unknown_model, now)) info.model = unheard_model;
      return answer(AnswerType::info, encode(info), now);
    }
    case Command::health: {
      DeviceHealth health;
      if (const auto code = faults_.value(FaultKind::health_warning, now)) {
        health = {Health::warning, static_cast<std::uint16_t>(*code)};
      }
      if (state_ == DeviceState::protection_stop) {
        health = {Health::error, error_of_protection_stop};
      }
      return answer(AnswerType::health, encode(health), now);
    }
    case Command::sample_rate: {
      if (!identity_.knows_since(1, 17)) return;
      const bool zero = misbehaves(FaultKind::zero_sample_time, now);
      const auto microseconds = [&](std::size_t mode) {
        const double time = zero ? 0.0 : identity_.modes[mode].sample_period * 1e6;
        return static_cast<std::uint16_t>(std::lround(time));
      };
      return answer(AnswerType::sample_rate,
                    encode(SampleTimes{microseconds(0), microseconds(identity_.typical_mode)}),
                    now);
    }
    case Command::get_configuration: {
      if (identity_.info.model < 0x40 && !identity_.knows_since(1, 24)) return;
      DeviceIdentity identity = identity_;
      if (misbehaves(FaultKind::zero_sample_time, now)) {
        for (ScanMode& mode : identity.modes) mode.sample_period = 0.0;
      }
      if (misbehaves(FaultKind::unknown_format, now)) {
        for (ScanMode& mode : identity.modes) mode.format = unheard_format;
      }
      if (const auto reply = configuration_answer(identity, payload)) {
        answer(AnswerType::configuration, *reply, now);
      }
      return;
    }
    case Command::set_configuration:
      if (const auto reply = set_configuration_answer(identity_, payload)) {
        answer(AnswerType::set_configuration, *reply, now);
      }
      return;
    case Command::accessory_board: {
      const bool has_pwm = identity_.motor == MotorControl::pwm;
      const std::uint8_t flags[4] = {static_cast<std::uint8_t>(has_pwm ? 1 : 0)};
      return answer(AnswerType::accessory_board, flags, now);
    }
    default:
      return;
  }
}

void EmulatedDevice::answer(AnswerType type, std::span<const std::uint8_t> payload, TimePoint now) {
  std::vector<std::uint8_t> bytes(payload.begin(), payload.end());
  if (misbehaves(FaultKind::long_answers, now)) {
    if (type == AnswerType::info) bytes.resize(bytes.size() + 4);
    if (type == AnswerType::health) bytes.resize(bytes.size() + 1);
    const bool format = type == AnswerType::configuration && bytes.size() == 5 && bytes[0] == 0x75;
    if (format) bytes.resize(bytes.size() + 2);
  }
  if (const auto pause = faults_.value(FaultKind::slow_answers, now)) {
    now += duration_of(*pause);
  }
  announce(static_cast<std::uint32_t>(bytes.size()), false, static_cast<std::uint8_t>(type), now);
  transmit(bytes, now);
}

void EmulatedDevice::start_scan(std::size_t mode, bool wait_for_speed, TimePoint now) {
  if (state_ != DeviceState::idle || mode >= identity_.modes.size()) return;
  mode_ = mode;
  const SampleFormat format = identity_.modes[mode].format;
  SampleFormat announced = format;
  if (misbehaves(FaultKind::unknown_format, now)) announced = unheard_format;
  if (misbehaves(FaultKind::wrong_format, now)) announced = SampleFormat::standard;
  announce(
      static_cast<std::uint32_t>(layout_of(announced == unheard_format ? format : announced).bytes),
      true, static_cast<std::uint8_t>(announced), now);
  enter(DeviceState::spinning_up, now);
  if (motor_.target() > 0.0 && (!wait_for_speed || motor_.stable_at() <= now)) begin_samples(now);
}

void EmulatedDevice::stop_scan(TimePoint now) {
  encoder_.reset();
  frame_.clear();
  if (state_ == DeviceState::scanning || state_ == DeviceState::spinning_up) {
    enter(DeviceState::idle, now);
  }
}

void EmulatedDevice::set_pwm(std::span<const std::uint8_t> payload, TimePoint now) {
  if (payload.size() != 2 || identity_.motor != MotorControl::pwm) return;
  pwm_ = payload[0] | static_cast<unsigned>(payload[1]) << 8U;
  drive_motor(now);
}

void EmulatedDevice::set_speed(std::span<const std::uint8_t> payload, TimePoint now) {
  if (payload.size() != 2 || identity_.motor != MotorControl::speed) return;
  const unsigned speed = payload[0] | static_cast<unsigned>(payload[1]) << 8U;
  if (speed == 0) {
    stop_scan(now);
    return;
  }
  speed_ = std::clamp<unsigned>(speed, identity_.slowest_speed, identity_.fastest_speed) / 60.0;
  drive_motor(now);
}

void EmulatedDevice::reset(TimePoint now) {
  transmitter_.clear();
  requests_ = RequestScanner();
  speed_ = identity_.usual_speed / 60.0;
  pwm_ = 0;
  resets_to_go_ = std::max<std::int64_t>(resets_to_go_ - 1, 0);
  ++counts_.resets;
  reset_until_ = now + duration_of(settings_.reset_time);
  enter(DeviceState::resetting, now);
}

void EmulatedDevice::enter(DeviceState state, TimePoint now) {
  if (state != state_) report(now, "state: " + std::string(state_name(state)));
  state_ = state;
  drive_motor(now);
}

void EmulatedDevice::drive_motor(TimePoint now) {
  // A motor on an accessory board turns with its PWM, whether the device measures or not.
  const bool runs = identity_.motor == MotorControl::pwm
                        ? pwm_ > 0 && state_ != DeviceState::unplugged
                        : state_ == DeviceState::scanning || state_ == DeviceState::spinning_up;
  const double speed = runs ? faults_.value(FaultKind::speed, now).value_or(speed_) : 0.0;
  const double ramp =
      faults_.value(FaultKind::slow_spin_up, now).value_or(settings_.spin_up_time);  // to 10 Hz
  const double acceleration = ramp > 0.0 ? 10.0 / ramp : std::numeric_limits<double>::infinity();
  motor_.turn_at(speed, acceleration, now);
}

void EmulatedDevice::begin_samples(TimePoint now) {
  encoder_.emplace(identity_.modes[mode_].format);
  second_encoder_.reset();
  frame_.clear();
  late_frame_.clear();
  samples_ = 0;
  first_sample_ = now;
  enter(DeviceState::scanning, now);
  if (identity_.modes[mode_].format != SampleFormat::standard) return;
  constexpr std::uint8_t first_node[] = {0x02, 0x8F, 0x63, 0x00, 0x00};  // of a real A1
  transmit(first_node, now);
}

// Ultra capsules wait for the sample behind them, on which they lean.
std::size_t EmulatedDevice::samples_for_frame() const {
  const SampleFormat format = identity_.modes[mode_].format;
  return layout_of(format).samples + (format == SampleFormat::ultra ? 1 : 0);
}

void EmulatedDevice::sample_until(TimePoint now) {
  if (!encoder_) return;
  const std::size_t frame_size = samples_for_frame();
  for (TimePoint time = sample_time(samples_); time <= now; time = sample_time(samples_)) {
    const double turns = motor_.turns(time);
    const double fraction = turns - std::floor(turns);
    Sample sample;
    sample.angle_q16 =
        static_cast<std::uint32_t>(std::llround(fraction * full_circle_q16)) % full_circle_q16;
    sample.distance_q2 =
        range_finder_.measure(direction_of_ray(2.0 * std::numbers::pi * fraction, time), time);
    sample.quality = sample.distance_q2 != 0 ? quality_of_return : 0;
    frame_.push_back(sample);
    ++samples_;
    if (frame_.size() == frame_size) send_frame(time);
  }
}

// Readers of ultra capsules take it that the optics look from 24 mm beside the axis, so that near
// things are seen at another angle than that of the motor.
double EmulatedDevice::direction_of_ray(double angle, TimePoint time) const {
  if (identity_.modes[mode_].format != SampleFormat::ultra) return angle;
  constexpr double offset = 0.02401;  // [m]
  double direction = angle;
  for (int i = 0; i < 3; ++i) {
    direction = angle + std::asin(std::min(1.0, offset / range_finder_.distance(direction, time)));
  }
  return direction;
}

void EmulatedDevice::send_frame(TimePoint now) {
  bytes_.clear();
  const TimePoint begin = sample_time(samples_ - frame_.size());
  encoder_->encode(
      frame_,
      static_cast<std::uint64_t>(
          std::chrono::duration_cast<std::chrono::microseconds>(begin - first_sample_).count()),
      bytes_);
  const auto frame_end = frame_.begin() + static_cast<std::ptrdiff_t>(
                                              layout_of(identity_.modes[mode_].format).samples);
  second_frame_.assign(frame_.begin(), frame_end);
  frame_.erase(frame_.begin(), frame_end);
  ++counts_.frames;
  const std::optional<double> share = faults_.value(FaultKind::wrong_checksums, now);
  if (share && damage_.uniform() < *share) {
    if (identity_.modes[mode_].format == SampleFormat::standard) {
      bytes_[1] &= 0xFE;  // has a check bit in place of a checksum
    } else {
      bytes_[2 + damage_.index(bytes_.size() - 2)] ^=
          static_cast<std::uint8_t>(1U << damage_.index(8));
    }
  }
  send_with_losses(now);
}

void EmulatedDevice::send_with_losses(TimePoint now) {
  const auto happens = [&](FaultKind kind) {
    const std::optional<double> share = faults_.value(kind, now);
    return share && damage_.uniform() < *share;
  };
  if (happens(FaultKind::lost_frames)) {
    ++counts_.faulty_frames;
    return;
  }
  if (late_frame_.empty() && happens(FaultKind::swapped_frames)) {
    ++counts_.faulty_frames;
    late_frame_ = bytes_;
    return;
  }
  transmit(bytes_, now);
  if (happens(FaultKind::repeated_frames)) {
    ++counts_.faulty_frames;
    transmit(bytes_, now);
  }
  if (!late_frame_.empty()) transmit(std::exchange(late_frame_, {}), now);
  if (!misbehaves(FaultKind::second_device, now)) return;
  // The other one stands elsewhere and turns the same way, a third of a circle ahead.
  std::vector<Sample> samples = second_frame_;
  for (Sample& sample : samples) {
    sample.angle_q16 = (sample.angle_q16 + full_circle_q16 / 3) % full_circle_q16;
    sample.distance_q2 += 2000;
  }
  if (samples.empty()) return;
  if (!second_encoder_) second_encoder_.emplace(identity_.modes[mode_].format);
  bytes_.clear();
  second_encoder_->encode(samples, 0, bytes_);
  transmit(bytes_, now);
}

void EmulatedDevice::announce(std::uint32_t length, bool repeated, std::uint8_t type,
                              TimePoint now) {
  if (misbehaves(FaultKind::wrong_length, now)) length += 3;
  auto bytes = encode(Descriptor{length, repeated, type});
  // The upper bits of the length of a scan descriptor.
  if (repeated && misbehaves(FaultKind::long_answers, now)) bytes[5] |= 0x80;
  transmit(bytes, now);
}

void EmulatedDevice::transmit(std::span<const std::uint8_t> bytes, TimePoint now) {
  if (misbehaves(FaultKind::silence, now)) return;
  const std::optional<double> drop = faults_.value(FaultKind::dropped_bytes, now);
  const std::optional<double> flip = faults_.value(FaultKind::flipped_bits, now);
  const bool garbage = misbehaves(FaultKind::garbage, now);
  if (!drop && !flip && !garbage) return transmitter_.push(bytes, now);
  std::vector<std::uint8_t> damaged(bytes.begin(), bytes.end());
  if (drop) std::erase_if(damaged, [&](std::uint8_t) { return damage_.uniform() < *drop; });
  for (std::size_t bit = 0; flip && bit < 8 * damaged.size(); ++bit) {
    if (damage_.uniform() < *flip) damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
  }
  if (garbage) garbler_.garble(damaged);
  transmitter_.push(damaged, now);
}

}  // namespace quoin::sensor_bridge::rplidar
