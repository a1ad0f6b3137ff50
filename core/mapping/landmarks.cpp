// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr double gate = 13.815510557964274;  // chi square of 2, 99.9 %
constexpr double near_gate = 30.0;           // what is nearer than this is no new wall
constexpr double same_wall_gate = 9.21;      // chi square of 2, 99 %
constexpr double largest_trusted = 2.5;      // standard deviations
constexpr double widest_offset = 0.30;       // [m] standard deviation of an innovation
constexpr double widest_direction = 0.10;    // [rad]
constexpr double wide_factor = 4.0;          // where nothing else fits
constexpr double lost_after = 0.6;           // [s]
constexpr int lost_scans = 3;                // in a row, whatever the time
constexpr double motion_gate = 16.27;        // chi square of 3, 99.9 %
constexpr double short_step = 0.25;          // [m]
constexpr double short_turn = 0.35;          // [rad]
constexpr double least_refuted = 1.0;        // [m]
constexpr double weak_position = 0.25;       // [m] by the walls alone
constexpr std::size_t refresh_keyframes = 12;
constexpr double refresh_distance = 4.0;  // [m]
constexpr std::size_t most_active = 120;
constexpr double least_share = 0.4;   // of the points of a scan that lie on the map around
constexpr double largest_fall = 0.3;  // of that share, from one scan to the next
constexpr double loop_reach = 12.0;   // [m] of the points that loops are found by
const Eigen::Matrix3d unknown_place = Eigen::Vector3d(0.25, 0.25, 0.1).asDiagonal();
constexpr double loop_gate = 30.0;
constexpr double loop_cost = 100.0;      // of what closes a loop, for each pair of keyframes
constexpr double loop_pair_apart = 0.5;  // [m] between pairs that count
constexpr double point_spacing = 0.05;   // [m] of a scan
// A pose that is found in the whole map.
constexpr std::size_t least_points = 40;    // of a scan
constexpr double least_found_share = 0.8;   // of them that lie on the map
constexpr double least_contradicted = 1.5;  // [m] more at any other place
constexpr double search_period = 0.5;       // [s]
constexpr double back_share = 0.85;         // of a scan that fits where the robot should be
constexpr int back_scans = 5;               // in a row
constexpr std::size_t blind_points = 10;    // of a scan that says nothing

SidedSegment sided(const LineMeasurement& m) { return {m.alpha, m.middle, m.half_length}; }
SidedSegment sided(const LineLandmark& l) {
  return {l.phi, l.at(0.5 * (l.low + l.high)), 0.5 * l.length()};
}

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

/// Covariance of the residual of a wall at this place of the joint covariance.
Eigen::Matrix2d innovation_of(const LineResidual& residual, const Eigen::MatrixXd& covariance,
                              std::size_t place, const Eigen::Matrix2d& noise) {
  const Eigen::Matrix<double, 2, 5> jacobian = jacobian_of(residual);
  return jacobian * block_of(covariance, place) * jacobian.transpose() + noise;
}

/// How much of a segment has to lie on a wall to be of it [m]: walls that end are different walls
/// from others farther on in the same line.
bool lies_on(const Pose2& pose, const LineLandmark& landmark, const LineMeasurement& m,
             double along_stddev) {
  const double shorter = std::min(2.0 * m.half_length, landmark.length());
  return overlap(pose, landmark, m) > 0.25 * shorter - 2.0 * along_stddev;
}

Pose2 moved(const Pose2& pose, const Eigen::Vector3d& change) {
  return {pose.x + change.x(), pose.y + change.y(), normalized_angle(pose.theta + change.z())};
}

/// As compose, with errors that may be correlated in any way: slip and bias of wheels last longer
/// than from scan to scan. The bound (1 + s) A + (1 + 1/s) B holds for all correlations; s makes
/// its trace least.
PoseEstimate compose_correlated(const PoseEstimate& first, const PoseEstimate& increment) {
  const Eigen::Matrix3d by_first = compose_by_first(first.pose, increment.pose);
  const Eigen::Matrix3d by_second = compose_by_second(first.pose);
  const Eigen::Matrix3d a = by_first * first.covariance * by_first.transpose();
  const Eigen::Matrix3d b = by_second * increment.covariance * by_second.transpose();
  const double trace_a = a.trace();
  const double trace_b = b.trace();
  if (!(trace_a > 0.0) || !(trace_b > 0.0)) return {compose(first.pose, increment.pose), a + b};
  const double s = std::sqrt(trace_b / trace_a);
  return {compose(first.pose, increment.pose), (1.0 + s) * a + (1.0 + 1.0 / s) * b};
}

std::vector<SurfacePoint> points_on(const LineLandmark& landmark) {
  const int steps = std::max(2, static_cast<int>(landmark.length() / 0.05));
  std::vector<SurfacePoint> points(static_cast<std::size_t>(steps));
  for (int i = 0; i < steps; ++i) {
    SurfacePoint& point = points[static_cast<std::size_t>(i)];
    const double s = landmark.low + (i + 0.5) / steps * landmark.length();
    point.position = landmark.at(s).cast<float>();
    point.normal = (-landmark.normal()).cast<float>();
  }
  return points;
}

/// A covariance of a pose in the map, in the frame of another pose.
Eigen::Matrix3d in_frame_of(const Pose2& frame, const Eigen::Matrix3d& covariance) {
  const double c = std::cos(frame.theta);
  const double s = std::sin(frame.theta);
  Eigen::Matrix3d turn;
  turn << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  return turn * covariance * turn.transpose();
}

}  // namespace

LineLandmark Landmarks::wall(const Belief& belief, std::size_t place) const {
  LineLandmark result = graph_.landmarks()[active_[place]];
  result.phi = belief.walls[place](0);
  result.offset = belief.walls[place](1);
  return result;
}

Landmarks::Belief Landmarks::predict(const PoseEstimate& motion) const {
  Belief prior = belief_;
  prior.pose = compose(belief_.pose, motion.pose);
  const Eigen::Matrix3d by_first = compose_by_first(belief_.pose, motion.pose);
  const Eigen::Matrix3d by_second = compose_by_second(belief_.pose);
  prior.covariance.topRows<3>() = by_first * belief_.covariance.topRows<3>();
  prior.covariance.leftCols<3>() = prior.covariance.leftCols<3>() * by_first.transpose();
  prior.covariance.leftCols<3>().bottomRows(prior.covariance.rows() - 3) =
      prior.covariance.topRows<3>().rightCols(prior.covariance.cols() - 3).transpose();
  prior.covariance.topLeftCorner<3, 3>() =
      by_first * belief_.covariance.topLeftCorner<3, 3>() * by_first.transpose() +
      by_second * motion.covariance * by_second.transpose();
  return prior;
}

