// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <idl/Scan.h>
#include <memory>
#include <mutex>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/header.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace quoin::runtime {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// [s]
constexpr double lease = 1.0;

/// A process that runs dds_peer, and the lines that it prints.
class Peer {
 public:
  explicit Peer(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), QUOIN_DDS_PEER);
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    int pipe_ends[2];
    if (::pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    const int failed =
        ::posix_spawn(&process_, QUOIN_DDS_PEER, &actions, nullptr, words.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(pipe_ends[1]);
    if (failed != 0) throw std::runtime_error("cannot run " QUOIN_DDS_PEER);
    reading_ = std::thread([this, end = pipe_ends[0]] { read_lines(end); });
  }
  ~Peer() {
    kill();
    reading_.join();
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// Without goodbye.
  void kill() {
    if (process_ <= 0) return;
    signal(SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }
  void signal(int number) { ::kill(process_, number); }

  [[nodiscard]] std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }
  /// True once it has printed that many lines.
  [[nodiscard]] bool wait_for_lines(std::size_t count, std::chrono::milliseconds timeout = 30s) {
    std::unique_lock lock(mutex_);
    return printed_.wait_for(lock, timeout, [&] { return lines_.size() >= count; });
  }

 private:
  void read_lines(int end) {
    FILE* stream = ::fdopen(end, "r");
    char line[64];
    while (std::fgets(line, sizeof line, stream) != nullptr) {
      std::string text = line;
      text.pop_back();
      const std::lock_guard lock(mutex_);
      lines_.push_back(text);
      printed_.notify_all();
    }
    std::fclose(stream);
  }

  pid_t process_ = -1;
  std::thread reading_;
  mutable std::mutex mutex_;
  std::condition_variable printed_;
  std::vector<std::string> lines_;
};

/// A lossless writer and its readers, who found each other through a discovery server.
class SilentReader : public testing::Test {
 protected:
  SilentReader() : server_(start_server()) {
    ParticipantConfig config{tests::test_domain(), "writer"};
    config.network.discovery = Discovery::server;
    config.network.servers = {{"127.0.0.1", static_cast<std::uint16_t>(port_)}};
    config.network.lease = lease;
    participant_ = std::make_unique<Participant>(config);
    writer_ = std::make_unique<Writer<msg::Scan>>(*participant_, topic_, QosPreset::lossless);
  }

  [[nodiscard]] std::unique_ptr<Peer> start_server() const {
    auto server = std::make_unique<Peer>(
        std::vector<std::string>{"server", std::to_string(tests::test_domain()),
                                 std::to_string(port_), std::to_string(lease)});
    EXPECT_TRUE(server->wait_for_lines(1));
    return server;
  }
  [[nodiscard]] std::unique_ptr<Peer> start_reader(std::chrono::milliseconds pause = 0ms) const {
    auto reader = std::make_unique<Peer>(std::vector<std::string>{
        "reader", std::to_string(tests::test_domain()), std::to_string(port_),
        std::to_string(lease), topic_, std::to_string(pause.count())});
    EXPECT_TRUE(reader->wait_for_lines(1));
    return reader;
  }

  /// As services deliver: what cannot be written is tried again, after a look at silent readers.
  [[nodiscard]] bool write(std::size_t count, std::chrono::milliseconds timeout = 30s) {
    const auto deadline = Clock::now() + timeout;
    msg::Scan scan;
    for (; count > 0; --count) {
      topics::set_origin(scan.header(), "front", 1, next_);
      while (!writer_->write(scan)) {
        for (const std::string& name : writer_->check_silent_readers()) silent_.push_back(name);
        if (Clock::now() > deadline) return false;
      }
      ++next_;
    }
    return true;
  }

  /// True once that many readers are matched. The last one counts for a moment after it has let go
  /// of the writer.
  [[nodiscard]] bool matched_within(std::size_t count,
                                    std::chrono::milliseconds timeout = 10s) const {
    const auto deadline = Clock::now() + timeout;
    while (writer_->matched() != count && Clock::now() < deadline) {
      std::this_thread::sleep_for(1ms);
    }
    return writer_->matched() == count;
  }

  /// What a reader that was there from the beginning has printed when it missed nothing.
  [[nodiscard]] std::vector<std::string> all() const {
    std::vector<std::string> lines{"ready"};
    for (std::uint64_t i = 0; i < next_; ++i) lines.push_back(std::to_string(i));
    return lines;
  }

  // Beyond the ports of the participants that the domain has room for.
  const int port_ = 7400 + 250 * tests::test_domain() + 245;
  const std::string topic_ = tests::test_namespace() + "/front/scan";
  std::unique_ptr<Peer> server_;
  std::unique_ptr<Participant> participant_;
  std::unique_ptr<Writer<msg::Scan>> writer_;
  std::uint64_t next_ = 0;
  std::vector<std::string> silent_;
};

TEST_F(SilentReader, IsDroppedWhenTheDiscoveryServerDiedBeforeIt) {
  auto dying = start_reader();
  auto living = start_reader();
  ASSERT_TRUE(writer_->wait_for_readers(2, 10s));
  ASSERT_TRUE(write(10));
  server_->kill();
  const auto later = Clock::now() + 1s;
  while (Clock::now() < later) ASSERT_TRUE(write(1));
  dying->kill();
  EXPECT_TRUE(write(1000));
  EXPECT_TRUE(matched_within(1));
  EXPECT_THAT(silent_, testing::Not(testing::IsEmpty()));
  EXPECT_THAT(silent_, testing::Each("reader"));
  EXPECT_TRUE(living->wait_for_lines(next_ + 1));
  EXPECT_EQ(living->lines(), all());
}

TEST_F(SilentReader, IsDroppedWhenTheDiscoveryServerLives) {
  auto dying = start_reader();
  auto living = start_reader();
  ASSERT_TRUE(writer_->wait_for_readers(2, 10s));
  ASSERT_TRUE(write(10));
  dying->kill();
  EXPECT_TRUE(write(1000));
  EXPECT_TRUE(matched_within(1));
  EXPECT_TRUE(living->wait_for_lines(next_ + 1));
  EXPECT_EQ(living->lines(), all());
}

TEST_F(SilentReader, IsDroppedWhenTheDiscoveryServerCameBackBeforeItDied) {
  auto dying = start_reader();
  auto living = start_reader();
  ASSERT_TRUE(writer_->wait_for_readers(2, 10s));
  ASSERT_TRUE(write(10));
  server_->kill();
  server_ = start_server();
  dying->kill();
  EXPECT_TRUE(write(1000));
  EXPECT_TRUE(matched_within(1));
  EXPECT_TRUE(living->wait_for_lines(next_ + 1));
  EXPECT_EQ(living->lines(), all());
}

TEST_F(SilentReader, IsDroppedWhenTheDiscoveryServerCameBackAfterItDied) {
  auto dying = start_reader();
  auto living = start_reader();
  ASSERT_TRUE(writer_->wait_for_readers(2, 10s));
  ASSERT_TRUE(write(10));
  while (!participant_->discovery_complete()) std::this_thread::sleep_for(1ms);
  server_->kill();
  dying->kill();
  // Clients take a server that comes back within their lease for the one they know, and then may
  // never learn of new participants.
  while (participant_->discovery_complete()) std::this_thread::sleep_for(1ms);
  server_ = start_server();
  EXPECT_TRUE(write(1000));
  EXPECT_TRUE(matched_within(1));
  auto next = start_reader();
  EXPECT_TRUE(writer_->wait_for_readers(2, 30s));
  EXPECT_TRUE(living->wait_for_lines(next_ + 1));
  EXPECT_EQ(living->lines(), all());
}

TEST_F(SilentReader, IsDroppedWhenItsProcessIsStopped) {
  auto stopped = start_reader();
  ASSERT_TRUE(writer_->wait_for_readers(1, 10s));
  ASSERT_TRUE(write(10));
  server_->kill();
  stopped->signal(SIGSTOP);
  EXPECT_TRUE(write(1000));
  EXPECT_TRUE(matched_within(0));
}

TEST_F(SilentReader, IsKeptWhileItIsOnlySlow) {
  auto slow = start_reader(10ms);
  ASSERT_TRUE(writer_->wait_for_readers(1, 10s));
  ASSERT_TRUE(write(10));
  server_->kill();
  EXPECT_TRUE(write(1000, 60s));
  EXPECT_EQ(silent_, std::vector<std::string>());
  EXPECT_TRUE(slow->wait_for_lines(next_ + 1));
  EXPECT_EQ(slow->lines(), all());
}

}  // namespace
}  // namespace quoin::runtime
