// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "core/geometry/angle.hpp"
#include "core/mapping/nearby_points.hpp"
#include "core/mapping/wall_matching.hpp"
#include "core/mapping/wall_selection.hpp"

namespace quoin {
namespace {

constexpr double back_share = 0.85;  // of a scan that fits where the robot should be
const Eigen::Matrix3d unknown_place = Eigen::Vector3d(0.25, 0.25, 0.1).asDiagonal();

PoseEstimate pose_of(const WallBelief& belief) {
  return {belief.pose, belief.covariance.topLeftCorner<3, 3>()};
}

}  // namespace

void Landmarks::operator()(const LocalizationInput& input, Localization& result) {
  take_scan(input);
  refreshed_ = false;
  if (graph_.keyframes().empty()) {
    begin(result);
  } else {
    localize(input, result);
  }
  report(input, result);
  // What can wait waits for a scan with less to do.
  if (given_.empty() && !refreshed_ && !loss_.is_lost()) loops_.work(graph_, clouds_);
  stamp_ = input.stamp;
}

/// Lines and points of the scan; where there are none, points of its lines.
void Landmarks::take_scan(const LocalizationInput& input) {
  measurements_.clear();
  for (const LineSegment& line : input.lines) {
    const LineMeasurement m = line_measurement(line, parameters_.flatness_stddev);
    if (m.half_length > 0.0 && m.covariance.allFinite() && m.covariance.determinant() > 0.0) {
      measurements_.push_back(m);
    }
  }
  if (input.points.empty()) {
    points_of(measurements_, scan_);
  } else {
    surface_points(input.points, point_spacing, 2.0 * parameters_.reach, scan_);
  }
}

void Landmarks::begin(Localization& result) {
  belief_.covariance = 1e-10 * Eigen::Matrix3d::Identity();
  add_keyframe(belief_, {});
  result.pose = pose_of(belief_);
  result.status = LocalizationStatus::tracking;
  result.matched = 0;
  result.weak_direction.reset();
  last_pose_ = belief_.pose;
}

void Landmarks::localize(const LocalizationInput& input, Localization& result) {
  const double seconds = stamp_ ? std::max(1e-3, input.stamp - *stamp_) : 0.1;
  has_odometry_ = input.motion.has_value();
  add_motion(input.motion, seconds);
  const bool found_again = loss_.is_lost() && find_again(input);
  const PoseWindow window = window_of(input.motion, seconds, found_again);
  const Pose2 expected_step = between(last_pose_, window.center);
  register_points(input.motion, window);

  const std::vector<LineLandmark>& map = graph_.landmarks();
  auto [pairs, weakening] =
      WallMatching({map, measurements_, belief_, since_, motion_.pose, search_covariance_}).find();
  motion_.covariance *= weakening;
  const WallBelief prior = predict(belief_, motion_);
  WallBelief posterior;
  update_with(prior, map, measurements_, pairs, posterior);
  if (pairs.empty()) posterior = prior;

  const ScanJudgement judged = judge({map, measurements_, posterior, pairs, share_, last_share_,
                                      scan_.size(), expected_step, has_odometry_});
  result.matched = pairs.size();
  result.pose = pose_of(posterior);
  result.weak_direction = judged.weak_direction;
  result.status = loss_.is_lost() ? LocalizationStatus::lost : judged.status;
  const double matched = length_of(pairs, measurements_);
  const double total = length_of(measurements_);
  well_matched_ = matched >= 0.5 * total && !pairs.empty();
  if (judged.fits) {
    last_share_ = share_;
    loss_.add_fit(input.stamp, share_ > back_share && pairs.size() >= 3 && matched > 0.7 * total);
  } else if (loss_.add_misfit(input.stamp)) {
    relocalization_.forget_map();
    result.status = LocalizationStatus::lost;
  }
  registered_.reset();
  if (share_ > 0.0) registered_ = posterior.pose;
  // Where a scan does not fit, the next one is expected as if this one had not been.
  if (judged.fits) velocity_ = twist_of(between(last_pose_, posterior.pose)) / seconds;
  last_pose_ = judged.fits ? posterior.pose : window.center;
  if (!judged.fits || loss_.is_lost() || !is_next_keyframe(posterior, matched, total)) return;
  if (is_known(posterior.pose, matched, total)) {
    go_on(posterior);
  } else {
    add_keyframe(posterior, pairs);
  }
  // What the graph has smoothed moves the last scan along.
  if (base_is_keyframe_ && since_.pose.x == 0.0 && since_.pose.y == 0.0) {
    last_pose_ = belief_.pose;
    if (registered_) registered_ = belief_.pose;
    result.pose = pose_of(belief_);
  }
}

void Landmarks::add_motion(const std::optional<PoseEstimate>& motion, double seconds) {
  if (motion) {
    since_ = compose_correlated(since_, odometry_scale_.scaled(*motion));
    search_covariance_ = since_.covariance;
    return;
  }
  // From the last scan on; the spread grows with the time since the last keyframe.
  const Pose2 pose = compose(last_pose_, after_twist(velocity_, seconds));
  const double position = parameters_.speed_stddev * seconds;
  const double heading = parameters_.turn_stddev * seconds;
  since_.pose = between(belief_.pose, pose);
  const Eigen::Vector3d variances(position * position, position * position, heading * heading);
  since_.covariance.diagonal() += variances;
  // Where the last scan was matched, lines are looked for around it; the estimate takes no more
  // from it than where to look, so that no scan counts twice.
  if (well_matched_) search_covariance_.setZero();
  search_covariance_.diagonal() += variances;
}

/// Where the points of the scan are looked for.
PoseWindow Landmarks::window_of(const std::optional<PoseEstimate>& motion, double seconds,
                                bool found_again) const {
  PoseWindow window;
  window.center = compose(belief_.pose, since_.pose);
  if (motion) {
    const Pose2& step = motion->pose;
    window.translation = 0.15 + 0.3 * std::hypot(step.x, step.y);
    window.turn = 0.05 + 0.3 * std::abs(step.theta);
    if (!found_again) window.center = compose(last_pose_, step);
  } else {
    window.translation = std::clamp(3.0 * parameters_.speed_stddev * seconds, 0.1, 1.0);
    window.turn = std::clamp(3.0 * parameters_.turn_stddev * seconds, 0.05, 0.8);
  }
  return window;
}

/// A robot that is lost and found goes on from there.
bool Landmarks::find_again(const LocalizationInput& input) {
  const std::optional<Registration> found =
      relocalization_.look({graph_, clouds_, measurements_, scan_, input.stamp, input.motion});
  if (!found) return false;
  const Pose2 pose = found->estimate.pose;
  // On from the keyframe that is nearest, as far from it as the points say.
  if (given_.empty()) {
    base_keyframe_ = nearest_keyframe(graph_, pose);
    base_is_keyframe_ = true;
    const Pose2 from = graph_.keyframes()[base_keyframe_].pose;
    belief_.pose = from;
    refresh();
    since_ = {between(belief_.pose, compose(belief_.pose, between(from, pose))),
              covariance_in_frame(from, found->estimate.covariance)};
  } else {
    belief_.pose = pose;
    belief_.covariance = found->estimate.covariance;
    since_ = PoseEstimate{};
    since_.covariance = Eigen::Vector3d(1e-6, 1e-6, 1e-8).asDiagonal();
    refresh();
  }
  search_covariance_ = since_.covariance;
  last_pose_ = compose(belief_.pose, since_.pose);
  rebuild_near();
  registered_.reset();
  loss_.found();
  return true;
}

/// The motion since the last keyframe by odometry and by the points together.
void Landmarks::register_points(const std::optional<PoseEstimate>& motion,
                                const PoseWindow& window) {
  motion_ = since_;
  by_points_ = {window.center, unknown_place};
  share_ = 0.0;
  const std::optional<Registration> found = register_scan(near_, scan_, window.center, window);
  if (!found) return;
  by_points_ = found->estimate;
  share_ = found->share;
  if (motion && registered_) {
    odometry_scale_.judge(*motion, between(*registered_, by_points_.pose), by_points_.covariance);
  }
  motion_ = fuse(since_, {between(belief_.pose, by_points_.pose),
                          covariance_in_frame(belief_.pose, by_points_.covariance)});
  search_covariance_ = motion_.covariance;
}

bool Landmarks::is_next_keyframe(const WallBelief& posterior, double matched, double total) const {
  const Pose2 way = between(belief_.pose, posterior.pose);
  const double driven = std::hypot(way.x, way.y);
  const double turned = std::abs(way.theta);
  const double part = matched < 0.7 * total ? 0.25 : 1.0;  // sooner where the scan shows new walls
  return driven > part * parameters_.keyframe_distance ||
         turned > part * parameters_.keyframe_angle;
}

void Landmarks::report(const LocalizationInput& input, Localization& result) const {
  result.keyframe.reset();
  if (given_.empty()) {
    result.keyframe =
        base_is_keyframe_ ? base_keyframe_ : nearest_keyframe(graph_, result.pose.pose);
    result.in_keyframe = between(graph_.keyframes()[*result.keyframe].pose, result.pose.pose);
  }
  result.map.clear();
  if (!input.wants_map) return;
  for (std::size_t i = 0; i < graph_.landmarks().size(); ++i) {
    const LineLandmark& landmark = graph_.landmarks()[i];
    if (!landmark.alive || landmark.observations < 3) continue;
    MapLine line;
    line.id = i;
    line.start = landmark.at(landmark.low);
    line.end = landmark.at(landmark.high);
    line.observations = landmark.observations;
    result.map.push_back(line);
  }
}

std::vector<Pose2> Landmarks::keyframes() const {
  std::vector<Pose2> poses;
  if (!given_.empty()) return poses;
  poses.reserve(graph_.keyframes().size());
  for (const LandmarkGraph::Keyframe& keyframe : graph_.keyframes()) {
    poses.push_back(keyframe.pose);
  }
  return poses;
}

void Landmarks::use_map(std::span<const MapLine> map, const std::optional<PoseEstimate>& pose) {
  reset();
  for (const GivenWall& wall : given_walls(map, parameters_.plan_stddev)) {
    graph_.add_landmark(wall.landmark);
    given_.push_back(wall.covariance);
  }
  const PoseEstimate from =
      pose.value_or(PoseEstimate{{}, Eigen::Vector3d(1e4, 1e4, 1e1).asDiagonal()});
  if (!pose) loss_.begin_lost();
  graph_.add_keyframe(0, from.pose, {});
  belief_.pose = last_pose_ = from.pose;
  belief_.covariance = from.covariance;
  refresh();
  rebuild_near();
}

}  // namespace quoin
