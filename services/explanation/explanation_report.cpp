// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/explanation/explanation_report.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {

namespace {

using nlohmann::ordered_json;

constexpr double degrees = 57.29577951308232;  // per radian
constexpr double far_off = 0.2;                // [m] a place with no point so near has none

/// The service behind the only input of one, as far as it is of that kind; null when it is not.
const ServiceConfig* input_of(const Deployment& deployment, const ServiceConfig& service,
                              std::string_view kind) {
  if (service.inputs.empty()) return nullptr;
  const ServiceConfig& input = deployment.service(service.inputs.front().service);
  return kind.empty() || input.kind == kind ? &input : nullptr;
}

/// Of a kind that this program does not know the deployment has no default.
template <class Methods>
MethodChoice choice_of(const ServiceConfig* service) {
  MethodChoice choice;
  if (service != nullptr) choice = {service->method, service->parameters};
  if (choice.method.empty()) choice.method = Methods::descriptions().front().name;
  return choice;
}

std::string formatted(const char* format, double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// Four digits, rounded away from `from`, so that the figure still helps.
double rounded_away(double value, double from) {
  if (value == 0.0 || value == std::floor(value)) return value;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
  return (value > from ? std::ceil(value / step) : std::floor(value / step)) * step;
}

std::string with_unit(double value, const std::string& unit) {
  if (unit == "rad") return formatted("%.4g deg", value * degrees);
  if (unit == "m" && std::abs(value) < 0.1) return formatted("%.4g mm", value * 1e3);
  return formatted("%.4g", value) + (unit.empty() ? "" : " " + unit);
}

ordered_json change(const ServiceConfig& service, const Remedy& remedy) {
  const double would = rounded_away(remedy.would, remedy.value);
  return {{"service", service.name},
          {"parameter", remedy.parameter},
          {"unit", remedy.unit},
          {"value", remedy.value},
          {"would", would},
          {"value_text", with_unit(remedy.value, remedy.unit)},
          {"would_text", with_unit(would, remedy.unit)},
          {"first_of_several", remedy.first_of_several}};
}

/// What a step did to the points, in words.
std::string sentence(const Explanation& found) {
  const std::string these =
      std::to_string(found.points) + (found.points == 1 ? " point" : " points");
  switch (found.outcome) {
    case PointOutcome::segment:
      return "segmentation made a wall of " + these;
    case PointOutcome::arc:
      return these + " are of something round; round things are no lines";
    case PointOutcome::no_return:
      return "the range is what the sensor writes where nothing came back";
    case PointOutcome::foreign:
      return these + " stand alone, or in front of a surface that goes on behind them";
    case PointOutcome::no_line:
      return "the method found no line through " + these + " of a surface of " +
             std::to_string(found.surface_points);
    case PointOutcome::too_few_points:
      return these + ": too few for a segment (surface of " + std::to_string(found.surface_points) +
             " points between two gaps)";
    case PointOutcome::off_line:
      return these + " are not on the wall beside them, and no wall by themselves";
    case PointOutcome::at_corner:
      return these + " are beside a corner, where noise decides on which wall they are; left out";
    case PointOutcome::piece_end:
      return these + " at the end of a segment, which may be of two surfaces; left out";
    case PointOutcome::too_short:
      return these + " over " + with_unit(found.extent, "m") + ": too short for a wall";
    case PointOutcome::too_narrow:
      return these + " over " + with_unit(found.extent, "m") +
             ": no longer than the tolerance is wide, which noise alone gives";
    case PointOutcome::one_point:
      return these + ": the direction would hang on one point at an end";
    case PointOutcome::too_bent:
      return these + " over " + with_unit(found.extent, "m") + ": too bent for a wall";
  }
  return "";
}

std::string sentence(std::string_view reason) {
  if (reason == "small_angle") return "they are nearly parallel";
  if (reason == "wide_gap") return "their facing ends are far apart";
  if (reason == "far_away") return "they would meet far from their ends";
  if (reason == "inside_line") return "they would meet where one of them is seen to go on";
  return std::string(reason);
}

std::string summary(const Place& place, const Explanation& found) {
  if (!found.measured) return "the scan has no points";
  std::string text;
  const double limit = place.range ? far_off : 0.02;
  if (found.distance > limit) {
    text = place.range ? "nothing was measured there; the nearest point is " +
                             with_unit(found.distance, "m") + " away. There "
                       : "no ray came back from there; the nearest is " +
                             with_unit(found.distance, "rad") + " beside it. There ";
  }
  text += sentence(found);
  if (found.outcome != PointOutcome::segment) return text;
  if (!found.fit_failure.empty()) return text + ", but the fit failed: " + found.fit_failure;
  if (!found.line) return text;
  text += ": line " + std::to_string(*found.line) + ", with " + std::to_string(found.corners) +
          (found.corners == 1 ? " corner" : " corners");
  for (const MissingCorner& missing : found.missing_corners) {
    text += "; none with line " + std::to_string(missing.line) + ": " + sentence(missing.reason);
  }
  return text;
}

}  // namespace

ExplainedServices explained_services(const Deployment& deployment, const std::string& name) {
  ExplainedServices result;
  const ServiceConfig* service = &deployment.service(name);
  if (service->kind == "corner_estimation") {
    result.corners = service;
    service = input_of(deployment, *service, "line_fitting");
  }
  if (service == nullptr || service->kind != "line_fitting") {
    throw std::out_of_range(deployment.file.string() + ": '" + name +
                            "' is no service of kind line_fitting or corner_estimation");
  }
  result.line_fitting = service;
  result.segmentation = input_of(deployment, *service, "segmentation");
  if (result.segmentation == nullptr) {
    throw std::out_of_range(deployment.file.string() + ": '" + name +
                            "' does not get its segments from a service of kind segmentation");
  }
  result.source = input_of(deployment, *result.segmentation, "");
  for (const ServiceConfig& each : deployment.services) {
    if (result.corners == nullptr && each.kind == "corner_estimation" &&
        input_of(deployment, each, "line_fitting") == result.line_fitting) {
      result.corners = &each;
    }
  }
  result.chain = {choice_of<Segmenters>(result.segmentation),
                  choice_of<Fitters>(result.line_fitting),
                  choice_of<CornerFinders>(result.corners)};
  return result;
}

ordered_json to_json(const ExplainedServices& services, const Place& place,
                     const Explanation& found) {
  ordered_json report{
      {"service", services.line_fitting->name},
      {"segmentation",
       {{"service", services.segmentation->name}, {"method", services.chain.segmenter.method}}},
      {"bearing", place.bearing}};
  if (place.range) report["range"] = *place.range;
  report["summary"] = summary(place, found);
  if (!found.measured) return report;
  report["point"] = {{"x", found.x}, {"y", found.y}};
  report["distance"] = found.distance;
  report["outcome"] = enum_name(found.outcome);
  report["points"] = found.points;
  report["surface_points"] = found.surface_points;
  report["extent"] = found.extent;
  report["changes"] = ordered_json::array();
  for (const Remedy& remedy : found.remedies) {
    report["changes"].push_back(change(*services.segmentation, remedy));
  }
  if (!found.fit_failure.empty()) report["fit_failure"] = found.fit_failure;
  if (!found.line) return report;
  report["line"] = *found.line;
  report["corners"] = found.corners;
  report["missing_corners"] = ordered_json::array();
  for (const MissingCorner& missing : found.missing_corners) {
    ordered_json row{{"line", missing.line}, {"reason", missing.reason}};
    row["changes"] = ordered_json::array();
    for (const Remedy& remedy : missing.remedies) {
      if (services.corners != nullptr) row["changes"].push_back(change(*services.corners, remedy));
    }
    report["missing_corners"].push_back(std::move(row));
  }
  return report;
}

std::string to_text(const ordered_json& report) {
  const auto get = [](const ordered_json& from, const char* key) {
    return from.at(key).get<std::string>();
  };
  std::string text = get(report, "summary") + "\n";
  const auto add_changes = [&](const ordered_json& changes) {
    for (const ordered_json& each : changes) {
      const bool first = each.at("first_of_several").get<bool>();
      text += "  " + get(each, "service") + ": " + get(each, "parameter") + " is " +
              get(each, "value_text") + "; " + get(each, "would_text") +
              (first ? " would have let it pass this step, but not the next\n"
                     : " would have let it pass\n");
    }
    if (changes.empty()) text += "  no parameter alone would have let it pass\n";
  };
  if (report.contains("changes") && report.at("outcome") != "segment") {
    add_changes(report.at("changes"));
  }
  if (report.contains("missing_corners")) {
    for (const ordered_json& missing : report.at("missing_corners")) {
      text += "no corner with line " + std::to_string(missing.at("line").get<std::size_t>()) +
              " (" + get(missing, "reason") + ")\n";
      add_changes(missing.at("changes"));
    }
  }
  return text;
}

}  // namespace quoin
