// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/figures.hpp"

#include <gtest/gtest.h>

#include "core/evaluation/papers/wctls_paper.hpp"

namespace quoin::deploy {
namespace {

TEST(Figures, FailuresAreNamed) {
  FailureCounts failures{};
  failures[static_cast<std::size_t>(FitFailure::none)] = 7;
  EXPECT_EQ(failures_text(failures), "-");
  EXPECT_EQ(failures_json(failures).dump(), "{}");
  failures[static_cast<std::size_t>(FitFailure::degenerate)] = 2;
  failures[static_cast<std::size_t>(FitFailure::through_sensor)] = 1;
  EXPECT_EQ(failures_text(failures), "2 degenerate, 1 through_sensor");
  EXPECT_EQ(failures_json(failures).dump(), R"({"degenerate":2,"through_sensor":1})");
}

TEST(Figures, IntervalsAndNoiseAreReadable) {
  EXPECT_EQ(interval_text({0.9512, 0.94, 0.96}, 1, 100.0), "95.1 [94.0, 96.0]");
  EXPECT_EQ(noise_text(data_sheet_model()), "50 mm, 0.391 deg");
  EXPECT_EQ(noise_text(rplidar_noise(0.003)), "3 mm, 0.113 deg");
  nlohmann::ordered_json object;
  add_interval(object, "nees", {2.0, 1.5, 2.5});
  EXPECT_EQ(object.dump(), R"({"nees":2.0,"nees_interval":[1.5,2.5]})");
}

TEST(Figures, WhatWasNotFoundIsNull) {
  nlohmann::ordered_json report;
  add_published(report, {"paper", "Table 1", "sigma", "mm", 3.5, std::nullopt});
  add_published(report, {"paper", "Table 1", "sigma", "mm", 3.5, 4.0});
  EXPECT_TRUE(report["published"][0]["measured"].is_null());
  EXPECT_EQ(report["published"][1]["measured"], 4.0);
  EXPECT_EQ(report["published"][1]["published"], 3.5);
}

}  // namespace
}  // namespace quoin::deploy
