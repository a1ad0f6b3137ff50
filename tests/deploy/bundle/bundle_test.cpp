// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "deploy/bundle/archive.hpp"
#include "deploy/bundle/captured_run.hpp"
#include "deploy/bundle/redaction.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::deploy {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const Redaction plain({});

TEST(Redaction, HidesWhatSecretVariablesHoldWhereverItStands) {
  const Redaction hide({"VIEWER_TOKEN=hunter42", "HOME=/home/robot", "API_KEY=abc"});
  EXPECT_EQ(hide("GET /?t=hunter42 from /home/robot"), "GET /?t=(hidden) from /home/robot");
  EXPECT_EQ(hide("abc"), "abc");  // too short: it would hide parts of words
}

TEST(Redaction, OfTwoValuesTheLongerOneGoesFirst) {
  const Redaction hide({"A_SECRET=hunter", "B_SECRET=hunter42"});
  EXPECT_EQ(hide("hunter42 hunter"), "(hidden) (hidden)");
}

TEST(Redaction, HidesValuesBehindSecretNames) {
  EXPECT_EQ(plain("token: abc\nrate_hz: 10\n"), "token: (hidden)\nrate_hz: 10\n");
  EXPECT_EQ(plain("{password: abc, rate: 3}"), "{password: (hidden), rate: 3}");
  EXPECT_EQ(plain(R"({"apiKey": "a, b", "x": 1})"), R"({"apiKey": (hidden), "x": 1})");
  EXPECT_EQ(plain("WIFI_PASSWD=abc def"), "WIFI_PASSWD=(hidden)");
  EXPECT_EQ(plain("security: {keys: ../keys}"), "security: {keys: ../keys}");
  EXPECT_EQ(plain("the token is needed"), "the token is needed");
}

TEST(Redaction, HidesPasswordsInUrlsAndPrivateKeys) {
  EXPECT_EQ(plain("https://me:pw@host/x:y@z"), "https://me:(hidden)@host/x:y@z");
  EXPECT_EQ(plain("http://host:8080/a@b"), "http://host:8080/a@b");
  EXPECT_EQ(plain("a\n-----BEGIN PRIVATE KEY-----\nMIIE\n-----END PRIVATE KEY-----\nb"),
            "a\n(hidden)\nb");
  EXPECT_EQ(plain("-----BEGIN EC PRIVATE KEY-----\nMIIE"), "(hidden)");
}

TEST(TarGz, IsUnpackedByTar) {
  const tests::TemporaryFolder folder;
  const std::string large(100000, 'x');
  std::ofstream(folder.path() / "a.tar.gz") << tar_gz({{"one/a.txt", "hello\n"}, {"one/b", large}});
  const std::string unpacked = captured_run(
      {"tar", "xzvf", folder.path() / "a.tar.gz", "-C", folder.path()}, milliseconds(20000));
  EXPECT_EQ(unpacked, "one/a.txt\none/b\n");
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "one/b"), large.size());
  EXPECT_EQ(captured_run({"cat", folder.path() / "one/a.txt"}, milliseconds(20000)), "hello\n");
  EXPECT_THROW((void)tar_gz({{std::string(100, 'n'), ""}}), std::invalid_argument);
}

TEST(CapturedRun, SaysHowAProgramEnded) {
  EXPECT_EQ(captured_run({"sh", "-c", "echo a; echo b >&2; exit 3"}, milliseconds(20000)),
            "a\nb\n(exit code 3)\n");
  EXPECT_THAT(captured_run({"no-such-program"}, milliseconds(20000)),
              StartsWith("(no-such-program cannot be started"));
  EXPECT_THAT(captured_run({"sh", "-c", "echo a; exec sleep 60"}, milliseconds(300)),
              AllOf(StartsWith("a\n"), HasSubstr("stopped after 300 ms")));
}

}  // namespace
}  // namespace quoin::deploy
