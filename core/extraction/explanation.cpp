// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/extraction/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/geometry/angle.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

constexpr std::size_t most_remedies = 4;
constexpr int doublings = 12;   // of the change of a parameter, until it helps or is out of range
constexpr int bisections = 12;  // to a part in 4000 of that change

std::vector<ParameterInfo> parameters_of(const std::vector<MethodInfo>& methods,
                                         const std::string& method) {
  for (const MethodInfo& info : methods) {
    if (info.name == method) return info.parameters;
  }
  return {};
}

double value_of(const ParameterInfo& info, const ParameterSettings& settings) {
  for (const ParameterSetting& setting : settings) {
    if (setting.name == info.name) return detail::parse_real(info, setting.text);
  }
  return detail::parse_real(info, info.default_value);
}

ParameterSettings changed(ParameterSettings settings, const ParameterInfo& info, double value) {
  std::erase_if(settings, [&](const ParameterSetting& each) { return each.name == info.name; });
  settings.push_back({info.name, detail::number_text(value)});
  return settings;
}

/// Whether a run with these settings does what is wanted.
using Trial = std::function<bool(const ParameterSettings&)>;

/// The nearest value in one direction that helps; nothing when none does.
std::optional<double> nearest_helpful(const ParameterInfo& info, const ParameterSettings& settings,
                                      double value, double direction, const Trial& helps) {
  const bool integer = info.type == ParameterType::integer;
  const double limit = direction > 0.0 ? info.maximum : info.minimum;
  const double unit = integer ? 1.0 : std::max(std::abs(value), 1e-3) / 8.0;
  double fails = value;
  double passes = value;
  double change = unit;
  bool found = false;
  for (int k = 0; k < doublings && !found; ++k, change *= 2.0) {
    double next = value + direction * change;
    if (direction * (next - limit) >= 0.0) next = limit;
    if (next == fails || !std::isfinite(next)) return std::nullopt;
    if (helps(changed(settings, info, next))) {
      passes = next;
      found = true;
    } else {
      fails = next;
    }
  }
  if (!found) return std::nullopt;
  for (int k = 0; k < bisections; ++k) {
    double middle = 0.5 * (fails + passes);
    if (integer) middle = std::round(middle);
    if (middle == fails || middle == passes) break;
    (helps(changed(settings, info, middle)) ? passes : fails) = middle;
  }
  return passes;
}

/// Each parameter whose change alone helps, the smallest change first.
std::vector<Remedy> remedies(const std::vector<ParameterInfo>& infos,
                             const ParameterSettings& settings, const Trial& helps) {
  std::vector<Remedy> found;
  for (const ParameterInfo& info : infos) {
    if (info.type != ParameterType::real && info.type != ParameterType::integer) continue;
    const double value = value_of(info, settings);
    std::optional<double> best;
    for (const double direction : {-1.0, 1.0}) {
      const auto would = nearest_helpful(info, settings, value, direction, helps);
      if (would && (!best || std::abs(*would - value) < std::abs(*best - value))) best = would;
    }
    if (best) found.push_back({info.name, info.unit, value, *best});
  }
  const auto change = [](const Remedy& each) {
    return std::abs(each.would - each.value) / std::max(std::abs(each.value), 1e-3);
  };
  std::ranges::sort(found, {}, change);
  if (found.size() > most_remedies) found.resize(most_remedies);
  return found;
}

/// One scan with a segmenter.
class Segmented {
 public:
  Segmented(const Points& points, const SensorModel& sensor, const std::string& method,
            const ParameterSettings& settings) {
    found_.trace = &trace_;
    Segmenters::make<Segmenter>(method, settings)(points, sensor, found_);
  }

  [[nodiscard]] const Segmentation& found() const { return found_; }
  [[nodiscard]] const SegmentationTrace& trace() const { return trace_; }
  [[nodiscard]] PointOutcome outcome(std::size_t i) const { return trace_.outcomes[i]; }

 private:
  Segmentation found_;
  SegmentationTrace trace_;
};

std::size_t nearest_point(const PointsView& points, const Place& place, double& distance) {
  std::size_t nearest = 0;
  distance = std::numeric_limits<double>::infinity();
  const double x = place.range.value_or(0.0) * std::cos(place.bearing);
  const double y = place.range.value_or(0.0) * std::sin(place.bearing);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double from = place.range ? std::hypot(points.x[i] - x, points.y[i] - y)
                                    : std::abs(normalized_angle(points.bearing[i] - place.bearing));
    if (from < distance) {
      distance = from;
      nearest = i;
    }
  }
  return nearest;
}

/// The points around `i` for which `same` holds without a gap.
Segment run_of(std::size_t i, std::size_t count, const std::function<bool(std::size_t)>& same) {
  Segment run{i, i + 1};
  while (run.begin > 0 && same(run.begin - 1)) --run.begin;
  while (run.end < count && same(run.end)) ++run.end;
  return run;
}

/// The step that is in the way, and those parameters that decide at it.
std::vector<std::string> deciding(PointOutcome outcome) {
  switch (outcome) {
    case PointOutcome::too_few_points:
      return {"min_points"};
    case PointOutcome::too_short:
      return {"min_length"};
    case PointOutcome::too_bent:
      return {"max_bend"};
    case PointOutcome::too_narrow:
      return {"split_distance", "noise_factor"};
    case PointOutcome::foreign:
      return {"min_points", "max_line_gap"};
    case PointOutcome::off_line:
    case PointOutcome::arc:
      return {"flatness", "noise_factor"};
    default:
      return {"split_distance", "breakpoint_angle"};
  }
}

