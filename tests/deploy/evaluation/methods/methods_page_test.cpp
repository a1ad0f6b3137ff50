// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/methods_page.hpp"

#include <gmock/gmock.h>

#include "deploy/kinds/kinds.hpp"
#include "tests/deploy/evaluation/methods/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

SensorModel noise(double range_stddev) {
  SensorModel noise;
  noise.range_stddev = range_stddev;
  return noise;
}

MeasuredFigures figures() {
  MeasuredFigures figures;
  figures.version = "1.2.3";
  figures.seed = 7;
  figures.trials = 2000;
  figures.fitters = {{"wctls", "propagated", "room", noise(0.05), 1.996, 0.9512, 1.0314},
                     {"wctls", "propagated", "hall", noise(0.05), {}, {}, {}}};
  figures.segmenters = {{"saw", noise(0.003), 4000, 0.9876, 0.0123, 123456.0},
                        {"saw", noise(0.05), 4000, 0.8, 0.2, 99000.0},
                        {"laser", noise(0.05), 4000, 0.7, 0.3, {}}};
  figures.fit_times = {{"wctls", 100, 1.5e-7, 2.04}, {"plain_covariance", 100, 7.4e-8, 1.0}};
  return figures;
}

std::string page_of(const KindInfo& kind, const MeasuredFigures* figures) {
  return methods_page({&kind}, figures);
}

TEST(MethodsPage, TellsEachMethod) {
  const std::string page = page_of(kind_of_two_methods(), nullptr);
  EXPECT_THAT(page, HasSubstr("## cutting\n\nCuts scans. Reads scan, publishes segments.\n\n"));
  EXPECT_THAT(page, HasSubstr("### saw (default)\n\nCuts slowly.\n\nSource: Smith 1900.\n\n"
                              "When to choose it: For wood.\n\n"));
  EXPECT_THAT(page, HasSubstr("### laser\n\nCuts fast.\n\nSource: Jones 2000.\n\n"
                              "When to choose it: For steel.\n\n"));
  EXPECT_THAT(page, HasSubstr("quoin methods --markdown --report"));
  EXPECT_TRUE(page.ends_with("|\n"));
}

TEST(MethodsPage, TellsSharedParametersOnce) {
  const std::string page = page_of(kind_of_two_methods(), nullptr);
  const std::size_t shared = page.find("| depth ");
  EXPECT_LT(shared, page.find("### saw"));
  EXPECT_EQ(page.find("| depth ", shared + 1), std::string::npos);
  EXPECT_THAT(page, HasSubstr("| depth     | 2       | m    | real 1..9 | what it does |"));
  // The same name with another default is not the same parameter.
  EXPECT_THAT(page, HasSubstr("| teeth     | 3 "));
  EXPECT_THAT(page, HasSubstr("| teeth     | 4 "));
  EXPECT_THAT(page, HasSubstr("| angle     | 1.5708 (90 deg) | rad "));
  KindInfo alone = kind_of_two_methods();
  alone.methods.resize(1);
  EXPECT_THAT(methods_page({&alone}, nullptr), Not(HasSubstr("All of its methods")));
}

TEST(MethodsPage, LeavesOutKindsWithoutMethods) {
  KindInfo source;
  source.name = "lidar";
  source.parameters = {parameter("speed", "2")};
  const KindInfo cutting = kind_of_two_methods();
  const std::string page = methods_page({&source, &cutting}, nullptr);
  EXPECT_THAT(page, Not(HasSubstr("lidar")));
  EXPECT_THAT(page, Not(HasSubstr("speed")));
}

TEST(MethodsPage, HasFiguresOfSegmenters) {
  const MeasuredFigures measured = figures();
  const std::string page = page_of(kind_of_two_methods(), &measured);
  EXPECT_THAT(page, HasSubstr("### Figures of cutting\n\n"));
  EXPECT_THAT(page, HasSubstr("version 1.2.3, seed 7"));
  EXPECT_THAT(page, HasSubstr("| segmenter | 3 mm, 0.113 deg | 50 mm, 0.113 deg |\n"
                              "|-----------|----------------:|-----------------:|\n"
                              "| saw       |            98.8 |             80.0 |\n"
                              "| laser     |               - |             70.0 |\n"));
  EXPECT_THAT(page, HasSubstr("| saw       |             1.2 |             20.0 |\n"));
  EXPECT_THAT(page, HasSubstr("| saw       |           123.5 |             99.0 |\n"
                              "| laser     |               - |                - |\n"));
  EXPECT_THAT(page, Not(HasSubstr("NEES")));
}

TEST(MethodsPage, HasFiguresOfFitters) {
  KindInfo fitting = kind_of_two_methods();
  fitting.outputs = {{"lines"}};
  MeasuredFigures measured = figures();
  const std::string page = methods_page({&fitting}, &measured);
  EXPECT_THAT(page, HasSubstr("2000 trials each"));
  EXPECT_THAT(page, HasSubstr("room, noise 50 mm, 0.113 deg:\n\n"
                              "| fitter | covariance | NEES | coverage [%] | RMSE/CRB |\n"
                              "|--------|------------|-----:|-------------:|---------:|\n"
                              "| wctls  | propagated | 2.00 |         95.1 |    1.031 |\n\n"));
  EXPECT_THAT(page, HasSubstr("| wctls  | propagated |    - |            - |        - |\n"));
  EXPECT_THAT(page,
              HasSubstr("| wctls            |    100 |     0.150 |                   2.0 |\n"
                        "| plain_covariance |    100 |     0.074 |                   1.0 |\n"));
  for (FitTimeFigures& time : measured.fit_times) time.seconds.reset();
  EXPECT_THAT(methods_page({&fitting}, &measured), Not(HasSubstr("plain_covariance")));
}

TEST(MethodsPage, IsWithoutFiguresWhereNothingWasMeasured) {
  const MeasuredFigures nothing;
  EXPECT_EQ(methods_page(kinds().kinds, &nothing), methods_page(kinds().kinds, nullptr));
}

TEST(MethodsPage, FiguresAreAddedToThePageWithout) {
  const MeasuredFigures measured = figures();
  const std::string page = methods_page(kinds().kinds, &measured);
  std::string plain = methods_page(kinds().kinds, nullptr);
  EXPECT_GT(page.size(), plain.size());
  for (std::size_t end = 0; (end = plain.find("\n\n")) != std::string::npos;) {
    EXPECT_THAT(page, HasSubstr(plain.substr(0, end + 1)));
    plain.erase(0, end + 2);
  }
}

}  // namespace
}  // namespace quoin::deploy
