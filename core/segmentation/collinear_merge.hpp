// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/geometry/line.hpp"
#include "core/segmentation/pieces.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Joins neighbours that are one line within the tolerance, which noise or clutter had split; best
/// match first, because a short piece may suit both sides. Each match is found once, so that many
/// pieces take little more than one by one. Keeps its memory from scan to scan.
class CollinearMerge {
 public:
  /// The pieces have been fitted. False when neighbours were left that nobody looked at: see
  /// `Segmentation::cut_short`.
  bool operator()(const PointsView& points, const Tolerance& tolerance, std::vector<Piece>& pieces);

 private:
  /// The line through two neighbours and how well it matches.
  struct Match {
    Moments moments;
    NormalLine line;
    double excess = std::numeric_limits<double>::infinity();  // of the worst point
  };
  // Of a piece with the one before it.
  struct Neighbour {
    std::size_t before = 0;  // number of the neighbours
    std::size_t next = 0;
    std::size_t looks = 0;
    Match match;
  };
  struct Waiting {
    double excess = 0.0;
    std::size_t second = 0;
    std::size_t look = 0;
    // The best on top of the heap; of equal ones the first of the scan.
    friend bool operator<(const Waiting& a, const Waiting& b) {
      return a.excess != b.excess ? a.excess > b.excess : a.second > b.second;
    }
  };

  [[nodiscard]] static Match match_of(const PointsView& points, const Piece& first,
                                      const Piece& second, const Tolerance& tolerance);
  void look_at(std::size_t second, const PointsView& points, const Tolerance& tolerance,
               const std::vector<Piece>& pieces);
  /// The later of the two that match best, which waits no more; 0 when no two do.
  [[nodiscard]] std::size_t take_best();

  std::vector<Neighbour> neighbours_;
  std::vector<Waiting> waiting_;  // a heap; those looked at again since count no more
  std::size_t points_left_ = 0;
  bool all_ = true;  // have been looked at
};

}  // namespace quoin
