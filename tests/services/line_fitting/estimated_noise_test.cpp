// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/line_fitting/estimated_noise.hpp"

#include <cmath>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/simulation/random.hpp"

namespace quoin {
namespace {

struct Heartbeat {
  std::map<std::string, std::string> entries;

  void set_diagnostic(const std::string& name, const std::string& value) { entries[name] = value; }
};

class EstimatedNoiseTest : public testing::Test {
 protected:
  EstimatedNoiseTest() { message_.sensor_model(topics::sensor_model_message(declared_)); }

  /// Messages of ten walls of 50 points with this noise.
  void run(int count, double stddev) {
    for (int k = 0; k < count; ++k) {
      clear_message();
      for (std::uint32_t wall = 0; wall < 10; ++wall) {
        const double distance = random_.uniform(1.0, 5.0);
        const double first = random_.uniform(-1.0, 0.6);
        for (int i = 0; i < 50; ++i) {
          const double incidence = first + 0.008 * i;
          message_.bearings().push_back(static_cast<float>(incidence));
          message_.ranges().push_back(
              static_cast<float>(distance / std::cos(incidence) + stddev * random_.normal()));
        }
        message_.segments().emplace_back();
        message_.segments().back().begin(50 * wall);
        message_.segments().back().end(50 * wall + 50);
      }
      topics::set_origin(message_.header(), "front", 1, number_++);
      convert_ordered(message_.bearings(), message_.ranges(), points_);
      model_ = noise_.model_for(message_);
      noise_.declare(message_, model_, lines_);
      noise_.add(message_, points_, heartbeat_);
    }
  }

  void clear_message() {
    message_.bearings().clear();
    message_.ranges().clear();
    message_.segments().clear();
  }

  const SensorModel declared_{0.01, 0.002, 0.03};
  Random random_{5};
  msg::Segments message_;
  msg::Lines lines_;
  std::uint64_t number_ = 0;
  Points points_;
  EstimatedNoise noise_;
  SensorModel model_;
  Heartbeat heartbeat_;
};

TEST_F(EstimatedNoiseTest, DeclaredNoiseStays) {
  run(60, 0.03);
  EXPECT_EQ(model_.range_stddev, 0.01);
  EXPECT_FALSE(lines_.sensor_model().estimated());
  EXPECT_TRUE(heartbeat_.entries.empty());
}

TEST_F(EstimatedNoiseTest, IsUsedOnceItIsKnown) {
  message_.sensor_model().estimated(true);
  run(10, 0.03);
  EXPECT_EQ(model_.range_stddev, 0.01);
  EXPECT_FALSE(lines_.sensor_model().estimated());
  run(50, 0.03);
  EXPECT_NEAR(model_.range_stddev, 0.03, 0.0015);
  EXPECT_EQ(model_.range_bias_stddev, 0.03);
  EXPECT_TRUE(lines_.sensor_model().estimated());
  EXPECT_EQ(lines_.sensor_model().range_stddev(), model_.range_stddev);
  EXPECT_THAT(heartbeat_.entries["Noise"],
              testing::MatchesRegex("range (29|30|31)[.].* mm, growing .*"));
  EXPECT_EQ(heartbeat_.entries.count("Noise Jumps"), 0U);
}

TEST_F(EstimatedNoiseTest, ReportsAJump) {
  message_.sensor_model().estimated(true);
  run(100, 0.01);
  run(40, 0.03);
  EXPECT_EQ(heartbeat_.entries["Noise Jumps"], "1, the last at scan 119");
  EXPECT_NEAR(model_.range_stddev, 0.03, 0.0015);
}

TEST_F(EstimatedNoiseTest, AnotherDeclarationBeginsAnew) {
  message_.sensor_model().estimated(true);
  run(40, 0.03);
  message_.sensor_model().range_stddev(0.005);
  run(1, 0.03);
  EXPECT_EQ(model_.range_stddev, 0.005);
}

}  // namespace
}  // namespace quoin
