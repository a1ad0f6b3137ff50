// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/arcs.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/circles/circle.hpp"
#include "core/fitting/orthogonal.hpp"
#include "core/segmentation/block_test.hpp"

namespace quoin {
namespace {

// Less of a circle is a line with a bow.
constexpr double smallest_angle = 0.26;  // [rad] 15 deg about the centre
// Chi square may be so many of its standard deviations above what is expected.
constexpr double largest_surplus = 4.0;
// So much must the chi square of two lines be below that of a circle: they have a place to split
// that was searched for. What is uncertain is no corner.
constexpr double clearly_better = 20.0;
// The chi square of a line falls by more with a bow once in 1000 times that there is none.
constexpr double significantly_better = 10.828;
// A bow of more tolerances would have been split.
constexpr double largest_bow = 3.0;
// Of a mean from a circle through three of them, in those of a point.
constexpr double largest_deviation = 3.0;
constexpr std::size_t fits_of_all_points = 24;

class ArcFinder {
 public:
  ArcFinder(const PointsView& points, const SensorModel& sensor, const Tolerance& tolerance,
            double flatness)
      : points_(points),
        sensor_(sensor),
        tolerance_(tolerance),
        flatness_(flatness),
        floor_(flatness * flatness / (deviations_in_tolerance * deviations_in_tolerance)),
        points_left_(fits_of_all_points * points.size()) {}

  /// Whether a run that is not straight is bent like a circle.
  [[nodiscard]] bool is_arc(const Segment& run) const {
    return circle_explains(run, chi_square_of_line(run) - clearly_better);
  }

  /// The same, with a cheap test first.
  [[nodiscard]] bool is_arc(const Segment& run, const BlockMeans& blocks) const {
    const std::span<const BlockMean> means = blocks.means();
    return are_on_circle(means.first(means.size() / 2), means.subspan(means.size() / 2)) &&
           is_arc(run);
  }

  /// Whether both are of one circle.
  [[nodiscard]] bool are_arc(const Piece& first, const TestedBlocks& blocks_of_first,
                             const Piece& second, const TestedBlocks& blocks_of_second) const {
    if (!second.joined && !are_close(first, second)) return false;
    if (!may_be_arc(first, blocks_of_first.test.line, second, blocks_of_second.test.line) ||
        !are_on_circle(blocks_of_first.means.means(), blocks_of_second.means.means())) {
      return false;
    }
    const Segment both{first.segment.begin, second.segment.end};
    const double chi_square_of_two = chi_square_of(first) + chi_square_of(second);
    return circle_explains(both, std::min(chi_square_of_two + clearly_better,
                                          chi_square_of_line(both) - significantly_better));
  }

 private:
  [[nodiscard]] PointsView view(const Segment& segment) const {
    return points_.subview(segment.begin, segment.end);
  }

  /// Noise breaks a near surface between any two points.
  [[nodiscard]] bool are_close(const Piece& first, const Piece& second) const {
    return squared_distance(points_, first.segment.end - 1, second.segment.begin) <=
           tolerance_.largest;
  }

  /// A cheap test first. Chords of lengths a and b, a chord of length g between them, that meet at
  /// the angle t are of a circle of radius (a + b + 2 g) / (2 t), and each has the sagitta length^2
  /// / (8 radius).
  [[nodiscard]] bool may_be_arc(const Piece& first, const NormalLine& line_of_first,
                                const Piece& second, const NormalLine& line_of_second) const {
    if (first.round || second.round) return true;
    const double cosine = line_of_first.normal_x * line_of_second.normal_x +
                          line_of_first.normal_y * line_of_second.normal_y;
    // The square of the angle, and a little less up to a right one.
    const double rest = 1.0 - std::min(std::abs(cosine), 1.0);
    const double turn_squared = 2.0 * rest + rest * rest / 3.0;
    const double a = length(first.segment);
    const double b = length(second.segment);
    const double gap = length({first.segment.end - 1, second.segment.begin + 1});
    const double longer = std::max(a, b);
    const double part = longer * longer / (4.0 * (a + b + 2.0 * gap));
    return part * part * turn_squared <= largest_bow * largest_bow * tolerance_.largest;
  }

