// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/corner_matching.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace quoin {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

CornerEstimate corner(double x, double y, double sigma = 0.05) {
  return {{x, y}, sigma * sigma * Eigen::Matrix2d::Identity()};
}

TEST(MatchCorners, TakesTheClosestPairFirstAndEachCornerOnce) {
  // The second of the first list is nearest to both.
  const auto matches = match_corners({corner(0.0, 0.0), corner(0.1, 0.0)},
                                     {corner(0.09, 0.0), corner(0.16, 0.0)}, {});
  ASSERT_THAT(matches, SizeIs(2));
  EXPECT_EQ(matches[0].first, 1U);
  EXPECT_EQ(matches[0].second, 0U);
  EXPECT_NEAR(matches[0].distance, 0.01, 1e-12);
  EXPECT_EQ(matches[1].first, 0U);
  EXPECT_EQ(matches[1].second, 1U);
  EXPECT_NEAR(matches[1].distance, 0.16, 1e-12);
}

TEST(MatchCorners, LeavesOverWhatHasNoPartner) {
  EXPECT_THAT(match_corners({corner(0, 0), corner(0.01, 0)}, {corner(0, 0)}, {}), SizeIs(1));
  EXPECT_THAT(match_corners({}, {corner(0, 0)}, {}), IsEmpty());
}

TEST(MatchCorners, CountsTheCovariancesOfBoth) {
  // Variance of the difference: 2 * 1 cm^2 along x. The gate is at 3.72 standard deviations.
  const double limit = std::sqrt(2.0 * 13.8155) * 0.01;
  EXPECT_THAT(match_corners({corner(0, 0, 0.01)}, {corner(limit * 0.999, 0, 0.01)}, {}), SizeIs(1));
  EXPECT_THAT(match_corners({corner(0, 0, 0.01)}, {corner(limit * 1.001, 0, 0.01)}, {}), IsEmpty());
  // A correlated covariance lets them be apart along its long axis alone.
  CornerEstimate stretched = corner(0, 0);
  stretched.covariance << 0.0025, 0.00249, 0.00249, 0.0025;
  CornerEstimate along = stretched;
  along.position << 0.1, 0.1;
  CornerEstimate across = stretched;
  across.position << 0.1, -0.1;
  EXPECT_THAT(match_corners({stretched}, {along}, {}), SizeIs(1));
  EXPECT_THAT(match_corners({stretched}, {across}, {}), IsEmpty());
}

TEST(MatchCorners, KeepsToTheLargestDistance) {
  EXPECT_THAT(match_corners({corner(0, 0, 1.0)}, {corner(0.19, 0, 1.0)}, {}), SizeIs(1));
  EXPECT_THAT(match_corners({corner(0, 0, 1.0)}, {corner(0.21, 0, 1.0)}, {}), IsEmpty());
  EXPECT_THAT(match_corners({corner(0, 0, 1.0)}, {corner(0.21, 0, 1.0)}, {.largest_distance = 0.3}),
              SizeIs(1));
}

TEST(MatchCorners, MatchesNothingThatCannotBeJudged) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const CornerEstimate good = corner(0, 0);
  for (const CornerEstimate& bad :
       {corner(nan, 0), corner(std::numeric_limits<double>::infinity(), 0), corner(0, 0, nan)}) {
    EXPECT_THAT(match_corners({good}, {bad}, {}), IsEmpty());
    EXPECT_THAT(match_corners({bad}, {good}, {}), IsEmpty());
  }
  EXPECT_THAT(match_corners({corner(0, 0, 0.0)}, {corner(0, 0, 0.0)}, {}), IsEmpty());
  CornerEstimate negative = good;
  negative.covariance *= -3.0;
  EXPECT_THAT(match_corners({good}, {negative}, {}), IsEmpty());
}

TEST(MatchCorners, LooksAtSoManyOnly) {
  const std::vector<CornerEstimate> many(most_matched + 10, corner(0, 0));
  EXPECT_THAT(match_corners(many, {corner(0, 0)}, {}), SizeIs(1));
  std::vector<CornerEstimate> far(most_matched, corner(5, 5));
  far.push_back(corner(0, 0));
  EXPECT_THAT(match_corners({corner(0, 0)}, far, {}), IsEmpty());
}

TEST(MatchTruth, TakesWhatIsNearOrInsideItsOwnEllipse) {
  const std::vector<Eigen::Vector2d> truth{{0, 0}};
  EXPECT_THAT(match_truth({corner(0.149, 0, 0.001)}, truth), SizeIs(1));
  EXPECT_THAT(match_truth({corner(0.151, 0, 0.001)}, truth), IsEmpty());
  EXPECT_THAT(match_truth({corner(0.39, 0, 0.1)}, truth), SizeIs(1));
  EXPECT_THAT(match_truth({corner(0.41, 0, 0.1)}, truth), IsEmpty());
  EXPECT_THAT(match_truth({corner(1.01, 0, 10.0)}, truth), IsEmpty());
}

TEST(MatchTruth, TakesEachOnceAndTellsTheDistance) {
  const auto matches =
      match_truth({corner(0.03, 0, 0.01), corner(0.02, 0, 0.01)}, {{0, 0}, {9, 9}});
  ASSERT_THAT(matches, SizeIs(1));
  EXPECT_EQ(matches[0].found, 1U);
  EXPECT_EQ(matches[0].truth, 0U);
  EXPECT_NEAR(matches[0].mahalanobis_squared, 4.0, 1e-9);
  // Without a covariance the position is judged all the same.
  const auto bare = match_truth({corner(0.02, 0, 0.0)}, {{0, 0}});
  ASSERT_THAT(bare, SizeIs(1));
  EXPECT_TRUE(std::isinf(bare[0].mahalanobis_squared));
}

}  // namespace
}  // namespace quoin
