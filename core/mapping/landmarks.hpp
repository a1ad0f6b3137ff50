// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "core/mapping/landmark_graph.hpp"
#include "core/mapping/localizer.hpp"
#include "core/mapping/loop_closing.hpp"
#include "core/mapping/motion_fusion.hpp"
#include "core/mapping/point_map.hpp"
#include "core/mapping/relocalization.hpp"
#include "core/mapping/scan_judgement.hpp"
#include "core/mapping/wall_belief.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// Walls as landmarks, in a graph of keyframes, and all points of a scan to find the pose by.
///
/// 1. The points of a scan are registered to those of the keyframes around (PointMap). That gives
///    the motion since the last keyframe, fused with the odometry; without odometry it is looked
///    for around constant velocity. Registrations also judge the odometry: covariances of
///    increments are scaled by the mean of their squared, normalized errors where that is above
///    one.
/// 2. A filter over pose and walls around starts from the joint covariance that the graph gives.
///    Lines are matched by Mahalanobis distance d^2 = v' S^-1 v below 13.8 (chi square of 2,
///    99.9 %), S = H P H' + R, and update it: x = x - K v, K = P H' S^-1, with R enlarged where a
///    line is beyond 2.5 standard deviations. So a scan is counted once, by its lines;
///    registrations enter with 15 mm and 0.004 rad or more, and matter where lines are few.
/// 3. A scan that the map does not know becomes a keyframe. The graph minimizes
///    sum |v_line|^2_R + sum |v_motion|^2_C with Huber's loss.
/// 4. Loops: the points of the last keyframes are looked for in those of long before, in a window
///    that grows with the way. A loop needs one clear best pose, two pairs of keyframes that agree,
///    and a trial on a copy of the graph, which is spread over some scans; it is taken out, with
///    the walls merged since, when its chi square grows beyond a gate later.
/// 5. Where the points do not fit and the walls contradict the scan, the status is `lost`, until
///    a scan fits one place of the whole map and no other by its points, and the next ones, too.
class Landmarks {
 public:
  static constexpr const char* name = "landmarks";
  static constexpr const char* description =
      "walls with their covariances, smoothed in a graph of keyframes; closes loops";
  static constexpr const char* source =
      "Dellaert and Kaess 2006 (square root SAM); Guivant and Nebot 2001 (local filter); Olson "
      "2009 "
      "(correlative matching); Censi 2008 (points to lines)";
  static constexpr const char* choose =
      "For a pose and a map that stay true over many laps, with odometry or with the LiDAR alone. "
      "It says where walls leave a direction open, and finds itself again in its map.";
  static constexpr const char* state = "landmarks/5";

  struct Parameters {
    double keyframe_distance = 0.4;  // [m]
    double keyframe_angle = 0.35;    // [rad]
    double flatness_stddev = 0.0;    // [m]
    double min_length = 0.25;        // [m]
    double reach = 15.0;             // [m]
    double speed_stddev = 0.5;       // [m/s]
    double turn_stddev = 1.0;        // [rad/s]
    double plan_stddev = 0.02;       // [m]

    static constexpr auto fields() {
      return std::make_tuple(
          field(&Parameters::keyframe_distance, "keyframe_distance", "m", 0.01, 10.0,
                "a scan becomes a keyframe after this way"),
          field(&Parameters::keyframe_angle, "keyframe_angle", "rad", 0.01, 3.2,
                "or after this turn"),
          field(&Parameters::flatness_stddev, "flatness_stddev", "m", 0.0, 1.0,
                "how far walls are off a line, beyond what the covariances of lines know"),
          field(&Parameters::min_length, "min_length", "m", 0.0, 100.0,
                "shorter lines make no landmark"),
          field(&Parameters::reach, "reach", "m", 1.0, 200.0,
                "walls nearer than this are compared with the lines of a scan"),
          field(&Parameters::speed_stddev, "speed_stddev", "m/s", 0.001, 50.0,
                "without odometry: how far the speed may be from that of the scan before"),
          field(&Parameters::turn_stddev, "turn_stddev", "rad/s", 0.001, 50.0,
                "the same of the turn rate"),
          field(&Parameters::plan_stddev, "plan_stddev", "m", 0.001, 1.0,
                "of walls of a given map that say nothing of how exact they are"));
    }
  };

