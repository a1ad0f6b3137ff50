// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/motion.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/extraction/extraction.hpp"
#include "core/fitting/fitters.hpp"
#include "core/geometry/angle.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/scanner.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

void expect_same(const Pose2& pose, const Pose2& expected, double tolerance) {
  EXPECT_NEAR(pose.x, expected.x, tolerance);
  EXPECT_NEAR(pose.y, expected.y, tolerance);
  EXPECT_NEAR(normalized_angle(pose.theta - expected.theta), 0.0, tolerance);
}

TEST(Poses, AreComposedOfWhatIsBetweenThem) {
  const Pose2 first{1.0, -2.0, 3.0};
  const Pose2 second{0.5, 0.7, -2.9};
  expect_same(compose(first, between(first, second)), second, 1e-12);
  // A quarter turn to the left, then one metre ahead is one metre up.
  expect_same(compose(Pose2{1.0, 1.0, pi / 2}, Pose2{1.0, 0.0, 0.0}), {1.0, 2.0, pi / 2}, 1e-12);
}

TEST(Poses, HaveTheDerivativesOfCentralDifferences) {
  const Pose2 first{1.0, -2.0, 0.8};
  const Pose2 second{0.5, 0.7, -0.4};
  constexpr double step = 1e-6;
  const auto moved = [](const Pose2& pose, int component, double by) {
    return Pose2{pose.x + (component == 0 ? by : 0.0), pose.y + (component == 1 ? by : 0.0),
                 pose.theta + (component == 2 ? by : 0.0)};
  };
  const auto difference = [](const Pose2& a, const Pose2& b) {
    return Eigen::Vector3d(a.x - b.x, a.y - b.y, a.theta - b.theta);
  };
  Eigen::Matrix3d by_first, by_second;
  for (int i = 0; i < 3; ++i) {
    by_first.col(i) = difference(compose(moved(first, i, step), second),
                                 compose(moved(first, i, -step), second)) /
                      (2 * step);
    by_second.col(i) = difference(compose(first, moved(second, i, step)),
                                  compose(first, moved(second, i, -step))) /
                       (2 * step);
  }
  EXPECT_TRUE(compose_by_first(first, second).isApprox(by_first, 1e-7));
  EXPECT_TRUE(compose_by_second(first).isApprox(by_second, 1e-7));
}

TEST(Twist, FollowsAnArc) {
  // A quarter of a circle of radius 1 to the left.
  expect_same(after_twist({pi / 2, 0.0, pi / 2}, 1.0), {1.0, 1.0, pi / 2}, 1e-12);
  const Eigen::Vector3d twist(0.3, -0.2, 1.1);
  EXPECT_TRUE(twist_of(after_twist(twist, 1.0)).isApprox(twist, 1e-12));
  expect_same(after_twist({1.0, 0.0, 1e-9}, 2.0), {2.0, 0.0, 2e-9}, 1e-8);
}

TEST(OdometryTrack, InterpolatesAndNeverExtrapolates) {
  OdometryTrack track;
  EXPECT_FALSE(track.at(0.0));
  EXPECT_TRUE(track.add(1.0, {0.0, 0.0, 0.0}));
  EXPECT_TRUE(track.add(2.0, {1.0, 1.0, pi / 2}));  // the arc above
  EXPECT_FALSE(track.add(2.0, {9.0, 9.0, 0.0}));
  EXPECT_FALSE(track.at(0.999));
  EXPECT_FALSE(track.at(2.001));
  expect_same(track.at(1.0).value(), {0.0, 0.0, 0.0}, 1e-12);
  expect_same(track.at(1.5).value(), {std::sqrt(0.5), 1.0 - std::sqrt(0.5), pi / 4}, 1e-12);
  track.add(3.0, {1.0, 2.0, pi / 2});
  track.forget_before(2.5);
  EXPECT_FALSE(track.at(1.5));
  expect_same(track.at(2.5).value(), {1.0, 1.5, pi / 2}, 1e-12);
}

TEST(OdometryNoise, GivesTheCovarianceOfManySmallErrorsOfTheHeading) {
  OdometryNoise noise{0.0, 0.0, 0.05, 0.0, 0.0, 0.0};
  const Pose2 increment{2.0, 0.0, 0.0};
  const Eigen::Matrix3d covariance = noise.covariance(increment);
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), 0.1, 1e-12);
  EXPECT_NEAR(std::sqrt(covariance(1, 1)), 0.1, 1e-12);  // half the way times the heading
  EXPECT_NEAR(covariance(0, 0), 0.0, 1e-15);
}

/// A scan of the room (-2, -1.5) to (3, 2) by a sensor that moves with this twist.
struct MovingScan {
  std::vector<float> bearings, ranges, times;

