// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/papers/cwlf_paper.hpp"

#include <algorithm>
#include <set>

#include "core/evaluation/scene.hpp"
#include "core/fitting/axis_regression.hpp"
#include "core/fitting/orthogonal.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

NamedFitter cwlf(CovarianceMode mode) { return {"cwlf", mode, Cwlf({mode})}; }
NamedFitter arras_siegwart(CovarianceMode mode) {
  return {"arras_siegwart", mode, ArrasSiegwart({mode})};
}

const std::vector<NamedFitter> fitters{
    cwlf(CovarianceMode::as_published), cwlf(CovarianceMode::propagated),
    arras_siegwart(CovarianceMode::as_published), arras_siegwart(CovarianceMode::propagated)};

CwlfPaperEnvironment measured(const char* world, std::uint64_t seed = 3) {
  return measure_cwlf_paper(built_in_world(world).value(), fitters, SensorModel{}, seed);
}

TEST(CwlfPaper, EnvironmentsHaveTheWallsAndCornersThatThePaperCounts) {
  const CwlfPaperEnvironment a = measured("cwlf_environment_a");
  EXPECT_EQ(a.walls, 36U);
  EXPECT_EQ(a.truth.size(), 23U);
  EXPECT_EQ(a.lines.size(), 36U);
  const CwlfPaperEnvironment b = measured("cwlf_environment_b");
  EXPECT_EQ(b.walls, 18U);
  EXPECT_EQ(b.truth.size(), 15U);
  for (const CwlfPaperEnvironment* environment : {&a, &b}) {
    EXPECT_LE(environment->points.size(), environment->rays);
    EXPECT_GT(environment->points.size(), environment->rays * 9 / 10);
    ASSERT_EQ(environment->methods.size(), fitters.size());
    for (const PaperCorners& method : environment->methods) {
      ASSERT_EQ(method.corners.size(), environment->truth.size());
    }
  }
}

TEST(CwlfPaper, CornersAreThoseOfADirectComputation) {
  const World world = built_in_world("cwlf_environment_b").value();
  const CwlfPaperEnvironment b = measured("cwlf_environment_b", 8);
  const Scene scene = observe(world, world.pose_at(0.0), 1000);
  Random random(8);
  std::vector<Points> walls(scene.walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    measure(scene.walls[i], SensorModel{}, random, walls[i]);
  }
  for (std::size_t m = 0; m < fitters.size(); ++m) {
    for (std::size_t k = 0; k < scene.corners.size(); ++k) {
      const VisibleCorner& truth = scene.corners[scene.corners.size() - 1 - k];
      const auto expected =
          intersect(fitters[m].fitter(walls[truth.first], data_sheet_model()).estimate,
                    fitters[m].fitter(walls[truth.second], data_sheet_model()).estimate);
      const auto& corner = b.methods[m].corners[k];
      ASSERT_TRUE(expected && corner);
      EXPECT_EQ(b.truth[k], truth.position);
      EXPECT_EQ(corner->position, expected->position);
      EXPECT_EQ(corner->covariance, expected->covariance);
    }
  }
}

TEST(CwlfPaper, PublishedCovariancesOfCwlfAreTooSmall) {
  for (const char* world : {"cwlf_environment_a", "cwlf_environment_b"}) {
    const CwlfPaperEnvironment environment = measured(world);
    const auto& published = environment.methods[0].corners;
    const auto& propagated = environment.methods[1].corners;
    for (std::size_t k = 0; k < published.size(); ++k) {
      ASSERT_TRUE(published[k] && propagated[k]);
      EXPECT_EQ(published[k]->position, propagated[k]->position);
      // The conditional variance is never above that of the residual, but the weights' own noise
      // may take back a little where both are nearly equal.
      EXPECT_LT(published[k]->covariance(0, 0), 1.01 * propagated[k]->covariance(0, 0));
      EXPECT_LT(published[k]->covariance(1, 1), 1.01 * propagated[k]->covariance(1, 1));
    }
  }
}

