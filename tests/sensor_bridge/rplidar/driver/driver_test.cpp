// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/driver.hpp"

#include <atomic>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/rplidar/protocol/sample_encoder.hpp"
#include "tests/sensor_bridge/rplidar/driver/driver_run.hpp"
#include "tests/sensor_bridge/rplidar/driver/scripted_transport.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

/// An A1: no configuration, no speed command; scans in the format that the test wants.
class ScriptedA1 {
 public:
  explicit ScriptedA1(SampleFormat format) : format_(format), encoder_(format) {
    script_.answer = [this](const Request& request) { return answer_to(request); };
    script_.stream = [this] { return scanning_ ? frame() : Bytes(); };
  }

  [[nodiscard]] Opener opener() {
    return [this](unsigned) { return std::make_unique<ScriptedTransport>(script_); };
  }
  [[nodiscard]] const Script& script() const { return script_; }

 private:
  Bytes answer_to(const Request& request) {
    scanning_ = false;
    switch (request.command()) {
      case Command::info:
        return info_answer(a1_info());
      case Command::health:
        return health_answer(Health::good);
      case Command::sample_rate:
        return answer(AnswerType::sample_rate, encode(SampleTimes{508, 254}));
      case Command::scan:
      case Command::express_scan: {
        scanning_ = true;
        const auto head = encode(Descriptor{static_cast<std::uint32_t>(layout_of(format_).bytes),
                                            true, static_cast<std::uint8_t>(format_)});
        return {head.begin(), head.end()};
      }
      default:
        return {};
    }
  }

  Bytes frame() {
    // About as fast as the device: a test shall not be busy with decoding.
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    Bytes bytes;
    std::vector<Sample> samples(layout_of(format_).samples);
    for (Sample& sample : samples) {
      sample = {.angle_q16 = angle_, .distance_q2 = 8000, .quality = 188};
      angle_ = (angle_ + (1u << 16)) % full_circle_q16;
    }
    encoder_.encode(samples, 0, bytes);
    return bytes;
  }

  SampleFormat format_;
  SampleEncoder encoder_;
  Script script_;
  bool scanning_ = false;
  std::uint32_t angle_ = 0;
};

DriverSettings a1_settings() {
  DriverSettings settings;
  settings.endpoint = parse_endpoint("/dev/lidar");
  settings.baud_rate = 115200;
  settings.time_outs = short_time_outs();
  settings.time_outs.revolution = std::chrono::seconds(5);
  return settings;
}

TEST(DriverOfAnA1, LetsTheMotorRunByItsLine) {
  ScriptedA1 device(SampleFormat::express);
  DriverRun driver(a1_settings(), device.opener());
  ASSERT_TRUE(driver.wait_for_revolutions(1));
  driver.stop();
  EXPECT_THAT(driver.record().problems, ElementsAre());
  EXPECT_THAT(device.script().commands, Contains(Command::express_scan));
  EXPECT_EQ(device.script().motor_held, true);
  EXPECT_EQ(driver.record().last_revolution.angle_q16.size(), 360u);
}

TEST(DriverOfAnA1, ReadsTheFormatThatArrives) {
  ScriptedA1 device(SampleFormat::dense);
  DriverRun driver(a1_settings(), device.opener());
  ASSERT_TRUE(driver.wait_for_revolutions(1));
  driver.stop();
  EXPECT_TRUE(driver.record().has_problem(Finding::other_format));
  EXPECT_EQ(driver.record().mode->format, SampleFormat::dense);
  EXPECT_DOUBLE_EQ(driver.record().mode->sample_period, 254e-6);
  EXPECT_EQ(driver.record().last_revolution.distance_q2.front(), 8000u);
}

/// Cannot bear what it is told.
class Thrower : public DriverListener {
 public:
  void connected(const DeviceFacts&, const ScanPlan&) override {}
  void revolution(const Revolution&, const ScanMode&) override { throw std::runtime_error("full"); }
  void problem(const Diagnosis&) override {}
};

TEST(DriverOfAnA1, StopsTheMotorWhenItsListenerThrows) {
  ScriptedA1 device(SampleFormat::express);
  Thrower listener;
  Driver driver(a1_settings(), listener, device.opener());
  EXPECT_THROW(driver.run(uninterrupted()), std::runtime_error);
  EXPECT_EQ(device.script().motor_held, true);
  EXPECT_EQ(device.script().commands.back(), Command::stop);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