/// One line after the other, the longest first; each one that is taken narrows the gates of the
/// others. A line that two walls explain about as well waits until the rest has been taken.
Landmarks::Pairs Landmarks::associate(Belief belief, double widest_direction,
                                      double widest_offset) const {
  Pairs pairs;
  std::vector<std::size_t> waiting(measurements_.size());
  for (std::size_t i = 0; i < waiting.size(); ++i) waiting[i] = i;
  std::stable_sort(waiting.begin(), waiting.end(), [&](std::size_t a, std::size_t b) {
    return measurements_[a].half_length > measurements_[b].half_length;
  });
  for (int pass = 0; pass < 3 && !waiting.empty(); ++pass) {
    std::vector<std::size_t> left;
    for (const std::size_t i : waiting) {
      const LineMeasurement& m = measurements_[i];
      double best = std::numeric_limits<double>::infinity();
      double second = best;
      std::size_t place = 0;
      const double position_stddev =
          std::min(0.25, std::sqrt(std::max(search_covariance_(0, 0), search_covariance_(1, 1))));
      for (std::size_t k = 0; k < active_.size(); ++k) {
        const LineLandmark landmark = wall(belief, k);
        if (std::cos(belief.pose.theta + m.alpha - landmark.phi) < 0.8) continue;
        if (!lies_on(belief.pose, landmark, m, position_stddev)) continue;
        const LineResidual residual = line_residual(belief.pose, landmark, m);
        const Eigen::Matrix2d s = innovation_of(residual, belief.covariance, k, m.covariance);
        if (s(0, 0) > widest_direction * widest_direction ||
            s(1, 1) > widest_offset * widest_offset) {
          continue;
        }
        const double squared = residual.value.dot(s.inverse() * residual.value);
        if (squared > gate) continue;
        const double value = squared + std::log(s.determinant());
        if (value < best) {
          second = best;
          best = value;
          place = k;
        } else {
          second = std::min(second, value);
        }
      }
      if (!std::isfinite(best)) continue;
      if (second - best < 4.0 && pass < 2) {
        left.push_back(i);
        continue;
      }
      if (second - best < 1.0) continue;  // either would be a guess
      pairs.emplace_back(i, place);
      const LineResidual residual = line_residual(belief.pose, wall(belief, place), m);
      const auto at = static_cast<Eigen::Index>(3 + 2 * place);
      const Eigen::MatrixXd gain_base =
          belief.covariance.leftCols<3>() * residual.by_pose.transpose() +
          belief.covariance.middleCols<2>(at) * residual.by_landmark.transpose();
      const Eigen::Matrix2d s = innovation_of(residual, belief.covariance, place, m.covariance);
      const Eigen::MatrixXd gain = gain_base * s.inverse();
      const Eigen::VectorXd change = -gain * residual.value;
      belief.pose = moved(belief.pose, change.head<3>());
      for (std::size_t k = 0; k < active_.size(); ++k) {
        belief.walls[k] += change.segment<2>(static_cast<Eigen::Index>(3 + 2 * k));
      }
      belief.covariance -= gain * gain_base.transpose();
    }
    waiting = std::move(left);
  }
  return pairs;
}

/// All lines together, where the pose is too uncertain for one at a time.
Landmarks::Pairs Landmarks::associate_by_alignment(const Belief& belief, double& weakening) const {
  weakening = 1.0;
  std::vector<SidedSegment> first, second;
  for (const LineMeasurement& m : measurements_) first.push_back(sided(m));
  for (std::size_t k = 0; k < active_.size(); ++k) second.push_back(sided(wall(belief, k)));
  AlignmentSearch search;
  search.center = belief.pose;
  // Relative to the walls seen last: what the motion adds.
  const Eigen::Matrix3d& c = search_covariance_;
  // Motion that slips is farther off than its covariance says.
  search.largest_translation =
      std::clamp(0.1 + 3.5 * std::sqrt(std::max(c(0, 0), c(1, 1))), 0.4, 1.5);
  search.largest_turn = std::clamp(0.05 + 3.5 * std::sqrt(c(2, 2)), 0.4, 0.8);
  const std::vector<Alignment> found = align(first, second, search);
  if (found.empty() || found.front().pairs.size() < 3) return {};
  if (found.size() > 1 && found[1].support > 0.8 * found[0].support) return {};
  // The motion counts less where the walls refute it.
  const Pose2 step = between(belief_.pose, found.front().pose);
  const Eigen::Vector3d off(step.x - since_.pose.x, step.y - since_.pose.y,
                            normalized_angle(step.theta - since_.pose.theta));
  const Eigen::Matrix3d& s = since_.covariance;
  const double squared = off.dot(s.ldlt().solve(off));
  if (squared > 3.0) weakening = squared / 3.0;
  // Put elsewhere, a robot finds walls that look alike: nearly all of the scan has to fit.
  if (squared > motion_gate && found.front().support < 0.7 * length_of_scan()) return {};
  return found.front().pairs;
}

/// Iterated update of the joint belief. Pairs that the posterior does not explain are dropped.
bool Landmarks::update(const Belief& prior, Pairs& pairs, Belief& posterior) const {
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
        const LineMeasurement& m = measurements_[i];
        const LineResidual residual = line_residual(posterior.pose, wall(posterior, k), m);
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
      for (std::size_t k = 0; k < active_.size(); ++k) {
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
      const LineMeasurement& m = measurements_[pair.first];
      const LineLandmark landmark = wall(posterior, pair.second);
      const LineResidual residual = line_residual(posterior.pose, landmark, m);
      const Eigen::Matrix2d s =
          innovation_of(residual, posterior.covariance, pair.second, m.covariance);
      return residual.value.dot(s.inverse() * residual.value) > gate ||
             !lies_on(posterior.pose, landmark, m, 0.0);
    });
    if (pairs.size() == before && round > 0) break;
  }
  return !pairs.empty();
}

/// Length [m] of mapped walls through which lines of the scan are seen.
double Landmarks::seen_through(const Pose2& pose, std::span<const std::size_t> walls) const {
  constexpr int samples = 5;
  double length = 0.0;
  for (const std::size_t index : walls) {
    const LineLandmark& landmark = graph_.landmarks()[index];
    if (landmark.observations < 3) continue;
    for (int i = 0; i < samples; ++i) {
      const double s = landmark.low + (i + 0.5) / samples * landmark.length();
      const Eigen::Vector2d point = pose.inverse_transform(landmark.at(s));
      const double distance = point.norm();
      if (distance < 0.3) continue;
      for (const LineMeasurement& m : measurements_) {
        const Eigen::Vector2d normal(std::cos(m.alpha), std::sin(m.alpha));
        const Eigen::Vector2d tangent(-normal.y(), normal.x());
        const double approach = normal.dot(point) / distance;
        if (approach < 0.1) continue;
        const double reached = normal.dot(m.middle) / approach;
        if (reached < 1.1 * distance + 0.3) continue;
        if (std::abs(tangent.dot(reached / distance * point - m.middle)) > m.half_length) continue;
        length += landmark.length() / samples;
        break;
      }
    }
  }
  return length;
}

