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

    template <class Archive, class Self>
    static void transfer(Archive& archive, Self& self) {
      archive(self.landmark, self.measurement);
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

  /// Adds a keyframe; `motion`, from the keyframe before, is not looked at for the first.
  std::size_t add_keyframe(const Pose2& pose, const PoseEstimate& motion);
  std::size_t add_landmark(const LineLandmark& landmark);
  void observe(std::size_t keyframe, std::size_t landmark, const LineMeasurement& measurement);

  /// Lets `kept` stand for `dropped`, with its observations and its extent.
  void merge(std::size_t kept, std::size_t dropped);

  /// Steps of Gauss-Newton. Returns the robust cost before the last one: half the chi square of
  /// what no wrong match distorts.
  double optimize(int steps);

  /// The covariance of (pose of the keyframe, phi and offset of these landmarks), as of the last
  /// Gauss-Newton step, which it takes: (3 + 2 n) squared.
  [[nodiscard]] Eigen::MatrixXd marginal_after_step(std::size_t keyframe,
                                                    std::span<const std::size_t> landmarks);

  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  [[nodiscard]] const std::vector<LineLandmark>& landmarks() const { return landmarks_; }
  [[nodiscard]] std::vector<LineLandmark>& landmarks() { return landmarks_; }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.keyframes_, self.motions_, self.motion_information_, self.landmarks_);
  }

 private:
  /// One step with these variables last in the order of elimination; returns the cost before it.
  double step(std::span<const int> last, Eigen::MatrixXd* covariance);

  std::vector<Keyframe> keyframes_;
  std::vector<PoseEstimate> motions_;  // of keyframe i from i - 1
  std::vector<Eigen::Matrix3d> motion_information_;
  std::vector<LineLandmark> landmarks_;
};

}  // namespace quoin
