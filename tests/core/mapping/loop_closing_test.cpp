// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/loop_closing.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"
#include "core/mapping/state_archive.hpp"

namespace quoin {
namespace {

/// A sensor that drives round a block of walls, 8 m to a side, by odometry that drifts.
class Round {
 public:
  /// Adds the next keyframe, with the points that it sees from where it truly is.
  void add_keyframe() {
    const std::size_t count = graph.keyframes().size();
    if (count == 0) {
      graph.add_keyframe(0, {}, {});
    } else {
      const Pose2 before = truth();
      ++steps_;
      PoseEstimate motion{between(before, truth()), Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal()};
      motion.pose.y += 0.005;
      motion.pose.theta += 0.001;
      graph.add_keyframe(count - 1, compose(graph.keyframes().back().pose, motion.pose), motion);
    }
    std::vector<SurfacePoint>& cloud = clouds.emplace_back();
    for (int side = 0; side < 4; ++side) {
      const double turn = 0.5 * pi * side;
      const Eigen::Vector2d normal(std::cos(turn), std::sin(turn));
      const Eigen::Vector2d along(-normal.y(), normal.x());
      // Walls of different lengths: no two corners look alike.
      for (double s = -3.0 + 0.4 * side; s < 4.0; s += 0.1) {
        const Eigen::Vector2d point = truth().inverse_transform(4.0 * normal + s * along);
        const Eigen::Vector2d towards = Pose2{0.0, 0.0, -truth().theta}.transform(-normal);
        cloud.push_back({point.cast<float>(), towards.cast<float>()});
      }
    }
  }
  [[nodiscard]] Pose2 truth() const {
    const double angle = 2.0 * pi * steps_ / 40.0;
    const Pose2 centered{2.0 * std::sin(angle), -2.0 * std::cos(angle), angle};
    return centered;
  }
  /// How far the last keyframe is off where the first one sees it.
  [[nodiscard]] double error() const {
    const Pose2 start{0.0, -2.0, 0.0};
    const Pose2 right = between(start, truth());
    const Pose2& pose = graph.keyframes().back().pose;
    return std::hypot(pose.x - right.x, pose.y - right.y);
  }

  LandmarkGraph graph;
  KeyframePoints clouds;

 private:
  int steps_ = 0;
};

TEST(LoopClosing, ClosesALoopBetweenOtherKeyframes) {
  Round round;
  LoopClosing loops;
  std::size_t tried_from = 0, closed_at = 0;
  double before = 0.0, after = 0.0;
  for (int i = 0; i < 60 && closed_at == 0; ++i) {
    round.add_keyframe();
    before = round.error();
    if (loops.close(round.graph)) {
      closed_at = round.graph.keyframes().size();
      round.graph.optimize(3);
      after = round.error();
    }
    loops.work(round.graph, round.clouds);
    if (loops.is_trying() && tried_from == 0) tried_from = round.graph.keyframes().size();
  }
  ASSERT_GT(closed_at, 0U);
  EXPECT_EQ(loops.closed(), 1U);
  EXPECT_GT(closed_at, tried_from);  // keyframes went on meanwhile
  EXPECT_LT(after, 0.5 * before);
}

TEST(LoopClosing, GoesOnFromASavedTrialAsIfNothingHadBeen) {
  Round round;
  LoopClosing loops;
  for (int i = 0; i < 60 && !loops.is_trying(); ++i) {
    round.add_keyframe();
    loops.work(round.graph, round.clouds);
  }
  ASSERT_TRUE(loops.is_trying());
  LoopClosing again;
  restore_state(save_state(loops), again);
  for (int i = 0; i < 20; ++i) {
    loops.work(round.graph, round.clouds);
    again.work(round.graph, round.clouds);
  }
  LandmarkGraph one = round.graph, two = round.graph;
  EXPECT_EQ(loops.close(one), again.close(two));
  EXPECT_EQ(save_state(one), save_state(two));
}

TEST(LoopClosing, TakesOutALoopThatWhatFollowsRefutes) {
  Round round;
  LoopClosing loops;
  for (int i = 0; i < 60 && loops.closed() == 0; ++i) {
    round.add_keyframe();
    loops.close(round.graph);
    loops.work(round.graph, round.clouds);
  }
  ASSERT_EQ(loops.closed(), 1U);
  const std::size_t edges = round.graph.edges().size();
  const std::size_t right = [&] {
    std::size_t count = 0;
    for (const auto& edge : round.graph.edges()) count += edge.closes_loop ? 1 : 0;
    return count;
  }();
  ASSERT_GT(right, 0U);
  loops.check(round.graph);
  EXPECT_EQ(round.graph.edges().size(), edges);  // a right one stays
  round.graph.close_loop(0, 30, {{5.0, 5.0, 0.0}, 1e-4 * Eigen::Matrix3d::Identity()});
  loops.check(round.graph);
  EXPECT_EQ(round.graph.edges().size(), edges);
}

}  // namespace
}  // namespace quoin
