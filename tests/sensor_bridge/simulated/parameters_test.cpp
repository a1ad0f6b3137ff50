// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/parameters.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/sensor_bridge/error_of.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;

TEST(ScannerSettings, AreThoseOfTheParameters) {
  const auto parameters = make_parameters<SimulatedParameters>({{"rate_hz", "20"},
                                                                {"points", "460"},
                                                                {"field_of_view", "3"},
                                                                {"range_min", "0.2"},
                                                                {"range_max", "12"},
                                                                {"range_stddev", "0.02"},
                                                                {"bearing_stddev", "0.001"},
                                                                {"range_stddev_per_metre", "1 %"},
                                                                {"range_bias", "-0.03"},
                                                                {"dropout", "0.25"}});
  const ScannerSettings settings = scanner_settings(parameters);
  EXPECT_EQ(settings.period, 0.05);
  EXPECT_EQ(settings.points, 460U);
  EXPECT_EQ(settings.field_of_view, 3.0);
  EXPECT_EQ(settings.first_bearing, -1.5);
  EXPECT_EQ(settings.range_min, 0.2);
  EXPECT_EQ(settings.range_max, 12.0);
  EXPECT_EQ(settings.noise.range_stddev, 0.02);
  EXPECT_EQ(settings.noise.bearing_stddev, 0.001);
  EXPECT_EQ(settings.noise.range_stddev_per_metre, 0.01);
  EXPECT_EQ(settings.range_bias, -0.03);
  EXPECT_EQ(settings.dropout, 0.25);
}

TEST(ScannerSettings, DefaultsPassTheirOwnLimits) {
  const SimulatedParameters defaults;
  EXPECT_EQ(make_parameters<SimulatedParameters>(parameter_settings(defaults)).field_of_view,
            defaults.field_of_view);
}

TEST(ScannerSettings, NeverSweepMoreThanARevolution) {
  const auto parameters = make_parameters<SimulatedParameters>({{"field_of_view", "6.2832"}});
  EXPECT_EQ(scanner_settings(parameters).field_of_view, 2.0 * std::numbers::pi);
}

TEST(ScannerSettings, RefuseRangeLimitsThatExcludeEverything) {
  SimulatedParameters parameters;
  parameters.range_min = 5.0;
  parameters.range_max = 5.0;
  EXPECT_EQ(error_of<ParameterError>([&] { (void)scanner_settings(parameters); }),
            "range_min must be below range_max");
}

}  // namespace
}  // namespace quoin::sensor_bridge
