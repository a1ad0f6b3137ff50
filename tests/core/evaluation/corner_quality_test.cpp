// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/corner_quality.hpp"

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/inverse_range.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

Extraction extraction(const ParameterSettings& segmenter = {}) {
  return {Segmenters::make<Segmenter>("iepf", segmenter), InverseRange(),
          CornerFinders::make<CornerFinder>("adjacent", {})};
}

TEST(CornerQuality, CountsTheCornersOfARoom) {
  Extraction good = extraction();
  const CornerQuality quality = judge_room_corners(good, {360, {}, 0.0, 100, 3});
  EXPECT_EQ(quality.scans, 100U);
  EXPECT_EQ(quality.true_corners, 400U);
  EXPECT_GE(quality.recall.value, 0.97);
  EXPECT_EQ(quality.false_corners, 0U);
  EXPECT_GT(quality.coverage.value, 0.90);  // 5 standard deviations
  EXPECT_NEAR(quality.mean_nees, 2.0, 0.5);
}

TEST(CornerQuality, SeesWhatStraysDoToASegmenterThatKnowsNone) {
  Extraction good = extraction();
  Extraction plain = extraction({{"max_line_gap", "0"}, {"merge", "false"}, {"refine", "false"}});
  const DisturbedScans strays{360, {}, 0.1, 50, 3};
  EXPECT_LT(judge_room_corners(plain, strays).recall.value,
            judge_room_corners(good, strays).recall.value);
}

TEST(CornerQuality, AColumnHasFalseCornersOnly) {
  Extraction plain = extraction({{"merge", "false"}, {"max_bend", "1"}});
  const CornerQuality quality = judge_column(plain, 0.45, 2.0, {920, {}, 0.0, 50, 3});
  EXPECT_EQ(quality.true_corners, 0U);
  EXPECT_GT(quality.false_per_100_scans(), 10.0);
  Extraction good = extraction();
  EXPECT_LE(judge_column(good, 0.45, 2.0, {920, {}, 0.0, 50, 3}).false_per_100_scans(), 2.0);
}

}  // namespace
}  // namespace quoin
