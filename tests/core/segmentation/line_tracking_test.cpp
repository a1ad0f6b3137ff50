// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/line_tracking.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

LineTracking::Parameters bare() {
  LineTracking::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  return parameters;
}

/// A wall at 2 m whose points [first, last] are `offset` too far.
Points wall_with_bump(std::size_t first, std::size_t last, double offset) {
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (std::size_t i = 0; i < 100; ++i) {
    bearings.push_back(-0.5 + 0.01 * static_cast<double>(i));
    const double more = i >= first && i <= last ? offset : 0.0;
    ranges.push_back((2.0 + more) / std::cos(bearings.back()));
  }
  return points_from(bearings, ranges);
}

TEST(LineTracking, LooksPastAMildOutlier) {
  const Points points = wall_with_bump(50, 50, 0.08);
  EXPECT_THAT(segments_by<LineTracking>(points, bare()), testing::ElementsAre(Segment{0, 100}));
  auto parameters = bare();
  parameters.look_ahead = 0;
  EXPECT_THAT(segments_by<LineTracking>(points, parameters)[0], Segment(0, 50));
}

TEST(LineTracking, EndsAtAGrossOutlier) {
  // The segment would contain it, and no fit of the segment would be right.
  const auto segments = segments_by<LineTracking>(wall_with_bump(50, 50, 0.2), bare());
  ASSERT_GE(segments.size(), 2U);
  EXPECT_EQ(segments[0], Segment(0, 50));
}

TEST(LineTracking, EndsWhereSeveralPointsLeave) {
  const auto segments = segments_by<LineTracking>(wall_with_bump(50, 99, 0.08), bare());
  EXPECT_THAT(segments, testing::ElementsAre(Segment{0, 50}, Segment{50, 100}));
}

TEST(LineTracking, IsLateAtACornerByTheToleranceAndRefinementUndoesIt) {
  const Eigen::Vector2d corner(2.0, 2.0);
  const Points points = polyline_points({{2.0, -1.0}, corner, {-1.0, 2.0}});
  const double vertex = static_cast<double>(nearest_point(points, corner));
  const auto raw = segments_by<LineTracking>(points, bare());
  ASSERT_EQ(raw.size(), 2U);
  // The second wall leaves the first at a right angle: 5 cm of it are within the tolerance, at
  // 2.8 m and 45 deg about 2.7 cm a point.
  EXPECT_GE(static_cast<double>(raw[0].end), vertex + 1.0);
  EXPECT_LE(static_cast<double>(raw[0].end), vertex + 4.0);
  LineTracking::Parameters parameters;
  const auto refined = segments_by<LineTracking>(points, parameters);
  ASSERT_EQ(refined.size(), 2U);
  EXPECT_LE(static_cast<double>(refined[0].end), vertex + 1.0);
}

}  // namespace
}  // namespace quoin
