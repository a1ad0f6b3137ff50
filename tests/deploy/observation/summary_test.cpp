// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/summary.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace quoin::deploy {
namespace {

DeploymentFigures figures() {
  DeploymentFigures figures;
  figures.deployment = "robot.yaml";
  figures.duration = 20.04;
  figures.scans_published = 200;
  ServiceFigures walls{"walls", "segmentation", "iepf", {}, 2};
  walls.report.state = "stopped";
  walls.report.received = 199;
  walls.report.published = 198;
  walls.report.lost = 2;
  walls.report.losses = {{"link", 1}, {"processing", 1}};
  walls.report.upstream_lost = 1;
  walls.report.failures = 4;
  walls.report.latency_p50 = 0.000512345;
  walls.report.latency_p99 = 0.0031;
  walls.report.processing_p50 = 24e-6;
  walls.report.processing_p99 = 61e-6;
  walls.report.resident_memory = 18792448;
  figures.services.push_back(walls);
  EndFigures end{
      .name = "corners", .type = "corners", .scans_expected = 205, .scans_delivered = 198};
  end.lost = {{{"walls", 2}, {"link", 1}}, 1, 2, 1};
  end.latency_p50 = 0.0012;
  end.latency_p99 = 0.0034;
  end.corners = CornerFigures{10.25, 0.0032714, 25.23e-6};
  figures.ends.push_back(end);
  return figures;
}

// The names are what scripts rely on.
TEST(Summary, HasStableNames) {
  const auto expected = nlohmann::ordered_json::parse(R"({
    "deployment": "robot.yaml", "duration_s": 20.04, "scans_published": 200,
    "services": {"walls": {
      "kind": "segmentation", "method": "iepf", "state": "stopped", "received": 199, "published": 198,
      "lost": 2, "losses": {"link": 1, "processing": 1}, "upstream_lost": 1, "failures": 4,
      "latency_p50_us": 512.3, "latency_p99_us": 3100.0, "processing_p50_us": 24.0,
      "processing_p99_us": 61.0, "resident_memory_bytes": 18792448, "restarts": 2}},
    "ends": {"corners": {
      "scans_expected": 205, "scans_delivered": 198, "scans_lost": 7,
      "lost_by_stage": {"link": 1, "walls": 2}, "lost_on_link": 1, "lost_at_start": 2,
      "lost_at_end": 1, "type": "corners", "latency_p50_us": 1200.0, "latency_p99_us": 3400.0}},
    "corners": {"corners": {
      "scans_expected": 205, "scans_delivered": 198, "scans_lost": 7,
      "lost_by_stage": {"link": 1, "walls": 2}, "lost_on_link": 1, "lost_at_start": 2,
      "lost_at_end": 1,
      "mean_corners": 10.25, "median_sigma_mm": 3.271, "median_ellipse_area_mm2": 25.23}}})");
  EXPECT_EQ(summary(figures()), expected) << summary(figures()).dump(2);
}

TEST(Summary, HasObjectsEvenWhenNothingHappened) {
  const auto json = summary({});
  EXPECT_TRUE(json["services"].is_object());
  EXPECT_TRUE(json["ends"].is_object());
  EXPECT_TRUE(json["corners"].is_object());
  EXPECT_TRUE(service_summary({})["losses"].is_object());
  EXPECT_EQ(json["duration_s"], 0.0);
}

TEST(Summary, HasNumbersOnly) {
  DeploymentFigures strange = figures();
  strange.services[0].report.latency_p50 = std::numeric_limits<double>::quiet_NaN();
  strange.ends[0].corners->median_sigma = std::numeric_limits<double>::infinity();
  const auto json = summary(strange);
  EXPECT_TRUE(json["services"]["walls"]["latency_p50_us"].is_number());
  EXPECT_EQ(json["corners"]["corners"]["median_sigma_mm"], 0.0);
}

}  // namespace
}  // namespace quoin::deploy
