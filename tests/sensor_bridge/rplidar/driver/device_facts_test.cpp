// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/device_facts.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/driver/driver_run.hpp"
#include "tests/sensor_bridge/rplidar/driver/scripted_transport.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Answers of an S1 to questions about its configuration, by key and mode.
class FactsTest : public ::testing::Test {
 protected:
  using Key = ConfigurationKey;

  FactsTest() {
    time_outs_.answer = 20ms;
    values_[{Key::mode_count, 0}] = {2, 0};
    values_[{Key::typical_mode, 0}] = {1, 0};
    values_[{Key::mode_format, 0}] = {0x81};
    values_[{Key::mode_format, 1}] = {0x85};
    values_[{Key::mode_range, 0}] = {0, 40, 0, 0};
    values_[{Key::mode_range, 1}] = {0, 40, 0, 0};
    values_[{Key::mode_sample_time, 0}] = {0, 244, 0, 0};
    values_[{Key::mode_sample_time, 1}] = {0, 108, 0, 0};
    values_[{Key::mode_name, 0}] = {'S', 'l', 'o', 'w', 0};
    values_[{Key::mode_name, 1}] = {'F', 'a', 's', 't', 0};
    values_[{Key::desired_speed, 0}] = {0x58, 2, 0, 0};
    values_[{Key::smallest_speed, 0}] = {0xE0, 1};
    values_[{Key::largest_speed, 0}] = {0x84, 3};
    script_.answer = [this](const Request& request) { return answer_to(request); };
  }

  Bytes answer_to(const Request& request) const {
    if (request.command() == Command::sample_rate) {
      return answer(AnswerType::sample_rate, encode(SampleTimes{508, 254}));
    }
    const auto payload = request.payload();
    if (request.command() != Command::get_configuration || payload.size() < 4) return {};
    const auto key = static_cast<Key>(payload[0]);
    const int mode = payload.size() >= 6 ? payload[4] : 0;
    const auto value = values_.find({key, mode});
    return value == values_.end() ? Bytes() : configuration_answer(key, value->second);
  }

  DeviceFacts ask(const DeviceInfo& info = s1_info()) {
    ScriptedTransport transport(script_);
    const Interruption interruption = uninterrupted();
    Client client(transport, interruption, time_outs_, "/dev/lidar");
    return ask_facts(client, "/dev/lidar", 256000, info);
  }

  TimeOuts time_outs_ = short_time_outs();
  Script script_;
  std::map<std::pair<Key, int>, Bytes> values_;
};

TEST_F(FactsTest, AreWhatTheDeviceSays) {
  const DeviceFacts facts = ask();
  ASSERT_THAT(facts.modes, SizeIs(2));
  EXPECT_EQ(facts.modes[1].name, "Fast");
  EXPECT_DOUBLE_EQ(facts.modes[1].sample_period, 108e-6);
  EXPECT_DOUBLE_EQ(facts.modes[1].range_max, 40.0);
  EXPECT_EQ(facts.modes[1].format, SampleFormat::dense);
  EXPECT_EQ(facts.speed, (SpeedRange{480, 600, 900}));
  EXPECT_EQ(plan_scan(facts, "", 0.0).mode.name, "Fast");
  EXPECT_EQ(plan_scan(facts, "", 0.0).speed, 600);
}

TEST_F(FactsTest, ALineIsInsideOfANetworkKitToo) {
  DeviceFacts facts = ask();
  EXPECT_EQ(line_rate(facts), 256000.0);
  facts.baud_rate = 115200;
  EXPECT_EQ(line_rate(facts), 115200.0);
  facts.baud_rate = 0;  // over TCP and UDP
  EXPECT_EQ(line_rate(facts), 256000.0);
}

TEST_F(FactsTest, ModesHaveANameInAnyCase) {
  EXPECT_EQ(plan_scan(ask(), "sLOW", 12.5).mode.id, 0);
  EXPECT_EQ(plan_scan(ask(), "sLOW", 12.5).speed, 750);
}