double Landmarks::length_of(const Pairs& pairs) const {
  double length = 0.0;
  for (const auto& pair : pairs) length += 2.0 * measurements_[pair.first].half_length;
  return length;
}

double Landmarks::length_of_scan() const {
  double length = 0.0;
  for (const LineMeasurement& m : measurements_) length += 2.0 * m.half_length;
  return length;
}

/// One line at a time; where that finds few, all lines together; where that does, too, one line at
/// a time in wide gates. With the pose that they give, the rest is looked for.
Landmarks::Pairs Landmarks::find_pairs(const Belief& prior, double& weakening) const {
  const double total = length_of_scan();
  Pairs pairs = associate(prior, widest_direction, widest_offset);
  weakening = 1.0;
  const auto improve = [&](Pairs found, double weaker) {
    Belief posterior;
    const Belief from = weaker > 1.0 ? predict({motion_.pose, weaker * search_covariance_}) : prior;
    if (found.empty() || !update(from, found, posterior)) return;
    Pairs again = associate(posterior, widest_direction, widest_offset);
    if (length_of(again) > length_of(found)) found = std::move(again);
    if (length_of(found) > 1.2 * length_of(pairs)) {
      pairs = std::move(found);
      weakening = weaker;
    }
  };
  if (length_of(pairs) < 0.5 * total) {
    double weaker = 1.0;
    Pairs aligned = associate_by_alignment(prior, weaker);
    if (!aligned.empty()) improve(std::move(aligned), weaker);
  }
  if (length_of(pairs) < 0.5 * total) {
    improve(associate(prior, wide_factor * widest_direction, wide_factor * widest_offset), 1.0);
  }
  return pairs;
}

void Landmarks::judge(const Belief& posterior, const Pairs& pairs, Localization& result) {
  const double matched = length_of(pairs);
  const double total = length_of_scan();
  // What the walls alone say of the position.
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const auto& [i, k] : pairs) {
    const LineMeasurement& m = measurements_[i];
    const Eigen::Vector2d normal = wall(posterior, k).normal();
    information += normal * normal.transpose() / m.covariance(1, 1);
  }
  result.matched = pairs.size();
  result.pose = {posterior.pose, posterior.covariance.topLeftCorner<3, 3>()};
  result.weak_direction.reset();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(information);
  const bool weak = axes.eigenvalues()(0) * weak_position * weak_position < 1.0;
  if (weak) {
    const Eigen::Vector2d direction = axes.eigenvectors().col(0);
    result.weak_direction = direction_of(direction.x(), direction.y());
  }
  const bool lies_well = share_ > 0.6;
  const double refuted = lies_well ? 0.0 : seen_through(posterior.pose, active_);
  const bool contradicted = share_ < least_share && matched < 0.5 * total &&
                            refuted > std::max({matched, 0.4 * total, least_refuted});
  // Neighbouring scans see the same walls.
  const bool fell = share_ < least_share || (!lies_well && share_ + largest_fall < last_share_);
  const bool jumped = fell && matched < 0.5 * total && scan_.size() > 20 &&
                      std::hypot(expected_step_.x, expected_step_.y) < short_step &&
                      std::abs(expected_step_.theta) < short_turn;
  const bool blind = scan_.size() < blind_points && pairs.empty();
  fits_ = !contradicted && !jumped && !blind && (has_odometry_ || share_ > 0.0 || !pairs.empty());
  if (lost_) {
    result.status = LocalizationStatus::lost;
  } else if (!fits_ || weak || (matched < 0.5 * total && !lies_well) || refuted > matched) {
    result.status = LocalizationStatus::ambiguous;
  } else {
    result.status = LocalizationStatus::tracking;
  }
}

/// Points of the scan; where there are none, points of its lines.
void Landmarks::collect_points(const LocalizationInput& input) {
  if (!input.points.empty()) {
    surface_points(input.points, point_spacing, 2.0 * parameters_.reach, scan_);
    return;
  }
  scan_.clear();
  for (const LineMeasurement& m : measurements_) {
    const Eigen::Vector2d normal(std::cos(m.alpha), std::sin(m.alpha));
    const Eigen::Vector2d along(-normal.y(), normal.x());
    const int count = std::max(2, static_cast<int>(2.0 * m.half_length / 0.1));
    for (int i = 0; i < count; ++i) {
      const double t = m.half_length * (2.0 * (i + 0.5) / count - 1.0);
      SurfacePoint point;
      point.position = (m.middle + t * along).cast<float>();
      point.normal = (-normal).cast<float>();
      scan_.push_back(point);
    }
  }
}

/// The points around, of keyframes that see the same walls as the last ones, and of the last ones.
void Landmarks::rebuild_near() {
  constexpr std::size_t last = 15;
  constexpr std::size_t most = 40;
  const auto& keyframes = graph_.keyframes();
  near_.clear({belief_.pose.x, belief_.pose.y}, parameters_.reach + 8.0);
  if (!given_.empty()) {
    for (const std::size_t index : active_) {
      near_.add({}, points_on(graph_.landmarks()[index]));
    }
    return;
  }
  std::vector<char> seen(graph_.landmarks().size(), 0);
  const std::size_t count = keyframes.size();
  const std::size_t end = std::min(count, base_keyframe_ + 3);
  for (std::size_t k = end > 6 ? end - 6 : 0; k < end; ++k) {
    for (const auto& observation : keyframes[k].observations) seen[observation.landmark] = 1;
  }
  std::vector<std::pair<double, std::size_t>> chosen;
  for (std::size_t k = 0; k < count; ++k) {
    const double distance =
        std::hypot(keyframes[k].pose.x - belief_.pose.x, keyframes[k].pose.y - belief_.pose.y);
    std::size_t common = 0;
    for (const auto& observation : keyframes[k].observations) {
      common += seen[observation.landmark] != 0 ? 1 : 0;
    }
    if (k < end && k + last >= end) {
      chosen.emplace_back(-1.0, k);
    } else if (distance < parameters_.reach && common >= 3) {
      chosen.emplace_back(distance, k);
    }
  }
  std::sort(chosen.begin(), chosen.end());
  if (chosen.size() > most) chosen.resize(most);
  std::sort(chosen.begin(), chosen.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const auto& [distance, k] : chosen) near_.add(keyframes[k].pose, clouds_[k]);
}