  Landmarks() : Landmarks(Parameters{}) {}
  explicit Landmarks(const Parameters& parameters) : parameters_(parameters) {}

  void operator()(const LocalizationInput& input, Localization& result);

  void use_map(std::span<const MapLine> map, const std::optional<PoseEstimate>& pose);
  void reset() { *this = Landmarks(parameters_); }
  /// By the last state of the graph: what was smoothed since counts.
  [[nodiscard]] std::vector<Pose2> keyframes() const;

  [[nodiscard]] const LandmarkGraph& graph() const { return graph_; }
  [[nodiscard]] std::size_t closed_loops() const { return loops_.closed(); }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.graph_, self.clouds_, self.given_, self.belief_, self.since_,
            self.search_covariance_, self.well_matched_, self.base_keyframe_,
            self.base_is_keyframe_, self.last_pose_, self.velocity_, self.stamp_, self.last_share_,
            self.has_odometry_, self.refreshed_at_, self.refreshed_keyframe_, self.refresh_again_,
            self.loops_, self.odometry_scale_, self.registered_, self.loss_, self.relocalization_,
            self.near_);
  }

 private:
  void take_scan(const LocalizationInput& input);
  void begin(Localization& result);
  void localize(const LocalizationInput& input, Localization& result);
  void add_motion(const std::optional<PoseEstimate>& motion, double seconds);
  [[nodiscard]] PoseWindow window_of(const std::optional<PoseEstimate>& motion, double seconds,
                                     bool found_again) const;
  bool find_again(const LocalizationInput& input);
  void register_points(const std::optional<PoseEstimate>& motion, const PoseWindow& window);
  [[nodiscard]] bool is_next_keyframe(const WallBelief& posterior, double matched,
                                      double total) const;
  [[nodiscard]] bool is_known(const Pose2& pose, double matched, double total) const;
  void go_on(const WallBelief& posterior);
  void add_keyframe(const WallBelief& posterior, const WallPairs& pairs);
  void add_new_walls(std::size_t keyframe, const WallPairs& known);
  void refresh();
  void rebuild_near();
  void report(const LocalizationInput& input, Localization& result) const;

  Parameters parameters_;

  // The map.
  LandmarkGraph graph_;
  KeyframePoints clouds_;
  std::vector<Eigen::Matrix2d> given_;  // covariances of the landmarks of a map that stays as it is
  LoopClosing loops_;

  // The filter.
  WallBelief belief_;                                            // at the last keyframe
  PoseEstimate since_;                                           // motion since the last keyframe
  Eigen::Matrix3d search_covariance_ = Eigen::Matrix3d::Zero();  // of it, to find lines by
  OdometryScale odometry_scale_;
  bool well_matched_ = true;
  std::size_t base_keyframe_ = 0;  // that belief_ comes from
  bool base_is_keyframe_ = true;   // and whether it is still of its pose
  Pose2 refreshed_at_;
  std::size_t refreshed_keyframe_ = 0;
  bool refresh_again_ = false;  // with the next keyframe, because a loop was closed
  bool refreshed_ = false;      // in this scan
  PointMap near_;               // points around, that scans are registered to

  // The last scan.
  std::optional<double> stamp_;
  Pose2 last_pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  std::optional<Pose2> registered_;  // its pose, if its points lay on those around
  double last_share_ = 0.0;          // of the points of the last one that fitted
  bool has_odometry_ = false;
  LossMonitor loss_;
  Relocalization relocalization_;

  // This scan.
  std::vector<LineMeasurement> measurements_;
  std::vector<SurfacePoint> scan_;
  PoseEstimate motion_;     // since_ with what the points say
  PoseEstimate by_points_;  // the pose by the points alone
  double share_ = 0.0;      // of the points that lie on those around; 0 when not registered
};

}  // namespace quoin
