// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/extraction/extraction.hpp"

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

TEST(ExtractionOfAScan, LeavesOutSegmentsWithoutALineAndTellsWhy) {
  ScannerSettings settings;
  settings.noise = {0.0, 0.0, 0.0};
  SimulatedScanner scanner(built_in_world("square_room").value(), settings, 1);
  SimulatedScan scan;
  scanner.scan(0.0, 0.0, scan);
  const Fitter wctls = Fitters::make<Fitter>("wctls", {});
  int calls = 0;
  const Fitter second_fails = [&](const PointsView& points, const SensorModel& sensor) {
    return ++calls == 2 ? FitResult::failed(FitFailure::through_sensor) : wctls(points, sensor);
  };
  Extraction extraction(Segmenters::make<Segmenter>("iepf", {}), second_fails,
                        CornerFinders::make<CornerFinder>("adjacent", {}));
  extraction.run(view(scan, settings), SensorModel{}, SensorModel{});
  ASSERT_EQ(extraction.segments().size(), 4U);
  ASSERT_EQ(extraction.lines().size(), 3U);
  EXPECT_EQ(extraction.fitted()[1], extraction.segments()[2]);
  EXPECT_EQ(extraction.failures(), std::vector{FitFailure::through_sensor});
  EXPECT_EQ(extraction.corners().size(), 2U);
}

}  // namespace
}  // namespace quoin
