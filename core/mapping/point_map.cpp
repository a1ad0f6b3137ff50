// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/point_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr double cell = 0.05;                   // [m]
constexpr int stamp_cells = 6;                  // around a point
constexpr double likelihood_stddev = 0.1;       // [m]
constexpr float same_point = 0.03F;             // [m]
constexpr std::array<int, 2> blocks_of{8, 16};  // cells to a side that share a bound, by level
constexpr int stride = 2;                       // cells from pose to pose of the search
constexpr std::size_t most_searched = 100;      // points of a scan
constexpr double robust_scale = 0.05;           // [m]
constexpr double round_stddev = 0.04;           // [m] of points without a direction
constexpr double least_stddev = 0.01;           // [m] of a point
constexpr double same_error = 10.0;             // neighbouring points that share their error
constexpr double on_surface = 0.10;             // [m]
constexpr float same_direction = 0.8F;          // cosine of normals
constexpr double floor_position = 0.015;        // [m] of a registration
constexpr double floor_heading = 0.004;         // [rad]
constexpr double surface_gap = 0.3;             // [m] between neighbours of one surface
constexpr int largest_side = 4000;              // cells

Eigen::Vector2f rotated(float c, float s, const Eigen::Vector2f& v) {
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

}  // namespace

void surface_points(std::span<const Eigen::Vector2d> points, double spacing, double reach,
                    std::vector<SurfacePoint>& result) {
  result.clear();
  Eigen::Vector2d last(1e9, 1e9);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d& p = points[i];
    if (p.squaredNorm() > reach * reach || (p - last).squaredNorm() < spacing * spacing) continue;
    last = p;
    // Neighbours some centimetres to each side: nearer ones are noise.
    Eigen::Vector2d ends[2] = {p, p};
    const double wanted = std::max(0.1, 0.02 * p.norm());
    for (int side = 0; side < 2; ++side) {
      const Eigen::Vector2d* before = &p;
      for (std::size_t step = 1; step <= 8; ++step) {
        if (side == 0 ? i < step : i + step >= points.size()) break;
        const Eigen::Vector2d& q = side == 0 ? points[i - step] : points[i + step];
        if ((q - *before).norm() > std::max(surface_gap, 0.05 * p.norm())) break;
        before = &q;
        ends[side] = q;
        if ((q - p).norm() >= wanted) break;
      }
    }
    SurfacePoint surface;
    surface.position = p.cast<float>();
    const Eigen::Vector2d along = ends[1] - ends[0];
    const double length = along.norm();
    if (length > 0.08) {
      Eigen::Vector2d normal(-along.y() / length, along.x() / length);
      // Both neighbours in line with the point.
      const double bend = std::abs(normal.dot(p - ends[0]));
      if (bend < 0.25 * length) {
        if (normal.dot(p) > 0.0) normal = -normal;
        surface.normal = normal.cast<float>();
      }
    }
    result.push_back(surface);
  }
}

SurfacePoint transformed(const Pose2& pose, const SurfacePoint& point) {
  const auto c = static_cast<float>(std::cos(pose.theta));
  const auto s = static_cast<float>(std::sin(pose.theta));
  return {rotated(c, s, point.position) +
              Eigen::Vector2f(static_cast<float>(pose.x), static_cast<float>(pose.y)),
          rotated(c, s, point.normal)};
}

void PointMap::clear(const Eigen::Vector2d& center, double reach) {
  center_ = center;
  side_ = std::clamp(2 * static_cast<int>(std::lround(reach / cell)), 2, largest_side);
  corner_ = center - Eigen::Vector2d::Constant(0.5 * side_ * cell);
  points_.clear();
  const auto cells = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  nearest_.assign(cells, -1);
  likelihood_.assign(cells, 0);
  for (auto& pooled : pooled_) pooled.clear();
}

void PointMap::add(const Pose2& pose, std::span<const SurfacePoint> points) {
  for (const SurfacePoint& local : points) {
    const SurfacePoint point = transformed(pose, local);
    const Eigen::Vector2d at = point.position.cast<double>();
    const int column = static_cast<int>(std::floor((at.x() - corner_.x()) / cell));
    const int row = static_cast<int>(std::floor((at.y() - corner_.y()) / cell));
    if (column < 0 || row < 0 || column >= side_ || row >= side_) continue;
    const SurfacePoint* known = nearest(at);
    if (known != nullptr && (known->position - point.position).norm() < same_point &&
        known->normal.dot(point.normal) > -0.5F) {
      continue;
    }
    points_.push_back(point);
    mark(points_.size() - 1);
  }
}

