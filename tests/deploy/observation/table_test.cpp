// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/table.hpp"

#include <gmock/gmock.h>

namespace quoin::deploy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr std::size_t no_limit = std::string::npos;

DeploymentFigures figures() {
  DeploymentFigures figures;
  figures.duration = 12.34;
  ServiceFigures front{"front", "simulated", "", {}, 0};
  front.report.state = "active";
  front.report.rate = 10.0;
  front.report.published = 123;
  front.report.latency_p50 = 1e-9;
  front.report.resident_memory = 17 * 1024 * 1024;
  ServiceFigures walls{"walls", "segmentation", "iepf", {}, 3};
  walls.report = front.report;
  walls.report.received = 122;
  walls.report.lost = 1;
  walls.report.latency_p50 = 0.00051;
  walls.report.latency_p99 = 0.0123;
  figures.services = {front, walls};
  return figures;
}

EndFigures corners() {
  EndFigures end{
      .name = "corners", .type = "corners", .scans_expected = 122, .scans_delivered = 121};
  end.lost.by_service["walls"] = 1;
  end.latency_p50 = 0.0012;
  end.latency_p99 = 0.0034;
  end.corners = CornerFigures{10.2, 0.00327, 25.23e-6};
  return end;
}

TEST(Table, AlignsColumns) {
  EXPECT_THAT(table_lines(figures(), no_limit),
              ElementsAre("service  kind/method        state     Hz  received  published  lost  "
                          "p50 / p99 [ms]  RSS MiB  restarts",
                          "front    simulated          active  10.0         0        123     0     "
                          "          -     17.0         0",
                          "walls    segmentation/iepf  active  10.0       122        123     1    "
                          "0.51 / 12.30     17.0         3"));
}

TEST(Table, ShowsWhatComesOutAtTheEnds) {
  DeploymentFigures with_ends = figures();
  EndFigures silent;
  silent.name = "others";
  silent.type = "lines";
  with_ends.ends = {corners(), silent};
  const auto lines = table_lines(with_ends, no_limit);
  ASSERT_THAT(lines, SizeIs(7));
  EXPECT_EQ(lines[3], "");
  EXPECT_EQ(lines[4],
            "what comes out of  type     scans  lost  p50 / p99 [ms]  corners/scan  median sigma "
            "[mm]  median ellipse area [mm^2]");
  EXPECT_EQ(lines[5],
            "corners            corners    121     1     1.20 / 3.40         10.20               "
            "3.27                       25.23");
  EXPECT_EQ(lines[6],
            "others             lines        0     0               -             -               "
            "   -                           -");
}

TEST(Table, LeavesOutCornersWhereThereAreNone) {
  DeploymentFigures with_ends = figures();
  EndFigures end;
  end.name = "map";
  end.type = "lines";
  with_ends.ends = {end};
  EXPECT_EQ(table_lines(with_ends, no_limit)[4],
            "what comes out of  type   scans  lost  p50 / p99 [ms]");
}

TEST(Table, IsClippedToTheWidth) {
  DeploymentFigures with_corners = figures();
  with_corners.ends = {corners()};
  for (const std::string& line : table_lines(with_corners, 40)) EXPECT_LE(line.size(), 40U);
  for (const std::string& line : table_lines(with_corners, 0)) EXPECT_EQ(line, "");
}

TEST(Table, OfNothingIsItsHead) { EXPECT_THAT(table_lines({}, no_limit), SizeIs(1)); }

TEST(ProgressLine, TellsOfServicesUntilCornersArrive) {
  DeploymentFigures with_corners = figures();
  with_corners.ends = {EndFigures{}};
  with_corners.ends[0].name = "corners";
  EXPECT_EQ(progress_line(with_corners),
            "12.3 s | corners 0 scans, 0 lost | front active 123 | walls active 123 (3 restarts)");
}

TEST(ProgressLine, TellsOfCornersAndWhatIsNotAsUsual) {
  DeploymentFigures with_corners = figures();
  with_corners.ends = {corners()};
  EXPECT_EQ(progress_line(with_corners),
            "12.3 s | corners 121 scans, 1 lost, 10.2 corners, sigma 3.27 mm | walls active (3 "
            "restarts)");
  with_corners.services[0].report.state = "restarting";
  EXPECT_THAT(progress_line(with_corners), HasSubstr("| front restarting"));
  with_corners.services[1].restarts = 0;
  EXPECT_THAT(progress_line(with_corners), Not(HasSubstr("walls")));
}

}  // namespace
}  // namespace quoin::deploy
