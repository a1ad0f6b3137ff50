// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/measured_figures.hpp"

#include <functional>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "deploy/evaluation/evaluation.hpp"

namespace quoin::deploy {
namespace {

using nlohmann::json;

/// A report as it is written, with little in it.
json report() {
  EvaluationOptions options;
  options.only = {"consistency", "segmenters"};
  options.fitters = {"wctls"};
  options.segmenters = {"iepf"};
  options.worlds = {"square_room"};
  options.trials = 5;
  options.scans_per_world = 2;
  options.timing = false;
  options.version = "1.2.3";
  return json::parse(
      evaluate(prepare(options), [](const EvaluationProgress&) { return true; }).json);
}

/// The error for the report after `change`.
std::string error_after(const std::function<void(json&)>& change) {
  json changed = report();
  change(changed);
  try {
    (void)parse_figures(changed.dump(), "r.json");
  } catch (const ReportError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MeasuredFigures, AreThoseOfTheReport) {
  json written = report();
  written["fit_times"][0]["seconds"] = 1e-6;
  written["fit_times"][0]["over_covariance"] = 2.5;
  const MeasuredFigures figures = parse_figures(written.dump(), "r.json");
  EXPECT_EQ(figures.version, "1.2.3");
  EXPECT_EQ(figures.seed, 1U);
  EXPECT_EQ(figures.trials, 5U);
  ASSERT_EQ(figures.fitters.size(), written["fitters"].size());
  const json& fitter = written["fitters"][0];
  EXPECT_EQ(figures.fitters[0].name, "wctls");
  EXPECT_EQ(figures.fitters[0].covariance, "propagated");
  EXPECT_EQ(figures.fitters[0].environment, "square_room");
  EXPECT_EQ(figures.fitters[0].noise.range_stddev, fitter["range_stddev"].get<double>());
  EXPECT_EQ(figures.fitters[0].noise.bearing_stddev, fitter["bearing_stddev"].get<double>());
  EXPECT_EQ(figures.fitters[0].nees, fitter["nees"].get<double>());
  EXPECT_EQ(figures.fitters[0].coverage95, fitter["coverage95"].get<double>());
  EXPECT_EQ(figures.fitters[0].rmse_over_crb, fitter["rmse_over_crb"].get<double>());
  ASSERT_EQ(figures.segmenters.size(), 4U);
  const json& segmenter = written["segmenters"][0];
  EXPECT_EQ(figures.segmenters[0].name, "iepf");
  EXPECT_EQ(figures.segmenters[0].noise.range_stddev, 0.003);
  EXPECT_EQ(figures.segmenters[0].scans, 2U);
  EXPECT_EQ(figures.segmenters[0].true_positive_rate,
            segmenter["true_positive_rate"].get<double>());
  EXPECT_EQ(figures.segmenters[0].false_positive_rate,
            segmenter["false_positive_rate"].get<double>());
  EXPECT_FALSE(figures.segmenters[0].scans_per_second);
  ASSERT_EQ(figures.fit_times.size(), 2U);
  EXPECT_EQ(figures.fit_times[0].points, 100U);
  EXPECT_EQ(figures.fit_times[0].seconds, 1e-6);
  EXPECT_EQ(figures.fit_times[0].over_covariance, 2.5);
  EXPECT_FALSE(figures.fit_times[1].seconds);
}

TEST(MeasuredFigures, ErrorsTellThePlace) {
  EXPECT_EQ(error_after([](json&) {}), "no error");
  EXPECT_EQ(error_after([](json& r) { r.erase("fit_times"); }),
            "r.json: no 'fit_times'; quoin evaluate writes the report anew");
  EXPECT_EQ(error_after([](json& r) { r["fitters"][1].erase("nees"); }),
            "r.json: fitters[1]: no 'nees'; quoin evaluate writes the report anew");
  EXPECT_EQ(error_after([](json& r) { r["fitters"][0]["nees"] = "two"; }),
            "r.json: fitters[0]: 'nees' is not a number");
  EXPECT_EQ(error_after([](json& r) { r["segmenters"][2]["name"] = 3; }),
            "r.json: segmenters[2]: 'name' is not a text");
  EXPECT_EQ(error_after([](json& r) { r["segmenters"][2]["true_positive_rate"] = nullptr; }),
            "r.json: segmenters[2]: 'true_positive_rate' is not a number");
  EXPECT_EQ(error_after([](json& r) { r["segmenters"][3] = 3; }),
            "r.json: segmenters[3] is not an object");
  EXPECT_EQ(error_after([](json& r) { r["fitters"] = 3; }), "r.json: 'fitters' is not an array");
  EXPECT_EQ(error_after([](json& r) { r["trials"] = -1; }),
            "r.json: 'trials' is not a whole number");
  EXPECT_EQ(error_after([](json& r) { r = json::array(); }), "r.json is not an object");
}

TEST(MeasuredFigures, WhatIsNotJsonIsAnError) {
  for (const char* text : {"", "{", "no JSON", "{\"seed\": 1e999}"}) {
    EXPECT_THROW((void)parse_figures(text, "r.json"), ReportError) << text;
  }
  EXPECT_THROW((void)read_figures("/no/such/report.json"), ReportError);
  EXPECT_THROW((void)read_figures("/"), ReportError);
}

}  // namespace
}  // namespace quoin::deploy
