// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/papers/cwlf_paper.hpp"

#include <algorithm>
#include <cmath>

#include "core/evaluation/fit_timing.hpp"
#include "core/evaluation/scene.hpp"
#include "core/fitting/axis_regression.hpp"
#include "core/fitting/orthogonal.hpp"

namespace quoin {
namespace {

constexpr std::size_t rays = 1000;            // section V: about as many in a sweep
constexpr std::size_t literal_points = 1000;  // beyond, the double sums take too long
constexpr double corner_distance = 3.0;       // [m]
constexpr double wall_length = 1.5;           // [m]

struct CwlfForm {
  static AxisRegression line(const PointsView& points, const SensorModel& sensor) {
    return cwlf_line(points, sensor);
  }
  static Eigen::Matrix2d covariance(const PointsView& points, const SensorModel& sensor,
                                    const AxisRegression& fit, CovarianceMode mode) {
    return cwlf_covariance(points, sensor, fit, mode);
  }
};

struct ArrasSiegwartForm {
  struct Fit {
    OrthogonalLine axes;
    Line line;
  };
  static Fit line(const PointsView& points, const SensorModel&) {
    const OrthogonalLine axes = arras_siegwart_line(points);
    return {axes, axes.line.normal_form()};
  }
  static Eigen::Matrix2d covariance(const PointsView& points, const SensorModel& sensor,
                                    const Fit& fit, CovarianceMode mode) {
    return arras_siegwart_covariance(points, sensor, fit.axes, mode);
  }
};

struct LiteralForm {
  struct Fit {
    Line line;
  };
  static Fit line(const PointsView& points, const SensorModel& sensor) {
    return {arras_siegwart_literal(points, sensor)};
  }
  /// Computes the moments, which the line did without, as part of this step.
  static Eigen::Matrix2d covariance(const PointsView& points, const SensorModel& sensor, const Fit&,
                                    CovarianceMode mode) {
    return arras_siegwart_covariance(points, sensor, arras_siegwart_line(points), mode);
  }
};

/// A wall of `count` points at even bearings from the corner at `bearing` in the direction
/// `heading`.
VisibleWall wall_from(double bearing, double heading, std::size_t count) {
  const Eigen::Vector2d corner(corner_distance * std::cos(bearing),
                               corner_distance * std::sin(bearing));
  const Eigen::Vector2d end =
      corner + wall_length * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  VisibleWall wall;
  wall.line = wall_line({corner, end}, {});
  const double width = normalized_angle(std::atan2(end.y(), end.x()) - bearing);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    wall.bearings.push_back(bearing + share * width);
    wall.ranges.push_back(wall.line.r / std::cos(wall.bearings.back() - wall.line.alpha));
  }
  return wall;
}

/// The measured points of both walls.
std::array<Points, 2> measure_walls(const CwlfPaperCorner& corner, const SensorModel& noise,
                                    std::uint64_t seed) {
  const double bearing = 0.5 * (pi - corner.angle);  // makes the first wall's heading -pi / 2
  Random random(seed);
  std::array<Points, 2> walls;
  measure(wall_from(bearing, -0.5 * pi, corner.points / 2), noise, random, walls[0]);
  measure(wall_from(bearing, -0.5 * pi - corner.angle, corner.points / 2), noise, random, walls[1]);
  return walls;
}

/// The paper's four steps. Each keeps its result for the next.
template <class Form>
class CornerSteps {
 public:
  CornerSteps(const std::array<Points, 2>& walls, CovarianceMode mode)
      : walls_(walls), mode_(mode) {}

  void lines() {
    for (std::size_t k = 0; k < 2; ++k) fits_[k] = Form::line(walls_[k], sensor_);
  }
  void line_covariances() {
    for (std::size_t k = 0; k < 2; ++k) {
      lines_[k] = {fits_[k].line, Form::covariance(walls_[k], sensor_, fits_[k], mode_)};
    }
  }
  void position() {
    for (std::size_t k = 0; k < 2; ++k) normals_[k] = fits_[k].line.normal();
    position_ = intersection(fits_[0].line, normals_[0], fits_[1].line, normals_[1]);
  }
  void covariance() {
    if (!position_) return;
    corner_ = CornerEstimate{*position_, intersection_covariance(*position_, lines_[0], normals_[0],
                                                                 lines_[1], normals_[1])};
  }
  void all() {
    lines();
    line_covariances();
    position();
    covariance();
  }
  [[nodiscard]] const std::optional<CornerEstimate>& corner() const { return corner_; }

 private:
  const std::array<Points, 2>& walls_;
  CovarianceMode mode_;
  SensorModel sensor_ = data_sheet_model();
  std::array<decltype(Form::line({}, {})), 2> fits_;
  std::array<LineEstimate, 2> lines_;
  std::array<Eigen::Vector2d, 2> normals_;
  std::optional<Eigen::Vector2d> position_;
  std::optional<CornerEstimate> corner_;
};

/// Calls `use` with the steps of the form that `corner` asks for.
template <class Function>
void with_steps(const CwlfPaperCorner& corner, const SensorModel& noise, std::uint64_t seed,
                const Function& use) {
  const std::array<Points, 2> walls = measure_walls(corner, noise, seed);
  const auto with = [&]<class Form>(Form) {
    CornerSteps<Form> steps(walls, corner.covariance);
    steps.all();
    use(steps);
  };
  switch (corner.form) {
    case CornerForm::cwlf:
      return with(CwlfForm{});
    case CornerForm::arras_siegwart:
      return with(ArrasSiegwartForm{});
    case CornerForm::arras_siegwart_literal:
      return with(LiteralForm{});
  }
}

}  // namespace

