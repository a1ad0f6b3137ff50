// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/circle_fitters.hpp"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/circles/circle_residuals.hpp"
#include "core/evaluation/circle_consistency.hpp"
#include "core/geometry/angle.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

/// Without noise; the centre in the direction 0.7 rad.
Points seen(const ArcScene& scene) {
  Points points;
  observe(scene, 0.7, 0.3, points);
  return points;
}

Circle truth_of(const ArcScene& scene) {
  return {scene.distance * Eigen::Vector2d(std::cos(0.7), std::sin(0.7)), scene.radius};
}

Points noisy(const ArcScene& scene, const SensorModel& noise, std::uint64_t seed) {
  Points points = seen(scene);
  Random random(seed);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.range[i] += std::sqrt(noise.range_variance(points.range[i])) * random.normal();
    points.bearing[i] += noise.bearing_stddev * random.normal();
  }
  compute_cartesian(points);
  return points;
}

const ArcScene column{0.3, 2.0};
const ArcScene round_room{3.0, 1.0};
const ArcScene piece_of_room{3.0, 1.0, 0.8};

class EachCircleFitter : public testing::TestWithParam<std::string> {
 protected:
  const CircleFitter fit_ = CircleFitters::make<CircleFitter>(GetParam(), {});
};

TEST_P(EachCircleFitter, IsExactWithoutNoise) {
  // The curvature makes noise that a model promises into a bias that is taken off: none promised.
  const SensorModel none{0.0, 0.0};
  for (const ArcScene& scene : {column, round_room, piece_of_room}) {
    const CircleFit fit = fit_(seen(scene), none);
    ASSERT_TRUE(fit.ok()) << enum_name(fit.failure);
    const Circle truth = truth_of(scene);
    EXPECT_NEAR((fit.estimate.circle.center - truth.center).norm(), 0.0, 1e-6);
    EXPECT_NEAR(fit.estimate.circle.radius, truth.radius, 1e-6);
  }
}

TEST_P(EachCircleFitter, NamesItsFailures) {
  const SensorModel sensor;
  const auto failure = [&](const PointsView& points) { return fit_(points, sensor).failure; };
  EXPECT_EQ(failure(points_from({0.0, 0.1}, {1.0, 1.0})), CircleFailure::too_few_points);
  EXPECT_EQ(failure(points_from({0.1, 0.1, 0.1}, {1.0, 1.0, 1.0})), CircleFailure::degenerate);
  // A column of 2 cm, seen with noise of 1 cm.
  EXPECT_EQ(failure(noisy({0.02, 0.5}, sensor, 1)), CircleFailure::not_determined);
  std::mt19937_64 engine(3);
  const CircleFit flat = fit_(wall_points({0.0, 2.0}, -0.3, 0.3, 50, sensor, engine), sensor);
  EXPECT_FALSE(flat.ok()) << flat.estimate.circle.radius;
}

TEST_P(EachCircleFitter, GivesUpAsSoonAsItIsToldTo) {
  const Points points = noisy(column, SensorModel{}, 1);
  const CircleFit fit = fit_(points, SensorModel{});
  ASSERT_TRUE(fit.ok());
  ASSERT_GT(fit.nonlinearity, 0.011);
  const auto strict = CircleFitters::make<CircleFitter>(GetParam(), {{"max_nonlinearity", "0.01"}});
  EXPECT_EQ(strict(points, SensorModel{}).failure, CircleFailure::not_determined);
}

// The covariance of the fit against the derivatives of the fit itself, by differences.
TEST_P(EachCircleFitter, PropagatesTheNoiseOfEachRay) {
  SensorModel sensor{0.002, 0.0005};
  sensor.range_stddev_per_metre = 0.001;
  for (const ArcScene& scene : {column, piece_of_room}) {
    const Points points = seen(scene);
    const auto parameters = [&](const Points& moved) {
      const CircleFit fit = fit_(moved, sensor);
      EXPECT_TRUE(fit.ok());
      const Circle& circle = fit.estimate.circle;
      return Eigen::Vector3d(circle.center.x(), circle.center.y(), circle.radius);
    };
    Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
    constexpr double small = 1e-6;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const bool range : {true, false}) {
        const auto moved_by = [&](double by) {
          Points moved = points;
          (range ? moved.range : moved.bearing)[i] += by;
          compute_cartesian(moved);
          return parameters(moved);
        };
        const Eigen::Vector3d derivative = (moved_by(small) - moved_by(-small)) / (2.0 * small);
        const double variance = range ? sensor.range_variance(points.range[i])
                                      : sensor.bearing_stddev * sensor.bearing_stddev;
        expected += variance * derivative * derivative.transpose();
      }
    }
    const Eigen::Matrix3d covariance = fit_(points, sensor).estimate.covariance;
    // Second order of the noise makes the difference.
    EXPECT_NEAR((covariance - expected).norm() / expected.norm(), 0.0, 0.03);
  }
}