std::optional<Registration> Landmarks::register_scan(const Pose2& predicted,
                                                     const PoseWindow& window) {
  if (near_.empty() || scan_.size() < 10) return std::nullopt;
  PoseEstimate prior{predicted, Eigen::Matrix3d::Zero()};
  const double position = 0.5 * window.translation;
  const double heading = 0.5 * window.turn;
  prior.covariance.diagonal() << position * position, position * position, heading * heading;
  std::optional<Registration> best;
  double best_value = 0.0;
  const auto consider = [&](const Pose2& start) {
    const Registration tried = near_.refine(scan_, start, prior);
    const Pose2 off = between(predicted, tried.estimate.pose);
    const double squared = (off.x * off.x + off.y * off.y) / (position * position) +
                           off.theta * off.theta / (heading * heading);
    const double value = tried.share - 0.02 * std::min(squared, 10.0);
    if (best && value <= best_value) return;
    best_value = value;
    best = tried;
  };
  consider(predicted);
  for (const PointMap::Candidate& candidate : near_.search(scan_, window, 3)) {
    consider(candidate.pose);
  }
  if (best->share < least_share) return std::nullopt;
  return best;
}

/// Compares odometry with what the points say of the same step.
void Landmarks::judge_odometry(const PoseEstimate& motion, const Registration& registration) {
  if (!registered_) return;
  const Pose2 step = between(*registered_, registration.estimate.pose);
  const Eigen::Vector3d off(step.x - motion.pose.x, step.y - motion.pose.y,
                            normalized_angle(step.theta - motion.pose.theta));
  const Eigen::Matrix3d& noise = registration.estimate.covariance;
  const double position =
      motion.covariance(0, 0) + motion.covariance(1, 1) + 2.0 * (noise(0, 0) + noise(1, 1));
  const double heading = motion.covariance(2, 2) + 2.0 * noise(2, 2);
  const Eigen::Vector2d ratio(off.head<2>().squaredNorm() / position, off.z() * off.z() / heading);
  judged_motions_ = std::min<std::size_t>(judged_motions_ + 1, 50);
  const double weight = 1.0 / (5.0 + static_cast<double>(judged_motions_));
  for (int i = 0; i < 2; ++i) {
    odometry_scale_(i) += weight * (std::min(ratio(i), 100.0) - odometry_scale_(i));
    odometry_scale_(i) = std::max(odometry_scale_(i), 1.0);
  }
}

/// The motion since the last keyframe by odometry and by the points together.
void Landmarks::fuse(const Registration& registration) {
  const Pose2 seen = between(belief_.pose, registration.estimate.pose);
  const Eigen::Matrix3d noise = in_frame_of(belief_.pose, registration.estimate.covariance);
  const Eigen::Vector3d off(seen.x - since_.pose.x, seen.y - since_.pose.y,
                            normalized_angle(seen.theta - since_.pose.theta));
  const double squared = off.dot((noise + since_.covariance).ldlt().solve(off));
  // Odometry that the points refute counts less: slip lasts longer than its covariance says.
  if (squared > 3.0) since_.covariance *= squared / 3.0;
  const Eigen::Matrix3d gain = since_.covariance * (since_.covariance + noise).inverse();
  const Eigen::Vector3d change = gain * off;
  motion_.pose = moved(since_.pose, change);
  motion_.covariance = since_.covariance - gain * since_.covariance;
  motion_.covariance = (0.5 * (motion_.covariance + motion_.covariance.transpose())).eval();
  search_covariance_ = motion_.covariance;
}

/// The keyframe whose pose is nearest, a radian counted as a metre.
std::size_t Landmarks::nearest_keyframe(const Pose2& pose) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < graph_.keyframes().size(); ++k) {
    const Pose2 apart = between(pose, graph_.keyframes()[k].pose);
    const double distance = apart.x * apart.x + apart.y * apart.y + apart.theta * apart.theta;
    if (distance >= least) continue;
    least = distance;
    nearest = k;
  }
  return nearest;
}

/// Whether the scan shows nothing that the map does not have from near this pose: another keyframe
/// would only make the graph grow.
bool Landmarks::is_known(const Pose2& pose, double matched, double total) const {
  if (!given_.empty()) return true;
  if (share_ < 0.8 || matched < 0.9 * total) return false;
  const Pose2 apart = between(graph_.keyframes()[nearest_keyframe(pose)].pose, pose);
  return std::hypot(apart.x, apart.y) < parameters_.keyframe_distance &&
         std::abs(apart.theta) < parameters_.keyframe_angle;
}

/// The filter goes on from here without a new keyframe, and from time to time with other walls.
void Landmarks::go_on(const Belief& posterior) {
  belief_ = posterior;
  since_ = PoseEstimate{};
  base_is_keyframe_ = false;
  if (std::hypot(belief_.pose.x - refreshed_at_.x, belief_.pose.y - refreshed_at_.y) <
      refresh_distance) {
    return;
  }
  if (given_.empty()) {
    // From the nearest keyframe, with what the points say of the way from there.
    base_keyframe_ = nearest_keyframe(posterior.pose);
    const Pose2 from = graph_.keyframes()[base_keyframe_].pose;
    refresh();
    since_ = {between(from, posterior.pose), in_frame_of(from, scan_covariance_)};
    base_is_keyframe_ = true;
  } else {
    refresh();
  }
  rebuild_near();
}

