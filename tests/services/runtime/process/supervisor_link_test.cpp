// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/supervisor_link.hpp"

#include <filesystem>

#include <gmock/gmock.h>

#include "services/runtime/node/service_record.hpp"
#include "tests/integration/harness/process.hpp"
#include "tests/services/runtime/notify_socket.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::runtime {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using tests::NotifySocket;

TEST(Pulse, IsDueWhenItWasPromised) {
  Pulse pulse;
  const auto now = Pulse::Clock::now();
  EXPECT_TRUE(pulse.alive(now + 1h, 1s)) << "the thread has not begun";
  pulse.beat();
  EXPECT_TRUE(pulse.alive(now, 1s));
  EXPECT_FALSE(pulse.alive(now + 1h, 1s));
  pulse.wait_until(now + 1h);
  EXPECT_TRUE(pulse.alive(now + 1h, 1s));
  EXPECT_FALSE(pulse.alive(now + 1h + 2s, 1s));
  pulse.wait_until(now - 1h);  // no time to wait
  EXPECT_TRUE(pulse.alive(now, 1s));
}

bool is_alive(SupervisorLink::Clock::time_point, SupervisorLink::Clock::duration) { return true; }

void says_everything(NotifySocket& socket) {
  SupervisorLink link(is_alive);
  link.status("starting:\nwaiting\tfor 1 readers");
  link.ready();
  link.ready();
  link.stopping();
  link.stopping();
  EXPECT_THAT(socket.take(),
              ElementsAre("STATUS=starting: waiting for 1 readers", "READY=1", "STOPPING=1"));
}

TEST(SupervisorLink, SpeaksToASocketOfAnyKind) {
  const tests::TemporaryFolder folder;
  NotifySocket socket((folder.path() / "notify").string());
  says_everything(socket);
  NotifySocket abstract("@quoin_notify_" + std::to_string(::getpid()));
  says_everything(abstract);
}

TEST(SupervisorLink, IsSilentWithoutASocket) {
  ::unsetenv("NOTIFY_SOCKET");
  SupervisorLink link(is_alive);
  link.ready();
  link.status("active");
  link.stopping();
}

TEST(SupervisorLink, GivesSignsOfLifeOnceItIsReady) {
  NotifySocket socket("@quoin_watchdog_" + std::to_string(::getpid()));
  ::setenv("WATCHDOG_USEC", "20000", 1);
  Pulse pulse;
  SupervisorLink link([&](auto now, auto allowance) { return pulse.alive(now, allowance); });
  EXPECT_THAT(socket.take(), IsEmpty());
  link.ready();
  EXPECT_EQ(socket.next("READY=1"), "READY=1");
  for (int i = 0; i < 3; ++i) {
    // A beat counts for half a period; on a busy machine the next look may come later.
    EXPECT_TRUE(tests::eventually([&] {
      pulse.beat();
      return testing::Value(socket.take(), testing::Contains("WATCHDOG=1"));
    }));
  }
}

}  // namespace
}  // namespace quoin::runtime
