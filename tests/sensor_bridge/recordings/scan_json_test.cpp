// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/scan_json.hpp"

#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ScanJson, IsReadHoweverItIsLaidOut) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.json", R"({"map": {"2.5": {"range": [1, 2.5,
    3e0, 4], "note": {"a": [1, {"b": "}"}]}, "x": 1, "y":
  -2, "theta": 0.5}
  ,"3.0":{"theta":1,"range":[5,6],"y":0}}})");
  const auto reader = open_scan_json(file, ScanGeometry{});
  RecordedScan scan;
  ASSERT_TRUE(reader->next(scan));
  EXPECT_EQ(scan.stamp, 2.5);
  EXPECT_THAT(scan.ranges, ElementsAre(1, 2.5, 3, 4));
  EXPECT_FLOAT_EQ(scan.bearings[1], static_cast<float>(-std::numbers::pi / 6));
  ASSERT_EQ(scan.odometry.size(), 1U);
  EXPECT_EQ(scan.odometry[0].pose.y, -2.0);
  ASSERT_TRUE(reader->next(scan));
  EXPECT_EQ(scan.stamp, 3.0);
  EXPECT_TRUE(scan.odometry.empty()) << "no x";
  EXPECT_FALSE(reader->next(scan));
  EXPECT_FALSE(reader->next(scan));
}

TEST(ScanJson, SaysWhereItIsWrong) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& content) {
    const auto reader = open_scan_json(folder.write("a.json", content), ScanGeometry{});
    RecordedScan scan;
    return error_of<ScanFileError>([&] {
      while (reader->next(scan)) {
      }
    });
  };
  EXPECT_THAT(error("{\"mop\": {"), HasSubstr("a.json:1:"));
  EXPECT_THAT(error("{\"map\":\n {\"x\": {"), HasSubstr("a.json:2:"));
  EXPECT_THAT(error("{\"map\": {\"1\": {\"range\": [1, two]}}}"),
              HasSubstr("a.json:1:29: 'two' is not a number"));
  EXPECT_THAT(error("{\"map\": {\"1\": {\"range\": [1,"), HasSubstr("cut off"));
  EXPECT_THAT(error("{\"map\": {\"1\": {\"range\": []}}}"), HasSubstr("without ranges"));
  EXPECT_THAT(error("{\"map\": {\"1\": {\"other\": {"), HasSubstr("cut off"));
  EXPECT_THAT(error(""), HasSubstr("cut off"));
}

}  // namespace
}  // namespace quoin::sensor_bridge
