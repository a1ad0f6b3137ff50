// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/segmentation_quality.hpp"

#include <gtest/gtest.h>

#include "core/segmentation/segmenters.hpp"
#include "core/simulation/world.hpp"

namespace quoin {
namespace {

const std::vector<World>& square_room() {
  static const std::vector<World> worlds{built_in_world("square_room").value()};
  return worlds;
}

SegmentationQuality judge(const Segmenter& segmenter) {
  return judge_segmentation(segmenter, square_room(), {}, 10, 1);
}

TEST(SegmentationQuality, IsFullForTheTruth) {
  const SegmentationQuality quality = judge(Segmenters::make<Segmenter>("iepf", {}));
  EXPECT_EQ(quality.scans, 10U);
  EXPECT_EQ(quality.true_segments, 40U);
  EXPECT_EQ(quality.matches, 40U);
  EXPECT_EQ(quality.found_segments, 40U);
  EXPECT_EQ(quality.false_positive_rate.value, 0.0);
  EXPECT_GT(quality.r_stddev, 0.0);
  EXPECT_LT(quality.r_stddev, 0.005);  // 10 mm over some 230 points
  EXPECT_LT(quality.alpha_stddev, 0.005);
}

TEST(SegmentationQuality, CountsHalvesOfWallsAsFalse) {
  // Four walls of about 230 points each, every one cut into two.
  const Segmenter iepf = Segmenters::make<Segmenter>("iepf", {});
  const SegmentationQuality quality =
      judge([&iepf](const PointsView& points, const SensorModel& sensor, Segmentation& found) {
        Segmentation whole;
        iepf(points, sensor, whole);
        found.clear();
        for (const Segment& segment : whole.segments) {
          const std::size_t middle = segment.begin + segment.size() / 2;
          found.segments.push_back({segment.begin, middle});
          found.segments.push_back({middle, segment.end});
        }
      });
  EXPECT_EQ(quality.found_segments, 80U);
  EXPECT_EQ(quality.matches, 0U);
  EXPECT_EQ(quality.true_positive_rate.value, 0.0);
  EXPECT_EQ(quality.false_positive_rate.value, 1.0);
}

TEST(SegmentationQuality, CountsWhatIsMissed) {
  const Segmenter iepf = Segmenters::make<Segmenter>("iepf", {});
  const SegmentationQuality quality =
      judge([&iepf](const PointsView& points, const SensorModel& sensor, Segmentation& found) {
        iepf(points, sensor, found);
        found.segments.pop_back();
      });
  EXPECT_EQ(quality.true_positive_rate.value, 0.75);
  EXPECT_EQ(quality.false_positive_rate.value, 0.0);
}

TEST(SegmentationQuality, NeitherRequiresNorBlamesSmallWalls) {
  const Segmenter iepf = Segmenters::make<Segmenter>("iepf", {});
  const SegmentationQuality quality = judge_segmentation(iepf, square_room(), {}, 10, 1, {9, 5.0});
  EXPECT_EQ(quality.true_segments, 0U);
  EXPECT_EQ(quality.matches, 0U);
  EXPECT_EQ(quality.false_positive_rate.value, 0.0);
}

TEST(SegmentationQuality, RefusesALineThatIsOff) {
  const Segmenter iepf = Segmenters::make<Segmenter>("iepf", {});
  // Each wall with a third of the next: most points in common, but bent around the corner.
  const SegmentationQuality quality =
      judge([&iepf](const PointsView& points, const SensorModel& sensor, Segmentation& found) {
        iepf(points, sensor, found);
        std::vector<Segment>& segments = found.segments;
        for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
          segments[i].end = segments[i + 1].begin + segments[i + 1].size() / 3;
          segments[i + 1].begin = segments[i].end;
        }
      });
  EXPECT_LT(quality.true_positive_rate.value, 0.5);
}

// The figures that the default method is there for; 60 rooms tell them to 1 %.
TEST(SegmentationQuality, OfTheDefaultHoldsAmongFurnitureAndClutter) {
  const std::vector<World> rooms = cluttered_rooms(60, 5);
  const Segmenter segmenter = Segmenters::make<Segmenter>("iepf", {});
  const SegmentationQuality fine =
      judge_segmentation(segmenter, rooms, {0.010, 0.00197, 0.0}, 3, 1);
  EXPECT_GE(fine.true_positive_rate.value, 0.98);
  EXPECT_LE(fine.false_positive_rate.value, 0.05);
  const SegmentationQuality coarse =
      judge_segmentation(segmenter, rooms, {0.050, 0.00197, 0.0}, 3, 1);
  EXPECT_GE(coarse.true_positive_rate.value, 0.85);
  EXPECT_LE(coarse.false_positive_rate.value, 0.20);
}

// What made the difference: fixed distances break down when noise comes near them.
TEST(SegmentationQuality, CollapsesWithAFixedThresholdAndNoMerging) {
  const std::vector<World> rooms = cluttered_rooms(20, 5);
  const Segmenter plain = Segmenters::make<Segmenter>(
      "iepf",
      {{"split_distance", "0.04"}, {"noise_factor", "0"}, {"merge", "false"}, {"refine", "false"}});
  const SegmentationQuality quality = judge_segmentation(plain, rooms, {0.050, 0.00197, 0.0}, 2, 1);
  EXPECT_LT(quality.true_positive_rate.value, 0.3);
  EXPECT_GT(quality.false_positive_rate.value, 0.5);
}

}  // namespace
}  // namespace quoin
