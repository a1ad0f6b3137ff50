// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "tests/sensor_bridge/rplidar/protocol/revolving_sensor.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr double delay = 3.3e-3;

double error(TimePoint stamp, TimePoint truth) {
  return std::chrono::duration<double>(stamp - truth).count();
}

TEST(AcquisitionClock, GoesBackFromTheArrival) {
  RevolvingSensor sensor;
  AcquisitionClock clock(sensor.sample_period, delay);
  for (int block = 0; block < 100; ++block) {
    const std::size_t first = sensor.sent;
    const SampleBlock samples = sensor.next();
    EXPECT_NEAR(error(clock.first_sample(samples, sensor.arrival(delay)), sensor.time_of(first)),
                0.0, 1e-7);
  }
}

TEST(AcquisitionClock, DoesNotFollowLateArrivals) {
  RevolvingSensor sensor;
  AcquisitionClock clock(sensor.sample_period, delay);
  std::mt19937 random(20260422);
  std::exponential_distribution<double> lateness(1.0 / 4e-3);
  double worst = 0.0;
  for (int block = 0; block < 2000; ++block) {
    const std::size_t first = sensor.sent;
    const SampleBlock samples = sensor.next();
    const TimePoint stamp =
        clock.first_sample(samples, sensor.arrival(delay) + seconds(lateness(random)));
    if (block >= 200) worst = std::max(worst, std::abs(error(stamp, sensor.time_of(first))));
  }
  // Lateness of 4 ms in the mean; one in 40 blocks is less than 0.1 ms late, and between two such
  // the pace may rise by 40 * 4.32 ms * 300e-6 = 0.05 ms.
  EXPECT_LT(worst, 0.5e-3);
}

TEST(AcquisitionClock, FollowsAClockThatDiffers) {
  for (const double drift : {-250e-6, -50e-6, 50e-6, 250e-6}) {
    RevolvingSensor sensor;
    AcquisitionClock clock(sensor.sample_period, delay);
    sensor.sample_period *= 1.0 + drift;
    std::mt19937 random(7);
    std::exponential_distribution<double> lateness(1.0 / 0.2e-3);
    double worst = 0.0;
    for (int block = 0; block < 10000; ++block) {
      const std::size_t first = sensor.sent;
      const SampleBlock samples = sensor.next();
      const TimePoint stamp =
          clock.first_sample(samples, sensor.arrival(delay) + seconds(lateness(random)));
      if (block >= 200) worst = std::max(worst, std::abs(error(stamp, sensor.time_of(first))));
    }
    // In these 43 s the clocks come 10.8 ms apart.
    EXPECT_LT(worst, 0.3e-3) << drift;
  }
}

TEST(AcquisitionClock, BeginsAnewBehindAGap) {
  RevolvingSensor sensor;
  AcquisitionClock clock(sensor.sample_period, delay);
  const SampleBlock begin = sensor.next();
  (void)clock.first_sample(begin, sensor.arrival(delay));
  for (int lost = 0; lost < 1000; ++lost) sensor.lose_block();
  const std::size_t first = sensor.sent;
  const SampleBlock samples = sensor.next();
  EXPECT_NEAR(error(clock.first_sample(samples, sensor.arrival(delay)), sensor.time_of(first)), 0.0,
              1e-7);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