TEST(CwlfPaper, IsTheSameForTheSameSeed) {
  const CwlfPaperEnvironment one = measured("cwlf_environment_a", 4);
  const CwlfPaperEnvironment same = measured("cwlf_environment_a", 4);
  const CwlfPaperEnvironment other = measured("cwlf_environment_a", 5);
  for (std::size_t k = 0; k < one.truth.size(); ++k) {
    EXPECT_EQ(one.methods[0].corners[k]->position, same.methods[0].corners[k]->position);
    EXPECT_EQ(one.methods[3].corners[k]->covariance, same.methods[3].corners[k]->covariance);
    EXPECT_NE(one.methods[0].corners[k]->position, other.methods[0].corners[k]->position);
  }
}

TEST(CwlfPaperCorners, LieWhereTheWallsMeetInEveryForm) {
  for (CwlfPaperCorner corner : cwlf_paper_corners()) {
    if (corner.points > 1000) continue;
    compute_corner(corner, {1e-9, 1e-10, 0.0}, 2);
    ASSERT_TRUE(corner.corner);
    const double bearing = 0.5 * (pi - corner.angle);
    EXPECT_NEAR(corner.corner->position.x(), 3.0 * std::cos(bearing), 1e-6);
    EXPECT_NEAR(corner.corner->position.y(), 3.0 * std::sin(bearing), 1e-6);
  }
}

TEST(CwlfPaperCorners, BothFormsOfArrasSiegwartAreTheSameMethod) {
  std::vector<CwlfPaperCorner> corners = cwlf_paper_corners();
  std::size_t compared = 0;
  for (CwlfPaperCorner& corner : corners) compute_corner(corner, SensorModel{}, 2);
  for (const CwlfPaperCorner& literal : corners) {
    if (literal.form != CornerForm::arras_siegwart_literal) continue;
    const auto linear = std::find_if(corners.begin(), corners.end(), [&](const auto& corner) {
      return corner.form == CornerForm::arras_siegwart && corner.angle == literal.angle &&
             corner.points == literal.points && corner.covariance == literal.covariance;
    });
    ASSERT_NE(linear, corners.end());
    // The double sums cancel about six digits of sixteen.
    EXPECT_NEAR((literal.corner->position - linear->corner->position).norm(), 0.0, 1e-8);
    EXPECT_THAT(literal.corner->covariance, CovarianceNear(linear->corner->covariance, 1e-6));
    ++compared;
  }
  EXPECT_EQ(compared, 2U * (8U + 2U));
}

TEST(CwlfPaperCorners, AreThoseOfTheFigures) {
  std::set<std::size_t> obtuse, right;
  for (const CwlfPaperCorner& corner : cwlf_paper_corners()) {
    (corner.angle > 2.0 ? obtuse : right).insert(corner.points);
    EXPECT_NEAR(corner.angle, (corner.angle > 2.0 ? 130.0 : 90.0) * pi / 180.0, 1e-12);
  }
  EXPECT_THAT(obtuse, testing::ElementsAre(10, 20, 50, 90, 100, 200, 500, 1000, 10000, 100000));
  EXPECT_THAT(right, testing::ElementsAre(50, 100));
}

TEST(CwlfPaperCorners, GrowMorePreciseWithTheRootOfTheNumberOfPoints) {
  for (const CovarianceMode mode : {CovarianceMode::as_published, CovarianceMode::propagated}) {
    for (const CornerForm form : {CornerForm::cwlf, CornerForm::arras_siegwart}) {
      CwlfPaperCorner few{0.5 * pi, 1000, form, mode, {}, {}};
      CwlfPaperCorner many{0.5 * pi, 100000, form, mode, {}, {}};
      compute_corner(few, SensorModel{}, 6);
      compute_corner(many, SensorModel{}, 6);
      // Fixed ends of the walls; the measured points shape the covariance by their noise of 10 mm.
      EXPECT_NEAR(few.corner->covariance(0, 0) / many.corner->covariance(0, 0), 100.0, 5.0);
      EXPECT_NEAR(few.corner->covariance(1, 1) / many.corner->covariance(1, 1), 100.0, 5.0);
    }
  }
}

TEST(CwlfPaperCorners, EveryStepTakesTime) {
  CwlfPaperCorner corner{0.5 * pi, 10, CornerForm::cwlf, CovarianceMode::as_published, {}, {}};
  time_corner(corner, SensorModel{}, 1);
  for (const double seconds : {corner.times.lines, corner.times.line_covariances,
                               corner.times.position, corner.times.covariance, corner.times.all}) {
    EXPECT_GT(seconds, 0.0);
  }
  EXPECT_FALSE(corner.corner);
}

}  // namespace
}  // namespace quoin
