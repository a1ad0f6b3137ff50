// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/device_info.hpp"

#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

// As a real S1 answered.
constexpr const char* real_s1 = "61 1C 01 12 7E 11 EA F2 C5 E1 9B CF C2 E1 9F F5 89 C3 45 09";

DeviceInfo of_model(std::uint8_t model) {
  DeviceInfo info;
  info.model = model;
  info.firmware_major = 1;
  return info;
}

TEST(DeviceInfo, ReadsARealS1) {
  const auto info = parse_info(hex(real_s1));
  ASSERT_TRUE(info.has_value());
  EXPECT_EQ(info->model, 97);
  EXPECT_EQ(info->hardware, 18);
  EXPECT_EQ(firmware_text(*info), "1.28");
  EXPECT_EQ(serial_number_text(*info), "7E11EAF2C5E19BCFC2E19FF589C34509");
  EXPECT_EQ(model_text(*info), "S1M1");
  EXPECT_EQ(to_bytes(encode(*info)), hex(real_s1));
}

TEST(DeviceInfo, RefusesShortAnswersAndReadsTheHeadOfLongOnes) {
  EXPECT_EQ(parse_info({}), std::nullopt);
  EXPECT_EQ(parse_info(Bytes(19)), std::nullopt);
  EXPECT_EQ(parse_info(hex(real_s1) + Bytes(4, 0xFF)), parse_info(hex(real_s1)));
  EXPECT_EQ(parse_health(Bytes(2)), std::nullopt);
  EXPECT_EQ(parse_health(hex("02 34 12 99")), (DeviceHealth{Health::error, 0x1234}));
  EXPECT_EQ(parse_sample_times(Bytes(3)), std::nullopt);
  EXPECT_EQ(parse_sample_times(Bytes(5)), SampleTimes{});
}

TEST(DeviceInfo, NamesTheSeries) {
  EXPECT_EQ(model_text(of_model(0x18)), "A1M8");
  EXPECT_EQ(model_text(of_model(0x31)), "A3M1");
  EXPECT_EQ(model_text(of_model(0x41)), "C1M1");
  EXPECT_EQ(model_text(of_model(0x71)), "S2M1");
  EXPECT_EQ(model_text(of_model(0x81)), "S3M1");
  EXPECT_EQ(model_text(of_model(0x91)), "T1M1");
  EXPECT_EQ(model_text(of_model(0xC0)), "M1M0");
  EXPECT_EQ(model_text(of_model(0x0F)), "unknown (0x0F)");
  EXPECT_EQ(firmware_text(of_model(0x61)), "1.00");
}

TEST(DeviceInfo, TellsWhatTheModelCanDo) {
  const ModelTraits s1 = traits_of(of_model(0x61));
  EXPECT_TRUE(s1.known);
  EXPECT_TRUE(s1.has_configuration);
  EXPECT_TRUE(s1.has_motor_speed);
  EXPECT_EQ(s1.usual_baud_rate, 256000u);

  DeviceInfo a1 = of_model(0x18);
  a1.hardware = 5;
  EXPECT_TRUE(traits_of(a1).known);
  EXPECT_FALSE(traits_of(a1).has_configuration);
  EXPECT_FALSE(traits_of(a1).has_motor_speed);
  EXPECT_EQ(traits_of(a1).usual_baud_rate, 115200u);
  a1.firmware_minor = 24;
  a1.hardware = 6;
  EXPECT_TRUE(traits_of(a1).has_configuration);
  EXPECT_EQ(traits_of(a1).usual_baud_rate, 256000u);

  EXPECT_EQ(traits_of(of_model(0x41)).usual_baud_rate, 460800u);
  EXPECT_FALSE(traits_of(of_model(0x41)).has_motor_speed);
  EXPECT_EQ(traits_of(of_model(0x71)).usual_baud_rate, 1000000u);
  EXPECT_EQ(traits_of(of_model(0x82)).usual_baud_rate, 460800u);
  EXPECT_FALSE(traits_of(of_model(0x01)).known);
}

TEST(DeviceHealth, ReadsStatusAndCode) {
  EXPECT_EQ(parse_health(hex("00 00 00")), (DeviceHealth{Health::good, 0}));
  EXPECT_EQ(parse_health(hex("02 34 12")), (DeviceHealth{Health::error, 0x1234}));
  EXPECT_EQ(parse_health(hex("04 00 00")), (DeviceHealth{Health::warning, 0, 4}));
  EXPECT_EQ(health_text({Health::warning, 16, 4}), "status 4, error code 16");
  EXPECT_EQ(to_bytes(encode(DeviceHealth{Health::warning, 0x8001})), hex("01 01 80"));
}

// An S1: 244 = F4h and 108 = 6Ch microseconds.
TEST(SampleTimes, AreThoseOfAnS1) {
  EXPECT_EQ(parse_sample_times(hex("F4 00 6C 00")), (SampleTimes{244, 108}));
  EXPECT_EQ(to_bytes(encode(SampleTimes{244, 108})), hex("F4 00 6C 00"));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
