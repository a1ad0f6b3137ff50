// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/corners/corner_finder.hpp"
#include "core/evaluation/papers/paper_corners.hpp"
#include "core/parameters/parameter.hpp"
#include "core/simulation/world.hpp"

namespace quoin {

/// What Tables I and II and Fig. 2 of the CWLF paper show of one environment.
struct CwlfPaperEnvironment {
  std::string world;
  std::size_t rays = 0;
  std::vector<Eigen::Vector2d> truth;   ///< [m] the corners in sight, clockwise as in the paper
  std::vector<Eigen::Vector2d> points;  ///< [m] of the walls in sight
  std::vector<LineSegment> lines;       ///< of the walls in sight, by the first fitter
  std::size_t walls = 0;                ///< in sight
  std::vector<PaperCorners> methods;
};

/// One scan of 1000 rays with `noise`, each point assigned to its true wall, covariances computed
/// from `data_sheet_model()`. Walls of fewer than six points are left out.
[[nodiscard]] CwlfPaperEnvironment measure_cwlf_paper(const World& world,
                                                      const std::vector<NamedFitter>& fitters,
                                                      const SensorModel& noise, std::uint64_t seed);

/// How the paper's Figs. 3 to 5 compute a corner.
enum class CornerForm {
  cwlf,
  arras_siegwart,          ///< in time that grows with the number of points
  arras_siegwart_literal,  ///< the line by double sums; its covariance as arras_siegwart does
};

template <>
struct EnumNames<CornerForm> {
  static constexpr std::array<std::pair<CornerForm, std::string_view>, 3> names{
      {{CornerForm::cwlf, "cwlf"},
       {CornerForm::arras_siegwart, "arras_siegwart"},
       {CornerForm::arras_siegwart_literal, "arras_siegwart_literal"}}};
};

/// Times [s] of the paper's four steps; 0 when not measured.
struct CornerTimes {
  double lines = 0.0;
  double line_covariances = 0.0;
  double position = 0.0;
  double covariance = 0.0;
  double all = 0.0;  ///< of all steps in one go, not their sum
};

/// One corner of two walls by one method.
struct CwlfPaperCorner {
  double angle = 0.0;      ///< [rad] between the walls
  std::size_t points = 0;  ///< of both walls together
  CornerForm form = CornerForm::cwlf;
  CovarianceMode covariance = CovarianceMode::propagated;
  std::optional<CornerEstimate> corner;  ///< nothing when a line has not been found
  CornerTimes times;
};

/// The line of eq. (16) and (17) with their double sums over all pairs of points, to compare its
/// time with. The factor printed as the sum of the weights before both double sums is its inverse.
/// Same line as `arras_siegwart_line`; at least two different points, checks nothing.
[[nodiscard]] Line arras_siegwart_literal(const PointsView& points, const SensorModel& sensor);

/// The corners of Figs. 3 to 5, not computed yet: one of 130 degrees with 10 to 100000 points, the
/// literal form with up to 1000, and one of 90 degrees with 50 and 100.
[[nodiscard]] std::vector<CwlfPaperCorner> cwlf_paper_corners();

/// Fills `corner`. The walls are 1.5 m long and meet 3 m away; the first is parallel to the y axis
/// and the bisector of both passes through the sensor. Same seed, same points for each form.
void compute_corner(CwlfPaperCorner& corner, const SensorModel& noise, std::uint64_t seed);

/// Fills `times`. They differ from run to run; nothing else does.
void time_corner(CwlfPaperCorner& corner, const SensorModel& noise, std::uint64_t seed);

}  // namespace quoin
