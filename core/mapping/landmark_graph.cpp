// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/landmark_graph.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

constexpr double huber = 2.5;         // standard deviations, of two dimensions together
constexpr double motion_scale = 3.4;  // the same of an edge, three dimensions
constexpr double loop_scale = 3.4;
constexpr double origin_information = 1e10;  // of the first pose

/// Normal equations, their lower triangle as triplets.
struct Equations {
  std::vector<Eigen::Triplet<double>> triplets;
  Eigen::VectorXd gradient;

  template <class Block>
  void add(int row, int column, const Block& block) {
    for (int c = 0; c < block.cols(); ++c) {
      for (int r = 0; r < block.rows(); ++r) {
        if (row + r >= column + c) triplets.emplace_back(row + r, column + c, block(r, c));
      }
    }
  }
};

/// Expected by the poses less the motion of the edge.
Eigen::Vector3d edge_error(const LandmarkGraph::Edge& edge, const Pose2& from, const Pose2& to) {
  const Pose2 expected = between(from, to);
  const Pose2& motion = edge.motion.pose;
  return {expected.x - motion.x, expected.y - motion.y,
          normalized_angle(expected.theta - motion.theta)};
}

}  // namespace

std::size_t LandmarkGraph::add_keyframe(std::size_t from, const Pose2& pose,
                                        const PoseEstimate& motion) {
  keyframes_.push_back({pose, {}});
  if (keyframes_.size() > 1) {
    const std::size_t last = keyframes_.size() - 1;
    edges_.push_back({from, last, motion, motion.covariance.inverse(), false});
  }
  return keyframes_.size() - 1;
}

std::size_t LandmarkGraph::add_landmark(const LineLandmark& landmark) {
  landmarks_.push_back(landmark);
  return landmarks_.size() - 1;
}

void LandmarkGraph::observe(std::size_t keyframe, std::size_t landmark,
                            const LineMeasurement& measurement) {
  keyframes_[keyframe].observations.push_back({landmark, measurement, landmark});
  LineLandmark& seen = landmarks_[landmark];
  if (seen.observations == 0) seen.first_keyframe = keyframe;
  seen.last_keyframe = keyframe;
  ++seen.observations;
}

void LandmarkGraph::merge(std::size_t kept, std::size_t dropped) {
  LineLandmark& to = landmarks_[kept];
  LineLandmark& from = landmarks_[dropped];
  merges_.push_back({kept, dropped, keyframes_.size(), to, from});
  for (const double end : {from.low, from.high}) {
    const double s = to.along().dot(from.at(end) - to.anchor);
    to.low = std::min(to.low, s);
    to.high = std::max(to.high, s);
  }
  to.observations += from.observations;
  to.first_keyframe = std::min(to.first_keyframe, from.first_keyframe);
  to.last_keyframe = std::max(to.last_keyframe, from.last_keyframe);
  from.alive = false;
  for (std::size_t k = from.first_keyframe; k <= from.last_keyframe && k < keyframes_.size(); ++k) {
    for (Observation& observation : keyframes_[k].observations) {
      if (observation.landmark == dropped) observation.landmark = kept;
    }
  }
}

void LandmarkGraph::close_loop(std::size_t from, std::size_t to, const PoseEstimate& relative) {
  edges_.push_back({from, to, relative, relative.covariance.inverse(), true});
}

double LandmarkGraph::chi_square(const Edge& edge) const {
  const Eigen::Vector3d error =
      edge_error(edge, keyframes_[edge.from].pose, keyframes_[edge.to].pose);
  return error.dot(edge.information * error);
}

void LandmarkGraph::drop_loop(std::size_t edge) {
  const std::size_t since = edges_[edge].to;
  edges_.erase(edges_.begin() + static_cast<std::ptrdiff_t>(edge));
  while (!merges_.empty() && merges_.back().keyframes > since) {
    const Merge& merge = merges_.back();
    // Where both are now; how far they reach and what sees them, as before.
    LineLandmark& kept = landmarks_[merge.kept];
    LineLandmark& dropped = landmarks_[merge.dropped];
    kept.low = merge.kept_before.low;
    kept.high = merge.kept_before.high;
    dropped = merge.dropped_before;
    dropped.observations = 0;
    // What had been merged into the dropped one before goes with it.
    std::vector<char> members(landmarks_.size(), 0);
    members[merge.dropped] = 1;
    for (std::size_t m = merges_.size() - 1; m-- > 0;) {
      if (members[merges_[m].kept] != 0) members[merges_[m].dropped] = 1;
    }
    for (std::size_t k = 0; k < keyframes_.size(); ++k) {
      for (Observation& observation : keyframes_[k].observations) {
        if (observation.landmark != merge.kept || members[observation.made_as] == 0) continue;
        observation.landmark = merge.dropped;
        --kept.observations;
        ++dropped.observations;
        dropped.last_keyframe = k;
      }
    }
    merges_.pop_back();
  }
}