void Landmarks::add_keyframe(const Belief& posterior, const Pairs& pairs) {
  PoseEstimate motion = motion_;
  if (!base_is_keyframe_) {
    base_keyframe_ = nearest_keyframe(posterior.pose);
    const Pose2& from = graph_.keyframes()[base_keyframe_].pose;
    motion = {between(from, scan_pose_), in_frame_of(from, scan_covariance_)};
  }
  const std::size_t keyframe = graph_.add_keyframe(base_keyframe_, posterior.pose, motion);
  base_keyframe_ = keyframe;
  base_is_keyframe_ = true;
  belief_ = posterior;
  clouds_.push_back(scan_);
  std::vector<char> used(measurements_.size(), 0);
  for (const auto& [i, k] : pairs) {
    used[i] = 1;
    LineLandmark& landmark = graph_.landmarks()[active_[k]];
    landmark.phi = posterior.walls[k](0);
    landmark.offset = posterior.walls[k](1);
    extend(landmark, posterior.pose, measurements_[i]);
    graph_.observe(keyframe, active_[k], measurements_[i]);
  }
  const std::size_t known = active_.size();
  for (std::size_t i = 0; i < measurements_.size(); ++i) {
    const LineMeasurement& m = measurements_[i];
    if (used[i] != 0 || 2.0 * m.half_length < parameters_.min_length) continue;
    bool near = false;
    for (std::size_t k = 0; k < known && !near; ++k) {
      const LineLandmark landmark = wall(belief_, k);
      if (std::cos(belief_.pose.theta + m.alpha - landmark.phi) < 0.8) continue;
      if (overlap(belief_.pose, landmark, m) <= 0.0) continue;
      const LineResidual residual = line_residual(belief_.pose, landmark, m);
      const Eigen::Matrix2d s = innovation_of(residual, belief_.covariance, k, m.covariance);
      near = s(1, 1) < widest_offset * widest_offset &&
             residual.value.dot(s.inverse() * residual.value) < near_gate;
    }
    if (near) continue;
    const LineLandmark landmark = landmark_of(belief_.pose, m);
    const std::size_t index = graph_.add_landmark(landmark);
    graph_.observe(keyframe, index, m);
    const Eigen::Index size = belief_.covariance.rows();
    const LineResidual residual = line_residual(belief_.pose, landmark, m);
    Eigen::MatrixXd grown(size + 2, size + 2);
    grown.topLeftCorner(size, size) = belief_.covariance;
    grown.bottomLeftCorner(2, size) = residual.by_pose * belief_.covariance.topRows<3>();
    grown.topRightCorner(size, 2) = grown.bottomLeftCorner(2, size).transpose();
    grown.bottomRightCorner<2, 2>() =
        residual.by_pose * belief_.covariance.topLeftCorner<3, 3>() * residual.by_pose.transpose() +
        m.covariance;
    belief_.covariance = std::move(grown);
    belief_.walls.emplace_back(landmark.phi, landmark.offset);
    active_.push_back(index);
  }
  since_ = PoseEstimate{};
  const Eigen::Vector2d here(belief_.pose.x, belief_.pose.y);
  if (near_.empty() || (here - near_.center()).norm() > 4.0) rebuild_near();
  near_.add(belief_.pose, scan_);
  const double way = std::hypot(belief_.pose.x - refreshed_at_.x, belief_.pose.y - refreshed_at_.y);
  check_loops();
  const bool closed = close_loop();
  if (closed || keyframe >= refreshed_keyframe_ + refresh_keyframes || way > refresh_distance) {
    refresh();
    if (closed) refresh();
    rebuild_near();
  }
}

/// One step of the whole graph, and the filter anew from its joint covariance.
void Landmarks::refresh() {
  const std::size_t keyframe = base_keyframe_;
  const Pose2 pose = given_.empty() ? graph_.keyframes()[keyframe].pose : belief_.pose;
  std::vector<std::pair<double, std::size_t>> around;
  for (std::size_t i = 0; i < graph_.landmarks().size(); ++i) {
    const LineLandmark& landmark = graph_.landmarks()[i];
    if (!landmark.alive) continue;
    // Seen once, long ago: something that moved.
    if (landmark.observations < 2 && landmark.last_keyframe + 30 < keyframe) continue;
    const Eigen::Vector2d from = Eigen::Vector2d(pose.x, pose.y) - landmark.anchor;
    const double s = std::clamp(landmark.along().dot(from), landmark.low, landmark.high);
    const double distance = (landmark.at(s) - Eigen::Vector2d(pose.x, pose.y)).norm();
    if (distance < parameters_.reach) around.emplace_back(distance, i);
  }
  std::sort(around.begin(), around.end());
  if (around.size() > most_active) around.resize(most_active);
  std::vector<std::size_t> active;
  for (const auto& [distance, index] : around) active.push_back(index);
  std::sort(active.begin(), active.end());
  if (given_.empty()) {
    const Eigen::MatrixXd covariance = graph_.marginal_after_step(keyframe, active);
    if (covariance.rows() == 0) return;
    active_ = std::move(active);
    belief_.covariance = covariance;
    belief_.pose = graph_.keyframes()[keyframe].pose;
  } else {
    active_ = std::move(active);
    const auto size = static_cast<Eigen::Index>(3 + 2 * active_.size());
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
    covariance.topLeftCorner<3, 3>() = belief_.covariance.topLeftCorner<3, 3>();
    for (std::size_t k = 0; k < active_.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(3 + 2 * k);
      covariance.block<2, 2>(at, at) = given_[active_[k]];
    }
    belief_.covariance = std::move(covariance);
  }
  belief_.walls.clear();
  for (const std::size_t index : active_) {
    belief_.walls.emplace_back(graph_.landmarks()[index].phi, graph_.landmarks()[index].offset);
  }
  refreshed_at_ = belief_.pose;
  refreshed_keyframe_ = keyframe;
  if (given_.empty()) merge_same_walls();
}

/// Walls that are one within their joint covariance, where that is narrow enough to tell.
void Landmarks::merge_same_walls() {
  for (std::size_t a = 0; a < active_.size(); ++a) {
    for (std::size_t b = a + 1; b < active_.size(); ++b) {
      const LineLandmark& first = graph_.landmarks()[active_[a]];
      const LineLandmark& second = graph_.landmarks()[active_[b]];
      if (!first.alive || !second.alive) continue;
      const double turn = normalized_angle(second.phi - first.phi);
      if (std::abs(turn) > 0.2) continue;
      const double s0 = first.along().dot(second.at(second.low) - first.anchor);
      const double s1 = first.along().dot(second.at(second.high) - first.anchor);
      const double low = std::max(first.low, std::min(s0, s1));
      const double high = std::min(first.high, std::max(s0, s1));
      if (high - low < 0.25 * std::min(first.length(), second.length())) continue;
      const double s = 0.5 * (low + high);
      const Eigen::Vector2d point = first.at(s);
      const Eigen::Vector2d difference(turn,
                                       second.normal().dot(point - second.anchor) - second.offset);
      Eigen::Matrix<double, 2, 4> jacobian;
      jacobian << -1.0, 0.0, 1.0, 0.0, -s, 1.0, second.along().dot(point - second.anchor), -1.0;
      const auto ia = static_cast<Eigen::Index>(3 + 2 * a);
      const auto ib = static_cast<Eigen::Index>(3 + 2 * b);
      Eigen::Matrix4d joint;
      joint << belief_.covariance.block<2, 2>(ia, ia), belief_.covariance.block<2, 2>(ia, ib),
          belief_.covariance.block<2, 2>(ib, ia), belief_.covariance.block<2, 2>(ib, ib);
      const Eigen::Matrix2d c = jacobian * joint * jacobian.transpose() +
                                Eigen::Matrix2d(1e-12 * Eigen::Matrix2d::Identity());
      if (c(0, 0) > 0.04 * 0.04 || c(1, 1) > 0.06 * 0.06) continue;
      if (difference.dot(c.inverse() * difference) > same_wall_gate) continue;
      const bool keep_first = first.observations >= second.observations;
      graph_.merge(keep_first ? active_[a] : active_[b], keep_first ? active_[b] : active_[a]);
    }
  }
  // The filter forgets the dropped ones: what they say of the pose is in the graph.
  std::vector<Eigen::Index> kept{0, 1, 2};
  std::vector<std::size_t> active;
  std::vector<Eigen::Vector2d> walls;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    if (!graph_.landmarks()[active_[k]].alive) continue;
    kept.push_back(static_cast<Eigen::Index>(3 + 2 * k));
    kept.push_back(static_cast<Eigen::Index>(4 + 2 * k));
    active.push_back(active_[k]);
    walls.push_back(belief_.walls[k]);
  }
  if (active.size() == active_.size()) return;
  belief_.covariance = Eigen::MatrixXd(belief_.covariance(kept, kept));
  active_ = std::move(active);
  belief_.walls = std::move(walls);
}