  /// Another cheap one: whether the means of blocks are near the circle through the first, the last
  /// and one between.
  [[nodiscard]] bool are_on_circle(std::span<const BlockMean> before,
                                   std::span<const BlockMean> behind) const {
    const BlockMean& a = before.front();
    const BlockMean& b = before.size() > behind.size() ? before.back() : behind.front();
    const BlockMean& c = behind.back();
    // About a: the centre is where the bisectors of both chords meet.
    const double bx = b.x - a.x;
    const double by = b.y - a.y;
    const double cx = c.x - a.x;
    const double cy = c.y - a.y;
    const double area = 2.0 * (bx * cy - by * cx);
    const double x = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / area;
    const double y = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / area;
    const double radius = std::sqrt(x * x + y * y);
    if (!std::isfinite(radius)) return false;
    const double limit =
        flatness_ + largest_deviation * std::sqrt(sensor_.range_variance(std::hypot(b.x, b.y)));
    const auto near = [&](const BlockMean& mean) {
      const double dx = mean.x - a.x - x;
      const double dy = mean.y - a.y - y;
      return std::abs(std::sqrt(dx * dx + dy * dy) - radius) <= limit;
    };
    return std::all_of(before.begin(), before.end(), near) &&
           std::all_of(behind.begin(), behind.end(), near);
  }

  [[nodiscard]] double length(const Segment& segment) const {
    return std::sqrt(squared_distance(points_, segment.begin, segment.end - 1));
  }

  [[nodiscard]] bool circle_explains(const Segment& segment, double limit) const {
    const PointsView own = view(segment);
    if (own.size() <= 3 || own.size() > points_left_) return false;
    points_left_ -= own.size();
    const auto circle = fit_circle(own, sensor_);
    if (!circle || covered_angle(*circle, own) < smallest_angle) return false;
    const double freedom = static_cast<double>(own.size()) - 3.0;
    const double chi_square = quoin::chi_square(*circle, own, sensor_, floor_);
    return chi_square <= freedom + largest_surplus * std::sqrt(2.0 * freedom) &&
           chi_square <= limit;
  }

  [[nodiscard]] double chi_square_of(const Piece& piece) const {
    if (!piece.round) return chi_square_of_line(piece.segment);
    const PointsView own = view(piece.segment);
    if (own.size() > points_left_) return 0.0;
    points_left_ -= own.size();
    const auto circle = fit_circle(own, sensor_);
    return circle ? quoin::chi_square(*circle, own, sensor_, floor_) : 0.0;
  }

  [[nodiscard]] double chi_square_of_line(const Segment& segment) const {
    const PointsView own = view(segment);
    const OrthogonalLine fit = fit_orthogonal(own, PointWeights::equal);
    if (!fit.ok()) return 0.0;
    const WeightVariances variances(sensor_);
    double sum = 0.0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const double distance = fit.line.distance(own.x[i], own.y[i]);
      const double along = fit.line.along(own.x[i], own.y[i]);
      const double cosine = fit.line.normal_x * own.cosine[i] + fit.line.normal_y * own.sine[i];
      sum += distance * distance /
             (variances.range_at(own.range[i] * own.range[i]) * cosine * cosine +
              variances.bearing * along * along + floor_);
    }
    return sum;
  }

  const PointsView& points_;
  const SensorModel& sensor_;
  const Tolerance& tolerance_;
  double flatness_;
  double floor_;  // [m^2]
  // To be fitted to circles: a round room is joined piece by piece, and each time fitted again.
  // More than that is left as it is, so that the work on a scan stays bounded.
  mutable std::size_t points_left_;
};

void make_round(Piece& piece) {
  piece.round = true;
  piece.line.reset();
}

// A circle through fewer says nothing of itself.
constexpr std::size_t fewest_on_arc = 5;

/// Whether the middle is nearer to the sensor than the chord: its point on the ray through the
/// middle is where the cross product with the chord is that of the chord's ends.
bool is_convex(const PointsView& points, const Segment& run) {
  const std::size_t last = run.end - 1;
  const std::size_t middle = run.begin + run.size() / 2;
  const double dx = points.x[last] - points.x[run.begin];
  const double dy = points.y[last] - points.y[run.begin];
  const double of_chord = points.x[run.begin] * dy - points.y[run.begin] * dx;
  const double of_middle = points.x[middle] * dy - points.y[middle] * dx;
  return std::abs(of_middle) < std::abs(of_chord);
}

/// Looks for round runs among points that are on nothing.
struct ThinSearch {
  const PointsView& points;
  const ArcFinder& finder;
  const BreakpointDetector& breakpoints;
  CoarsePoints& coarse;
  std::vector<Segment>& arcs;

