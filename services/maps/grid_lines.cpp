// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Walls out of an occupancy grid: the borders of occupied cells are followed, split at their
// corners (Ramer 1972, Douglas and Peucker 1973) and each piece is fitted by total least squares.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "services/maps/map_file.hpp"
#include "services/maps/occupancy_grid.hpp"

namespace quoin::maps {

namespace {

constexpr double shortest = 0.25;   // [m]
constexpr double tolerance = 1.25;  // cells: a slanted wall has steps of one
constexpr std::size_t fewest_edges = 4;

/// An edge between an occupied and a free cell, which is to its left. In units of cells.
struct Edge {
  std::int64_t from_x, from_y, to_x, to_y;
  bool used = false;
  [[nodiscard]] Eigen::Vector2d middle() const {
    return {0.5 * static_cast<double>(from_x + to_x), 0.5 * static_cast<double>(from_y + to_y)};
  }
};

std::vector<Edge> edges_of(const OccupancyGrid& grid) {
  std::vector<Edge> edges;
  for (std::size_t row = 0; row < grid.height; ++row) {
    for (std::size_t column = 0; column < grid.width; ++column) {
      if (grid.at(column, row) != Cell::occupied) continue;
      const auto x = static_cast<std::int64_t>(column);
      const auto y = static_cast<std::int64_t>(row);
      if (row > 0 && grid.at(column, row - 1) == Cell::free) edges.push_back({x + 1, y, x, y});
      if (column > 0 && grid.at(column - 1, row) == Cell::free) edges.push_back({x, y, x, y + 1});
      if (row + 1 < grid.height && grid.at(column, row + 1) == Cell::free) {
        edges.push_back({x, y + 1, x + 1, y + 1});
      }
      if (column + 1 < grid.width && grid.at(column + 1, row) == Cell::free) {
        edges.push_back({x + 1, y + 1, x + 1, y});
      }
    }
  }
  return edges;
}

using Points = std::vector<Eigen::Vector2d>;

/// Chains of edges, as the middles of their edges.
std::vector<Points> chains_of(std::vector<Edge> edges) {
  const auto key = [](std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) << 32U | static_cast<std::uint64_t>(y);
  };
  std::unordered_multimap<std::uint64_t, std::size_t> starts;
  std::unordered_map<std::uint64_t, int> ends;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    starts.emplace(key(edges[i].from_x, edges[i].from_y), i);
    ++ends[key(edges[i].to_x, edges[i].to_y)];
  }
  std::vector<Points> chains;
  const auto follow = [&](std::size_t first) {
    Points& points = chains.emplace_back();
    for (std::size_t i = first;;) {
      Edge& edge = edges[i];
      edge.used = true;
      points.push_back(edge.middle());
      const auto [begin, end] = starts.equal_range(key(edge.to_x, edge.to_y));
      // Where two cells meet at a corner alone the chain stays with its own: it turns right.
      std::size_t best = edges.size();
      std::int64_t best_turn = -2;
      for (auto next = begin; next != end; ++next) {
        const Edge& candidate = edges[next->second];
        if (candidate.used) continue;
        const std::int64_t turn = (edge.to_x - edge.from_x) * (candidate.to_y - candidate.from_y) -
                                  (edge.to_y - edge.from_y) * (candidate.to_x - candidate.from_x);
        if (-turn > best_turn || best == edges.size()) {
          best = next->second;
          best_turn = -turn;
        }
      }
      if (best == edges.size()) return;
      i = best;
    }
  };
  // First those that have a beginning, then rings.
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!edges[i].used && !ends.contains(key(edges[i].from_x, edges[i].from_y))) follow(i);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!edges[i].used) follow(i);
  }
  return chains;
}

class Pieces {
 public:
  explicit Pieces(const OccupancyGrid& grid) : grid_(grid) {}

