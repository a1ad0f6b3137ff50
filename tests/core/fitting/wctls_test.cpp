// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/wctls.hpp"

#include <cmath>
#include <string>

#include "core/geometry/corner.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/fitting/published_equations.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

class AlgebraicFitter : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Names, AlgebraicFitter, testing::Values("wctls", "utls", "wtls"));

TEST_P(AlgebraicFitter, GivesTheCornerOfThePublishedEquations) {
  const Points p = first_wall();
  const Points q = second_wall();
  const bool weighted = std::string(GetParam()) != "utls";
  const auto a = published::implicit_line(p, noisy, weighted);
  const auto b = published::implicit_line(q, noisy, weighted);
  const auto expected = published::corner(a, b);
  const auto corner = intersect(make_fitter(GetParam())(p, noisy).estimate,
                                make_fitter(GetParam())(q, noisy).estimate);
  ASSERT_TRUE(corner);
  EXPECT_NEAR((corner->position - expected.position).norm(), 0.0, 1e-11);
  EXPECT_THAT(corner->covariance, CovarianceNear(expected.covariance, 1e-9));

  if (std::string(GetParam()) == "wctls") return;  // publishes the propagated one
  const auto literal = published::corner(published::with_common_errors(a, noisy),
                                         published::with_common_errors(b, noisy));
  const auto printed = intersect(make_fitter(GetParam(), "as_published")(p, noisy).estimate,
                                 make_fitter(GetParam(), "as_published")(q, noisy).estimate);
  EXPECT_THAT(printed->covariance, CovarianceNear(literal.covariance, 1e-9));
  EXPECT_GT(one_sigma_ellipse_area(printed->covariance),
            3.0 * one_sigma_ellipse_area(corner->covariance));
}

TEST(Wctls, GivesTheCornerOfItsConformalPoint) {
  const Points p = first_wall();
  const Points q = second_wall();
  // C_Q by exact influences, mapped back from (alpha, r): from Q and from the normal form it is the
  // same.
  const auto to_q = [](const LineEstimate& e) {
    const double c = std::cos(e.line.alpha);
    const double s = std::sin(e.line.alpha);
    Eigen::Matrix2d j;
    j << -s / e.line.r, -c / (e.line.r * e.line.r), -c / e.line.r, s / (e.line.r * e.line.r);
    return published::ConformalPoint{{c / e.line.r, -s / e.line.r},
                                     j * e.covariance * j.transpose()};
  };
  const LineEstimate a = make_fitter("wctls")(p, noisy).estimate;
  const LineEstimate b = make_fitter("wctls")(q, noisy).estimate;
  const auto expected =
      published::corner(published::normalized_line(to_q(a)), published::normalized_line(to_q(b)));
  const auto corner = intersect(a, b);
  EXPECT_NEAR((corner->position - expected.position).norm(), 0.0, 1e-12);
  EXPECT_THAT(corner->covariance, CovarianceNear(expected.covariance, 1e-9));
  // Q and C_Q found independently, differentiated numerically.
  const auto numerical = published::conformal_point(p, noisy);
  EXPECT_NEAR((numerical.q - to_q(a).q).norm(), 0.0, 1e-12);
  EXPECT_THAT(to_q(a).covariance, CovarianceNear(numerical.covariance, 1e-6));
  EXPECT_EQ(make_fitter("wctls", "as_published")(p, noisy).estimate.covariance, a.covariance);
}

}  // namespace
}  // namespace quoin