CwlfPaperEnvironment measure_cwlf_paper(const World& world, const std::vector<NamedFitter>& fitters,
                                        const SensorModel& noise, std::uint64_t seed) {
  Scene scene = observe(world, world.pose_at(0.0), rays);
  std::reverse(scene.corners.begin(), scene.corners.end());
  CwlfPaperEnvironment result;
  result.world = world.name;
  result.rays = rays;
  result.walls = scene.walls.size();
  for (const VisibleCorner& corner : scene.corners) result.truth.push_back(corner.position);

  Random random(seed);
  std::vector<Points> walls(scene.walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    measure(scene.walls[i], noise, random, walls[i]);
    for (std::size_t k = 0; k < walls[i].size(); ++k) {
      result.points.emplace_back(walls[i].x[k], walls[i].y[k]);
    }
  }

  for (const NamedFitter& named : fitters) {
    std::vector<FitResult> fits;
    for (const Points& wall : walls) {
      fits.push_back(named.fitter(wall, data_sheet_model()));
      if (&named == &fitters.front() && fits.back().ok()) {
        result.lines.push_back(line_segment(fits.back().estimate, wall));
      }
    }
    PaperCorners method{named.name, named.covariance, {}};
    for (const VisibleCorner& corner : scene.corners) {
      const FitResult& first = fits[corner.first];
      const FitResult& second = fits[corner.second];
      method.corners.push_back(
          first.ok() && second.ok() ? intersect(first.estimate, second.estimate) : std::nullopt);
    }
    result.methods.push_back(std::move(method));
  }
  return result;
}

Line arras_siegwart_literal(const PointsView& points, const SensorModel& sensor) {
  const std::size_t n = points.size();
  const auto weight = [&](std::size_t i) {  // eq. (3)
    const double root = sensor.range_stddev * points.range[i] * sensor.bearing_stddev;
    return 1.0 / (root * root);
  };
  double weights = 0.0;
  double single_sine = 0.0;
  double single_cosine = 0.0;
  double double_sine = 0.0;
  double double_cosine = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = weight(i);
    weights += w;
    single_sine += w * points.range[i] * points.range[i] * std::sin(2.0 * points.bearing[i]);
    single_cosine += w * points.range[i] * points.range[i] * std::cos(2.0 * points.bearing[i]);
    for (std::size_t k = 0; k < n; ++k) {
      const double product = w * points.range[i] * weight(k) * points.range[k];
      double_sine += product * std::sin(points.bearing[i]) * std::cos(points.bearing[k]);
      double_cosine += product * std::cos(points.bearing[i] + points.bearing[k]);
    }
  }
  const double alpha = 0.5 * std::atan2(2.0 / weights * double_sine - single_sine,
                                        1.0 / weights * double_cosine - single_cosine);
  double r = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    r += weight(i) * points.range[i] * std::cos(points.bearing[i] - alpha);
  }
  return normalized(LineEstimate{{alpha, r / weights}, {}}).line;
}

std::vector<CwlfPaperCorner> cwlf_paper_corners() {
  constexpr double degree = pi / 180.0;
  std::vector<CwlfPaperCorner> corners;
  const auto add = [&corners](double angle, std::size_t points) {
    for (const CovarianceMode mode : {CovarianceMode::as_published, CovarianceMode::propagated}) {
      for (const auto& [form, name] : EnumNames<CornerForm>::names) {
        if (form == CornerForm::arras_siegwart_literal && points > literal_points) continue;
        corners.push_back({angle, points, form, mode, {}, {}});
      }
    }
  };
  for (const std::size_t points : {10, 20, 50, 90, 100, 200, 500, 1000, 10000, 100000}) {
    add(130.0 * degree, points);
  }
  for (const std::size_t points : {50, 100}) add(90.0 * degree, points);
  return corners;
}

void compute_corner(CwlfPaperCorner& corner, const SensorModel& noise, std::uint64_t seed) {
  with_steps(corner, noise, seed, [&](const auto& steps) { corner.corner = steps.corner(); });
}

void time_corner(CwlfPaperCorner& corner, const SensorModel& noise, std::uint64_t seed) {
  with_steps(corner, noise, seed, [&](auto& steps) {
    corner.times = {seconds_per_call([&] { steps.lines(); }),
                    seconds_per_call([&] { steps.line_covariances(); }),
                    seconds_per_call([&] { steps.position(); }),
                    seconds_per_call([&] { steps.covariance(); }),
                    seconds_per_call([&] { steps.all(); })};
  });
}

}  // namespace quoin