  void split(const Points& points) {
    if (points.size() < fewest_edges) return;
    const std::size_t last = points.size() - 1;
    if ((points.front() - points.back()).norm() > 2.0) {
      split(points, 0, last);
      return;
    }
    // A ring is cut where it is farthest from its beginning, and there again.
    const std::size_t far = farthest_from(points, points.front());
    const std::size_t near = farthest_from(points, points[far]);
    Points turned(points.begin() + static_cast<std::ptrdiff_t>(near), points.end());
    turned.insert(turned.end(), points.begin(),
                  points.begin() + static_cast<std::ptrdiff_t>(near) + 1);
    const std::size_t middle = (far + points.size() - near) % points.size();
    split(turned, 0, middle);
    split(turned, middle, turned.size() - 1);
  }

  std::vector<MapLine> lines;

 private:
  static std::size_t farthest_from(const Points& points, const Eigen::Vector2d& from) {
    std::size_t far = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((points[i] - from).squaredNorm() > (points[far] - from).squaredNorm()) far = i;
    }
    return far;
  }

  void split(const Points& points, std::size_t first, std::size_t last) {
    std::vector<std::pair<std::size_t, std::size_t>> left{{first, last}};
    while (!left.empty()) {
      const auto [from, to] = left.back();
      left.pop_back();
      const Eigen::Vector2d chord = (points[to] - points[from]).normalized();
      std::size_t worst = from;
      double distance = 0.0;
      for (std::size_t i = from + 1; i < to; ++i) {
        const Eigen::Vector2d off = points[i] - points[from];
        const double across = std::abs(chord.x() * off.y() - chord.y() * off.x());
        if (across > distance) {
          distance = across;
          worst = i;
        }
      }
      if (distance > tolerance) {
        left.emplace_back(worst, to);
        left.emplace_back(from, worst);
      } else if (!ranges_.empty() && ranges_.back().second == from &&
                 fits(points, ranges_.back().first, to)) {
        ranges_.back().second = to;  // it was split for an outlier
      } else {
        ranges_.emplace_back(from, to);
      }
    }
    for (const auto& [from, to] : ranges_) add(points, from, to);
    ranges_.clear();
  }

  struct Fit {
    Eigen::Vector2d mean;
    Eigen::Vector2d along;
  };

  static Fit fit(const Points& points, std::size_t from, std::size_t to) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (std::size_t i = from; i <= to; ++i) mean += points[i];
    mean /= static_cast<double>(to - from + 1);
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (std::size_t i = from; i <= to; ++i) {
      scatter += (points[i] - mean) * (points[i] - mean).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(scatter);
    Eigen::Vector2d along = axes.eigenvectors().col(1);
    if (along.dot(points[to] - points[from]) < 0.0) along = -along;
    return {mean, along};
  }

  static bool fits(const Points& points, std::size_t from, std::size_t to) {
    const auto [mean, along] = fit(points, from, to);
    for (std::size_t i = from; i <= to; ++i) {
      const Eigen::Vector2d off = points[i] - mean;
      if (std::abs(along.x() * off.y() - along.y() * off.x()) > tolerance) return false;
    }
    return true;
  }

  void add(const Points& points, std::size_t from, std::size_t to) {
    if (to - from + 1 < fewest_edges) return;
    const Fit line_fit = fit(points, from, to);
    const auto place = [&](std::size_t i) {
      const Eigen::Vector2d on_line =
          line_fit.mean + line_fit.along.dot(points[i] - line_fit.mean) * line_fit.along;
      return grid_.origin.transform(grid_.resolution * on_line);
    };
    MapLine line;
    line.start = place(from);
    line.end = place(to);
    line.observations = 1;
    if (line.length() < shortest) return;
    if (lines.size() == most_lines) throw MapError("a grid with more than a million walls");
    line.id = lines.size();
    lines.push_back(line);
  }

  const OccupancyGrid& grid_;
  std::vector<std::pair<std::size_t, std::size_t>> ranges_;
};

}  // namespace

std::vector<MapLine> vectorized(const OccupancyGrid& grid) {
  Pieces pieces(grid);
  for (const Points& chain : chains_of(edges_of(grid))) pieces.split(chain);
  return std::move(pieces.lines);
}

}  // namespace quoin::maps
