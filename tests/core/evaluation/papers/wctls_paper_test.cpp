// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/papers/wctls_paper.hpp"

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/papers/published_figures.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

NamedFitter named(const char* name, CovarianceMode mode) {
  return {name, mode, Fitters::make<Fitter>(name, {{"covariance", std::string(enum_name(mode))}})};
}

WctlsPaperEnvironment repeat(const char* world, const std::vector<NamedFitter>& fitters) {
  return repeat_wctls_paper(built_in_world(world).value(), Segmenters::make<Segmenter>("iepf", {}),
                            CornerFinders::make<CornerFinder>("adjacent", {}), fitters,
                            SensorModel{}, 20, 5);
}

TEST(WctlsPaper, TablesFollowFromReadingEquationFiveLiterally) {
  const auto a = repeat("environment_a", {named("wctls", CovarianceMode::propagated),
                                          named("utls", CovarianceMode::propagated),
                                          named("utls", CovarianceMode::as_published)});
  ASSERT_EQ(a.methods.size(), 3U);
  const double wctls = median(a.methods[0].median_areas);
  EXPECT_NEAR(median(a.methods[1].median_areas) / wctls, 1.0, 0.1);
  const double printed = median(a.methods[2].median_areas) / wctls;
  EXPECT_GT(printed, 4.0);  // the paper: 7.2
  EXPECT_LT(printed, 14.0);
}

TEST(WctlsPaper, RepresentativeScanShowsTheCornersInSight) {
  const auto a = repeat("environment_a", {named("wctls", CovarianceMode::propagated)});
  EXPECT_EQ(a.rays, 935U);
  EXPECT_EQ(a.truth.size(), 18U);
  EXPECT_LE(a.points.size(), 935U);
  EXPECT_GT(a.points.size(), 900U);
  ASSERT_EQ(a.methods.front().corners.size(), 18U);
  EXPECT_EQ(a.methods.front().median_areas.size(), 20U);
  std::size_t found = 0;
  for (std::size_t k = 0; k < 18; ++k) {
    const auto& corner = a.methods.front().corners[k];
    if (!corner) continue;
    ++found;
    EXPECT_LT((corner->position - a.truth[k]).norm(), 0.15);
  }
  EXPECT_GE(found, 16U);
  // Clockwise: the bearing falls from corner to corner, but for one jump.
  int rises = 0;
  for (std::size_t k = 0; k < 18; ++k) {
    const Eigen::Vector2d& here = a.truth[k];
    const Eigen::Vector2d& next = a.truth[(k + 1) % 18];
    rises += here.x() * next.y() - here.y() * next.x() > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(rises, 0);
}

TEST(PublishedFigures, HaveTheCornersThatThePapersCount) {
  const auto tables = published_wctls_tables();
  ASSERT_EQ(tables.size(), 2U);
  for (const PublishedTable& table : tables) {
    ASSERT_EQ(table.methods.size(), 3U);
    for (const PublishedSigmas& method : table.methods) {
      EXPECT_EQ(method.x.size(), table.environment == "environment_a" ? 18U : 23U);
      EXPECT_EQ(method.y.size(), method.x.size());
    }
  }
  // The last rows of Tables 1 and 2.
  EXPECT_EQ(tables[0].methods[2].y.back(), 66.36);
  EXPECT_EQ(tables[1].methods[0].x.back(), 31.48);
  // Table I and II print means of their columns.
  const auto cwlf = published_cwlf_tables();
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  };
  EXPECT_NEAR(mean(cwlf[0].methods[0].x), 23.02, 0.01);
  EXPECT_NEAR(mean(cwlf[0].methods[1].y), 27.98, 0.01);
  EXPECT_NEAR(mean(cwlf[1].methods[0].y), 13.92, 0.01);
  EXPECT_NEAR(mean(cwlf[1].methods[1].x), 25.32, 0.01);
}

}  // namespace
}  // namespace quoin
