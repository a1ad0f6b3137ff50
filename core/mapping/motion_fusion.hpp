// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "core/mapping/motion.hpp"

namespace quoin {

/// As compose, with errors that may be correlated in any way: slip and bias of wheels last longer
/// than from scan to scan. The bound (1 + s) A + (1 + 1/s) B holds for all correlations; s makes
/// its trace least.
[[nodiscard]] PoseEstimate compose_correlated(const PoseEstimate& first,
                                              const PoseEstimate& increment);

/// A motion by odometry and another of the same way by points together. Odometry that the points
/// refute counts less: slip lasts longer than its covariance says, and `odometry` is enlarged so.
[[nodiscard]] PoseEstimate fuse(PoseEstimate& odometry, const PoseEstimate& points);

/// By how much the squared errors of odometry are larger than its covariances say: the mean of what
/// registrations of points show, at least one.
class OdometryScale {
 public:
  /// Compares an increment with what the points say of it, whose covariance at either end is
  /// `noise`.
  void judge(const PoseEstimate& increment, const Pose2& seen, const Eigen::Matrix3d& noise);
  /// The increment with its covariance scaled.
  [[nodiscard]] PoseEstimate scaled(const PoseEstimate& increment) const;

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.scale_, self.judged_);
  }

 private:
  Eigen::Vector2d scale_ = Eigen::Vector2d::Ones();  // of the translation and of the heading
  std::size_t judged_ = 0;
};

}  // namespace quoin
