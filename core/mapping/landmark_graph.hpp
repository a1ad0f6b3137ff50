// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/mapping/line_landmark.hpp"
#include "core/mapping/motion.hpp"

namespace quoin {

/// Poses of the sensor at some scans, the walls that it saw from them and the motion between them,
/// as one sparse least-squares problem. The first pose is the origin and fixed.
///
/// Lines are weighted with Huber's loss, so that a wrong match bends the map no more than a match
/// at its limit does.
class LandmarkGraph {
 public:
  struct Observation {
    std::size_t landmark = 0;
    LineMeasurement measurement;
    std::size_t made_as = 0;  ///< the landmark before merges

    template <class Archive, class Self>
    static void transfer(Archive& archive, Self& self) {
      archive(self.landmark, self.measurement, self.made_as);
    }
  };
  struct Keyframe {
    Pose2 pose;
    std::vector<Observation> observations;

    template <class Archive, class Self>
    static void transfer(Archive& archive, Self& self) {
      archive(self.pose, self.observations);
    }
  };

  /// A pose of keyframe `to` in the frame of keyframe `from` by other means than walls.
  struct Edge {
    std::size_t from = 0;
    std::size_t to = 0;
    PoseEstimate motion;
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    bool closes_loop = false;

    template <class Archive, class Self>
    static void transfer(Archive& archive, Self& self) {
      archive(self.from, self.to, self.motion, self.information, self.closes_loop);
    }
  };

  /// Adds a keyframe; `motion`, from the keyframe `from`, is not looked at for the first.
  std::size_t add_keyframe(std::size_t from, const Pose2& pose, const PoseEstimate& motion);
  std::size_t add_landmark(const LineLandmark& landmark);
  void observe(std::size_t keyframe, std::size_t landmark, const LineMeasurement& measurement);

  /// Adds what closes a loop, until `drop_loop` takes it out.
  void close_loop(std::size_t from, std::size_t to, const PoseEstimate& relative);
  /// Chi square (of 3) of an edge where the poses are.
  [[nodiscard]] double chi_square(const Edge& edge) const;
  /// Takes an edge out, and undoes the merges made since its keyframe `to` was the last one.
  void drop_loop(std::size_t edge);

  /// Lets `kept` stand for `dropped`, with its observations and its extent.
  void merge(std::size_t kept, std::size_t dropped);

  /// Steps of Gauss-Newton. Returns the robust cost before the last one: half the chi square of
  /// what no wrong match distorts. With `trust_loops` what closes loops bends the map however far
  /// it has to.
  double optimize(int steps, bool trust_loops = false);

  /// The largest change of a pose by the last step of `optimize` [m, rad].
  [[nodiscard]] double largest_change() const { return largest_change_; }
  /// How much a step costs: it grows with this.
  [[nodiscard]] std::size_t size() const { return keyframes_.size() + landmarks_.size(); }
  /// Takes poses and walls over from a copy that was optimized meanwhile. What was added since then
  /// moves along with the last keyframe that the copy has.
  void take_solution(const LandmarkGraph& solved);

  /// The covariance of (pose of the keyframe, phi and offset of these landmarks), as of the last
  /// Gauss-Newton step, which it takes: (3 + 2 n) squared.
  [[nodiscard]] Eigen::MatrixXd marginal_after_step(std::size_t keyframe,
                                                    std::span<const std::size_t> landmarks);

  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  [[nodiscard]] const std::vector<LineLandmark>& landmarks() const { return landmarks_; }
  [[nodiscard]] std::vector<LineLandmark>& landmarks() { return landmarks_; }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.keyframes_, self.edges_, self.landmarks_, self.merges_);
  }

 private:
  struct Merge {
    std::size_t kept = 0;
    std::size_t dropped = 0;
    std::size_t keyframes = 0;  // when it was made
    LineLandmark kept_before, dropped_before;

    template <class Archive, class Self>
    static void transfer(Archive& archive, Self& self) {
      archive(self.kept, self.dropped, self.keyframes, self.kept_before, self.dropped_before);
    }
  };

  /// One step with these variables last in the order of elimination; returns the cost before it.
  double step(std::span<const int> last, Eigen::MatrixXd* covariance, std::vector<int>& order,
              bool trust_loops = false);

  std::vector<Keyframe> keyframes_;
  std::vector<Edge> edges_;
  std::vector<LineLandmark> landmarks_;
  std::vector<Merge> merges_;
  double largest_change_ = 0.0;
};

}  // namespace quoin