/// Where no single parameter helps: those that get the points beyond the step that decides now.
std::vector<Remedy> first_remedies(const Points& points, const SensorModel& sensor,
                                   const MethodChoice& choice,
                                   const std::vector<ParameterInfo>& infos, std::size_t i,
                                   PointOutcome outcome) {
  std::vector<ParameterInfo> few;
  const std::vector<std::string> names = deciding(outcome);
  for (const ParameterInfo& info : infos) {
    if (std::ranges::find(names, info.name) != names.end()) few.push_back(info);
  }
  auto found = remedies(few, choice.settings, [&](const ParameterSettings& settings) {
    return Segmented(points, sensor, choice.method, settings).outcome(i) != outcome;
  });
  for (Remedy& each : found) each.first_of_several = true;
  return found;
}

/// Lines of a scan, and the segment of each.
struct Lines {
  std::vector<LineSegment> lines;
  std::vector<Segment> segments;
  std::string failure;              // of the segment that is asked for
  std::optional<std::size_t> line;  // of that
};

Lines fit_lines(const Points& points, const Segmentation& found, const SensorModel& sensor,
                const Fitter& fit, const Segment& wanted) {
  Lines result;
  for (const Segment& segment : found.segments) {
    const PointsView own = points.view().subview(segment.begin, segment.end);
    const FitResult line = fit(own, sensor);
    if (!line.ok()) {
      if (segment == wanted) result.failure = enum_name(line.failure);
      continue;
    }
    if (segment == wanted) result.line = result.lines.size();
    result.lines.push_back(
        true_segment(line, own, sensor, chi_square(line.estimate.line, own, sensor)));
    result.segments.push_back(segment);
  }
  return result;
}

void explain_corners(const Lines& lines, const SensorModel& sensor, const MethodChoice& choice,
                     Explanation& result) {
  const std::size_t line = *result.line;
  const auto find = [&](const ParameterSettings& settings) {
    FoundCorners found;
    CornerFinders::make<CornerFinder>(choice.method, settings)(lines.lines,
                                                               sensor.range_bias_stddev, found);
    return found;
  };
  const FoundCorners now = find(choice.settings);
  for (const Corner& corner : now.corners) {
    if (corner.first_line == line || corner.second_line == line) ++result.corners;
  }
  const auto infos = parameters_of(CornerFinders::descriptions(), choice.method);
  for (const NoCorner& none : now.without) {
    if (none.first_line != line && none.second_line != line) continue;
    MissingCorner missing{none.first_line == line ? none.second_line : none.first_line,
                          std::string(enum_name(none.reason)),
                          {}};
    missing.remedies = remedies(infos, choice.settings, [&](const ParameterSettings& settings) {
      const FoundCorners found = find(settings);
      return std::ranges::any_of(found.corners, [&](const Corner& corner) {
        return corner.first_line == none.first_line && corner.second_line == none.second_line;
      });
    });
    result.missing_corners.push_back(std::move(missing));
  }
}

}  // namespace

Place Place::at(double x, double y) { return {std::atan2(y, x), std::hypot(x, y)}; }

Explanation explain(const ScanView& scan, const SensorModel& sensor, const MethodChain& chain,
                    const Place& place) {
  Points points;
  convert(scan, points);
  Explanation result;
  if (points.size() == 0) return result;
  const std::size_t i = nearest_point(points, place, result.distance);
  result.measured = true;
  result.x = points.x[i];
  result.y = points.y[i];

  const MethodChoice& segmenter = chain.segmenter;
  const Segmented now(points, sensor, segmenter.method, segmenter.settings);
  result.outcome = now.outcome(i);
  const auto& surfaces = now.trace().surfaces;
  const auto on_surface = [&](std::size_t k) { return surfaces[k] == surfaces[i]; };
  result.surface_points = run_of(i, points.size(), on_surface).size();
  const Segment alike = run_of(i, points.size(), [&](std::size_t k) {
    return on_surface(k) && now.outcome(k) == result.outcome;
  });
  result.points = alike.size();
  result.extent = std::sqrt(squared_distance(points, alike.begin, alike.end - 1));

  if (result.outcome != PointOutcome::segment) {
    const auto infos = parameters_of(Segmenters::descriptions(), segmenter.method);
    result.remedies = remedies(infos, segmenter.settings, [&](const ParameterSettings& settings) {
      return Segmented(points, sensor, segmenter.method, settings).outcome(i) ==
             PointOutcome::segment;
    });
    if (result.remedies.empty()) {
      result.remedies = first_remedies(points, sensor, segmenter, infos, i, result.outcome);
    }
    return result;
  }
  const auto& segments = now.found().segments;
  const auto own = std::ranges::find_if(
      segments, [&](const Segment& each) { return each.begin <= i && i < each.end; });
  result.points = own->size();
  result.extent = std::sqrt(squared_distance(points, own->begin, own->end - 1));

  // The index i is of the points before the foreign ones are set aside; lines are fitted after.
  const auto number = static_cast<std::size_t>(own - segments.begin());
  Segmentation found = now.found();
  found.trace = nullptr;
  set_aside(points, found);
  const Lines lines = fit_lines(points, found, sensor,
                                Fitters::make<Fitter>(chain.fitter.method, chain.fitter.settings),
                                found.segments[number]);
  result.fit_failure = lines.failure;
  result.line = lines.line;
  if (result.line) explain_corners(lines, sensor, chain.finder, result);
  return result;
}

}  // namespace quoin
