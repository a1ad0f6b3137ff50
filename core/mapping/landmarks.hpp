// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/mapping/landmark_graph.hpp"
#include "core/mapping/line_alignment.hpp"
#include "core/mapping/localizer.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// Walls as landmarks: a graph of keyframes and walls, and a filter over the last keyframe and the
/// walls around, which starts from the joint covariance that the graph gives for them. Scans in
/// between only read the filter, so that none counts twice.
class Landmarks {
 public:
  static constexpr const char* name = "landmarks";
  static constexpr const char* description =
      "walls with their covariances, smoothed in a graph of keyframes; closes loops";
  static constexpr const char* source =
      "Dellaert and Kaess 2006 (square root SAM); Guivant and Nebot 2001 (local filter); gates by "
      "Mahalanobis distance";
  static constexpr const char* choose =
      "For a pose and a map that stay true over many laps, with odometry or with the LiDAR alone. "
      "It says where walls leave a direction open, and finds itself again in its map.";
  static constexpr const char* state = "landmarks/1";

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
    archive(self.graph_, self.given_, self.active_, self.belief_, self.since_,
            self.search_covariance_, self.well_matched_, self.last_pose_, self.velocity_,
            self.stamp_, self.lost_since_, self.unfit_scans_, self.found_scans_, self.has_odometry_,
            self.fits_, self.lost_, self.refreshed_at_, self.refreshed_keyframe_,
            self.last_loop_keyframe_, self.closed_loops_, self.candidate_);
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
  [[nodiscard]] Belief predict(const Eigen::Matrix3d& motion_covariance) const;
  [[nodiscard]] Pairs associate(Belief belief, double widest_direction, double widest_offset) const;
  [[nodiscard]] Pairs find_pairs(const Belief& prior, double& weakening) const;
  [[nodiscard]] double length_of(const Pairs& pairs) const;
  [[nodiscard]] double length_of_scan() const;
  [[nodiscard]] Pairs associate_by_alignment(const Belief& belief, double& weakening) const;
  bool update(const Belief& prior, Pairs& pairs, Belief& posterior) const;
  void judge(const Belief& posterior, const Pairs& pairs, Localization& result);
  void add_keyframe(const Belief& posterior, const Pairs& pairs);
  void refresh();
  void merge_same_walls();
  bool close_loop();
  bool relocalize(Localization& result);
  [[nodiscard]] double seen_through(const Pose2& pose) const;

  Parameters parameters_;
  LandmarkGraph graph_;
  std::vector<std::size_t> active_;                              // landmarks of the filter
  Belief belief_;                                                // at the last keyframe
  PoseEstimate since_;                                           // motion since the last keyframe
  Eigen::Matrix3d search_covariance_ = Eigen::Matrix3d::Zero();  // of it, to find lines by
  bool well_matched_ = true;
  Pose2 last_pose_;  // of the last scan
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  std::optional<double> stamp_;
  double lost_since_ = 0.0;  // [s] stamp of the first scan that did not fit
  int unfit_scans_ = 0;
  int found_scans_ = 0;
  bool has_odometry_ = false;
  bool fits_ = true;
  bool lost_ = false;
  Pose2 refreshed_at_;
  std::size_t refreshed_keyframe_ = 0;
  std::size_t last_loop_keyframe_ = 0;
  std::size_t closed_loops_ = 0;
  std::optional<Pose2> candidate_;  // a pose found again, until the next scan confirms it
  std::vector<LineMeasurement> measurements_;
  std::vector<Eigen::Matrix2d> given_;  // covariances of the landmarks of a map that stays as it is
};

}  // namespace quoin
