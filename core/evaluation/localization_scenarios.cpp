// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/localization_scenarios.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "core/geometry/angle.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/wheel_odometry.hpp"

namespace quoin {
namespace {

constexpr double drive_speed = 0.5;          // [m/s]
constexpr double scan_period = 0.1;          // [s]
constexpr double event_time = 25.0;          // [s] doors open, robots are carried away
constexpr double blind_time = 3.0;           // [s]
constexpr double wrong_beyond = 22.06;       // chi square of 3, 99.9937 %: 4 sigma of one dimension
constexpr double leg_radius = 0.07;          // [m]
constexpr double corridor_range_max = 12.0;  // [m]

struct Stage {
  World world;
  std::vector<Wall> before_event, after_event;  // that are not there all the time
  double carried = 0.0;                         // [m] along the path
  double carried_turn = 0.0;                    // [rad]
  std::size_t people = 0;
  double range_max = 40.0;  // [m]
  bool goes_blind = false;
};

void add_box(World& world, const Eigen::Vector2d& low, double width, double depth) {
  const Eigen::Vector2d x(width, 0.0), y(0.0, depth);
  world.add_polyline({low, low + x, low + x + y, low + y}, true);
}

/// A room of this size with cabinets along its walls, of which no two are alike.
void add_furnished_room(World& world, const Eigen::Vector2d& low, double width, double depth,
                        Random& random) {
  add_box(world, low, width, depth);
  add_box(world, low + Eigen::Vector2d(0.0, random.uniform(0.2, 0.4) * depth),
          random.uniform(0.3, 0.6), random.uniform(0.5, 1.0));
  add_box(world, low + Eigen::Vector2d(random.uniform(0.3, 0.5) * width, 0.0),
          random.uniform(0.6, 1.4), random.uniform(0.3, 0.5));
  const double wide = random.uniform(0.5, 1.2);
  const double deep = random.uniform(0.3, 0.6);
  add_box(world, low + Eigen::Vector2d(random.uniform(0.5, 0.8) * (width - wide), depth - deep),
          wide, deep);
}

/// A way through these points, turned into its direction.
void set_path(World& world, const std::vector<Eigen::Vector2d>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t from = std::min(i, points.size() - 2);
    const Eigen::Vector2d along = points[from + 1] - points[from];
    world.path.push_back({points[i].x(), points[i].y(), direction_of(along.x(), along.y())});
  }
}

Stage staged(LocalizationScenario scenario, Random& random) {
  Stage stage;
  World& world = stage.world;
  const double width = random.uniform(6.5, 9.0);
  const double depth = random.uniform(4.5, 6.0);
  switch (scenario) {
    case LocalizationScenario::corridor: {
      const double wide = random.uniform(1.6, 2.4);
      world.walls = {{{-60.0, 0.0}, {60.0, 0.0}}, {{60.0, wide}, {-60.0, wide}}};
      set_path(world, {{-10.0, 0.4 * wide}, {0.0, 0.6 * wide}, {10.0, 0.4 * wide}});
      stage.range_max = corridor_range_max;
      break;
    }
    case LocalizationScenario::opening_door: {
      add_furnished_room(world, {0.0, 0.0}, width, depth, random);
      add_furnished_room(world, {width + 0.1, 0.0}, width, depth, random);
      // The walls between the rooms get a gap for the door.
      const double door = random.uniform(0.8, 1.0);
      const double y = random.uniform(0.45, 0.6) * depth;
      std::erase_if(world.walls, [&](const Wall& wall) {
        return wall.start.x() == wall.end.x() && std::abs(wall.start.x() - width) < 0.11 &&
               std::abs(wall.start.y() - wall.end.y()) > 0.9 * depth;
      });
      for (const double x : {width, width + 0.1}) {
        world.walls.push_back({{x, 0.0}, {x, y}});
        world.walls.push_back({{x, y + door}, {x, depth}});
      }
      world.walls.push_back({{width, y}, {width + 0.1, y}});
      world.walls.push_back({{width, y + door}, {width + 0.1, y + door}});
      stage.before_event = {{{width + 0.05, y}, {width + 0.05, y + door}}};
      stage.after_event = {{{width + 0.1, y}, {width + 0.1 + door, y + 0.05}}};
      set_path(world,
               {{1.2, 1.2}, {width - 1.2, 1.2}, {width - 1.2, depth - 1.2}, {1.2, depth - 1.2}});
      break;
    }
    case LocalizationScenario::parallel_walls: {
      add_box(world, {0.0, 0.0}, width + 2.0, depth + 2.0);
      // One as thick as that, and one before the outer wall.
      add_box(world, {0.3 * width, 0.5 * depth + 0.75}, 0.4 * width, 0.5);
      world.walls.push_back({{0.3 * width, 0.5}, {0.7 * width, 0.5}});
      add_box(world, {0.0, 0.6 * depth}, random.uniform(0.3, 0.6), random.uniform(0.5, 1.0));
      set_path(world,
               {{1.2, 1.4}, {width + 0.8, 1.4}, {width + 0.8, depth + 0.8}, {1.2, depth + 0.8}});
      break;
    }
    case LocalizationScenario::rooms_alike: {
      const double wide = 1.5;
      const double door = 0.9;
      const Random same = random;
      for (int room = 0; room < 2; ++room) {
        Random furniture = same;
        World one;
        add_furnished_room(one, {room * (width + 0.1), wide}, width, depth, furniture);
        one.walls.erase(one.walls.begin());  // towards the corridor
        std::erase_if(one.walls, [&](const Wall& wall) {
          return std::min(wall.start.y(), wall.end.y()) < wide + 0.55;
        });
        const double x = room * (width + 0.1);
        one.walls.push_back({{x, wide}, {x, wide + depth}});
        one.walls.push_back({{x + width, wide}, {x + width, wide + depth}});
        one.walls.push_back({{x, wide}, {x + 0.5 * width, wide}});
        one.walls.push_back({{x + 0.5 * width + door, wide}, {x + width, wide}});
        world.walls.insert(world.walls.end(), one.walls.begin(), one.walls.end());
      }
      const double length = 2.0 * width + 0.1;
      world.add_polyline({{0.0, wide}, {0.0, 0.0}, {length, 0.0}, {length, wide}}, false);
      const double middle = 0.5 * (width + door);
      const double other = middle + width + 0.1;
      set_path(world, {{middle, wide + 0.5 * depth},
                       {middle, 0.5 * wide},
                       {other, 0.5 * wide},
                       {other, wide + 0.5 * depth}});
      break;
    }
    case LocalizationScenario::passing_people:
    case LocalizationScenario::kidnapping:
    case LocalizationScenario::blinding: {
      add_furnished_room(world, {0.0, 0.0}, width, depth, random);
      set_path(world,
               {{1.2, 1.2}, {width - 1.2, 1.2}, {width - 1.2, depth - 1.2}, {1.2, depth - 1.2}});
      if (scenario == LocalizationScenario::passing_people) stage.people = 1 + random.index(3);
      if (scenario == LocalizationScenario::kidnapping) {
        stage.carried = random.uniform(2.0, 8.0);
        stage.carried_turn = random.uniform(0.5, 2.0 * pi - 0.5);
      }
      stage.goes_blind = scenario == LocalizationScenario::blinding;
      break;
    }
  }
  return stage;
}

/// Two legs of each, half a metre or more before the robot, at walking speed.
void add_people(World& world, const Pose2& robot, double time, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<double>(i);
    const double across = 1.5 * std::sin(0.7 * time + 2.0 * number);
    const Eigen::Vector2d body = robot.transform({0.7 + 0.4 * number, across});
    for (const double side : {-0.12, 0.12}) {
      world.pillars.push_back(
          {body + Eigen::Vector2d(side, side * std::sin(3.0 * time)), leg_radius});
    }
  }
}

}  // namespace