double LandmarkGraph::step(std::span<const int> last, Eigen::MatrixXd* covariance,
                           std::vector<int>& order_of_elimination, bool trust_loops) {
  const int poses = static_cast<int>(keyframes_.size());
  const int size = 3 * poses + 2 * static_cast<int>(landmarks_.size());
  Equations equations;
  equations.gradient = Eigen::VectorXd::Zero(size);
  equations.triplets.reserve(64 * keyframes_.size());
  double cost = 0.0;
  equations.add(0, 0, Eigen::Matrix3d(origin_information * Eigen::Matrix3d::Identity()));
  for (const Edge& edge : edges_) {
    const Pose2& before = keyframes_[edge.from].pose;
    const Eigen::Vector3d error = edge_error(edge, before, keyframes_[edge.to].pose);
    const double c = std::cos(before.theta);
    const double s = std::sin(before.theta);
    const Pose2 expected = between(before, keyframes_[edge.to].pose);
    Eigen::Matrix3d by_before, by_pose;
    by_before << -c, -s, expected.y, s, -c, -expected.x, 0.0, 0.0, -1.0;
    by_pose << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
    Eigen::Matrix3d information = edge.information;
    const double squared = error.dot(information * error);
    const double scale = edge.closes_loop ? loop_scale : motion_scale;
    if (squared > scale * scale && !(trust_loops && edge.closes_loop)) {
      const double deviations = std::sqrt(squared);
      information *= scale / deviations;
      cost += scale * (deviations - 0.5 * scale);
    } else {
      cost += 0.5 * squared;
    }
    const Eigen::Matrix3d weighted_before = by_before.transpose() * information;
    const Eigen::Matrix3d weighted_pose = by_pose.transpose() * information;
    const int earlier = 3 * static_cast<int>(edge.from);
    const int own = 3 * static_cast<int>(edge.to);
    equations.add(earlier, earlier, Eigen::Matrix3d(weighted_before * by_before));
    equations.add(own, earlier, Eigen::Matrix3d(weighted_pose * by_before));
    equations.add(own, own, Eigen::Matrix3d(weighted_pose * by_pose));
    equations.gradient.segment<3>(earlier) += weighted_before * error;
    equations.gradient.segment<3>(own) += weighted_pose * error;
  }
  std::vector<char> seen(landmarks_.size(), 0);
  for (int k = 0; k < poses; ++k) {
    const Keyframe& keyframe = keyframes_[static_cast<std::size_t>(k)];
    for (const Observation& observation : keyframe.observations) {
      seen[observation.landmark] = 1;
      const LineResidual residual =
          line_residual(keyframe.pose, landmarks_[observation.landmark], observation.measurement);
      Eigen::Matrix2d information = observation.measurement.covariance.inverse();
      const double squared = residual.value.dot(information * residual.value);
      const double deviations = std::sqrt(squared);
      if (deviations > huber) {
        information *= huber / deviations;
        cost += huber * (deviations - 0.5 * huber);
      } else {
        cost += 0.5 * squared;
      }
      const int at = 3 * poses + 2 * static_cast<int>(observation.landmark);
      const Eigen::Matrix<double, 3, 2> weighted_pose = residual.by_pose.transpose() * information;
      const Eigen::Matrix2d weighted_landmark = residual.by_landmark.transpose() * information;
      const int own = 3 * k;
      equations.add(own, own, Eigen::Matrix3d(weighted_pose * residual.by_pose));
      equations.add(at, own, Eigen::Matrix<double, 2, 3>(weighted_landmark * residual.by_pose));
      equations.add(at, at, Eigen::Matrix2d(weighted_landmark * residual.by_landmark));
      equations.gradient.segment<3>(own) += weighted_pose * residual.value;
      equations.gradient.segment<2>(at) += weighted_landmark * residual.value;
    }
  }
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (landmarks_[i].alive && seen[i] != 0) continue;
    const int at = 3 * poses + 2 * static_cast<int>(i);
    equations.add(at, at, Eigen::Matrix2d(Eigen::Matrix2d::Identity()));
  }
  Sparse lower(size, size);
  lower.setFromTriplets(equations.triplets.begin(), equations.triplets.end());

  // Minimum degree, but for the variables whose joint covariance is wanted: what is eliminated last
  // has it in the last block of the factor.
  Permutation inverse(size);  // from the place of a variable to its place in the order
  if (order_of_elimination.empty()) {
    Permutation order;
    const Sparse full = lower.selfadjointView<Eigen::Lower>();
    Eigen::AMDOrdering<int>()(full, order);
    std::vector<char> is_last(static_cast<std::size_t>(size), 0);
    for (const int variable : last) is_last[static_cast<std::size_t>(variable)] = 1;
    int next = 0;
    for (int i = 0; i < size; ++i) {
      const int variable = order.indices()(i);
      if (is_last[static_cast<std::size_t>(variable)] == 0) inverse.indices()(variable) = next++;
    }
    for (const int variable : last) inverse.indices()(variable) = next++;
    order_of_elimination.assign(inverse.indices().data(), inverse.indices().data() + size);
  } else {
    std::copy(order_of_elimination.begin(), order_of_elimination.end(), inverse.indices().data());
  }
  Sparse ordered(size, size);
  ordered.selfadjointView<Eigen::Lower>() =
      lower.selfadjointView<Eigen::Lower>().twistedBy(inverse);
  Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(ordered);
  if (factor.info() != Eigen::Success) return cost;
  const Eigen::VectorXd change =
      inverse.transpose() * factor.solve(Eigen::VectorXd(inverse * -equations.gradient));
  if (!change.allFinite()) return cost;
  largest_change_ = change.head(3 * poses).lpNorm<Eigen::Infinity>();
  for (int k = 0; k < poses; ++k) {
    Pose2& pose = keyframes_[static_cast<std::size_t>(k)].pose;
    const int row = 3 * k;
    pose.x += change(row);
    pose.y += change(row + 1);
    pose.theta = normalized_angle(pose.theta + change(row + 2));
  }
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const int at = 3 * poses + 2 * static_cast<int>(i);
    landmarks_[i].phi = normalized_angle(landmarks_[i].phi + change(at));
    landmarks_[i].offset += change(at + 1);
  }
  if (covariance != nullptr) {
    const int count = static_cast<int>(last.size());
    const Sparse factored = factor.matrixL();
    const Eigen::MatrixXd block = factored.bottomRightCorner(count, count);
    const Eigen::MatrixXd root =
        block.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(count, count));
    covariance->setZero(count, count);
    covariance->selfadjointView<Eigen::Lower>().rankUpdate(root.transpose());
    covariance->triangularView<Eigen::StrictlyUpper>() = covariance->transpose();
  }
  return cost;
}

