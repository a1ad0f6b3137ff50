// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/emulator.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <sys/eventfd.h>
#include <system_error>
#include <utility>

#include "sensor_bridge/rplidar/emulator/garbler.hpp"
#include "sensor_bridge/rplidar/emulator/seconds.hpp"
#include "sensor_bridge/simulated/world_file.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using Clock = std::chrono::steady_clock;

// Bytes are handed over in pieces, as adapters do.
constexpr std::chrono::milliseconds shortest_pause{2};
constexpr std::chrono::milliseconds pause_between_attempts{500};

}  // namespace

std::string status_text(const EmulatorStatus& status) {
  char text[512];
  const std::string baud_rate =
      status.client_baud_rate ? ", client at " + std::to_string(*status.client_baud_rate) + " bit/s"
                              : "";
  std::snprintf(
      text, sizeof text,
      "%s, %.2f rev/s%s, %llu requests (%llu damaged), %llu frames, %llu bytes sent, %llu lost, "
      "%llu resets",
      std::string(state_name(status.state)).c_str(), status.motor_speed, baud_rate.c_str(),
      static_cast<unsigned long long>(status.counts.requests),
      static_cast<unsigned long long>(status.counts.checksum_errors),
      static_cast<unsigned long long>(status.counts.frames),
      static_cast<unsigned long long>(status.sent_bytes),
      static_cast<unsigned long long>(status.lost_bytes),
      static_cast<unsigned long long>(status.counts.resets));
  return status.endpoint + ": " + text;
}

Emulator::Emulator(const EmulatorSettings& settings, Report report,
                   const std::filesystem::path& base_directory)
    : start_(Clock::now()),
      report_(std::move(report)),
      link_(make_link(settings,
                      [this](const std::string& what) { this->report(Clock::now(), what); })),
      device_(settings, load_world(settings.environment, base_directory), start_,
              [this](TimePoint time, const std::string& what) { this->report(time, what); }),
      baud_rate_(device_.identity().baud_rate),
      wake_up_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!wake_up_) throw std::system_error(errno, std::generic_category(), "eventfd");
  if (device_.state() != DeviceState::unplugged) link_->plug_in();
}

void Emulator::run() {
  std::vector<pollfd> descriptors;
  while (!stop_) {
    std::chrono::nanoseconds wait{};
    {
      const std::lock_guard lock(mutex_);
      const TimePoint now = Clock::now();
      step(now);
      wait = std::max<std::chrono::nanoseconds>(next_step(now) - Clock::now(),
                                                std::chrono::nanoseconds::zero());
      descriptors.assign(1, {wake_up_.get(), POLLIN, 0});
      link_->watch(descriptors);
    }
    const auto whole = std::chrono::duration_cast<std::chrono::seconds>(wait);
    const timespec timeout{static_cast<std::time_t>(whole.count()),
                           static_cast<long>((wait - whole).count())};
    ::ppoll(descriptors.data(), descriptors.size(), &timeout, nullptr);
    eventfd_t count = 0;
    (void)::eventfd_read(wake_up_.get(), &count);
  }
}

void Emulator::stop() {
  stop_ = true;
  wake();
}

void Emulator::apply(const Fault& fault) {
  {
    const std::lock_guard lock(mutex_);
    device_.apply(fault, Clock::now());
  }
  wake();
}

void Emulator::clear_faults() {
  {
    const std::lock_guard lock(mutex_);
    device_.clear_faults(Clock::now());
  }
  wake();
}

EmulatorStatus Emulator::status() const {
  const std::lock_guard lock(mutex_);
  const TimePoint now = Clock::now();
  EmulatorStatus status;
  status.time = seconds_between(start_, now);
  status.state = device_.state();
  status.motor_speed = device_.motor_speed(now);
  status.endpoint = link_->endpoint();
  status.client_baud_rate = link_->baud_rate();
  status.counts = device_.counts();
  status.misread_bytes = misread_bytes_;
  status.sent_bytes = link_->sent_bytes();
  status.lost_bytes = link_->lost_bytes() + status.counts.lost_bytes;
  return status;
}

void Emulator::step(TimePoint now) {
  bytes_.clear();
  link_->read(bytes_);
  misread(bytes_, true, now);
  device_.receive(bytes_, now);
  bytes_.clear();
  device_.send(now, bytes_);
  misread(bytes_, false, now);
  plug(now);
  if (link_->plugged_in()) link_->write(bytes_, now);
}

// What becomes of the bytes when the client's baud rate is not that of the device.
void Emulator::misread(std::vector<std::uint8_t>& bytes, bool from_client, TimePoint now) {
  if (bytes.empty()) return;
  const unsigned client = link_->baud_rate().value_or(baud_rate_);
  if (client == baud_rate_) return;
  misread_bytes_ += bytes.size();
  bytes = from_client ? read_at_other_rate(bytes, client, baud_rate_)
                      : read_at_other_rate(bytes, baud_rate_, client);
  if (std::exchange(misread_baud_rate_, client) == client) return;
  report(now, "the client talks at " + std::to_string(client) + " bit/s, the device at " +
                  std::to_string(baud_rate_) + " bit/s: both get garbage");
}

void Emulator::plug(TimePoint now) {
  const bool wanted = device_.state() != DeviceState::unplugged;
  if (wanted == link_->plugged_in()) return;
  if (!wanted) {
    link_->unplug();
    report(now, "endpoint gone: " + link_->endpoint());
    return;
  }
  if (now < retry_plug_in_) return;
  try {
    link_->plug_in();
    report(now, "endpoint there: " + link_->endpoint());
  } catch (const std::exception& error) {
    retry_plug_in_ = now + pause_between_attempts;
    report(now, error.what());
  }
}

Emulator::TimePoint Emulator::next_step(TimePoint now) const {
  // Far enough that an idle device costs nothing.
  TimePoint next = now + std::chrono::minutes(1);
  if (const auto event = device_.next_event()) next = std::min(next, *event);
  if (const auto write = link_->next_write()) next = std::min(next, *write);
  if (link_->plugged_in() == (device_.state() == DeviceState::unplugged)) {
    next = std::min(next, retry_plug_in_);
  }
  return std::max(next, now + shortest_pause);
}

void Emulator::wake() const { (void)::eventfd_write(wake_up_.get(), 1); }

void Emulator::report(TimePoint now, const std::string& what) const {
  if (report_) report_(seconds_between(start_, now), what);
}

}  // namespace quoin::sensor_bridge::rplidar
