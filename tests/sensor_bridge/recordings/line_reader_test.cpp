// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/line_reader.hpp"

#include <string>
#include <sys/stat.h>
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
using ::testing::HasSubstr;

std::vector<std::string> all_lines(const std::filesystem::path& file) {
  LineReader lines(file);
  std::vector<std::string> result;
  std::string_view line;
  while (lines.next(line)) result.emplace_back(line);
  EXPECT_EQ(lines.line_number(), result.size());
  EXPECT_FALSE(lines.next(line));
  return result;
}

TEST(LineReader, SplitsAtEitherLineEnd) {
  const TemporaryFolder folder;
  EXPECT_THAT(all_lines(folder.write("a", "one\r\n\ntwo\n")), ElementsAre("one", "", "two"));
  EXPECT_THAT(all_lines(folder.write("b", "one\ntwo")), ElementsAre("one", "two"));
  EXPECT_THAT(all_lines(folder.write("c", "one\ntwo\r")), ElementsAre("one", "two"));
  EXPECT_THAT(all_lines(folder.write("d", "")), ElementsAre());
  EXPECT_THAT(all_lines(folder.write("f", "one\n\rtwo\n\r\n\rthree")),
              ElementsAre("one", "two", "", "three"));
  EXPECT_THAT(all_lines(folder.write("e",
                                     "\xEF\xBB\xBF"
                                     "one\n")),
              ElementsAre("one"));
}

TEST(LineReader, ReadsLinesOfAnyLengthPlainAndCompressed) {
  const TemporaryFolder folder;
  std::vector<std::string> expected;
  std::string content;
  for (std::size_t length : {0, 1, 4094, 4095, 4096, 4097, 9000, 100000}) {
    expected.emplace_back(length, static_cast<char>('a' + expected.size()));
    content += expected.back() + "\n";
  }
  EXPECT_EQ(all_lines(folder.write("plain", content)), expected);
  EXPECT_EQ(all_lines(write_compressed(folder, "compressed.gz", content)), expected);
}

TEST(LineReader, RefusesALineThatIsTooLong) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("a", "x\n" + std::string(LineReader::max_line_length + 5000, 'x'));
  EXPECT_EQ(error_of<ScanFileError>([&] { (void)all_lines(file); }),
            file + ":2:16777217: line longer than 16 MiB; is this a scan file?");
}

TEST(LineReader, ReportsWhatCannotBeOpened) {
  const TemporaryFolder folder;
  const std::string missing = folder.path() / "missing.log";
  EXPECT_EQ(error_of<ScanFileError>([&] { LineReader lines(missing); }),
            "cannot read scan file '" + missing + "': No such file or directory");
  EXPECT_EQ(error_of<ScanFileError>([&] { LineReader lines(folder.path()); }),
            "cannot read scan file '" + folder.path().string() + "': it is a folder");
  const std::string fifo = folder.path() / "fifo.log";  // opening it would wait for a writer
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(error_of<ScanFileError>([&] { LineReader lines(fifo); }),
            "cannot read scan file '" + fifo + "': it is not a regular file");
}

TEST(LineReader, GivesEachWholeLineOfACompressedFileThatIsCutOff) {
  const TemporaryFolder folder;
  std::string content;
  for (int i = 0; i < 5000; ++i) content += std::to_string(i * 7919 % 10007) + "\n";
  const std::filesystem::path file = write_compressed(folder, "cut.gz", content);
  const auto whole_size = std::filesystem::file_size(file);
  for (const auto missing : {1U, 4U, 9U, 500U, 5000U}) {
    std::filesystem::resize_file(file, whole_size - missing);
    LineReader lines(file);
    std::string read;
    const std::string error = error_of<ScanFileError>([&] {
      std::string_view line;
      while (lines.next(line)) read += std::string(line) + "\n";
    });
    EXPECT_EQ(read, content.substr(0, read.size()));
    EXPECT_GT(read.size(), missing < 10 ? content.size() - 10 : content.size() / 4);
    const auto last_line = std::to_string(lines.line_number());
    EXPECT_THAT(error, HasSubstr(file.string() + ":" + last_line + ":"));
    EXPECT_THAT(
        error,
        HasSubstr(": the compressed file ends in the middle; it was cut off, copy it again"));
    write_compressed(folder, "cut.gz", content);
  }
}

TEST(LineReader, ReportsADamagedCompressedFileAfterTheLinesBefore) {
  const TemporaryFolder folder;
  std::string content;
  for (int i = 0; i < 20000; ++i) content += std::to_string(i * 7919 % 10007) + "\n";
  const std::filesystem::path file = write_compressed(folder, "damaged.gz", content);
  {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file)) - 6);  // checksum
    stream.put('\x5A');
  }
  LineReader lines(file);
  std::string read;
  const std::string error = error_of<ScanFileError>([&] {
    std::string_view line;
    while (lines.next(line)) read += std::string(line) + "\n";
  });
  EXPECT_EQ(read, content.substr(0, read.size()));
  EXPECT_GT(read.size(), content.size() - 10000);
  EXPECT_THAT(
      error,
      HasSubstr(": the compressed file is damaged here (incorrect data check); copy it again"));
}

}  // namespace
}  // namespace quoin::sensor_bridge