TEST_P(EachCircleFitter, CountsARangeBiasOnce) {
  const Points points = seen(round_room);
  SensorModel sensor{0.001, 0.0001};
  const Eigen::Matrix3d without = fit_(points, sensor).estimate.covariance;
  sensor.range_bias_stddev = 0.02;
  const Eigen::Matrix3d with = fit_(points, sensor).estimate.covariance;
  // From inside all ranges grow alike: so does the radius, whatever the number of points.
  EXPECT_NEAR(std::sqrt(with(2, 2) - without(2, 2)), 0.02, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Circles, EachCircleFitter, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const MethodInfo& method : CircleFitters::descriptions()) {
                             names.push_back(method.name);
                           }
                           return names;
                         }()),
                         [](const auto& name) { return name.param; });

TEST(CircleFit, ChiSquareIsThatOfTheDegreesOfFreedom) {
  const CircleFitter fit = CircleFitters::make<CircleFitter>("maximum_likelihood", {});
  const SensorModel sensor;
  const Points first = noisy(column, sensor, 1);
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    sum += fit(noisy(column, sensor, seed), sensor).chi_square;
  }
  const double freedom = static_cast<double>(first.size()) - 3.0;
  EXPECT_NEAR(sum / 400.0, freedom, 5.0 * std::sqrt(2.0 * freedom / 400.0));
}

TEST(CircleFit, IsScaledWhereTheResidualsRefuteTheModel) {
  const CircleFitter fit = CircleFitters::make<CircleFitter>("maximum_likelihood", {});
  const SensorModel sensor{0.003, 0.0005};
  const Points points = noisy(column, {0.012, 0.002}, 1);
  CircleFit result = fit(points, sensor);
  ASSERT_TRUE(result.ok());
  const double before = result.estimate.covariance(2, 2);
  const double factor = scale_to_residuals(result, points.size());
  EXPECT_NEAR(factor, 16.0, 9.0);
  EXPECT_DOUBLE_EQ(result.estimate.covariance(2, 2), factor * before);
  CircleFit good = fit(noisy(column, sensor, 1), sensor);
  EXPECT_EQ(scale_to_residuals(good, points.size()), 1.0);
}

TEST(SeenArc, RunsCounterClockwiseAboutTheCentre) {
  // The near side of a column lies towards the sensor.
  const Points points = seen(column);
  const Circle circle = truth_of(column);
  const Arc near = seen_arc(circle, points);
  EXPECT_FALSE(near.concave);
  EXPECT_NEAR(normalized_angle(0.5 * (near.start + near.end) - (0.7 - pi)), 0.0, 0.1);
  const auto direction = [&](std::size_t i) {
    return std::atan2(points.y[i] - circle.center.y(), points.x[i] - circle.center.x());
  };
  EXPECT_NEAR(normalized_angle(near.start - direction(points.size() - 1)), 0.0, 1e-9);
  EXPECT_NEAR(normalized_angle(near.end - direction(0)), 0.0, 1e-9);
  EXPECT_GT(near.end, near.start);
  const Arc wall = seen_arc(truth_of(piece_of_room), seen(piece_of_room));
  EXPECT_TRUE(wall.concave);
  EXPECT_NEAR(normalized_angle(0.5 * (wall.start + wall.end) - 0.7), 0.0, 0.01);
  const Arc room = seen_arc(truth_of(round_room), seen(round_room));
  EXPECT_NEAR(room.end - room.start, 2.0 * pi, 0.02);
}

TEST(InverseOf, RefusesWhatIsNotPositiveDefinite) {
  Eigen::Matrix3d matrix{{4.0, 1.0, 0.5}, {1.0, 3.0, 0.2}, {0.5, 0.2, 2.0}};
  ASSERT_TRUE(inverse_of(matrix));
  EXPECT_NEAR((*inverse_of(matrix) * matrix - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-12);
  EXPECT_FALSE(inverse_of(Eigen::Matrix3d::Ones()));
  matrix(2, 2) = -2.0;
  EXPECT_FALSE(inverse_of(matrix));
}

}  // namespace
}  // namespace quoin
