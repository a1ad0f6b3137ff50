// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/maps/map_file.hpp"

#include <filesystem>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::maps {
namespace {

using quoin::tests::error_of;
using testing::HasSubstr;

SavedMap a_map() {
  SavedMap map{"hall", 1234567890123456789, "landmarks", "landmarks/7", {0, 255, 16}, {}};
  MapLine line;
  line.id = 300;
  line.start = {0.1, -1e-17};
  line.end = {1.0 / 3.0, 2.5};
  line.covariance << 1e-6, -2e-7, -2e-7, 3e-5;
  line.observations = 7;
  map.lines = {line, MapLine{}};
  return map;
}

TEST(MapFile, KeepsEveryBit) {
  const SavedMap map = a_map();
  const SavedMap back = parse_map(map_text(map), "a.qmap");
  EXPECT_EQ(back.frame, map.frame);
  EXPECT_EQ(back.begun, map.begun);
  EXPECT_EQ(back.method, map.method);
  EXPECT_EQ(back.state_form, map.state_form);
  EXPECT_EQ(back.state, map.state);
  ASSERT_EQ(back.lines.size(), 2U);
  EXPECT_EQ(back.lines[0].id, 300U);
  EXPECT_EQ(back.lines[0].start, map.lines[0].start);
  EXPECT_EQ(back.lines[0].end, map.lines[0].end);
  EXPECT_EQ(back.lines[0].covariance, map.lines[0].covariance);
  EXPECT_EQ(back.lines[0].observations, 7U);
}

TEST(MapFile, WithoutAMethodIsReadToo) {
  const SavedMap back = parse_map(map_text(SavedMap{}), "a.qmap");
  EXPECT_EQ(back.method, "");
  EXPECT_TRUE(back.state.empty() && back.lines.empty());
}

TEST(MapFile, NoticesEveryChangedOrMissingByte) {
  const std::string text = map_text(a_map());
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_THROW((void)parse_map(changed, "a.qmap"), MapError) << i;
    EXPECT_THROW((void)parse_map(text.substr(0, i), "a.qmap"), MapError) << i;
  }
}

TEST(MapFile, SaysWhatIsWrong) {
  std::string text = map_text(a_map());
  text[text.find("map 1") + 4] = '2';
  EXPECT_THAT(error_of<MapError>([&] { (void)parse_map(text, "a.qmap"); }),
              HasSubstr("a.qmap:1: a map of version 2; this program reads version 1"));
  EXPECT_THAT(error_of<MapError>([] { (void)parse_map("<svg/>", "a.qmap"); }),
              HasSubstr("a.qmap:1: this is no map of Quoin"));
  std::string edited = map_text(a_map());
  edited.replace(edited.find("hall"), 4, "room");
  EXPECT_THAT(error_of<MapError>([&] { (void)parse_map(edited, "a.qmap"); }),
              HasSubstr("damaged or was edited"));
}

/// Opening one would wait for whoever writes into it.
TEST(MapFile, IsNoFifo) {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "map.qmap";
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_THAT(error_of<MapError>([&] { (void)read_text(file); }), HasSubstr("regular file"));
}

TEST(WriteWhole, ReplacesOrLeavesWhatIsThere) {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "map.svg";
  write_whole(file, "first");
  write_whole(file, "second");
  EXPECT_EQ(read_text(file), "second");
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0644U);
  EXPECT_THAT(error_of<MapError>([&] { write_whole(folder.path() / "none" / "map.svg", "x"); }),
              HasSubstr("map.svg: cannot be written: No such file"));
  std::filesystem::create_directory(folder.path() / "folder");
  EXPECT_THROW(write_whole(folder.path() / "folder", "x"), MapError);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++files;
  }
  EXPECT_EQ(files, 2U) << "nothing is left behind";
}

}  // namespace
}  // namespace quoin::maps
