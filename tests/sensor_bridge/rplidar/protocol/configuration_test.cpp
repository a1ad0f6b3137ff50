// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/configuration.hpp"

#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

TEST(Configuration, TakesTheKeyOff) {
  const Bytes payload = hex("70 00 00 00 02 00");
  const auto value = configuration_value(ConfigurationKey::mode_count, payload);
  ASSERT_TRUE(value.has_value());
  EXPECT_EQ(to_bytes(*value), hex("02 00"));
  EXPECT_FALSE(configuration_value(ConfigurationKey::typical_mode, payload).has_value());
  EXPECT_FALSE(configuration_value(ConfigurationKey::mode_count, hex("70 00 00")).has_value());
  const Bytes nothing = hex("79 00 00 00");
  ASSERT_TRUE(configuration_value(ConfigurationKey::address, nothing).has_value());
  EXPECT_TRUE(configuration_value(ConfigurationKey::address, nothing)->empty());
}

TEST(Configuration, PutsTheKeyOn) {
  EXPECT_EQ(encode_configuration(ConfigurationKey::typical_mode, hex("01 00")),
            hex("7C 00 00 00 01 00"));
  EXPECT_EQ(encode_configuration(ConfigurationKey::address, {}), hex("79 00 00 00"));
}

TEST(Configuration, ReadsNumbers) {
  EXPECT_EQ(parse_number(hex("85")), 0x85u);
  EXPECT_EQ(parse_number(hex("58 02")), 600u);
  EXPECT_EQ(parse_number(hex("00 28 00 80")), 0x80002800u);
  EXPECT_EQ(parse_number({}), std::nullopt);
  EXPECT_EQ(parse_number(hex("01 02 03")), std::nullopt);
  EXPECT_EQ(parse_number(hex("01 02 03 04 05")), std::nullopt);
}

// In 1/256 microseconds: 6C00h = 108 * 256, F400h = 244 * 256, 64000 = 250 * 256.
TEST(Configuration, ReadsSampleTimes) {
  EXPECT_DOUBLE_EQ(parse_sample_time(hex("00 6C 00 00")).value(), 108e-6);
  EXPECT_DOUBLE_EQ(parse_sample_time(hex("00 F4 00 00")).value(), 244e-6);
  EXPECT_DOUBLE_EQ(parse_sample_time(hex("00 FA 00 00")).value(), 250e-6);
  EXPECT_DOUBLE_EQ(parse_sample_time(hex("80 6C 00 00")).value(), 108.5e-6);
  EXPECT_EQ(parse_sample_time(hex("00 00 00 00")), std::nullopt);
  EXPECT_EQ(parse_sample_time(hex("00 00 00 80")), std::nullopt);
  EXPECT_EQ(parse_sample_time(hex("00 6C")), std::nullopt);
}

TEST(Configuration, ReadsTexts) {
  EXPECT_EQ(parse_text(hex("44 65 6E 73 65 42 6F 6F 73 74 00 58")), "DenseBoost");
  EXPECT_EQ(parse_text(hex("41 0A FF 7F 42")), "A???B");
  EXPECT_EQ(parse_text({}), "");
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