void LandmarkGraph::take_solution(const LandmarkGraph& solved) {
  const std::size_t known = solved.keyframes_.size();
  const Pose2 back = between(keyframes_[known - 1].pose, {});
  const Pose2 correction = compose(solved.keyframes_[known - 1].pose, back);
  for (std::size_t k = 0; k < keyframes_.size(); ++k) {
    Pose2& pose = keyframes_[k].pose;
    pose = k < known ? solved.keyframes_[k].pose : compose(correction, pose);
  }
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    LineLandmark& landmark = landmarks_[i];
    if (i < solved.landmarks_.size()) {
      landmark.phi = solved.landmarks_[i].phi;
      landmark.offset = solved.landmarks_[i].offset;
    } else {
      landmark.anchor = correction.transform(landmark.anchor);
      landmark.phi = normalized_angle(landmark.phi + correction.theta);
    }
  }
}

double LandmarkGraph::optimize(int steps, bool trust_loops) {
  double cost = 0.0;
  std::vector<int> order;
  for (int i = 0; i < steps; ++i) cost = step({}, nullptr, order, trust_loops);
  return cost;
}

Eigen::MatrixXd LandmarkGraph::marginal_after_step(std::size_t keyframe,
                                                   std::span<const std::size_t> landmarks) {
  std::vector<int> last;
  for (int i = 0; i < 3; ++i) last.push_back(3 * static_cast<int>(keyframe) + i);
  for (const std::size_t landmark : landmarks) {
    const int at = static_cast<int>(3 * keyframes_.size() + 2 * landmark);
    last.push_back(at);
    last.push_back(at + 1);
  }
  Eigen::MatrixXd covariance;
  std::vector<int> order;
  step(last, &covariance, order);
  return covariance;
}

}  // namespace quoin