/// Points of some keyframes, from the pose of one of them.
std::vector<SurfacePoint> Landmarks::points_around(std::size_t keyframe, std::size_t first,
                                                   std::size_t last) const {
  const auto& keyframes = graph_.keyframes();
  std::vector<SurfacePoint> points;
  for (std::size_t k = first; k <= last && k < keyframes.size(); ++k) {
    const Pose2 relative = between(keyframes[keyframe].pose, keyframes[k].pose);
    for (const SurfacePoint& point : clouds_[k]) {
      if (point.position.norm() < loop_reach) points.push_back(transformed(relative, point));
    }
  }
  return points;
}

/// Looks for the last keyframes in the map around keyframes of long before. A loop is closed when
/// two pairs of keyframes say the same, and the graph can explain it.
bool Landmarks::close_loop() {
  const auto& keyframes = graph_.keyframes();
  const std::size_t now = keyframes.size() - 1;
  if (now < 30 || now < last_loop_keyframe_ + 2) return false;
  last_loop_keyframe_ = now;
  std::vector<char> seen(graph_.landmarks().size(), 0);
  for (std::size_t k = now - 5; k <= now; ++k) {
    for (const auto& observation : keyframes[k].observations) seen[observation.landmark] = 1;
  }
  // How far the map may have drifted since each keyframe.
  double way = 0.0, turned = 0.0, best_distance = 1e9, window = 0.0, turn = 0.0;
  std::size_t old = now;
  const Pose2& here = keyframes[now].pose;
  for (std::size_t k = now; k-- > 0;) {
    const Pose2 step = between(keyframes[k].pose, keyframes[k + 1].pose);
    way += std::hypot(step.x, step.y);
    turned += std::abs(step.theta);
    if (k + 20 > now) continue;
    const double drift = std::min(4.0, 0.5 + 0.03 * way);
    const double distance = std::hypot(keyframes[k].pose.x - here.x, keyframes[k].pose.y - here.y);
    if (distance > drift + 1.0 || distance >= best_distance) continue;
    std::size_t common = 0;
    for (const auto& observation : keyframes[k].observations) {
      common += seen[observation.landmark] != 0 ? 1 : 0;
    }
    if (common >= 3) return false;  // closed already
    best_distance = distance;
    old = k;
    window = drift;
    turn = std::min(0.4, 0.1 + 0.002 * way + 0.002 * turned);
  }
  if (old == now) return false;
  PointMap around;
  const Pose2& base = keyframes[old].pose;
  around.clear({base.x, base.y}, loop_reach + 2.0);
  const std::size_t first = old > 6 ? old - 6 : 0;
  for (std::size_t k = first; k <= std::min(old + 6, now); ++k)
    around.add(keyframes[k].pose, clouds_[k]);
  const std::vector<SurfacePoint> recent = points_around(now, now - 6, now);
  const std::vector<PointMap::Candidate> found = around.search(recent, {here, window, turn}, 3);
  if (found.empty()) return false;
  std::vector<Registration> refined;
  for (const PointMap::Candidate& candidate : found) {
    const PoseEstimate prior{candidate.pose, 0.04 * Eigen::Matrix3d::Identity()};
    refined.push_back(around.refine(recent, candidate.pose, prior));
  }
  const auto best = std::max_element(
      refined.begin(), refined.end(),
      [](const Registration& a, const Registration& b) { return a.share < b.share; });
  double second = 0.0;
  for (const Registration& other : refined) {
    const Pose2 apart = between(best->estimate.pose, other.estimate.pose);
    if (std::hypot(apart.x, apart.y) > 0.3 || std::abs(apart.theta) > 0.15) {
      second = std::max(second, other.share);
    }
  }
  if (best->share < 0.55 || second > 0.85 * best->share) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(best->estimate.covariance.topLeftCorner<2, 2>()));
  if (axes.eigenvalues()(1) > 0.1 * 0.1) return false;
  LandmarkGraph::Edge edge;
  edge.from = old;
  edge.to = now;
  edge.motion.pose = between(base, best->estimate.pose);
  edge.motion.covariance = in_frame_of(base, best->estimate.covariance);
  std::erase_if(pending_loops_, [&](const auto& pending) { return pending.to + 20 < now; });
  // Pairs that put their keyframes where this one does, seen from the last one. Those from one
  // place say the same again.
  std::vector<LandmarkGraph::Edge> agreeing;
  Pose2 last = here;
  for (auto pending = pending_loops_.rbegin(); pending != pending_loops_.rend(); ++pending) {
    const Pose2 to = keyframes[pending->to].pose;
    if (!agreeing.empty() && std::hypot(to.x - last.x, to.y - last.y) < loop_pair_apart) continue;
    const Pose2 one = compose(keyframes[pending->from].pose, pending->motion.pose);
    const Pose2 two = compose(base, edge.motion.pose);
    const Pose2 off = between(between(to, here), between(one, two));
    if (std::hypot(off.x, off.y) >= 0.3 || std::abs(off.theta) >= 0.06) continue;
    agreeing.push_back(*pending);
    last = to;
  }
  if (agreeing.empty()) {
    pending_loops_.push_back(edge);
    return false;
  }
  LandmarkGraph tried = graph_;
  const double before = tried.optimize(3);
  const std::size_t first_loop = tried.edges().size();
  for (const LandmarkGraph::Edge& pair : agreeing) {
    tried.close_loop(pair.from, pair.to, pair.motion);
  }
  tried.close_loop(edge.from, edge.to, edge.motion);
  const double after = tried.optimize(6, true);
  tried.optimize(3);  // it has to hold without, too
  double chi = 0.0;
  for (std::size_t i = first_loop; i < tried.edges().size(); ++i) {
    chi = std::max(chi, tried.chi_square(tried.edges()[i]));
  }
  // A map is more certain of itself than it should be, by errors that scans have in common. What
  // bends it far needs more pairs.
  if (chi > loop_gate || after - before > loop_cost * static_cast<double>(agreeing.size())) {
    pending_loops_.push_back(edge);
    return false;
  }
  graph_ = std::move(tried);
  pending_loops_.clear();
  ++closed_loops_;
  return true;
}

