// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/statistics/line_scatter.hpp"

#include <limits>

#include <gmock/gmock.h>

#include "core/simulation/random.hpp"

namespace quoin {
namespace {

/// Lines of walls whose noise is `stddevs` times what their model says, ten a second.
void add_lines(RunningScatter& running, double from, std::size_t count, double stddevs,
               std::size_t points = 30) {
  Random random(3);
  for (std::size_t k = 0; k < count; ++k) {
    double chi_square = 0.0;
    for (std::size_t i = 2; i < points; ++i) {
      const double residual = stddevs * random.normal();
      chi_square += residual * residual;
    }
    const double x = stddevs * random.normal();
    const double y = stddevs * random.normal();
    running.add(from + 0.1 * static_cast<double>(k), chi_square, points);
    running.add_split(from + 0.1 * static_cast<double>(k), x * x + y * y);
  }
}

TEST(RunningScatter, IsOneWhereTheModelIsTrue) {
  for (const std::size_t points : {4UL, 10UL, 200UL}) {
    RunningScatter running;
    add_lines(running, 0.0, 500, 1.0, points);
    const LineScatter scatter = running.scatter(50.0);
    EXPECT_EQ(scatter.lines, 500U);
    EXPECT_NEAR(scatter.reduced_chi_square.value, 1.0, points == 4 ? 0.2 : 0.1);
    EXPECT_LT(scatter.reduced_chi_square.low, scatter.reduced_chi_square.value);
    EXPECT_GT(scatter.reduced_chi_square.high, scatter.reduced_chi_square.value);
    EXPECT_NEAR(scatter.split_inside95.value, 0.95, 0.04);
    EXPECT_EQ(complaint(scatter), "") << points;
  }
}

TEST(RunningScatter, SaysHowMuchLargerOrSmallerTheNoiseIs) {
  RunningScatter running;
  add_lines(running, 0.0, 500, 1.9);
  const LineScatter scatter = running.scatter(50.0);
  EXPECT_NEAR(scatter.reduced_chi_square.value, 1.9 * 1.9, 0.2);
  EXPECT_NEAR(scatter.split_inside95.value, 0.564, 0.09);  // P(chi^2_2 < 5.99 / 1.9^2)
  EXPECT_THAT(complaint(scatter), testing::HasSubstr("1.9 times as much"));
  running.clear();
  add_lines(running, 60.0, 500, 0.5);
  EXPECT_THAT(complaint(running.scatter(110.0)), testing::HasSubstr("0.5 times as much"));
}

TEST(RunningScatter, IsNotMovedByAFewOddWalls) {
  RunningScatter running;
  add_lines(running, 0.0, 300, 1.0);
  add_lines(running, 30.0, 30, 20.0);
  EXPECT_NEAR(running.scatter(33.0).reduced_chi_square.value, 1.0, 0.15);
}

TEST(RunningScatter, ComplainsOnlyOfEnoughLines) {
  RunningScatter running;
  add_lines(running, 0.0, 99, 3.0);
  EXPECT_EQ(complaint(running.scatter(10.0)), "");
  add_lines(running, 10.0, 1, 3.0);
  EXPECT_NE(complaint(running.scatter(10.0)), "");
}

TEST(RunningScatter, ForgetsWhatIsOlderThanAMinute) {
  RunningScatter running;
  add_lines(running, 0.0, 500, 3.0);  // until 49.9 s
  EXPECT_EQ(running.scatter(100.0).lines, 100U);
  add_lines(running, 100.0, 200, 1.0);
  EXPECT_EQ(running.scatter(120.0).lines, 200U);
  EXPECT_EQ(running.scatter(120.0).split_lines, 200U);
  const LineScatter none = running.scatter(1000.0);
  EXPECT_EQ(none.lines, 0U);
  EXPECT_EQ(none.reduced_chi_square.value, 0.0);
  EXPECT_EQ(complaint(none), "");
}

TEST(RunningScatter, KeepsTheNewestOfMany) {
  RunningScatter running;
  for (std::size_t k = 0; k < RunningScatter::most_lines + 100; ++k) running.add(0.0, 28.0, 30);
  running.add(0.0, std::numeric_limits<double>::quiet_NaN(), 30);
  running.add(0.0, 1.0, 2);
  EXPECT_EQ(running.scatter(0.0).lines, RunningScatter::most_lines);
}

TEST(LineScatterText, IsReadAsItIsWritten) {
  const LineScatter scatter{4523, {3.61, 3.5, 3.75}, 600, {0.531, 0.49, 0.57}};
  const auto parsed = parse_line_scatter(to_text(scatter));
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->lines, 4523U);
  EXPECT_NEAR(parsed->reduced_chi_square.value, 3.61, 1e-9);
  EXPECT_NEAR(parsed->reduced_chi_square.high, 3.75, 1e-9);
  EXPECT_EQ(parsed->split_lines, 600U);
  EXPECT_NEAR(parsed->split_inside95.low, 0.49, 1e-9);
  EXPECT_FALSE(parse_line_scatter(""));
  EXPECT_FALSE(parse_line_scatter("3.6 of many"));
  EXPECT_FALSE(parse_line_scatter(to_text(scatter) + "x"));
}

}  // namespace
}  // namespace quoin
