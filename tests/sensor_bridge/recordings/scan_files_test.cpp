// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/scan_files.hpp"

#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/compressed.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using quoin::tests::write_compressed;
using ::testing::ElementsAre;

constexpr double pi = std::numbers::pi;

std::string flaser(const std::string& range) {
  return "FLASER 1 " + range + " 1 2 0.5 3 4 0.25 12.5 host 13\n";
}

std::vector<float> first_ranges(ScanFiles& files, std::vector<bool>* first_of_file = nullptr) {
  std::vector<float> ranges;
  RecordedScan scan;
  while (files.next(scan)) {
    ranges.push_back(scan.ranges.front());
    if (first_of_file != nullptr) first_of_file->push_back(scan.first_of_file);
  }
  return ranges;
}

TEST(ScanFiles, ReadAFolderInTheOrderOfNames) {
  const TemporaryFolder folder;
  folder.write("c.csv", "0,4\n");
  folder.write("a.log", flaser("1") + flaser("2"));
  write_compressed(folder, "b.log.gz", flaser("3"));
  folder.write("a.txt", "not a scan");
  folder.write("notes.md", "neither");
  std::filesystem::create_directory(folder.path() / "d.csv");

  ScanFiles files(folder.path(), ScanFormat::automatic, pi);
  std::vector<bool> first_of_file;
  EXPECT_THAT(first_ranges(files, &first_of_file), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(first_of_file, ElementsAre(true, false, true, true));
  RecordedScan scan;
  EXPECT_FALSE(files.next(scan));
  files.rewind();
  EXPECT_THAT(first_ranges(files), ElementsAre(1, 2, 3, 4));
}

TEST(ScanFiles, ReadAFileOfAnyNameWhenTheFormatIsGiven) {
  const TemporaryFolder folder;
  ScanFiles csv(folder.write("one", "0,4\n"), ScanFormat::csv, pi);
  EXPECT_THAT(first_ranges(csv), ElementsAre(4));
  ScanFiles carmen(folder.write("two", flaser("5")), ScanFormat::carmen, pi);
  EXPECT_THAT(first_ranges(carmen), ElementsAre(5));
  // By its content, too.
  ScanFiles found(folder.path() / "one", ScanFormat::automatic, pi);
  EXPECT_THAT(first_ranges(found), ElementsAre(4));
}

TEST(ScanFiles, ReportWhatIsMissingWhenOpened) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      error_of<ScanFileError>([] { ScanFiles files("/nowhere/a.log", ScanFormat::automatic, pi); }),
      "cannot read scan file '/nowhere/a.log': No such file or directory");
  EXPECT_EQ(
      error_of<ScanFileError>([&] { ScanFiles files(folder.path(), ScanFormat::automatic, pi); }),
      "folder '" + folder.path().string() +
          "' holds no scan file (.csv, .log, .clf, .dat, .mcap, .bag, .db3)");
}

TEST(ScanFiles, ReportAFileWithoutScans) {
  const TemporaryFolder folder;
  for (const auto& [name, content, place] :
       {std::tuple{"empty.log", "", ":1:1: "}, std::tuple{"no_scan.log", "# a\nODOM 1\n", ":2:1: "},
        std::tuple{"empty.csv", "# a\n\n", ":2:1: "}}) {
    const std::string file = folder.write(name, content);
    ScanFiles files(file, ScanFormat::automatic, pi);
    RecordedScan scan;
    EXPECT_EQ(
        error_of<ScanFileError>([&] { (void)files.next(scan); }),
        file + place +
            "the file ends here and holds no scan; is it a scan file, and is 'format' right?");
    EXPECT_FALSE(files.next(scan));
  }
}

TEST(ScanFiles, GiveAllScansBeforeTheErrorAndNoneAfter) {
  const TemporaryFolder folder;
  folder.write("a.csv", "0,1\n");
  const std::string bad = folder.write("b.log", flaser("2") + flaser("oops") + flaser("3"));
  folder.write("c.csv", "0,4\n");
  ScanFiles files(folder.path(), ScanFormat::automatic, pi);
  RecordedScan scan;
  ASSERT_TRUE(files.next(scan));
  ASSERT_TRUE(files.next(scan));
  EXPECT_THAT(scan.ranges, ElementsAre(2));
  EXPECT_EQ(error_of<ScanFileError>([&] { (void)files.next(scan); }),
            bad + ":2:10: 'oops' is not a number");
  EXPECT_FALSE(files.next(scan));
}

TEST(ScanFiles, DoNotAllocateOnceWarm) {
  const TemporaryFolder folder;
  ScanFiles files(folder.write("a.log", flaser("1") + flaser("2")), ScanFormat::automatic, pi);
  RecordedScan scan;
  ASSERT_TRUE(files.next(scan));
  const float* memory = scan.ranges.data();
  ASSERT_TRUE(files.next(scan));
  EXPECT_EQ(scan.ranges.data(), memory);
}

TEST(OpenScanFiles, StartsAtTheBaseDirectory) {
  const TemporaryFolder folder;
  folder.write("a.csv", "0,7\n");
  ReplayParameters parameters;
  parameters.path = "a.csv";
  ScanFiles files = open_scan_files(parameters, folder.path());
  EXPECT_THAT(first_ranges(files), ElementsAre(7));
}

TEST(OpenScanFiles, RefusesParametersThatContradictEachOther) {
  ReplayParameters parameters;
  parameters.path = "a.csv";
  parameters.range_min = 80.0;
  EXPECT_EQ(error_of<ParameterError>([&] { (void)open_scan_files(parameters, "."); }),
            "range_min must be below range_max");
}

TEST(ReplayParameters, DefaultsPassTheirOwnLimits) {
  ReplayParameters defaults;
  defaults.path = "scans.csv";
  ParameterSettings settings = parameter_settings(defaults);
  EXPECT_EQ(make_parameters<ReplayParameters>(settings).field_of_view, defaults.field_of_view);
}

}  // namespace
}  // namespace quoin::sensor_bridge
