// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "core/fitting/axis_regression.hpp"
#include "core/geometry/corner.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/fitting/published_cwlf.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

Points wall(double alpha) {
  std::mt19937_64 engine(7);
  return wall_points({alpha, 1.9}, alpha - 0.5, alpha + 0.3, 50, noisy, engine);
}

TEST(Cwlf, GivesTheCornerOfThePublishedEquations) {
  const Fitter fitter = make_fitter("cwlf", "as_published");
  // Both y on x, both x on y, one of each in either order; towards all sides.
  const std::vector<std::pair<double, double>> pairs{
      {1.2, 1.9}, {-1.2, -1.9}, {0.2, -0.4}, {2.8, -2.9}, {0.4, 1.8}, {1.8, 0.4}, {-2.8, -1.3}};
  int both_y = 0;
  int both_x = 0;
  for (const auto& [first, second] : pairs) {
    const Points p = wall(first);
    const Points q = wall(second);
    const published::AxisLine a = published::conditional_line(p, noisy);
    const published::AxisLine b = published::conditional_line(q, noisy);
    both_y += a.y_on_x && b.y_on_x ? 1 : 0;
    both_x += !a.y_on_x && !b.y_on_x ? 1 : 0;
    const published::AxisCorner expected = published::corner(a, b);
    const auto corner = intersect(fitter(p, noisy).estimate, fitter(q, noisy).estimate);
    ASSERT_TRUE(corner);
    EXPECT_NEAR((corner->position - expected.position).norm(), 0.0, 1e-10);
    EXPECT_THAT(corner->covariance, CovarianceNear(expected.covariance, 1e-7));
  }
  EXPECT_EQ(both_y, 2);
  EXPECT_EQ(both_x, 2);
}

TEST(Cwlf, IsItsTwoSteps) {
  const Points p = first_wall();
  for (const CovarianceMode mode : {CovarianceMode::propagated, CovarianceMode::as_published}) {
    const FitResult fit = Cwlf({mode})(p, noisy);
    const AxisRegression line = cwlf_line(p, noisy);
    EXPECT_EQ(fit.estimate.line.alpha, line.line.alpha);
    EXPECT_EQ(fit.estimate.line.r, line.line.r);
    EXPECT_EQ(fit.estimate.covariance, cwlf_covariance(p, noisy, line, mode));
  }
}

TEST(Cwlf, PublishedEllipseIsTheSmallerOne) {
  for (const double alpha : {0.3, 1.1, 1.7, -2.5}) {
    const Points p = wall(alpha);
    EXPECT_LT(Cwlf({CovarianceMode::as_published})(p, noisy).estimate.covariance.determinant(),
              Cwlf()(p, noisy).estimate.covariance.determinant());
  }
}

}  // namespace
}  // namespace quoin