TEST_F(FactsTest, ModesOfUnknownFormatsAreLeftOut) {
  values_[{Key::mode_format, 0}] = {0x99};
  values_[{Key::mode_name, 1}] = {0};
  const DeviceFacts facts = ask();
  ASSERT_THAT(facts.modes, SizeIs(1));
  EXPECT_EQ(facts.modes[0].name, "mode 1");
}

TEST_F(FactsTest, SilenceAboutTheMotorIsNoFault) {
  values_.erase({Key::smallest_speed, 0});
  const DeviceFacts facts = ask();
  EXPECT_FALSE(facts.speed);
  EXPECT_EQ(plan_scan(facts, "", 0.0).speed, 600);
  EXPECT_EQ(plan_scan(facts, "", 20.0).speed, 1200);
}

TEST_F(FactsTest, ValuesThatCannotBeAreRefused) {
  values_[{Key::mode_sample_time, 1}] = {0, 0, 0, 0};
  EXPECT_EQ(plan_scan(ask(), "fast", 0.0).mode.sample_period, 0.0);  // is measured
  values_[{Key::mode_sample_time, 1}] = {0, 108, 0, 0};
  values_[{Key::mode_range, 1}] = {0, 0, 0, 0};
  EXPECT_EQ(thrown_diagnosis([&] { (void)plan_scan(ask(), "fast", 0.0); }).finding,
            Finding::wrong_value);
  values_[{Key::mode_count, 0}] = {0, 0};
  EXPECT_EQ(thrown_diagnosis([&] { (void)ask(); }).finding, Finding::wrong_value);
  values_[{Key::mode_count, 0}] = {0xFF, 0xFF};
  EXPECT_EQ(thrown_diagnosis([&] { (void)ask(); }).finding, Finding::wrong_value);
  values_[{Key::mode_count, 0}] = {};
  EXPECT_EQ(thrown_diagnosis([&] { (void)ask(); }).finding, Finding::wrong_value);
}

TEST_F(FactsTest, SettingsBeyondTheDeviceAreRefused) {
  const DeviceFacts facts = ask();
  EXPECT_THROW((void)plan_scan(facts, "Faster", 0.0), SettingsError);
  EXPECT_THROW((void)plan_scan(facts, "", 7.9), SettingsError);
  EXPECT_THROW((void)plan_scan(facts, "", 15.1), SettingsError);
  EXPECT_EQ(plan_scan(facts, "", 8.0).speed, 480);
}

TEST_F(FactsTest, DevicesWithoutAConfigurationTellTheirSampleTimes) {
  const DeviceFacts facts = ask(a1_info());
  ASSERT_THAT(facts.modes, SizeIs(2));
  EXPECT_DOUBLE_EQ(facts.modes[0].sample_period, 508e-6);
  EXPECT_EQ(plan_scan(facts, "", 0.0).mode.format, SampleFormat::express);
  EXPECT_EQ(plan_scan(facts, "standard", 0.0).mode.format, SampleFormat::standard);
  EXPECT_FALSE(plan_scan(facts, "", 0.0).speed);
  const ScanPlan plan = plan_scan(facts, "", 10.0);
  ASSERT_TRUE(plan.warning);
  EXPECT_THAT(plan.warning->text, HasSubstr("the speed of A1M8 cannot be set"));
}

TEST_F(FactsTest, OldFirmwareDoesNotKnowItsSampleTimes) {
  DeviceInfo info = a1_info();
  info.firmware_minor = 15;
  script_.answer = [](const Request&) { return Bytes(); };
  const DeviceFacts facts = ask(info);
  ASSERT_THAT(facts.modes, SizeIs(1));
  EXPECT_DOUBLE_EQ(facts.modes[0].sample_period, 476e-6);
  EXPECT_EQ(facts.motor, MotorControl::line);
  info.firmware_minor = 17;
  EXPECT_EQ(thrown_diagnosis([&] { (void)ask(info); }).finding, Finding::no_bytes);
}

TEST_F(FactsTest, ReadsTheHeadOfALongFormat) {
  values_[{Key::mode_format, 1}] = {0x85, 0, 0};
  EXPECT_EQ(ask().modes.at(1).format, SampleFormat::dense);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
