// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/extraction/extraction.hpp"
#include "core/fitting/fit.hpp"
#include "core/geometry/line.hpp"
#include "core/geometry/pose.hpp"
#include "core/parameters/parameter.hpp"
#include "core/sensor/points.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// From which points the two lines come that are compared.
enum class SplitTest {
  odd_even,  ///< every other point of a wall: the noise of single rays
  halves,    ///< first and last half of a wall: what neighbouring points share as well, such as
             ///< walls that are not flat, motion, and bearings that err slowly
  at_rest,   ///< a wall in two consecutive scans of a sensor at rest: repeatability alone
};

template <>
struct EnumNames<SplitTest> {
  static constexpr std::array<std::pair<SplitTest, std::string_view>, 3> names{
      {{SplitTest::odd_even, "odd_even"},
       {SplitTest::halves, "halves"},
       {SplitTest::at_rest, "at_rest"}}};
};
inline constexpr std::size_t split_test_count = EnumNames<SplitTest>::names.size();

/// Walls of fewer points are not compared: each half has at least ten.
inline constexpr std::size_t fewest_compared_points = 20;

/// Squared distances of the lines of one test. True covariances have 95 % inside, a mean of 2 and a
/// median of 1.39.
struct DistanceFigures {
  std::size_t count = 0;
  Interval inside95;  ///< share below the 95 % quantile of chi-square with two degrees of freedom
  double median = 0.0;
  double mean = 0.0;
  std::vector<double> quantiles;  ///< at (k + 0.5) / size; empty without distances
};

/// What recorded scans say about the covariances of their lines, without any truth.
struct ScanConsistencyFigures {
  /// Chi-square of all lines over their degrees of freedom; 1 when the noise model is true.
  Interval reduced_chi_square;
  std::size_t lines = 0;
  std::size_t scans_at_rest = 0;  ///< compared with the scan before
  /// By SplitTest: covariances of the noise model alone.
  std::array<DistanceFigures, split_test_count> modelled;
  /// By SplitTest: covariances as the services report them, scaled where residuals refute the
  /// noise model (`scale_to_residuals`).
  std::array<DistanceFigures, split_test_count> reported;
};

/// Compares fits of disjoint points of a wall at its middle (LineDifference), scan by scan.
/// Intervals take the scans in 20 stretches for independent, because consecutive scans show the
/// same walls.
class ScanConsistency {
 public:
  /// `sensor` is the noise model that is judged. How flat walls are is left out of it where both
  /// lines share it, which is in `odd_even` and `at_rest`.
  ScanConsistency(Fitter fitter, const SensorModel& sensor);

  /// The scans that follow are not of where the ones before are.
  void begin_recording() { last_.clear(); }

  /// Takes the segments of the last scan of `extraction`. `pose` [m, rad] is where the sensor was,
  /// if the recording knows it: what has moved less than 1 mm and 0.05 deg since the scan before is
  /// at rest, what has moved more than 2 cm or 0.5 deg is not. Between them, and without a pose,
  /// the sensor is at rest when its lines show no significant motion.
  void add(const Extraction& extraction, const std::optional<Pose2>& pose = std::nullopt);

  [[nodiscard]] ScanConsistencyFigures figures() const;

 private:
  struct Fitted {
    LineSegment line;        // as modelled
    LineEstimate reported;   // the same, scaled to its residuals
    Eigen::Vector2d middle;  // [m]
  };
  struct Distance {
    std::size_t scan;
    double squared;
  };
  struct Residuals {
    std::size_t scan;
    double chi_square;
    double freedom;
  };

  [[nodiscard]] std::optional<Fitted> fit(const PointsView& points,
                                          const SensorModel& sensor) const;
  void compare(SplitTest test, const Fitted& first, const Fitted& second,
               const Eigen::Vector2d& point);
  void compare_with_last(const std::vector<Fitted>& lines, bool known_at_rest);
  [[nodiscard]] DistanceFigures figures_of(const std::vector<Distance>& distances) const;

  Fitter fitter_;
  SensorModel sensor_;
  SensorModel flat_;  // the same for walls that are flat
  std::size_t scans_ = 0;
  std::size_t at_rest_ = 0;
  std::vector<Residuals> residuals_;
  std::array<std::vector<Distance>, split_test_count> modelled_;
  std::array<std::vector<Distance>, split_test_count> reported_;
  std::vector<Fitted> last_;
  std::optional<Pose2> last_pose_;
  Points part_;
};

}  // namespace quoin
