// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include <gmock/gmock.h>

#include "deploy/orchestration/checksum.hpp"
#include "deploy/orchestration/file_watch.hpp"
#include "deploy/orchestration/frozen_file.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::deploy {
namespace {

using namespace std::chrono_literals;

std::string read(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(FrozenFile, CanBeReadAgainAndAgainButNotChanged) {
  const FrozenFile file("version: 1\n");
  EXPECT_EQ(read(file.path()), "version: 1\n");
  EXPECT_EQ(read(file.path()), "version: 1\n");
  const int descriptor = ::open(file.path().c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor >= 0) {
    EXPECT_EQ(::write(descriptor, "x", 1), -1);
    EXPECT_EQ(::ftruncate(descriptor, 0), -1);
    ::close(descriptor);
  }
  EXPECT_EQ(read(file.path()), "version: 1\n");
}

TEST(FrozenFile, GoesWithItsOwner) {
  std::filesystem::path path;
  {
    const FrozenFile file("text");
    path = file.path();
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Checksum, IsFnv1a) {
  EXPECT_EQ(checksum(""), 0xcbf29ce484222325U);
  EXPECT_EQ(checksum("a"), 0xaf63dc4c8601ec8cU);
}

/// A watched file at times of the test's own making.
class Watch : public testing::Test {
 protected:
  Watch() { write("one"); }

  void write(const std::string& text) const { std::ofstream(file_) << text; }
  /// As editors do: a new file gets the name of the old one.
  void replace(const std::string& text) const {
    const std::filesystem::path other = file_.string() + ".new";
    std::ofstream(other) << text;
    std::filesystem::rename(other, file_);
  }
  int changes(FileWatch& watch, int looks = 10) {
    int count = 0;
    for (int i = 0; i < looks; ++i) count += watch.changed(now_ += 100ms) ? 1 : 0;
    return count;
  }

  const tests::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "watched";
  FileWatch::Clock::time_point now_ = FileWatch::Clock::now();
};

TEST_F(Watch, TellsEachChangeOnce) {
  FileWatch watch(file_);
  EXPECT_EQ(changes(watch), 0);
  write("two, longer");
  EXPECT_EQ(changes(watch), 1);
  replace("three");
  EXPECT_EQ(changes(watch), 1);
}

TEST_F(Watch, WaitsUntilTheFileIsAtRest) {
  FileWatch watch(file_);
  for (int i = 0; i < 5; ++i) {
    write(std::string(static_cast<std::size_t>(i) + 10, 'x'));
    EXPECT_EQ(changes(watch, 1), 0);
  }
  EXPECT_EQ(changes(watch), 1);
}

TEST_F(Watch, AFileThatIsAwayIsNoChange) {
  FileWatch watch(file_);
  std::filesystem::remove(file_);
  EXPECT_EQ(changes(watch), 0);
  write("back again");
  EXPECT_EQ(changes(watch), 1);
}

}  // namespace
}  // namespace quoin::deploy
