// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/mapping/landmark_graph.hpp"
#include "core/mapping/line_alignment.hpp"
#include "core/mapping/localizer.hpp"
#include "core/mapping/point_map.hpp"
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
///    and a trial on a copy of the graph; it is taken out, with the walls merged since, when its
///    chi square grows beyond a gate later.
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
  static constexpr const char* state = "landmarks/3";

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
  [[nodiscard]] std::size_t closed_loops() const { return closed_loops_; }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.graph_, self.clouds_, self.given_, self.active_, self.belief_, self.since_,
            self.search_covariance_, self.well_matched_, self.base_keyframe_,
            self.base_is_keyframe_, self.last_pose_, self.velocity_, self.stamp_, self.lost_since_,
            self.unfit_scans_, self.found_scans_, self.back_scans_, self.last_share_,
            self.has_odometry_, self.fits_, self.lost_, self.refreshed_at_,
            self.refreshed_keyframe_, self.last_loop_keyframe_, self.closed_loops_,
            self.pending_loops_, self.odometry_scale_, self.judged_motions_, self.registered_,
            self.candidate_, self.near_);
  }

 private:
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;  // measurement, place in active_
  /// Pose and walls around with their joint covariance.
  struct Belief {
    Pose2 pose;
    std::vector<Eigen::Vector2d> walls;  // (phi, offset) of active_
    Eigen::MatrixXd covariance;

    template <class Archive, class Self>
    static void transfer(Archive& archive, Self& self) {
      archive(self.pose, self.walls, self.covariance);
    }
  };

  [[nodiscard]] LineLandmark wall(const Belief& belief, std::size_t place) const;
  [[nodiscard]] Belief predict(const PoseEstimate& motion) const;
  void collect_points(const LocalizationInput& input);
  void rebuild_near();
  [[nodiscard]] std::optional<Registration> register_scan(const Pose2& predicted,
                                                          const PoseWindow& window);
  void fuse(const Registration& registration);
  void judge_odometry(const PoseEstimate& motion, const Registration& registration);
  [[nodiscard]] Pairs associate(Belief belief, double widest_direction, double widest_offset) const;
  [[nodiscard]] Pairs find_pairs(const Belief& prior, double& weakening) const;
  [[nodiscard]] double length_of(const Pairs& pairs) const;
  [[nodiscard]] double length_of_scan() const;
  [[nodiscard]] Pairs associate_by_alignment(const Belief& belief, double& weakening) const;
  bool update(const Belief& prior, Pairs& pairs, Belief& posterior) const;
  void judge(const Belief& posterior, const Pairs& pairs, Localization& result);
  [[nodiscard]] std::size_t nearest_keyframe(const Pose2& pose) const;
  [[nodiscard]] bool is_known(const Pose2& pose, double matched, double total) const;
  void go_on(const Belief& posterior);
  void add_keyframe(const Belief& posterior, const Pairs& pairs);
  void refresh();
  void merge_same_walls();
  bool close_loop();
  void check_loops();
  [[nodiscard]] std::vector<SurfacePoint> points_around(std::size_t keyframe, std::size_t first,
                                                        std::size_t last) const;
  void build_whole();
  [[nodiscard]] std::optional<Registration> find_in_whole();
  [[nodiscard]] double contradicted_length(const Registration& registration) const;
  [[nodiscard]] bool lies_at(const Registration& registration) const;
  bool relocalize(const LocalizationInput& input);
  [[nodiscard]] double seen_through(const Pose2& pose, std::span<const std::size_t> walls) const;

  Parameters parameters_;
  LandmarkGraph graph_;
  std::vector<std::size_t> active_;                              // landmarks of the filter
  Belief belief_;                                                // at the last keyframe
  PoseEstimate since_;                                           // motion since the last keyframe
  Eigen::Matrix3d search_covariance_ = Eigen::Matrix3d::Zero();  // of it, to find lines by
  bool well_matched_ = true;
  std::size_t base_keyframe_ = 0;  // that belief_ comes from
  bool base_is_keyframe_ = true;   // and whether it is still of its pose
  Pose2 scan_pose_;                // by the points alone
  Eigen::Matrix3d scan_covariance_ = Eigen::Matrix3d::Identity();
  double last_share_ = 0.0;  // the same of the last scan that fitted
  double share_ = 0.0;       // of the points of the scan that lie on the map around
  Pose2 last_pose_;          // of the last scan
  Pose2 expected_step_;      // since then, before anything was seen
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  std::optional<double> stamp_;
  double lost_since_ = 0.0;  // [s] stamp of the first scan that did not fit
  int unfit_scans_ = 0;
  int found_scans_ = 0;  // in a row that lie at candidate_
  int back_scans_ = 0;   // in a row that fit where a lost robot should be
  bool has_odometry_ = false;
  bool fits_ = true;
  bool lost_ = false;
  Pose2 refreshed_at_;
  std::size_t refreshed_keyframe_ = 0;
  std::size_t last_loop_keyframe_ = 0;
  std::size_t closed_loops_ = 0;
  std::vector<LandmarkGraph::Edge> pending_loops_;
  /// By how much the squared errors of odometry are larger than its covariances say: of the
  /// translation and of the heading.
  Eigen::Vector2d odometry_scale_ = Eigen::Vector2d::Ones();
  std::size_t judged_motions_ = 0;
  std::optional<Pose2> registered_;  // the last scan
  std::optional<Pose2> candidate_;   // a pose found again, until the next scans confirm it
  double next_search_ = 0.0;         // [s] stamp from which the whole map is searched again
  PointMap whole_;                   // empty unless the robot is lost
  PoseWindow whole_window_;
  std::vector<LineMeasurement> measurements_;
  PoseEstimate motion_;                            // since_ with what the points say
  std::vector<std::vector<SurfacePoint>> clouds_;  // of the keyframes
  std::vector<SurfacePoint> scan_;
  PointMap near_;
  std::vector<Eigen::Matrix2d> given_;  // covariances of the landmarks of a map that stays as it is
};

}  // namespace quoin
