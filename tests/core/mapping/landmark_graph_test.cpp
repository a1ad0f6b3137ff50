// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/landmark_graph.hpp"

#include <array>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/simulation/random.hpp"

namespace quoin {
namespace {

/// Three walls from five poses, with noise of the motion and of the lines.
struct Example {
  LandmarkGraph graph;
  std::array<Pose2, 5> truth;
  std::array<LineLandmark, 3> walls;

  explicit Example(std::uint64_t seed) {
    Random random(seed);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const auto step = static_cast<double>(i);
      truth[i] = {0.4 * step, 0.1 * step, 0.2 * step};
    }
    for (std::size_t k = 0; k < walls.size(); ++k) {
      LineMeasurement m;
      m.alpha = 1.9 * static_cast<double>(k);
      m.middle = 3.0 * Eigen::Vector2d(std::cos(m.alpha), std::sin(m.alpha));
      m.half_length = 1.0;
      walls[k] = landmark_of({}, m);
      LineLandmark guess = walls[k];
      guess.phi += 0.02 * random.normal();
      guess.offset += 0.02 * random.normal();
      graph.add_landmark(guess);
    }
    Pose2 dead_reckoned;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      PoseEstimate motion;
      if (i > 0) {
        motion.pose = between(truth[i - 1], truth[i]);
        motion.pose.x += 0.02 * random.normal();
        motion.pose.y += 0.02 * random.normal();
        motion.pose.theta += 0.02 * random.normal();
        motion.covariance = 4e-4 * Eigen::Matrix3d::Identity();
        dead_reckoned = compose(dead_reckoned, motion.pose);
      }
      graph.add_keyframe(graph.keyframes().empty() ? 0 : graph.keyframes().size() - 1,
                         dead_reckoned, motion);
      for (std::size_t k = 0; k < walls.size(); ++k) {
        LineMeasurement m;
        m.covariance = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
        m.alpha = walls[k].phi - truth[i].theta + 0.01 * random.normal();
        const Eigen::Vector2d point =
            walls[k].at(random.uniform(-0.5, 0.5)) + 0.01 * random.normal() * walls[k].normal();
        m.middle = truth[i].inverse_transform(point);
        m.half_length = 0.5;
        graph.observe(i, k, m);
      }
    }
  }
};

TEST(LandmarkGraph, HasATrueJointCovariance) {
  // Squared Mahalanobis distance of pose and walls: chi square of 9, mean 9, variance 18.
  constexpr int trials = 400;
  double sum = 0.0;
  const std::array<std::size_t, 3> all{0, 1, 2};
  for (int trial = 0; trial < trials; ++trial) {
    Example example(static_cast<std::uint64_t>(trial) + 1);
    example.graph.optimize(4);
    const Eigen::MatrixXd covariance = example.graph.marginal_after_step(4, all);
    ASSERT_EQ(covariance.rows(), 9);
    Eigen::VectorXd error(9);
    const Pose2& pose = example.graph.keyframes()[4].pose;
    error.head<3>() << pose.x - example.truth[4].x, pose.y - example.truth[4].y,
        pose.theta - example.truth[4].theta;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = static_cast<Eigen::Index>(3 + 2 * k);
      error(at) = example.graph.landmarks()[k].phi - example.walls[k].phi;
      error(at + 1) = example.graph.landmarks()[k].offset - example.walls[k].offset;
    }
    sum += error.dot(covariance.inverse() * error);
  }
  EXPECT_NEAR(sum / trials, 9.0, 4.0 * std::sqrt(18.0 / trials));
}

TEST(LandmarkGraph, BendsLittleForAWrongMatch) {
  Example right(7);
  Example wrong(7);
  LineMeasurement m = wrong.graph.keyframes()[4].observations[0].measurement;
  m.middle += 0.5 * Eigen::Vector2d(std::cos(m.alpha), std::sin(m.alpha));  // another wall
  wrong.graph.observe(4, 0, m);
  right.graph.optimize(8);
  wrong.graph.optimize(8);
  const Pose2& a = right.graph.keyframes()[4].pose;
  const Pose2& b = wrong.graph.keyframes()[4].pose;
  // 50 standard deviations off; by least squares it would move the pose by 0.1 m.
  EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 0.02);
}

