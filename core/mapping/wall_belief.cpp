// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/wall_belief.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/geometry/angle.hpp"
#include "core/mapping/line_gates.hpp"

namespace quoin {
namespace {

constexpr double largest_trusted = 2.5;  // standard deviations

/// Rows of pose and one wall in the joint covariance: 5x5.
Eigen::Matrix<double, 5, 5> block_of(const Eigen::MatrixXd& covariance, std::size_t place) {
  const auto at = static_cast<Eigen::Index>(3 + 2 * place);
  Eigen::Matrix<double, 5, 5> block;
  block.topLeftCorner<3, 3>() = covariance.topLeftCorner<3, 3>();
  block.topRightCorner<3, 2>() = covariance.block<3, 2>(0, at);
  block.bottomLeftCorner<2, 3>() = covariance.block<2, 3>(at, 0);
  block.bottomRightCorner<2, 2>() = covariance.block<2, 2>(at, at);
  return block;
}

Eigen::Matrix<double, 2, 5> jacobian_of(const LineResidual& residual) {
  Eigen::Matrix<double, 2, 5> jacobian;
  jacobian << residual.by_pose, residual.by_landmark;
  return jacobian;
}

}  // namespace

LineLandmark WallBelief::wall(std::span<const LineLandmark> map, std::size_t place) const {
  LineLandmark result = map[landmarks[place]];
  result.phi = walls[place](0);
  result.offset = walls[place](1);
  return result;
}

void WallBelief::forget_merged(std::span<const LineLandmark> map) {
  std::vector<Eigen::Index> kept{0, 1, 2};
  WallBelief left;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    if (!map[landmarks[k]].alive) continue;
    kept.push_back(static_cast<Eigen::Index>(3 + 2 * k));
    kept.push_back(static_cast<Eigen::Index>(4 + 2 * k));
    left.landmarks.push_back(landmarks[k]);
    left.walls.push_back(walls[k]);
  }
  if (left.walls.size() == walls.size()) return;
  covariance = Eigen::MatrixXd(covariance(kept, kept));
  landmarks = std::move(left.landmarks);
  walls = std::move(left.walls);
}

WallBelief predict(const WallBelief& belief, const PoseEstimate& motion) {
  WallBelief prior = belief;
  prior.pose = compose(belief.pose, motion.pose);
  const Eigen::Matrix3d by_first = compose_by_first(belief.pose, motion.pose);
  const Eigen::Matrix3d by_second = compose_by_second(belief.pose);
  prior.covariance.topRows<3>() = by_first * belief.covariance.topRows<3>();
  prior.covariance.leftCols<3>() = prior.covariance.leftCols<3>() * by_first.transpose();
  prior.covariance.leftCols<3>().bottomRows(prior.covariance.rows() - 3) =
      prior.covariance.topRows<3>().rightCols(prior.covariance.cols() - 3).transpose();
  prior.covariance.topLeftCorner<3, 3>() =
      by_first * belief.covariance.topLeftCorner<3, 3>() * by_first.transpose() +
      by_second * motion.covariance * by_second.transpose();
  return prior;
}

Eigen::Matrix2d innovation_covariance(const LineResidual& residual,
                                      const Eigen::MatrixXd& covariance, std::size_t place,
                                      const Eigen::Matrix2d& noise) {
  const Eigen::Matrix<double, 2, 5> jacobian = jacobian_of(residual);
  return jacobian * block_of(covariance, place) * jacobian.transpose() + noise;
}

bool lies_on(const Pose2& pose, const LineLandmark& landmark, const LineMeasurement& m,
             double along_stddev) {
  const double shorter = std::min(2.0 * m.half_length, landmark.length());
  return overlap(pose, landmark, m) > 0.25 * shorter - 2.0 * along_stddev;
}

void update_with(WallBelief& belief, std::span<const LineLandmark> map, std::size_t place,
                 const LineMeasurement& m) {
  const LineResidual residual = line_residual(belief.pose, belief.wall(map, place), m);
  const auto at = static_cast<Eigen::Index>(3 + 2 * place);
  const Eigen::MatrixXd gain_base =
      belief.covariance.leftCols<3>() * residual.by_pose.transpose() +
      belief.covariance.middleCols<2>(at) * residual.by_landmark.transpose();
  const Eigen::Matrix2d s = innovation_covariance(residual, belief.covariance, place, m.covariance);
  const Eigen::MatrixXd gain = gain_base * s.inverse();
  const Eigen::VectorXd change = -gain * residual.value;
  belief.pose = moved(belief.pose, change.head<3>());
  for (std::size_t k = 0; k < belief.walls.size(); ++k) {
    belief.walls[k] += change.segment<2>(static_cast<Eigen::Index>(3 + 2 * k));
  }
  belief.covariance -= gain * gain_base.transpose();
}