  /// Points [begin, end), which are on nothing.
  void operator()(std::size_t begin, std::size_t end) const {
    if (end < begin + fewest_on_arc) return;
    coarse.assign(points.subview(begin, end));
    for (std::size_t first = begin; first + fewest_on_arc <= end;) {
      std::size_t next = first + 1;
      while (next < end && breakpoints.connected(coarse, next - 1 - begin, next - begin)) ++next;
      const Segment run{first, next};
      first = next;
      if (run.size() < fewest_on_arc || !is_convex(points, run)) continue;
      if (finder.is_arc(run)) arcs.push_back(run);
    }
  }
};

}  // namespace

void find_arcs(const PointsView& points, const SensorModel& sensor, const Tolerance& tolerance,
               double flatness, std::vector<Piece>& pieces, std::vector<TestedBlocks>& blocks) {
  const ArcFinder finder(points, sensor, tolerance, flatness);
  blocks.clear();
  std::size_t kept = 0;
  for (const Piece& piece : pieces) {
    TestedBlocks& own = blocks.emplace_back();
    own.means = BlockMeans(points, piece.segment);
    own.test = test_blocks(own.means, sensor, flatness);
    if (kept > 0 && finder.are_arc(pieces[kept - 1], blocks[kept - 1], piece, own)) {
      Piece& arc = pieces[kept - 1];
      arc.segment.end = piece.segment.end;
      make_round(arc);
      blocks.pop_back();
      blocks.back().means = BlockMeans(points, arc.segment);
      continue;
    }
    pieces[kept] = piece;
    if (own.test.crooked && finder.is_arc(piece.segment, own.means)) make_round(pieces[kept]);
    ++kept;
  }
  pieces.resize(kept);
}

void ThinThings::find(const PointsView& scan, const SensorModel& sensor, const Tolerance& tolerance,
                      const BreakpointDetector& breakpoints, double flatness, Segmentation& found) {
  taken_.assign(found.segments.begin(), found.segments.end());
  taken_.insert(taken_.end(), found.arcs.begin(), found.arcs.end());
  std::sort(taken_.begin(), taken_.end(), begins_before);
  const std::size_t before = found.arcs.size();
  const ArcFinder finder(scan, sensor, tolerance, flatness);
  const ThinSearch search{scan, finder, breakpoints, coarse_, found.arcs};
  std::size_t begin = 0;
  for (const Segment& run : taken_) {
    search(begin, run.begin);
    begin = run.end;
  }
  search(begin, scan.size());
  for (std::size_t k = 0; k < found.foreign.size();) {
    std::size_t next = k + 1;
    while (next < found.foreign.size() && found.foreign[next] == found.foreign[next - 1] + 1)
      ++next;
    search(found.foreign[k], found.foreign[next - 1] + 1);
    k = next;
  }
  if (found.arcs.size() == before) return;
  std::sort(found.arcs.begin(), found.arcs.end(), begins_before);
  // What is left over beside an arc may be more of it.
  std::size_t kept = 0;
  for (const Segment& arc : found.arcs) {
    if (kept > 0 && found.arcs[kept - 1].end == arc.begin) {
      const Segment both{found.arcs[kept - 1].begin, arc.end};
      if (finder.is_arc(both)) {
        found.arcs[kept - 1] = both;
        continue;
      }
    }
    found.arcs[kept++] = arc;
  }
  found.arcs.resize(kept);
}

}  // namespace quoin
