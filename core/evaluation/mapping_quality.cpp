// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/mapping_quality.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "core/geometry/angle.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/scanner.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

constexpr double four_sigma_3 = 22.06;     // chi square of 3, 99.9937 %: 4 sigma of one dimension
constexpr double on_wall_distance = 0.05;  // [m]
constexpr double on_wall_angle = 3.0 * pi / 180.0;
constexpr double sample_step = 0.05;  // [m]

/// Whether a point of a line with this direction lies on one of the segments.
template <class Segments>
bool lies_on_any(const Eigen::Vector2d& point, const Eigen::Vector2d& direction,
                 const Segments& segments) {
  return std::any_of(segments.begin(), segments.end(), [&](const auto& segment) {
    const Eigen::Vector2d along = segment.end - segment.start;
    const double length = along.norm();
    if (!(length > 0.0)) return false;
    const Eigen::Vector2d unit = along / length;
    const double sine = unit.x() * direction.y() - unit.y() * direction.x();
    if (std::abs(sine) > std::sin(on_wall_angle)) return false;
    const Eigen::Vector2d from = point - segment.start;
    const double s = unit.dot(from);
    return s > -on_wall_distance && s < length + on_wall_distance &&
           std::abs(unit.x() * from.y() - unit.y() * from.x()) < on_wall_distance;
  });
}

/// Share of the length of `segments` that lies on `others`.
template <class Segments, class Others>
double share_on(const Segments& segments, const Others& others) {
  std::size_t on = 0, all = 0;
  for (const auto& segment : segments) {
    const Eigen::Vector2d along = segment.end - segment.start;
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    const auto samples = static_cast<std::size_t>(std::ceil(length / sample_step));
    for (std::size_t i = 0; i < samples; ++i) {
      const double fraction = (static_cast<double>(i) + 0.5) / static_cast<double>(samples);
      ++all;
      on += lies_on_any(segment.start + fraction * along, along / length, others) ? 1 : 0;
    }
  }
  return all == 0 ? 0.0 : static_cast<double>(on) / static_cast<double>(all);
}

double path_length(const World& world) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < world.path.size(); ++i) {
    length +=
        std::hypot(world.path[i + 1].x - world.path[i].x, world.path[i + 1].y - world.path[i].y);
  }
  return length;
}

/// What wheels with these errors count on the way of this increment.
Pose2 counted(const Pose2& increment, const SimulatedDrive& drive, Random& random) {
  Eigen::Vector3d twist = twist_of(increment);
  const double driven = std::hypot(twist.x(), twist.y());
  const OdometryNoise& noise = drive.odometry_noise;
  twist.head<2>() *= 1.0 + drive.slip;
  twist.x() += noise.translation_floor * random.normal();
  twist.y() += noise.sideways_per_metre * driven * random.normal();
  twist.z() += drive.heading_bias * driven + noise.heading_floor * random.normal() +
               noise.heading_per_radian * twist.z() * random.normal() +
               noise.heading_per_metre * driven * random.normal();
  return after_twist(twist, 1.0);
}

std::optional<Pose2> pose_at(std::span<const StampedPose> trajectory, double stamp, double gap,
                             bool interpolate) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                                      [](const StampedPose& p, double t) { return p.stamp < t; });
  if (!interpolate) {
    auto nearest = after;
    if (after == trajectory.end() ||
        (after != trajectory.begin() && stamp - (after - 1)->stamp < after->stamp - stamp)) {
      if (after == trajectory.begin()) return std::nullopt;
      nearest = after - 1;
    }
    if (std::abs(nearest->stamp - stamp) > gap) return std::nullopt;
    return nearest->pose;
  }
  if (after == trajectory.end()) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;
  const StampedPose& before = *(after - 1);
  if (after->stamp - before.stamp > gap) return std::nullopt;
  const double fraction = (stamp - before.stamp) / (after->stamp - before.stamp);
  return quoin::interpolate(before.pose, after->pose, fraction);
}

}  // namespace

