// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/options.hpp"

#include <gmock/gmock.h>

#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "sensor_bridge/recordings/line_reader.hpp"
#include "sensor_bridge/simulated/world_file.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::deploy {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Error>
std::string complaint(const EvaluationOptions& options) {
  return error_of<Error>([&] { (void)prepare(options); });
}

TEST(EvaluationOptions, NameAllMethodsWhenNoneIsNamed) {
  const EvaluationSetup setup = prepare({});
  EXPECT_EQ(setup.fitters.size(), Fitters::descriptions().size());
  EXPECT_EQ(setup.segmenters.size(), Segmenters::descriptions().size());
  EXPECT_THAT(setup.loop_segmenters, ElementsAre(Segmenters::descriptions().front().name));
  EXPECT_TRUE(setup.worlds.empty());
  EvaluationOptions options;
  options.fitters = {"wtls", "utls"};
  options.worlds = {"corridor"};
  const EvaluationSetup chosen = prepare(options);
  EXPECT_THAT(chosen.fitters, ElementsAre("wtls", "utls"));
  ASSERT_EQ(chosen.worlds.size(), 1U);
  EXPECT_EQ(chosen.worlds.front().name, "corridor");
}

TEST(EvaluationOptions, UnknownNamesGetASuggestion) {
  EvaluationOptions options;
  options.fitters = {"wctls", "wclts"};
  EXPECT_EQ(complaint<OptionError>(options),
            "--fitters: unknown fitter 'wclts'; did you mean 'wctls'?");
  options.fitters = {"utls", "utls"};
  EXPECT_EQ(complaint<OptionError>(options), "--fitters: 'utls' is named twice");
  options = {};
  options.segmenters = {"iefp"};
  EXPECT_EQ(complaint<OptionError>(options),
            "--segmenters: unknown segmenter 'iefp'; did you mean 'iepf'?");
  options = {};
  options.only = {"consistancy"};
  EXPECT_EQ(complaint<OptionError>(options),
            "--only: unknown section 'consistancy'; did you mean 'consistency'?");
  options.only = {"scans"};
  EXPECT_THAT(complaint<OptionError>(options), HasSubstr("needs scan files"));
  options = {};
  options.worlds = {"coridor"};
  EXPECT_THAT(complaint<sensor_bridge::WorldError>(options), HasSubstr("coridor"));
  options = {};
  options.trials = 0;
  EXPECT_THAT(complaint<OptionError>(options), HasSubstr("more than 0"));
}

TEST(EvaluationOptions, BadScanFilesAreToldWithTheirPlace) {
  const TemporaryFolder folder;
  const auto file = folder.write("scan.csv", "0.0,1.0\n0.1,x\n");
  EvaluationOptions options;
  options.scans = {file.string()};
  EXPECT_THAT(complaint<sensor_bridge::ScanFileError>(options),
              HasSubstr(file.string() + ":2:5: "));
  options.scans = {(folder.path() / "absent.csv").string()};
  EXPECT_THAT(complaint<sensor_bridge::ScanFileError>(options), HasSubstr("absent.csv"));
}

TEST(EvaluationOptions, RelationsAreReadWithTheirOffset) {
  const TemporaryFolder folder;
  EvaluationOptions options;
  options.relations = folder.write("r", "# t1 t2 x y z roll pitch yaw\n12 13 1 2 0 0 0 0.5\n");
  EXPECT_THAT(complaint<OptionError>(options), HasSubstr("--scans"));
  options.scans = {folder.write("scan.csv", "0.0,1.0\n0.1,1.0\n").string()};
  options.relations_offset = 10.0;
  const EvaluationSetup setup = prepare(options);
  ASSERT_EQ(setup.relations.size(), 1U);
  EXPECT_DOUBLE_EQ(setup.relations[0].first, 2.0);
  EXPECT_DOUBLE_EQ(setup.relations[0].second, 3.0);
  EXPECT_DOUBLE_EQ(setup.relations[0].relative.y, 2.0);
  EXPECT_DOUBLE_EQ(setup.relations[0].relative.theta, 0.5);
  options.relations = folder.write("bad", "1 2 0 0 0 0 0 0\n1 2 0 x 0 0 0 0\n");
  EXPECT_THAT(complaint<sensor_bridge::ScanFileError>(options),
              HasSubstr(options.relations + ":2:7: a relation is eight numbers"));
}

TEST(EvaluationOptions, AFolderOfWorldsIsReadByName) {
  const TemporaryFolder folder;
  EvaluationOptions options;
  options.worlds = {folder.path().string()};
  EXPECT_THAT(complaint<OptionError>(options), HasSubstr("there is no world file"));
  for (const char* name : {"b.yaml", "a.yml"}) {
    folder.write(name,
                 "walls:\n  - {points: [[2, -3], [2, 3]], closed: false}\npath:\n  - [0, 0, 0]\n");
  }
  options.worlds.push_back("corridor");
  const EvaluationSetup setup = prepare(options);
  ASSERT_EQ(setup.worlds.size(), 3U);
  EXPECT_EQ(setup.worlds[0].name, "a");
  EXPECT_EQ(setup.worlds[1].name, "b");
  EXPECT_EQ(setup.worlds[2].name, "corridor");
}

TEST(EvaluationOptions, CovarianceModesAreThoseOfTheFitter) {
  EXPECT_THAT(covariance_modes("utls"), ElementsAre("propagated", "as_published"));
  EXPECT_THAT(covariance_modes("no_such_fitter"), ElementsAre(""));
}

}  // namespace
}  // namespace quoin::deploy