  MovingScan(const Eigen::Vector3d& velocity, double period, std::uint64_t seed,
             double range_stddev) {
    World world;
    world.add_polyline({{-2.0, -1.5}, {3.0, -1.5}, {3.0, 2.0}, {-2.0, 2.0}}, true);
    Random random(seed);
    constexpr int rays = 720;
    const double start = random.uniform() * 2.0 * pi;
    for (int i = 0; i < rays; ++i) {
      const double time = period * i / rays;
      const double bearing = start + 2.0 * pi * i / rays;
      const Pose2 pose = after_twist(velocity, time);
      const double heading = pose.theta + bearing;
      const Hit hit = cast_ray(world, {pose.x, pose.y}, {std::cos(heading), std::sin(heading)});
      bearings.push_back(static_cast<float>(bearing));
      ranges.push_back(static_cast<float>(hit.distance + range_stddev * random.normal()));
      times.push_back(static_cast<float>(time));
    }
  }
};

constexpr std::array<std::array<double, 2>, 4> room_corners{
    {{-2.0, -1.5}, {3.0, -1.5}, {3.0, 2.0}, {-2.0, 2.0}}};

class MotionDuringAScan : public testing::TestWithParam<std::array<double, 4>> {};

TEST_P(MotionDuringAScan, LeavesCornersWithinTheirCovariances) {
  const auto [vx, vy, turn, period] = GetParam();
  const Eigen::Vector3d velocity(vx, vy, turn);
  const SensorModel noise{0.010, 0.0, 0.0};
  Extraction extraction{Segmenters::make<Segmenter>("iepf", {}),
                        Fitters::make<Fitter>("inverse_range", {}),
                        CornerFinders::make<CornerFinder>("adjacent", {})};
  int corners = 0, covered = 0, scans = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    MovingScan scan(velocity, period, seed, 0.010);
    deskew(velocity, scan.times, scan.bearings, scan.ranges);
    extraction.run({scan.bearings, scan.ranges, 0.1F, 40.0F}, noise, noise);
    ++scans;
    for (const Corner& corner : extraction.corners()) {
      double nearest = 1e9;
      for (const auto& [x, y] : room_corners) {
        const Eigen::Vector2d error = corner.estimate.position - Eigen::Vector2d(x, y);
        nearest = std::min(nearest, error.dot(corner.estimate.covariance.inverse() * error));
      }
      ++corners;
      covered += nearest <= chi_square_2_95 ? 1 : 0;
    }
  }
  // Against the rotation of the rays 12 of 360 degrees are not scanned, and a corner in them.
  EXPECT_GE(corners, 4 * scans - 20);
  EXPECT_LE(corners, 4 * scans);
  EXPECT_GE(covered, 0.90 * corners);  // 95 % of 200, less four standard deviations
}

INSTANTIATE_TEST_SUITE_P(Twists, MotionDuringAScan,
                         testing::Values(std::array{1.0, 0.0, 0.0, 0.1},
                                         std::array{0.0, 0.0, 1.693, 0.12},
                                         std::array{0.0, 0.0, -1.693, 0.12},
                                         std::array{1.5, -0.5, 1.0, 0.1}));

TEST(Deskewing, WithOdometryIsThatWithTheTwist) {
  const Eigen::Vector3d velocity(1.0, 0.2, 0.8);
  MovingScan by_twist(velocity, 0.1, 3, 0.0);
  MovingScan by_track(velocity, 0.1, 3, 0.0);
  OdometryTrack track;
  const Pose2 origin{4.0, 5.0, 2.0};
  for (int i = 0; i <= 4; ++i) {
    track.add(10.0 + 0.05 * i, compose(origin, after_twist(velocity, 0.05 * i)));
  }
  deskew(velocity, by_twist.times, by_twist.bearings, by_twist.ranges);
  // The twist starts at the first ray, wherever that is in the track.
  ASSERT_TRUE(deskew(track, 10.07, by_track.times, by_track.bearings, by_track.ranges));
  for (std::size_t i = 0; i < by_twist.ranges.size(); ++i) {
    ASSERT_EQ(std::isnan(by_track.ranges[i]), std::isnan(by_twist.ranges[i]));
    if (std::isnan(by_track.ranges[i])) {
      EXPECT_GT(i, 690U);  // the turn of 0.08 rad is 9 rays
    } else {
      EXPECT_NEAR(by_track.ranges[i], by_twist.ranges[i], 1e-5);
    }
  }
}

TEST(Deskewing, ChangesNothingWhereOdometryDoesNotReach) {
  MovingScan scan({1.0, 0.0, 0.0}, 0.1, 3, 0.0);
  const std::vector<float> ranges = scan.ranges;
  OdometryTrack track;
  track.add(0.0, {});
  track.add(0.05, {0.05, 0.0, 0.0});
  EXPECT_FALSE(deskew(track, 0.0, scan.times, scan.bearings, scan.ranges));
  EXPECT_EQ(scan.ranges, ranges);
}

}  // namespace
}  // namespace quoin
