// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/localizer.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/extraction/extraction.hpp"
#include "core/fitting/fitters.hpp"
#include "core/mapping/localizers.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {
namespace {

/// A robot that drives through a built-in world, 5 cm from scan to scan.
class Drive {
 public:
  explicit Drive(const char* world) : world_(built_in_world(world).value()) {
    settings_.points = 360;
  }
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] Pose2 truth() const { return world_.pose_at(distance_); }

  /// The same scans for all that are given, each with odometry.
  void go_on(const std::vector<Localizer*>& localizers, std::vector<Localization>& results) {
    const Pose2 before = truth();
    if (seed_ > 0) distance_ += 0.05;
    SimulatedScanner scanner(world_, settings_, ++seed_);
    scanner.scan(distance_, 0.0, scan_);
    extraction_.run(view(scan_, settings_), settings_.noise, settings_.noise);
    LocalizationInput input;
    input.stamp = 0.1 * static_cast<double>(seed_);
    input.lines = extraction_.lines();
    input.corners = extraction_.corners();
    input.wants_map = true;
    const Pose2 increment = between(before, truth());
    if (seed_ > 1) input.motion = PoseEstimate{increment, OdometryNoise{}.covariance(increment)};
    results.resize(localizers.size());
    for (std::size_t i = 0; i < localizers.size(); ++i) (*localizers[i])(input, results[i]);
  }

 private:
  World world_;
  ScannerSettings settings_;
  SimulatedScan scan_;
  Extraction extraction_{Segmenters::make<Segmenter>("iepf", {}),
                         Fitters::make<Fitter>("inverse_range", {}),
                         CornerFinders::make<CornerFinder>("adjacent", {})};
  double distance_ = 0.0;
  std::uint64_t seed_ = 0;
};

class AllLocalizers : public testing::TestWithParam<std::string> {};

TEST_P(AllLocalizers, GoOnFromASavedStateAsIfNothingHadBeen) {
  Drive drive("domestic_room");
  Localizer first = Localizers::make<Localizer>(GetParam(), {});
  std::vector<Localization> results;
  for (int i = 0; i < 60; ++i) drive.go_on({&first}, results);
  Localizer second = Localizers::make<Localizer>(GetParam(), {});
  second.restore(first.save());
  for (int i = 0; i < 60; ++i) {
    drive.go_on({&first, &second}, results);
    EXPECT_EQ(results[0].pose.pose.x, results[1].pose.pose.x);
    EXPECT_EQ(results[0].pose.pose.y, results[1].pose.pose.y);
    EXPECT_EQ(results[0].pose.pose.theta, results[1].pose.pose.theta);
    EXPECT_EQ(results[0].pose.covariance, results[1].pose.covariance);
    EXPECT_EQ(results[0].map.size(), results[1].map.size());
  }
  EXPECT_EQ(first.save(), second.save());
}

TEST_P(AllLocalizers, RejectADamagedStateAndKeepTheirOwn) {
  Drive drive("domestic_room");
  Localizer localizer = Localizers::make<Localizer>(GetParam(), {});
  std::vector<Localization> results;
  for (int i = 0; i < 20; ++i) drive.go_on({&localizer}, results);
  const std::vector<std::uint8_t> before = localizer.save();
  for (const std::size_t kept :
       {std::size_t{0}, std::size_t{7}, before.size() / 2, before.size() - 1}) {
    EXPECT_THROW(localizer.restore(std::span(before).first(kept)), std::invalid_argument) << kept;
  }
  std::vector<std::uint8_t> longer = before;
  longer.push_back(0);
  EXPECT_THROW(localizer.restore(longer), std::invalid_argument);
  EXPECT_EQ(localizer.save(), before);
}

/// The walls as an architect draws them.
std::vector<MapLine> plan_of(const World& world) {
  std::vector<MapLine> plan;
  for (const Wall& wall : world.walls) {
    MapLine line;
    line.start = wall.start;
    line.end = wall.end;
    plan.push_back(line);
  }
  return plan;
}

TEST_P(AllLocalizers, LeaveAGivenMapAsItIs) {
  Drive drive("domestic_room");
  const std::vector<MapLine> plan = plan_of(drive.world());
  Localizer localizer = Localizers::make<Localizer>(GetParam(), {});
  localizer.use_map(plan, PoseEstimate{drive.truth(), 1e-4 * Eigen::Matrix3d::Identity()});
  std::vector<Localization> results;
  std::size_t lines = 0;
  for (int i = 0; i < 100; ++i) {
    drive.go_on({&localizer}, results);
    if (i == 0) lines = results[0].map.size();
    EXPECT_EQ(results[0].map.size(), lines);
    EXPECT_NEAR(results[0].pose.pose.x, drive.truth().x, 0.05);
    EXPECT_NEAR(results[0].pose.pose.y, drive.truth().y, 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, AllLocalizers, testing::Values("landmarks", "angular_offsets"),
                         [](const auto& method) { return method.param; });

TEST(Landmarks, FindThemselvesInAGivenMap) {
  Drive drive("environment_b");
  const std::vector<MapLine> plan = plan_of(drive.world());
  Localizer localizer = Localizers::make<Localizer>("landmarks", {});
  localizer.use_map(plan, std::nullopt);
  std::vector<Localization> results;
  for (int i = 0; i < 100; ++i) {
    drive.go_on({&localizer}, results);
    if (i == 0) {
      EXPECT_EQ(results[0].status, LocalizationStatus::lost);
    }
    if (results[0].status != LocalizationStatus::tracking) continue;
    EXPECT_NEAR(results[0].pose.pose.x, drive.truth().x, 0.1) << i;
    EXPECT_NEAR(results[0].pose.pose.y, drive.truth().y, 0.1) << i;
  }
  EXPECT_EQ(results[0].status, LocalizationStatus::tracking);
}

}  // namespace
}  // namespace quoin
