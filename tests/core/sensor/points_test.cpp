// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/points.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace quoin {
namespace {

void expect_accurate(const std::vector<double>& bearings) {
  Points points;
  points.resize(bearings.size());
  points.bearing = bearings;
  points.range.assign(bearings.size(), 2.0);
  compute_cartesian(points);
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const double c = std::cos(bearings[i]);
    const double s = std::sin(bearings[i]);
    ASSERT_NEAR(points.cosine[i], c, 3e-16) << bearings[i];
    ASSERT_NEAR(points.sine[i], s, 3e-16) << bearings[i];
    ASSERT_EQ(points.x[i], 2.0 * points.cosine[i]);
    ASSERT_EQ(points.y[i], 2.0 * points.sine[i]);
  }
}

TEST(ComputeCartesian, AgreesWithTheStandardLibrary) {
  std::mt19937_64 engine(5);
  for (const double limit : {0.8, 7.0, 1000.0, 1e6}) {
    std::uniform_real_distribution<double> uniform(-limit, limit);
    std::vector<double> bearings(50001);  // odd: the rest behind the last full vector counts, too
    for (double& bearing : bearings) bearing = uniform(engine);
    expect_accurate(bearings);
  }
}

TEST(ComputeCartesian, IsExactAtQuarterTurns) {
  std::vector<double> bearings{0.0, -0.0, 1e-300, 1e-9, -1e-9};
  for (int k = -40; k <= 40; ++k) bearings.push_back(k * 0.78539816339744828);
  for (const float k : {-3.14159274F, 3.14159274F, 6.28318548F, 628.318542F}) {
    bearings.push_back(static_cast<double>(k));
  }
  expect_accurate(bearings);
}

TEST(ConvertOrdered, TakesPointsAsTheyAre) {
  Points p;
  const std::vector<float> bearings{3.0F, 1.0F};
  const std::vector<float> ranges{2.0F, 4.0F};
  convert_ordered(bearings, ranges, p);
  EXPECT_THAT(p.range, testing::ElementsAre(2.0, 4.0));
  EXPECT_NEAR(p.y[1], 4.0 * std::sin(1.0), 1e-15);
}

}  // namespace
}  // namespace quoin
