// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/loop_trial.hpp"

#include <gtest/gtest.h>

namespace quoin {
namespace {

/// A round of 40 keyframes whose odometry has drifted by `drift` [m] at its end.
LandmarkGraph round_trip(double drift) {
  constexpr int steps = 40;
  LandmarkGraph graph;
  Pose2 pose;
  graph.add_keyframe(0, pose, {});
  for (int i = 0; i < steps; ++i) {
    const PoseEstimate motion{{0.5, drift / steps, 2.0 * 3.14159265358979 / steps},
                              Eigen::Vector3d(4e-4, 4e-4, 1e-5).asDiagonal()};
    pose = compose(pose, motion.pose);
    graph.add_keyframe(static_cast<std::size_t>(i), pose, motion);
  }
  return graph;
}

LandmarkGraph::Edge loop(std::size_t from, std::size_t to, const Pose2& relative) {
  LandmarkGraph::Edge edge;
  edge.from = from;
  edge.to = to;
  edge.motion = {relative, 1e-4 * Eigen::Matrix3d::Identity()};
  return edge;
}

LoopTrial::Verdict run(LoopTrial& trial) {
  LoopTrial::Verdict verdict = LoopTrial::Verdict::open;
  for (int i = 0; i < 100 && verdict == LoopTrial::Verdict::open; ++i) verdict = trial.step();
  return verdict;
}

TEST(LoopTrial, HoldsForALoopWithinTheDrift) {
  const LandmarkGraph graph = round_trip(0.1);
  const Pose2 there = graph.keyframes()[39].pose;
  const Pose2 known = between({}, there);
  LoopTrial trial(graph, std::vector{loop(1, 40, {-0.5, 0.0, -0.157})}, loop(0, 40, {}));
  EXPECT_EQ(run(trial), LoopTrial::Verdict::holds);
  const Pose2& end = trial.graph().keyframes()[40].pose;
  EXPECT_NEAR(end.x, 0.0, 0.05);
  EXPECT_NEAR(end.y, 0.0, 0.05);
  EXPECT_GT(std::hypot(known.x, known.y), 0.1);
}

TEST(LoopTrial, RefutesALoopThatTheMotionCannotExplain) {
  const LandmarkGraph graph = round_trip(0.0);
  LoopTrial trial(graph, std::vector{loop(1, 40, {2.0, 5.0, 0.0})}, loop(0, 40, {2.5, 5.0, 0.0}));
  EXPECT_EQ(run(trial), LoopTrial::Verdict::refuted);
}

TEST(LoopTrial, NeedsMorePairsWhereItBendsTheMapFar) {
  // Of the same edge one pair more or less decides.
  const LandmarkGraph graph = round_trip(0.0);
  const LandmarkGraph::Edge far = loop(0, 40, {0.0, 1.6, 0.0});
  std::vector<LandmarkGraph::Edge> pairs;
  std::size_t needed = 0;
  for (; needed < 20; ++needed) {
    LoopTrial trial(graph, pairs, far);
    if (run(trial) == LoopTrial::Verdict::holds) break;
    pairs.push_back(far);
  }
  EXPECT_GE(needed, 1U);
  EXPECT_LT(needed, 20U);
}

}  // namespace
}  // namespace quoin
