// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "core/evaluation/papers/cwlf_paper.hpp"
#include "core/fitting/orthogonal.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

TEST(ArrasSiegwart, IsTheLineOfThePublishedDoubleSums) {
  std::mt19937_64 engine(5);
  for (const double alpha : {0.0, 0.4, 1.5, 2.6, 3.1, -0.7, -2.2, -3.1}) {
    const Points p = wall_points({alpha, 1.9}, alpha - 0.9, alpha + 0.3, 50, noisy, engine);
    const Line literal = arras_siegwart_literal(p, noisy);
    EXPECT_THAT(arras_siegwart_line(p).line.normal_form(),
                LineNear(literal.alpha, literal.r, 1e-12));
  }
}

TEST(ArrasSiegwart, PublishesTheRangeNoiseAlone) {
  const Points p = first_wall();
  const SensorModel range_only{noisy.range_stddev, 0.0, 0.0};
  const Fitter fitter = make_fitter("arras_siegwart", "as_published");
  EXPECT_THAT(fitter(p, noisy).estimate.covariance,
              CovarianceNear(numerical_covariance(fitter, p, noisy, range_only), 1e-7));
}

TEST(ArrasSiegwart, IsItsTwoSteps) {
  const Points p = first_wall();
  for (const CovarianceMode mode : {CovarianceMode::propagated, CovarianceMode::as_published}) {
    const FitResult fit = ArrasSiegwart({mode})(p, noisy);
    const OrthogonalLine line = arras_siegwart_line(p);
    EXPECT_EQ(fit.estimate.line.alpha, line.line.normal_form().alpha);
    EXPECT_EQ(fit.estimate.line.r, line.line.offset);
    EXPECT_EQ(fit.estimate.covariance, arras_siegwart_covariance(p, noisy, line, mode));
  }
}

}  // namespace
}  // namespace quoin