TEST(LandmarkGraph, MergesAWallThatWasSeenAsTwo) {
  Example example(3);
  LineLandmark twin = example.walls[1];
  twin.low += 1.5;
  twin.high += 1.5;
  const std::size_t index = example.graph.add_landmark(twin);
  example.graph.observe(4, index, example.graph.keyframes()[4].observations[1].measurement);
  example.graph.merge(1, index);
  EXPECT_FALSE(example.graph.landmarks()[index].alive);
  EXPECT_EQ(example.graph.landmarks()[1].observations, 6U);
  EXPECT_NEAR(example.graph.landmarks()[1].length(), 3.5, 0.05);
  EXPECT_EQ(example.graph.keyframes()[4].observations.back().landmark, 1U);
}

TEST(LandmarkGraph, UndoesAWrongLoop) {
  Example example(3);
  LandmarkGraph& graph = example.graph;
  graph.optimize(8);
  const std::size_t twin = graph.add_landmark(graph.landmarks()[1]);
  graph.observe(4, twin, graph.keyframes()[4].observations[1].measurement);
  graph.optimize(8);
  const Pose2 right = graph.keyframes()[4].pose;
  PoseEstimate wrong{between(example.truth[0], example.truth[4]),
                     1e-4 * Eigen::Matrix3d::Identity()};
  wrong.pose.y += 0.5;
  graph.close_loop(0, 4, wrong);
  graph.merge(1, twin);
  graph.optimize(8);
  const Pose2 bent = graph.keyframes()[4].pose;
  EXPECT_GT(std::hypot(bent.x - right.x, bent.y - right.y), 0.01);
  EXPECT_GT(graph.chi_square(graph.edges().back()), 100.0);
  graph.drop_loop(graph.edges().size() - 1);
  graph.optimize(12);
  EXPECT_NEAR(graph.keyframes()[4].pose.x, right.x, 1e-4);
  EXPECT_NEAR(graph.keyframes()[4].pose.y, right.y, 1e-4);
  EXPECT_TRUE(graph.landmarks()[twin].alive);
  EXPECT_EQ(graph.keyframes()[4].observations.back().landmark, twin);
}

TEST(LandmarkGraph, UndoesMergesOfMergedWalls) {
  Example example(3);
  LandmarkGraph& graph = example.graph;
  const LineMeasurement m = graph.keyframes()[4].observations[1].measurement;
  LineLandmark twin = graph.landmarks()[1];
  twin.observations = 0;
  const std::size_t second = graph.add_landmark(twin);
  const std::size_t third = graph.add_landmark(twin);
  graph.observe(4, second, m);
  graph.observe(4, third, m);
  graph.close_loop(0, 4,
                   {between(example.truth[0], example.truth[4]), Eigen::Matrix3d::Identity()});
  graph.merge(second, third);
  graph.merge(1, second);
  graph.drop_loop(graph.edges().size() - 1);
  const auto& seen = graph.keyframes()[4].observations;
  EXPECT_EQ(seen[3].landmark, second);
  EXPECT_EQ(seen[4].landmark, third);
  EXPECT_EQ(graph.landmarks()[1].observations, 5U);
  EXPECT_EQ(graph.landmarks()[second].observations, 1U);
  EXPECT_EQ(graph.landmarks()[third].observations, 1U);
}

TEST(LandmarkGraph, BendsFartherForLoopsThatAreTrusted) {
  // Twenty steps of 2 mm deviation each, which end 0.3 m from where a loop of 10 mm has them.
  constexpr int steps = 20;
  constexpr double chain = steps * 0.002 * 0.002;
  constexpr double loop = 0.01 * 0.01;
  constexpr double off = 0.3;
  LandmarkGraph graph;
  graph.add_keyframe(0, {}, {});
  const PoseEstimate step{{0.5, 0.0, 0.0}, 4e-6 * Eigen::Matrix3d::Identity()};
  for (int i = 1; i <= steps; ++i) {
    graph.add_keyframe(static_cast<std::size_t>(i) - 1, {0.5 * i, 0.0, 0.0}, step);
  }
  graph.close_loop(0, steps, {{0.5 * steps + off, 0.0, 0.0}, loop * Eigen::Matrix3d::Identity()});
  graph.optimize(12);
  const double limited = graph.chi_square(graph.edges().back());
  graph.optimize(12, true);
  const double trusted = graph.chi_square(graph.edges().back());
  const double remainder = off * loop / (loop + chain);  // least squares
  EXPECT_NEAR(trusted, remainder * remainder / loop, 1.0);
  EXPECT_GT(limited, 1.5 * trusted);
}

}  // namespace
}  // namespace quoin
