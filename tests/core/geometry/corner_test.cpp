// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/corner.hpp"

#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

TEST(Intersect, AgreesWithCentralDifferences) {
  LineEstimate a{{0.3, 2.0}, Eigen::Matrix2d{{1e-4, 3e-5}, {3e-5, 4e-5}}};
  LineEstimate b{{1.9, 1.5}, Eigen::Matrix2d{{2e-4, -5e-5}, {-5e-5, 3e-5}}};
  const auto corner = intersect(a, b);
  ASSERT_TRUE(corner);
  Eigen::Matrix<double, 2, 4> jacobian;
  const double h = 1e-6;
  for (int k = 0; k < 4; ++k) {
    const auto moved = [&](double step) {
      LineEstimate first = a;
      LineEstimate second = b;
      double* const values[] = {&first.line.alpha, &first.line.r, &second.line.alpha,
                                &second.line.r};
      *values[k] += step;
      return intersect(first, second)->position;
    };
    jacobian.col(k) = (moved(h) - moved(-h)) / (2.0 * h);
  }
  Eigen::Matrix4d both = Eigen::Matrix4d::Zero();
  both.topLeftCorner<2, 2>() = a.covariance;
  both.bottomRightCorner<2, 2>() = b.covariance;
  EXPECT_THAT(corner->covariance,
              CovarianceNear(Eigen::Matrix2d(jacobian * both * jacobian.transpose()), 1e-8));
}

TEST(Intersect, KnowsWhenThereIsNone) {
  EXPECT_FALSE(intersect({{0.3, 2.0}, {}}, {{0.3, 1.0}, {}}));
  EXPECT_FALSE(intersect({{0.3, 2.0}, {}}, {{0.3 + pi, 1.0}, {}}));
  const auto corner = intersect({{0.0, 2.0}, {}}, {{pi / 2, 1.0}, {}});
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->position.x(), 2.0, 1e-15);
  EXPECT_NEAR(corner->position.y(), 1.0, 1e-15);
}

TEST(Intersection, IsThePositionAndTheCovarianceOfIntersect) {
  const LineEstimate a{{0.3, 2.0}, Eigen::Matrix2d{{1e-4, 3e-5}, {3e-5, 4e-5}}};
  const LineEstimate b{{1.9, 1.5}, Eigen::Matrix2d{{2e-4, -5e-5}, {-5e-5, 3e-5}}};
  const Eigen::Vector2d m = a.line.normal();
  const Eigen::Vector2d n = b.line.normal();
  const auto position = intersection(a.line, m, b.line, n);
  ASSERT_TRUE(position);
  EXPECT_NEAR(m.dot(*position), 2.0, 1e-12);
  EXPECT_NEAR(n.dot(*position), 1.5, 1e-12);
  EXPECT_EQ(*position, intersect(a, b)->position);
  EXPECT_EQ(intersection_covariance(*position, a, m, b, n), intersect(a, b)->covariance);
  EXPECT_FALSE(intersection(a.line, m, b.line, -m));
}

TEST(Intersect, DoesNotDependOnWhereTheCovariancesAre) {
  const LineEstimate a{{0.3, 2.0}, Eigen::Matrix2d{{1e-4, 3e-5}, {3e-5, 4e-5}}};
  const LineEstimate b{{1.9, 1.5}, Eigen::Matrix2d{{2e-4, -5e-5}, {-5e-5, 3e-5}}};
  EXPECT_THAT(intersect(a.about(1.7), b.about(-0.8))->covariance,
              CovarianceNear(intersect(a, b)->covariance, 1e-12));
}

TEST(RangeBias, ActsAlongTheRay) {
  CornerEstimate corner{{3.0, 4.0}, Eigen::Matrix2d::Identity() * 1e-4};
  const Eigen::Matrix2d c = with_range_bias(corner, 0.05).covariance;
  EXPECT_THAT(c, CovarianceNear(Eigen::Matrix2d{{1e-4 + 0.0025 * 0.36, 0.0025 * 0.48},
                                                {0.0025 * 0.48, 1e-4 + 0.0025 * 0.64}},
                                1e-12));
  EXPECT_EQ(with_range_bias({}, 0.05).covariance, Eigen::Matrix2d::Zero());
}

TEST(Ellipse, HasAxesAndArea) {
  const Ellipse e = ellipse(Eigen::Matrix2d{{2.5, 1.5}, {1.5, 2.5}}, 1.0);  // eigenvalues 4 and 1
  EXPECT_NEAR(e.semi_major, 2.0, 1e-12);
  EXPECT_NEAR(e.semi_minor, 1.0, 1e-12);
  EXPECT_NEAR(e.direction, pi / 4, 1e-12);
  EXPECT_NEAR(ellipse(Eigen::Matrix2d{{1.0, 0.0}, {0.0, 9.0}}, 4.0).semi_major, 6.0, 1e-12);
  EXPECT_NEAR(ellipse(Eigen::Matrix2d{{1.0, 0.0}, {0.0, 9.0}}, 4.0).direction, pi / 2, 1e-12);
  EXPECT_NEAR(one_sigma_ellipse_area(Eigen::Matrix2d{{2.5, 1.5}, {1.5, 2.5}}), 2.0 * pi, 1e-12);
  EXPECT_EQ(ellipse(Eigen::Matrix2d::Zero(), 1.0).semi_major, 0.0);
}

}  // namespace
}  // namespace quoin
