// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/mapping_quality.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/localization_scenarios.hpp"
#include "core/fitting/fitters.hpp"
#include "core/mapping/localizers.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

Extraction usual_extraction() {
  return {Segmenters::make<Segmenter>("iepf", {}), Fitters::make<Fitter>("inverse_range", {}),
          CornerFinders::make<CornerFinder>("adjacent", {})};
}

TEST(RelationErrors, AreThoseOfRelativePoses) {
  // Turned by a quarter as a whole: relative poses do not see it. The second step is 0.1 m short.
  const std::vector<StampedPose> trajectory{
      {1.0, {0.0, 0.0, 1.5}}, {2.0, compose(Pose2{0.0, 0.0, 1.5}, Pose2{1.0, 0.0, 0.2})}};
  const std::vector<PoseRelation> relations{
      {1.0, 2.0, {1.1, 0.0, 0.2}}, {1.004, 2.0, {1.0, 0.0, 0.25}}, {1.0, 3.0, {1.0, 0.0, 0.2}}};
  const RelationErrors errors = relation_errors(trajectory, relations, 0.01, false);
  ASSERT_EQ(errors.translation.size(), 2U);
  EXPECT_EQ(errors.skipped, 1U);
  EXPECT_NEAR(errors.translation[0], 0.1, 1e-12);
  EXPECT_NEAR(errors.rotation[0], 0.0, 1e-12);
  EXPECT_NEAR(errors.translation[1], 0.0, 1e-12);
  EXPECT_NEAR(errors.rotation[1], 0.05, 1e-12);
}

TEST(RelationErrors, InterpolateOverShortGapsOnly) {
  const std::vector<StampedPose> trajectory{
      {1.0, {}}, {2.0, {1.0, 0.0, 0.0}}, {9.0, {8.0, 0.0, 0.0}}};
  const std::vector<PoseRelation> relations{{1.0, 1.5, {0.5, 0.0, 0.0}},
                                            {1.0, 5.0, {4.0, 0.0, 0.0}}};
  const RelationErrors errors = relation_errors(trajectory, relations, 2.0, true);
  ASSERT_EQ(errors.translation.size(), 1U);
  EXPECT_NEAR(errors.translation[0], 0.0, 1e-12);
  EXPECT_EQ(errors.skipped, 1U);
}

TEST(MappingQuality, OfDeadReckoningIsItsSlip) {
  Localize dead_reckoning = [pose = PoseEstimate{}](const LocalizationInput& input,
                                                    Localization& result) mutable {
    if (input.motion) pose = compose(pose, *input.motion);
    result.pose = pose;
    result.status = LocalizationStatus::tracking;
    result.map.clear();
    if (!input.wants_map) return;
    for (const LineSegment& line : input.lines) {
      result.map.push_back(
          {0, pose.pose.transform(line.start), pose.pose.transform(line.end), {}, 1});
    }
  };
  World world = built_in_world("square_room").value();
  world.path = {{1.0, 2.0, 0.0}, {3.0, 2.0, 0.0}};
  SimulatedDrive drive;
  drive.laps = 0.5;
  drive.slip = 0.1;
  drive.odometry_noise = {1e-6, 1e-6, 1e-6, 1e-6, 1e-9, 1e-9};
  Extraction extraction = usual_extraction();
  const MappingQuality quality = judge_localizer(dead_reckoning, extraction, world, drive);
  EXPECT_EQ(quality.scans, 41U);
  EXPECT_NEAR(quality.translation_errors.back(), 0.2, 1e-3);
  EXPECT_NEAR(quality.heading_errors.back(), 0.0, 1e-4);
  EXPECT_EQ(quality.confident_wrong, 40U);
  EXPECT_EQ(quality.coverage95(), 0.0);
  EXPECT_EQ(quality.map_lines, 4U);
  // Two of four walls of 4 m are 0.2 m off along x; the others miss 0.15 m at an end of 4 m.
  EXPECT_NEAR(quality.map_precision, 0.48, 0.03);
  EXPECT_NEAR(quality.map_recall, 0.48, 0.03);
}

/// Believes the wheels, and that they are right.
void believe_wheels(PoseEstimate& pose, const LocalizationInput& input, Localization& result) {
  if (input.motion) pose = compose(pose, *input.motion);
  result.pose = pose;
  result.pose.covariance += 1e-6 * Eigen::Matrix3d::Identity();
  result.status = LocalizationStatus::tracking;
}

ScenarioRun carried_away(bool odometry) {
  return {LocalizationScenario::kidnapping, 5, odometry, 30.0};
}

TEST(LocalizationScenarios, CountPosesThatAreWrongAndBelievedIn) {
  Extraction extraction = usual_extraction();
  PoseEstimate pose;
  const ScenarioOutcome outcome = run_scenario(
      carried_away(true),
      [&](const auto& input, auto& result) { believe_wheels(pose, input, result); }, extraction);
  EXPECT_EQ(outcome.scans, 300U);
  EXPECT_EQ(outcome.tracking, 300U);
  EXPECT_GE(outcome.confident_wrong, 50U);  // all after 25 s
  EXPECT_GT(outcome.largest_tracked, 1.0);
  EXPECT_FALSE(outcome.lost_after.has_value());
}

TEST(LocalizationScenarios, LandmarksAreLostWhereTheyAreCarriedAndFindThemselves) {
  for (const bool odometry : {false, true}) {
    SCOPED_TRACE(odometry);
    Extraction extraction = usual_extraction();
    Localizer landmarks = Localizers::make<Localizer>("landmarks", {});
    const ScenarioOutcome outcome =
        run_scenario(carried_away(odometry), std::ref(landmarks), extraction);
    EXPECT_EQ(outcome.confident_wrong, 0U);
    ASSERT_TRUE(outcome.lost_after.has_value());
    EXPECT_LE(*outcome.lost_after, 1.0);
    ASSERT_TRUE(outcome.found_after.has_value());
    EXPECT_LT(outcome.largest_tracked, 0.03);
  }
}

}  // namespace
}  // namespace quoin
