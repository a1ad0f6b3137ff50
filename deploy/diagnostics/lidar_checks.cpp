// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/diagnostics/lidar_checks.hpp"

#include <cmath>

#include "deploy/observation/table.hpp"

namespace quoin::deploy {
namespace {

using namespace sensor_bridge;
using namespace sensor_bridge::rplidar;

constexpr double tolerance = 0.05;  // of speed and sample rate; an S1 keeps both within 1 %

bool differs(double measured, double expected) {
  return expected > 0.0 && std::abs(measured - expected) > tolerance * expected;
}

/// The device can be used in spite of these.
bool is_harmless(Finding finding) {
  return finding == Finding::fine || finding == Finding::health_warning ||
         finding == Finding::other_baud_rate || finding == Finding::unknown_model ||
         finding == Finding::speed_out_of_range;
}

Check check_health(const DeviceHealth& health) {
  const std::string code = ": " + health_text(health);
  switch (health.status) {
    case Health::good:
      return {"health", Verdict::good, "good", ""};
    case Health::warning:
      return {"health", Verdict::doubtful, "the device warns" + code,
              "clean it and see that it can turn freely"};
    case Health::error:
      break;
  }
  return {"health", Verdict::bad, "protection stop" + code,
          "see that it can turn freely, then switch it off and on"};
}

Check check_rotation(const Measurement& measurement) {
  const std::string measured = fixed(measurement.frequency, 2) + " Hz";
  const double expected =
      measurement.plan && measurement.plan->speed ? *measurement.plan->speed / 60.0 : 0.0;
  if (differs(measurement.frequency, expected)) {
    return {"rotation", Verdict::doubtful, measured + " instead of " + fixed(expected, 2) + " Hz",
            "see that it can turn freely, and that the supply gives 5 V with 1.5 A at the start"};
  }
  return {"rotation", Verdict::good, measured, ""};
}

Check check_samples(const Measurement& measurement) {
  const std::string measured = fixed(measurement.sample_rate, 0) + " a second, " +
                               std::to_string(measurement.counts.lost_samples) + " lost, " +
                               std::to_string(measurement.counts.checksum_errors) +
                               " damaged frames";
  const double declared = measurement.plan ? measurement.plan->mode.sample_period : 0.0;
  const double expected = declared > 0.0 ? 1.0 / declared : 0.0;
  if (measurement.counts.lost_samples > 0 || measurement.counts.checksum_errors > 0) {
    return {"samples", Verdict::doubtful, measured,
            "use a shorter or better cable, and no USB hub without a supply of its own"};
  }
  if (differs(measurement.sample_rate, expected)) {
    return {"samples", Verdict::doubtful, measured + ", expected " + fixed(expected, 0),
            "the link is too slow or the rotation uneven; try another cable or adapter"};
  }
  return {"samples", Verdict::good, measured, ""};
}

Check check_period(const Measurement& measurement) {
  const double declared = measurement.plan ? measurement.plan->mode.sample_period : 0.0;
  const double measured = measurement.counts.sample_period;
  const std::string text =
      (measured > 0.0 ? fixed(measured * 1e6, 2) + " us measured, " : "not measured yet, ") +
      (declared > 0.0 ? fixed(declared * 1e6, 2) + " us declared" : "none declared");
  return {"sample period", Verdict::good, text, ""};
}

Check check_returns(const Measurement& measurement) {
  constexpr double few = 0.2;
  const std::string share = fixed(100.0 * measurement.return_share, 0) + " % have a range";
  if (measurement.return_share < few) {
    return {"returns", Verdict::doubtful, share,
            "clean the window; out in the open or between black walls it may be right"};
  }
  return {"returns", Verdict::good, share, ""};
}

}  // namespace

Checks lidar_checks(const LidarReport& report) {
  const Diagnosis& diagnosis = report.probe.diagnosis;
  const Finding finding = diagnosis.finding;
  Checks checks;
  if (!report.found()) {
    checks.push_back({"connection", Verdict::bad, diagnosis.text, diagnosis.advice});
    return checks;
  }
  const bool noted = finding == Finding::other_baud_rate || finding == Finding::unknown_model;
  checks.push_back({"connection", noted ? Verdict::doubtful : Verdict::good, diagnosis.text,
                    noted ? diagnosis.advice : ""});
  checks.push_back(check_health(report.probe.facts->health));
  if (!report.measurement) return checks;
  const Measurement& measurement = *report.measurement;
  if (measurement.revolutions > 0) {
    checks.push_back(check_rotation(measurement));
    checks.push_back(check_samples(measurement));
    checks.push_back(check_period(measurement));
    checks.push_back(check_returns(measurement));
  }
  for (const Diagnosis& problem : measurement.problems) {
    checks.push_back({"measurement",
                      is_harmless(problem.finding) ? Verdict::doubtful : Verdict::bad, problem.text,
                      problem.advice});
  }
  if (measurement.revolutions == 0 && measurement.problems.empty()) {
    checks.push_back({"measurement", Verdict::bad, "no complete revolution arrived",
                      "see that it turns; give it more time with --seconds"});
  }
  return checks;
}

}  // namespace quoin::deploy