bool update_with(const WallBelief& prior, std::span<const LineLandmark> map,
                 std::span<const LineMeasurement> measurements, WallPairs& pairs,
                 WallBelief& posterior) {
  posterior = prior;
  for (int round = 0; round < 3; ++round) {
    const auto rows = static_cast<Eigen::Index>(2 * pairs.size());
    if (rows == 0) {
      posterior = prior;
      return false;
    }
    const Eigen::Index size = prior.covariance.rows();
    for (int iteration = 0; iteration < 2; ++iteration) {
      Eigen::MatrixXd base(size, rows);
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, size);
      Eigen::VectorXd innovation(rows);
      Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(rows, rows);
      for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto [i, k] = pairs[p];
        const auto row = static_cast<Eigen::Index>(2 * p);
        const auto at = static_cast<Eigen::Index>(3 + 2 * k);
        const LineMeasurement& m = measurements[i];
        const LineResidual residual = line_residual(posterior.pose, posterior.wall(map, k), m);
        jacobian.block<2, 3>(row, 0) = residual.by_pose;
        jacobian.block<2, 2>(row, at) = residual.by_landmark;
        base.middleCols<2>(row) =
            prior.covariance.leftCols<3>() * residual.by_pose.transpose() +
            prior.covariance.middleCols<2>(at) * residual.by_landmark.transpose();
        const double deviations =
            std::sqrt(residual.value.dot(m.covariance.inverse() * residual.value));
        const double inflation =
            round > 0 && deviations > largest_trusted ? deviations / largest_trusted : 1.0;
        noise.block<2, 2>(row, row) = inflation * m.covariance;
        // The residual where the prior is, linearized here.
        Eigen::Vector3d back(prior.pose.x - posterior.pose.x, prior.pose.y - posterior.pose.y,
                             normalized_angle(prior.pose.theta - posterior.pose.theta));
        innovation.segment<2>(row) = residual.value + residual.by_pose * back +
                                     residual.by_landmark * (prior.walls[k] - posterior.walls[k]);
      }
      const Eigen::MatrixXd s = jacobian * base + noise;
      const Eigen::LLT<Eigen::MatrixXd> factor(s);
      if (factor.info() != Eigen::Success) return false;
      const Eigen::MatrixXd gain = factor.solve(base.transpose()).transpose();
      const Eigen::VectorXd change = -gain * innovation;
      if (!change.allFinite()) return false;
      posterior.pose = moved(prior.pose, change.head<3>());
      for (std::size_t k = 0; k < posterior.walls.size(); ++k) {
        posterior.walls[k] =
            prior.walls[k] + change.segment<2>(static_cast<Eigen::Index>(3 + 2 * k));
      }
      if (iteration == 1) {
        posterior.covariance = prior.covariance - gain * base.transpose();
        posterior.covariance =
            (0.5 * (posterior.covariance + posterior.covariance.transpose())).eval();
      }
    }
    const std::size_t before = pairs.size();
    std::erase_if(pairs, [&](const auto& pair) {
      const LineMeasurement& m = measurements[pair.first];
      const LineLandmark landmark = posterior.wall(map, pair.second);
      const LineResidual residual = line_residual(posterior.pose, landmark, m);
      const Eigen::Matrix2d s =
          innovation_covariance(residual, posterior.covariance, pair.second, m.covariance);
      return residual.value.dot(s.inverse() * residual.value) > line_gate ||
             !lies_on(posterior.pose, landmark, m, 0.0);
    });
    if (pairs.size() == before && round > 0) break;
  }
  return !pairs.empty();
}

void append_wall(WallBelief& belief, std::size_t index, const LineLandmark& landmark,
                 const LineMeasurement& m) {
  const Eigen::Index size = belief.covariance.rows();
  const LineResidual residual = line_residual(belief.pose, landmark, m);
  Eigen::MatrixXd grown(size + 2, size + 2);
  grown.topLeftCorner(size, size) = belief.covariance;
  grown.bottomLeftCorner(2, size) = residual.by_pose * belief.covariance.topRows<3>();
  grown.topRightCorner(size, 2) = grown.bottomLeftCorner(2, size).transpose();
  grown.bottomRightCorner<2, 2>() =
      residual.by_pose * belief.covariance.topLeftCorner<3, 3>() * residual.by_pose.transpose() +
      m.covariance;
  belief.covariance = std::move(grown);
  belief.walls.emplace_back(landmark.phi, landmark.offset);
  belief.landmarks.push_back(index);
}

}  // namespace quoin