double MappingQuality::mean_nees() const {
  double sum = 0.0;
  for (const double value : nees) sum += value;
  return nees.empty() ? 0.0 : sum / static_cast<double>(nees.size());
}

double MappingQuality::coverage95() const {
  const auto inside = std::count_if(nees.begin(), nees.end(),
                                    [](double value) { return value <= chi_square_3_95; });
  return nees.empty() ? 0.0 : static_cast<double>(inside) / static_cast<double>(nees.size());
}

MappingQuality judge_localizer(const Localize& localizer, Extraction& extraction,
                               const World& world, const SimulatedDrive& drive) {
  ScannerSettings settings;
  settings.points = drive.rays;
  settings.period = drive.period;
  settings.range_max = drive.range_max;
  settings.noise = drive.noise;
  SimulatedScanner scanner(world, settings, drive.seed);
  Random random(drive.seed + 1000003);
  const double step = drive.speed * drive.period;
  const auto scans = static_cast<std::size_t>(2.0 * drive.laps * path_length(world) / step) + 1;
  const Pose2 origin = world.pose_at(0.0);

  MappingQuality quality;
  SimulatedScan scan;
  Localization result;
  Pose2 previous = origin;
  for (; quality.scans < scans; ++quality.scans) {
    const double distance = step * static_cast<double>(quality.scans);
    const Pose2 truth = world.pose_at(distance);
    scanner.scan(distance, 0.0, scan);
    extraction.run(view(scan, settings), drive.noise, drive.noise);
    LocalizationInput input;
    input.stamp = drive.period * static_cast<double>(quality.scans);
    input.lines = extraction.lines();
    input.corners = extraction.corners();
    input.wants_map = quality.scans + 1 == scans;
    if (drive.odometry && quality.scans > 0) {
      const Pose2 increment = counted(between(previous, truth), drive, random);
      input.motion = PoseEstimate{increment, drive.odometry_noise.covariance(increment)};
    }
    previous = truth;
    localizer(input, result);

    const Pose2 expected = between(origin, truth);
    const Eigen::Vector3d error(result.pose.pose.x - expected.x, result.pose.pose.y - expected.y,
                                normalized_angle(result.pose.pose.theta - expected.theta));
    quality.translation_errors.push_back(error.head<2>().norm());
    quality.heading_errors.push_back(std::abs(error.z()));
    quality.tracking += result.status == LocalizationStatus::tracking ? 1 : 0;
    quality.ambiguous += result.status == LocalizationStatus::ambiguous ? 1 : 0;
    quality.lost += result.status == LocalizationStatus::lost ? 1 : 0;
    if (result.status == LocalizationStatus::tracking && quality.scans > 0) {
      const double squared = error.dot(result.pose.covariance.inverse() * error);
      quality.nees.push_back(squared);
      quality.confident_wrong += squared <= four_sigma_3 ? 0 : 1;
    }
  }
  std::vector<Wall> mapped;
  for (const MapLine& line : result.map) {
    mapped.push_back({origin.transform(line.start), origin.transform(line.end)});
  }
  quality.map_lines = mapped.size();
  quality.map_precision = share_on(mapped, world.walls);
  quality.map_recall = share_on(world.walls, mapped);
  return quality;
}

RelationErrors relation_errors(std::span<const StampedPose> trajectory,
                               std::span<const PoseRelation> relations, double largest_gap,
                               bool interpolate) {
  RelationErrors errors;
  for (const PoseRelation& relation : relations) {
    const auto first = pose_at(trajectory, relation.first, largest_gap, interpolate);
    const auto second = pose_at(trajectory, relation.second, largest_gap, interpolate);
    if (!first || !second) {
      ++errors.skipped;
      continue;
    }
    const Pose2 error = between(relation.relative, between(*first, *second));
    errors.translation.push_back(std::hypot(error.x, error.y));
    errors.rotation.push_back(std::abs(error.theta));
  }
  return errors;
}

}  // namespace quoin
