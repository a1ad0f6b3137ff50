// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <condition_variable>
#include <csignal>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <mutex>
#include <thread>
#include <utility>

#include <gmock/gmock.h>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/process/run_node.hpp"
#include "services/segmentation/kind.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/services/runtime/notify_socket.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using tests::NotifySocket;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

std::string socket_name() { return "@quoin_test_" + std::to_string(::getpid()); }

TEST(Notify, ASourceIsReadyWhenItsReadersAreThere) {
  const TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 50}}
  - {name: walls, kind: segmentation, input: front}
)");
  NotifySocket socket(socket_name());
  Process front = deployment.start("front");
  EXPECT_THAT(socket.next("STATUS=starting: waiting"), HasSubstr("waiting for 1 readers"));
  EXPECT_THAT(socket.take(), Not(Contains("READY=1")));
  runtime::Participant participant(deployment.participant("test"));
  runtime::Reader<msg::Scan> reader(participant, deployment.topic("front"),
                                    runtime::QosPreset::sensor);
  EXPECT_EQ(socket.next("READY=1"), "READY=1");
  EXPECT_THAT(socket.next("STATUS="), HasSubstr("active"));
  front.signal(SIGTERM);
  EXPECT_EQ(socket.next("STOPPING=1"), "STOPPING=1");
  EXPECT_THAT(socket.next("STATUS=stopped"), HasSubstr(" published, 0 lost"));
  EXPECT_EQ(front.wait(20s), 0);
}

/// A method that hangs for as long as it is told to.
class Obstacle {
 public:
  void meet() {
    std::unique_lock lock(mutex_);
    met_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return removed_; });
  }
  bool wait_until_met() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 20s, [this] { return met_; });
  }
  void remove() {
    const std::lock_guard lock(mutex_);
    removed_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool met_ = false;
  bool removed_ = false;
};

TEST(Notify, AStageWhoseMethodHangsIsNotReportedAlive) {
  const TestDeployment deployment(R"(
  - {name: front, kind: simulated}
  - {name: walls, kind: segmentation, input: front}
)");
  // The stage blocks the signal in its own threads; it must not end this process either.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  NotifySocket socket(socket_name());
  ::setenv("WATCHDOG_USEC", "200000", 1);
  Obstacle obstacle;
  std::thread stage([&] {
    std::string file = deployment.file().string();
    std::vector<std::string> words{"test", "--deployment", file, "--service", "walls"};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    const int exit_code = runtime::run_process(
        static_cast<int>(arguments.size()), arguments.data(),
        {runtime::stage_component<msg::Scan, msg::Segments>(
            segmentation_kind(), [&](const std::string&, const ParameterSettings&) {
              return [&](const msg::Scan&, msg::Segments&) -> std::size_t {
                obstacle.meet();
                return 0;
              };
            })});
    EXPECT_EQ(exit_code, 0);
  });
  EXPECT_EQ(socket.next("READY=1"), "READY=1");
  EXPECT_EQ(socket.next("WATCHDOG=1"), "WATCHDOG=1");
  EXPECT_EQ(socket.next("WATCHDOG=1"), "WATCHDOG=1") << "waiting for scans is no hanging";

  runtime::Participant participant(deployment.participant("test"));
  runtime::Writer<msg::Scan> scans(participant, deployment.topic("front"),
                                   runtime::QosPreset::sensor);
  StatusRecorder status(participant, deployment);
  ASSERT_TRUE(scans.wait_for_readers(1, 20s));
  msg::Scan scan;
  scan.header().trace().resize(1);
  scan.header().trace()[0].service("front");
  scans.write(scan);
  EXPECT_TRUE(obstacle.wait_until_met());
  // Heartbeats come once a second, and say that the process as such is well.
  auto next_heartbeat = [&, last = std::int64_t{0}]() mutable {
    return status.wait_for("walls", [&](const msg::ServiceStatus& heartbeat) {
      return heartbeat.stamp() > std::exchange(last, heartbeat.stamp()) && heartbeat.received() > 0;
    });
  };
  EXPECT_TRUE(next_heartbeat());
  EXPECT_TRUE(next_heartbeat());
  (void)socket.take();
  EXPECT_TRUE(next_heartbeat());
  EXPECT_THAT(socket.take(), Not(Contains("WATCHDOG=1")));

  obstacle.remove();
  EXPECT_EQ(socket.next("WATCHDOG=1"), "WATCHDOG=1") << "the loop goes on";
  ::kill(::getpid(), SIGTERM);
  stage.join();
  EXPECT_THAT(socket.take(), Contains("STOPPING=1"));
}

}  // namespace
}  // namespace quoin