ScenarioOutcome run_scenario(const ScenarioRun& run, const Localize& localizer,
                             Extraction& extraction) {
  Random random(run.seed);
  const Stage stage = staged(run.scenario, random);
  ScannerSettings settings;
  settings.points = 720;
  settings.period = scan_period;
  settings.range_max = stage.range_max;
  const WheelErrors wheels{0.02, 0.002, {}};
  const bool has_event = stage.carried > 0.0 || stage.goes_blind;
  const auto count = static_cast<std::size_t>(run.duration / scan_period);
  ScenarioOutcome outcome;
  SimulatedScan scan;
  Localization result;
  std::vector<Eigen::Vector2d> points;
  Pose2 origin, previous;
  bool is_carried = false;
  for (; outcome.scans < count; ++outcome.scans) {
    const double time = scan_period * static_cast<double>(outcome.scans);
    const bool after = time >= event_time;
    Pose2 truth = stage.world.pose_at(drive_speed * time + (after ? stage.carried : 0.0));
    if (after) truth.theta = normalized_angle(truth.theta + stage.carried_turn);
    if (outcome.scans == 0) origin = previous = truth;
    World world = stage.world;
    const std::vector<Wall>& extra = after ? stage.after_event : stage.before_event;
    world.walls.insert(world.walls.end(), extra.begin(), extra.end());
    add_people(world, truth, time, stage.people);
    if (stage.goes_blind && after && time < event_time + blind_time) {
      world.walls.clear();
      world.pillars.clear();
    }
    world.path = {truth};
    SimulatedScanner scanner(std::move(world), settings, run.seed * 100003 + outcome.scans);
    scanner.scan(0.0, 0.0, scan);
    extraction.run(view(scan, settings), settings.noise, settings.noise);
    points.clear();
    for (std::size_t i = 0; i < extraction.points().size(); ++i) {
      points.emplace_back(extraction.points().x[i], extraction.points().y[i]);
    }
    LocalizationInput input;
    input.stamp = time;
    input.lines = extraction.lines();
    input.corners = extraction.corners();
    input.points = points;
    if (run.odometry && outcome.scans > 0) {
      // Who carries the robot does not turn its wheels.
      const bool carries = after && !std::exchange(is_carried, after) && stage.carried > 0.0;
      const Pose2 moved = carries ? Pose2{} : between(previous, truth);
      const Pose2 increment = counted_increment(moved, wheels, random);
      input.motion = PoseEstimate{increment, wheels.noise.covariance(increment)};
    }
    previous = truth;
    localizer(input, result);

    const Pose2 expected = between(origin, truth);
    const Pose2& pose = result.pose.pose;
    const Eigen::Vector3d error(pose.x - expected.x, pose.y - expected.y,
                                normalized_angle(pose.theta - expected.theta));
    bool is_right = false;
    switch (result.status) {
      case LocalizationStatus::tracking: {
        ++outcome.tracking;
        outcome.largest_tracked = std::max(outcome.largest_tracked, error.head<2>().norm());
        const double squared = error.dot(result.pose.covariance.inverse() * error);
        is_right = outcome.scans == 0 || squared <= wrong_beyond;
        if (is_right) break;
        ++outcome.confident_wrong;
        if (!outcome.first_wrong) outcome.first_wrong = time;
        break;
      }
      case LocalizationStatus::ambiguous:
        ++outcome.ambiguous;
        break;
      case LocalizationStatus::lost:
        ++outcome.lost;
        break;
    }
    if (!has_event || !after) continue;
    if (!outcome.lost_after && result.status == LocalizationStatus::lost) {
      outcome.lost_after = time - event_time;
    }
    if (outcome.lost_after && !outcome.found_after && is_right) {
      outcome.found_after = time - event_time;
    }
  }
  return outcome;
}

}  // namespace quoin