/// Loops that prove wrong, by what came after them, are taken out.
void Landmarks::check_loops() {
  for (std::size_t i = graph_.edges().size(); i-- > 0;) {
    const LandmarkGraph::Edge& edge = graph_.edges()[i];
    if (edge.closes_loop && graph_.chi_square(edge) > 2.0 * loop_gate) {
      graph_.drop_loop(i);
      --closed_loops_;
    }
  }
}

/// The points of the whole map: of all keyframes, or of all given walls.
void Landmarks::build_whole() {
  constexpr double margin = 2.0;  // [m]
  const auto& keyframes = graph_.keyframes();
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const LineLandmark& landmark : graph_.landmarks()) {
    if (!landmark.alive) continue;
    for (const double s : {landmark.low, landmark.high}) {
      low = low.cwiseMin(landmark.at(s));
      high = high.cwiseMax(landmark.at(s));
    }
  }
  if (given_.empty()) {
    for (const LandmarkGraph::Keyframe& keyframe : keyframes) {
      low = low.cwiseMin(Eigen::Vector2d(keyframe.pose.x, keyframe.pose.y));
      high = high.cwiseMax(Eigen::Vector2d(keyframe.pose.x, keyframe.pose.y));
    }
  }
  whole_window_.center = {0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), 0.0};
  whole_window_.translation = 0.5 * (high - low).maxCoeff();
  whole_window_.turn = pi;
  whole_.clear(0.5 * (low + high), whole_window_.translation + margin);
  if (given_.empty()) {
    for (std::size_t k = 0; k < keyframes.size(); ++k) whole_.add(keyframes[k].pose, clouds_[k]);
    return;
  }
  for (const LineLandmark& landmark : graph_.landmarks()) whole_.add({}, points_on(landmark));
}

/// Where on the whole map the points of the scan lie, if they lie at one place only.
std::optional<Registration> Landmarks::find_in_whole() {
  std::vector<Registration> refined;
  for (const PointMap::Candidate& candidate : whole_.search(scan_, whole_window_, 20)) {
    const PoseEstimate prior{candidate.pose, 0.04 * Eigen::Matrix3d::Identity()};
    refined.push_back(whole_.refine(scan_, candidate.pose, prior));
  }
  if (refined.empty()) return std::nullopt;
  const Registration best = *std::max_element(
      refined.begin(), refined.end(),
      [](const Registration& a, const Registration& b) { return a.share < b.share; });
  if (!lies_at(best)) return std::nullopt;
  // Every other place contradicts the scan by more than a door or a sofa that people move.
  for (const Registration& other : refined) {
    const Pose2 apart = between(best.estimate.pose, other.estimate.pose);
    if (std::hypot(apart.x, apart.y) < 0.3 && std::abs(apart.theta) < 0.15) continue;
    if (contradicted_length(other) < contradicted_length(best) + least_contradicted) {
      return std::nullopt;
    }
  }
  return best;
}

/// Length [m] of what is seen where the map has nothing, and of mapped walls that are seen through.
double Landmarks::contradicted_length(const Registration& registration) const {
  std::vector<std::size_t> walls;
  for (std::size_t i = 0; i < graph_.landmarks().size(); ++i) {
    if (graph_.landmarks()[i].alive) walls.push_back(i);
  }
  return (1.0 - registration.share) * static_cast<double>(scan_.size()) * point_spacing +
         seen_through(registration.estimate.pose, walls);
}

/// Whether nearly all that is seen lies on the map there, and the position is determined in every
/// direction.
bool Landmarks::lies_at(const Registration& registration) const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(registration.estimate.covariance.topLeftCorner<2, 2>()));
  const double length = static_cast<double>(scan_.size()) * point_spacing;
  return registration.share > least_found_share && axes.eigenvalues()(1) < 0.1 * 0.1 &&
         contradicted_length(registration) < std::max(least_refuted, 0.25 * length);
}