/// Enters a point in the cells around it.
void PointMap::mark(std::size_t point_index) {
  const SurfacePoint& point = points_[point_index];
  const Eigen::Vector2d at = point.position.cast<double>();
  const int column = static_cast<int>(std::floor((at.x() - corner_.x()) / cell));
  const int row = static_cast<int>(std::floor((at.y() - corner_.y()) / cell));
  const auto index = static_cast<std::int32_t>(point_index);
  for (auto& pooled : pooled_) pooled.clear();
  for (int r = std::max(0, row - stamp_cells); r <= std::min(side_ - 1, row + stamp_cells); ++r) {
    for (int c = std::max(0, column - stamp_cells); c <= std::min(side_ - 1, column + stamp_cells);
         ++c) {
      const Eigen::Vector2f middle =
          (corner_ + cell * Eigen::Vector2d(c + 0.5, r + 0.5)).cast<float>();
      const auto place = static_cast<std::size_t>(r) * static_cast<std::size_t>(side_) +
                         static_cast<std::size_t>(c);
      const float squared = (middle - point.position).squaredNorm();
      std::int32_t& owner = nearest_[place];
      if (owner >= 0 &&
          (points_[static_cast<std::size_t>(owner)].position - middle).squaredNorm() <= squared) {
        continue;
      }
      owner = index;
      constexpr auto scale = static_cast<float>(0.5 / (likelihood_stddev * likelihood_stddev));
      likelihood_[place] = static_cast<std::uint8_t>(255.0F * std::exp(-squared * scale));
    }
  }
}

void PointMap::restore_cells() {
  if (side_ < 0 || side_ > largest_side) throw std::invalid_argument("the state has a wrong map");
  const std::vector<SurfacePoint> points = std::move(points_);
  clear(center_, 0.5 * side_ * cell);
  points_ = points;
  for (std::size_t i = 0; i < points_.size(); ++i) mark(i);
}

const SurfacePoint* PointMap::nearest(const Eigen::Vector2d& point) const {
  const double x = (point.x() - corner_.x()) / cell;
  const double y = (point.y() - corner_.y()) / cell;
  if (!(x >= 0.0 && y >= 0.0 && x < side_ && y < side_)) return nullptr;
  const std::int32_t index =
      nearest_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
               static_cast<std::size_t>(x)];
  return index < 0 ? nullptr : &points_[static_cast<std::size_t>(index)];
}

/// The largest likelihood of the block of cells to the right of and above each cell.
void PointMap::pool(std::size_t level) {
  std::vector<std::uint8_t>& pooled = pooled_[level];
  if (!pooled.empty()) return;
  const auto side = static_cast<std::size_t>(side_);
  std::size_t step = 1;
  if (level > 0) {
    pool(level - 1);
    step = static_cast<std::size_t>(blocks_of[level - 1]);
  }
  pooled = level > 0 ? pooled_[level - 1] : likelihood_;
  for (; step < static_cast<std::size_t>(blocks_of[level]); step *= 2) {  // doubles the block
    for (std::size_t r = 0; r < side; ++r) {
      std::uint8_t* line = pooled.data() + r * side;
      for (std::size_t c = 0; c + step < side; ++c) line[c] = std::max(line[c], line[c + step]);
    }
    for (std::size_t r = 0; r + step < side; ++r) {
      std::uint8_t* line = pooled.data() + r * side;
      const std::uint8_t* above = line + step * side;
      for (std::size_t c = 0; c < side; ++c) line[c] = std::max(line[c], above[c]);
    }
  }
}

std::vector<PointMap::Candidate> PointMap::search(std::span<const SurfacePoint> scan,
                                                  const PoseWindow& window, std::size_t count) {
  std::vector<Candidate> found;
  if (scan.empty() || empty()) return found;
  const std::size_t used = std::min(scan.size(), most_searched);
  std::vector<Eigen::Vector2f> points(used);
  double far = 0.0;
  for (std::size_t i = 0; i < used; ++i) {
    points[i] = scan[i * scan.size() / used].position;
    far += points[i].norm() / static_cast<double>(used);
  }
  const double turn_step = std::clamp(1.5 * cell * stride / std::max(far, 0.1), 0.005, 0.035);
  const int turns = static_cast<int>(std::ceil(window.turn / turn_step));
  constexpr int block = blocks_of[0];
  const int width = static_cast<int>(std::ceil(2.0 * window.translation / (cell * block))) * block;
  // Large blocks pay in large windows alone.
  const std::size_t top = width > 2 * blocks_of[1] ? 1 : 0;
  pool(top);
  struct Block {
    int bound;
    std::size_t level;
    int turn, up, right;
    // The largest bound is next; of equal ones large blocks, whose parts may have it, too.
    bool operator<(const Block& o) const {
      return std::tie(bound, level, o.turn, o.up, o.right) <
             std::tie(o.bound, o.level, turn, up, right);
    }
  };
  std::vector<std::array<int, 2>> cells(used);
  const double left = window.center.x - window.translation;
  const double below = window.center.y - window.translation;
  const auto place = [&](int turn) {
    const double theta = window.center.theta + turn_step * turn;
    const auto c = static_cast<float>(std::cos(theta));
    const auto s = static_cast<float>(std::sin(theta));
    for (std::size_t i = 0; i < used; ++i) {
      const Eigen::Vector2f p = rotated(c, s, points[i]);
      cells[i] = {
          static_cast<int>(std::floor((left + static_cast<double>(p.x()) - corner_.x()) / cell)),
          static_cast<int>(std::floor((below + static_cast<double>(p.y()) - corner_.y()) / cell))};
    }
  };
  // Of blocks of `size` cells, some of which may be on the map where their first one is not.
  const auto sum = [&](const std::vector<std::uint8_t>& grid, int size, int right, int up) {
    int total = 0;
    for (const auto& [x, y] : cells) {
      const int column = x + right;
      const int row = y + up;
      if (column <= -size || row <= -size || column >= side_ || row >= side_) continue;
      total += grid[static_cast<std::size_t>(std::max(row, 0)) * static_cast<std::size_t>(side_) +
                    static_cast<std::size_t>(std::max(column, 0))];
    }
    return total;
  };
  std::priority_queue<Block> open;
  const auto add_blocks = [&](std::size_t level, int turn, int up, int right, int size) {
    const int step = blocks_of[level];
    for (int u = up; u < std::min(up + size, width); u += step) {
      for (int r = right; r < std::min(right + size, width); r += step) {
        open.push({sum(pooled_[level], step, r, u), level, turn, u, r});
      }
    }
  };
  for (int turn = -turns; turn <= turns; ++turn) {
    place(turn);
    add_blocks(top, turn, 0, 0, width);
  }
  std::vector<Candidate> best;
  int highest = 0;
  int placed = turns + 1;
  while (!open.empty()) {
    const Block b = open.top();
    open.pop();
    if (5 * b.bound < 4 * highest || b.bound == 0) break;
    if (placed != b.turn) place(placed = b.turn);
    if (b.level > 0) {
      add_blocks(b.level - 1, b.turn, b.up, b.right, blocks_of[b.level]);
      continue;
    }
    Candidate local;
    int local_sum = -1;
    for (int up = 0; up < block; up += stride) {
      for (int right = 0; right < block; right += stride) {
        const int total = sum(likelihood_, 1, b.right + right, b.up + up);
        if (total <= local_sum) continue;
        local_sum = total;
        local.pose = {left + cell * (b.right + right), below + cell * (b.up + up),
                      normalized_angle(window.center.theta + turn_step * b.turn)};
      }
    }
    local.score = local_sum / (255.0 * static_cast<double>(used));
    highest = std::max(highest, local_sum);
    best.push_back(local);
  }
  std::stable_sort(best.begin(), best.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  for (const Candidate& candidate : best) {
    if (found.size() >= count) break;
    const bool is_new = std::none_of(found.begin(), found.end(), [&](const Candidate& other) {
      return std::hypot(other.pose.x - candidate.pose.x, other.pose.y - candidate.pose.y) < 0.3 &&
             std::abs(normalized_angle(other.pose.theta - candidate.pose.theta)) < 0.15;
    });
    if (is_new) found.push_back(candidate);
  }
  return found;
}

Registration PointMap::refine(std::span<const SurfacePoint> scan, const Pose2& start,
                              const PoseEstimate& prior) const {
  Registration result;
  Pose2 pose = start;
  const Eigen::Matrix3d prior_information = prior.covariance.inverse();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double squares = 0.0, weights = 0.0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    information.setZero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    squares = weights = 0.0;
    const double c = std::cos(pose.theta);
    const double s = std::sin(pose.theta);
    for (const SurfacePoint& local : scan) {
      const Eigen::Vector2d from(
          c * static_cast<double>(local.position.x()) - s * static_cast<double>(local.position.y()),
          s * static_cast<double>(local.position.x()) +
              c * static_cast<double>(local.position.y()));
      const Eigen::Vector2d at = from + Eigen::Vector2d(pose.x, pose.y);
      const SurfacePoint* other = nearest(at);
      if (other == nullptr) continue;
      const Eigen::Vector2d off = at - other->position.cast<double>();
      const Eigen::Vector2d lever(-from.y(), from.x());
      const bool directed = !other->normal.isZero() && !local.normal.isZero();
      if (directed) {
        const Eigen::Vector2f turned =
            rotated(static_cast<float>(c), static_cast<float>(s), local.normal);
        if (other->normal.dot(turned) < same_direction) continue;
        const Eigen::Vector2d normal = other->normal.cast<double>();
        const double residual = normal.dot(off);
        const double ratio = residual / robust_scale;
        const double root = 1.0 / (1.0 + ratio * ratio);
        const double weight = root * root;
        const Eigen::Vector3d row(normal.x(), normal.y(), normal.dot(lever));
        information += weight * row * row.transpose();
        gradient += weight * residual * row;
        squares += weight * residual * residual;
        weights += weight;
      } else {
        const double ratio = off.norm() / (2.0 * robust_scale);
        const double root = 1.0 / (1.0 + ratio * ratio);
        const double factor = least_stddev / round_stddev;
        const double weight = root * root * factor * factor;
        Eigen::Matrix<double, 2, 3> rows;
        rows << 1.0, 0.0, lever.x(), 0.0, 1.0, lever.y();
        information += weight * rows.transpose() * rows;
        gradient += weight * rows.transpose() * off;
      }
    }
    const double variance =
        std::max(weights > 0.0 ? squares / weights : 1.0, least_stddev * least_stddev);
    information /= variance * same_error;
    gradient /= variance * same_error;
    const Eigen::Vector3d from_prior(pose.x - prior.pose.x, pose.y - prior.pose.y,
                                     normalized_angle(pose.theta - prior.pose.theta));
    const Eigen::Matrix3d total = information + prior_information;
    const Eigen::Vector3d change = -total.ldlt().solve(gradient + prior_information * from_prior);
    if (!change.allFinite()) break;
    pose.x += change.x();
    pose.y += change.y();
    pose.theta = normalized_angle(pose.theta + change.z());
    if (change.head<2>().norm() < 1e-4 && std::abs(change.z()) < 1e-5) break;
  }
  result.estimate.pose = pose;
  const Eigen::Vector3d weakest(1e-2, 1e-2, 1e-1);  // information where the points give none
  const Eigen::Vector3d floors(floor_position * floor_position, floor_position * floor_position,
                               floor_heading * floor_heading);
  result.estimate.covariance = (information + Eigen::Matrix3d(weakest.asDiagonal())).inverse() +
                               Eigen::Matrix3d(floors.asDiagonal());
  result.share = share(scan, pose);
  return result;
}

double PointMap::share(std::span<const SurfacePoint> scan, const Pose2& pose) const {
  if (scan.empty()) return 0.0;
  std::size_t on = 0;
  for (const SurfacePoint& local : scan) {
    const SurfacePoint point = transformed(pose, local);
    const SurfacePoint* other = nearest(point.position.cast<double>());
    if (other == nullptr) continue;
    const bool directed = !other->normal.isZero() && !point.normal.isZero();
    if (directed && other->normal.dot(point.normal) < same_direction) continue;
    const Eigen::Vector2f off = point.position - other->position;
    const float distance = directed ? std::abs(other->normal.dot(off)) : off.norm();
    on += distance < static_cast<float>(on_surface) ? 1 : 0;
  }
  return static_cast<double>(on) / static_cast<double>(scan.size());
}

}  // namespace quoin