/// Looks for the scan in the whole map. A pose that is found goes on with the motion, and is taken
/// when the scans that follow lie there, too.
bool Landmarks::relocalize(const LocalizationInput& input) {
  if (scan_.size() < least_points) {
    candidate_.reset();
    return false;
  }
  if (whole_.empty()) build_whole();
  std::optional<Registration> found;
  if (candidate_) {
    if (input.motion) candidate_ = compose(*candidate_, input.motion->pose);
    const PoseEstimate prior{*candidate_, 0.04 * Eigen::Matrix3d::Identity()};
    for (const PointMap::Candidate& near : whole_.search(scan_, {*candidate_, 0.3, 0.2}, 1)) {
      found = whole_.refine(scan_, near.pose, prior);
    }
    if (found && !lies_at(*found)) found.reset();
    ++found_scans_;
  } else if (input.stamp >= next_search_) {
    next_search_ = input.stamp + search_period;
    found = find_in_whole();
    found_scans_ = 0;
  }
  candidate_.reset();
  if (!found) return false;
  const Pose2 pose = found->estimate.pose;
  if (found_scans_ < lost_scans) {
    candidate_ = pose;
    return false;
  }
  // On from the keyframe that is nearest, as far from it as the points say.
  if (given_.empty()) {
    base_keyframe_ = nearest_keyframe(pose);
    base_is_keyframe_ = true;
    const Pose2 from = graph_.keyframes()[base_keyframe_].pose;
    belief_.pose = from;
    refresh();
    since_ = {between(belief_.pose, compose(belief_.pose, between(from, pose))),
              in_frame_of(from, found->estimate.covariance)};
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
  whole_ = PointMap{};
  registered_.reset();
  found_scans_ = 0;
  lost_ = false;
  return true;
}

void Landmarks::operator()(const LocalizationInput& input, Localization& result) {
  measurements_.clear();
  for (const LineSegment& line : input.lines) {
    const LineMeasurement m = line_measurement(line, parameters_.flatness_stddev);
    if (m.half_length > 0.0 && m.covariance.allFinite() && m.covariance.determinant() > 0.0) {
      measurements_.push_back(m);
    }
  }
  collect_points(input);
  result.map.clear();
  const bool first = graph_.keyframes().empty();
  if (first) {
    belief_.covariance = 1e-10 * Eigen::Matrix3d::Identity();
    add_keyframe(belief_, {});
    result.pose = {belief_.pose, belief_.covariance.topLeftCorner<3, 3>()};
    result.status = LocalizationStatus::tracking;
    result.matched = 0;
    result.weak_direction.reset();
    last_pose_ = belief_.pose;
  } else {
    const double seconds = stamp_ ? std::max(1e-3, input.stamp - *stamp_) : 0.1;
    has_odometry_ = input.motion.has_value();
    if (input.motion) {
      PoseEstimate motion = *input.motion;
      Eigen::Vector3d scale(odometry_scale_.x(), odometry_scale_.x(), odometry_scale_.y());
      scale = scale.cwiseSqrt();
      motion.covariance = scale.asDiagonal() * motion.covariance * scale.asDiagonal();
      since_ = compose_correlated(since_, motion);
      search_covariance_ = since_.covariance;
    } else {
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
    Belief posterior;
    const bool found_again = lost_ && relocalize(input);
    if (found_again) fits_ = true;
    motion_ = since_;
    PoseWindow window;
    window.center = compose(belief_.pose, since_.pose);
    if (input.motion) {
      const Pose2& step = input.motion->pose;
      window.translation = 0.15 + 0.3 * std::hypot(step.x, step.y);
      window.turn = 0.05 + 0.3 * std::abs(step.theta);
      if (!found_again) window.center = compose(last_pose_, step);
    } else {
      window.translation = std::clamp(3.0 * parameters_.speed_stddev * seconds, 0.1, 1.0);
      window.turn = std::clamp(3.0 * parameters_.turn_stddev * seconds, 0.05, 0.8);
    }
    expected_step_ = between(last_pose_, window.center);
    const std::optional<Registration> registration = register_scan(window.center, window);
    if (registration) {
      if (input.motion) judge_odometry(*input.motion, *registration);
      fuse(*registration);
    }
    share_ = registration ? registration->share : 0.0;
    scan_pose_ = registration ? registration->estimate.pose : window.center;
    scan_covariance_ = registration ? registration->estimate.covariance : unknown_place;
    registered_.reset();
    double weakening = 1.0;
    Pairs pairs = find_pairs(predict({motion_.pose, search_covariance_}), weakening);
    motion_.covariance *= weakening;
    const Belief prior = predict(motion_);
    update(prior, pairs, posterior);
    if (pairs.empty()) posterior = prior;
    judge(posterior, pairs, result);
    const double matched = length_of(pairs);
    const double total = length_of_scan();
    well_matched_ = matched >= 0.5 * total && !pairs.empty();
    if (fits_) {
      last_share_ = share_;
      lost_since_ = input.stamp;
      unfit_scans_ = 0;
      // Back where it should be, such as when what hid the walls has gone.
      const bool is_back =
          lost_ && share_ > back_share && pairs.size() >= 3 && matched > 0.7 * total;
      back_scans_ = is_back ? back_scans_ + 1 : 0;
      if (back_scans_ >= back_scans) lost_ = false;
    } else if (++unfit_scans_ >= lost_scans && input.stamp - lost_since_ > lost_after) {
      if (!lost_) whole_ = PointMap{};
      lost_ = true;
      back_scans_ = 0;
      result.status = LocalizationStatus::lost;
    }
    if (registration) registered_ = posterior.pose;
    // Where a scan does not fit, the next one is expected as if this one had not been.
    if (fits_) velocity_ = twist_of(between(last_pose_, posterior.pose)) / seconds;
    last_pose_ = fits_ ? posterior.pose : window.center;
    const Pose2 way = between(belief_.pose, posterior.pose);
    const double driven = std::hypot(way.x, way.y);
    const bool shows_new = matched < 0.7 * total;
    if (fits_ && !lost_ &&
        (driven > parameters_.keyframe_distance ||
         std::abs(way.theta) > parameters_.keyframe_angle ||
         (shows_new && (driven > 0.25 * parameters_.keyframe_distance ||
                        std::abs(way.theta) > 0.25 * parameters_.keyframe_angle)))) {
      if (is_known(posterior.pose, matched, total)) {
        go_on(posterior);
      } else {
        add_keyframe(posterior, pairs);
      }
      // What the graph has smoothed moves the last scan along.
      if (base_is_keyframe_ && since_.pose.x == 0.0 && since_.pose.y == 0.0) {
        last_pose_ = belief_.pose;
        result.pose = {belief_.pose, belief_.covariance.topLeftCorner<3, 3>()};
      }
    }
  }
  result.keyframe.reset();
  if (given_.empty()) {
    result.keyframe = base_is_keyframe_ ? base_keyframe_ : nearest_keyframe(result.pose.pose);
    result.in_keyframe = between(graph_.keyframes()[*result.keyframe].pose, result.pose.pose);
  }
  stamp_ = input.stamp;
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
  for (const MapLine& line : map) {
    const double length = line.length();
    if (!(length > 0.0)) continue;
    const Eigen::Vector2d along = (line.end - line.start) / length;
    LineLandmark landmark;
    landmark.anchor = line.middle();
    landmark.phi = direction_of(along.y(), -along.x());
    landmark.low = -0.5 * length;
    landmark.high = 0.5 * length;
    landmark.observations = std::max<std::size_t>(line.observations, 3);
    Eigen::Matrix2d covariance = line.covariance;
    if (!(covariance.determinant() > 0.0)) {
      const double offset = parameters_.plan_stddev;
      const double turn = std::min(2.0 * offset / length, 0.1);
      covariance = Eigen::Vector2d(turn * turn, offset * offset).asDiagonal();
    }
    graph_.add_landmark(landmark);
    given_.push_back(covariance);
    if (line.observations > 0) continue;
    landmark.phi = normalized_angle(landmark.phi + pi);  // the other face
    graph_.add_landmark(landmark);
    given_.push_back(covariance);
  }
  const PoseEstimate from =
      pose.value_or(PoseEstimate{{}, Eigen::Vector3d(1e4, 1e4, 1e1).asDiagonal()});
  lost_ = !pose;
  graph_.add_keyframe(0, from.pose, {});
  belief_.pose = last_pose_ = from.pose;
  belief_.covariance = from.covariance;
  refresh();
  rebuild_near();
}

}  // namespace quoin
