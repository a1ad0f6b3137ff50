// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/file.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/diagnostics/host_checks.hpp"
#include "deploy/diagnostics/network_checks.hpp"
#include "deploy/diagnostics/shared_memory.hpp"
#include "deploy/kinds/kinds.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::deploy {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

/// A folder that stands for one of the kernel's or for /dev/shm.
class Doctor : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) {
    return temporary_.write(name, text);
  }

  const tests::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

auto is(Verdict verdict, const std::string& text, const std::string& advice) {
  return AllOf(Field(&Check::verdict, verdict), Field(&Check::text, HasSubstr(text)),
               Field(&Check::advice, advice.empty() ? testing::Matcher<std::string>(IsEmpty())
                                                    : HasSubstr(advice)));
}

std::vector<std::string> names_of(const std::vector<StaleFile>& files) {
  std::vector<std::string> names;
  for (const StaleFile& file : files) names.push_back(file.path.filename());
  std::sort(names.begin(), names.end());
  return names;
}

TEST_F(Doctor, FindsSharedMemoryThatNobodyUsesAndRemovesItAlone) {
  write("fastrtps_0123", "segment");
  write("fastrtps_0123_el", "");
  write("sem.fastrtps_port7411_mutex", "semaphore");
  write("fast_datasharing_01.0f", "history");
  write("fastdds_4567_el", "");
  write("sem.fastdds_port7412_mutex", "semaphore");
  const fs::path open_one = write("fastrtps_open_el", "");
  write("fastrtps_open", "of a living process");
  const fs::path locked = write("fastrtps_port7413_sl", "");
  write("somebody_elses", "data");
  const int in_use = ::open(open_one.c_str(), O_RDONLY | O_CLOEXEC);
  const int lock = ::open(locked.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);

  const auto stale = stale_files(folder_, "/proc");
  EXPECT_THAT(
      names_of(stale),
      ElementsAre("fast_datasharing_01.0f", "fastdds_4567_el", "fastrtps_0123", "fastrtps_0123_el",
                  "sem.fastdds_port7412_mutex", "sem.fastrtps_port7411_mutex"));
  EXPECT_THAT(check_shared_memory(stale), is(Verdict::doubtful, "6 files", "--fix removes them"));
  // As seen by somebody who cannot look at other processes.
  EXPECT_THAT(names_of(stale_files(folder_, folder_ / "none")),
              testing::Not(testing::Contains("fastrtps_port7413_sl")));

  EXPECT_EQ(remove(stale), 6U);
  EXPECT_THAT(stale_files(folder_, "/proc"), IsEmpty());
  EXPECT_THAT(check_shared_memory({}), is(Verdict::good, "", ""));
  EXPECT_TRUE(fs::exists(open_one));
  EXPECT_TRUE(fs::exists(folder_ / "fastrtps_open"));
  EXPECT_TRUE(fs::exists(folder_ / "somebody_elses"));
  ::close(in_use);
  ::close(lock);
}

TEST_F(Doctor, TellsWhichSocketBufferIsTooSmall) {
  write("rmem_max", "212992\n");
  write("wmem_max", "4194304\n");
  EXPECT_THAT(check_socket_buffers(folder_, 4194304),
              is(Verdict::doubtful, "net.core.rmem_max is 212992",
                 "sysctl -w net.core.rmem_max=4194304 ("));
  write("rmem_max", "8388608\n");
  EXPECT_THAT(check_socket_buffers(folder_, 4194304), is(Verdict::good, "", ""));
  EXPECT_THAT(check_socket_buffers(folder_ / "none", 4194304), is(Verdict::good, "", ""))
      << "a container may not see them";
}

TEST_F(Doctor, FindsThatLostPacketsBlockOthersForLong) {
  write("ipfrag_time", "30\n");
  EXPECT_THAT(check_reassembly(folder_), is(Verdict::doubtful, "net.ipv4.ipfrag_time is 30",
                                            "sysctl -w net.ipv4.ipfrag_time=3 ("));
  write("ipfrag_time", "3\n");
  EXPECT_THAT(check_reassembly(folder_), is(Verdict::good, "", ""));
  EXPECT_THAT(check_reassembly(folder_ / "none"), is(Verdict::good, "", ""));
}

TEST_F(Doctor, LooksAtInterfacesThatTheDeploymentNames) {
  write("eth0/flags", "0x1003\n");  // up, broadcast, multicast
  write("can0/flags", "0x3\n");
  const std::string head =
      "Iface\tDestination\tGateway\tFlags\tRefCnt\tUse\tMetric\tMask\tMTU\tWindow\tIRTT\n";
  const fs::path lan_only = write("lan", head + "eth0\t0000070A\t0\t0001\t0\t0\t0\t00FFFFFF\t0\n");
  const fs::path routes =
      write("route", head + "eth0\t000000E0\t00000000\t0001\t0\t0\t0\t000000F0\t0\t0\t0\n");
  NetworkConfig network;
  network.interfaces = {"eth0", "can0", "wlan0"};
  network.discovery = Discovery::multicast;
  EXPECT_THAT(
      check_network(network,
                    {{"eth0", "10.7.0.1"}, {"can0", "10.8.0.1"}, {"wlan0", "1.2.3.4", false}},
                    folder_, lan_only),
      ElementsAre(
          is(Verdict::good, "eth0 (10.7.0.1), with multicast", ""),
          is(Verdict::bad, "can0 (10.8.0.1) has no multicast", "ip link set can0 multicast"),
          is(Verdict::bad, "wlan0 (1.2.3.4) is down", "ip link set wlan0 up"),
          is(Verdict::doubtful, "no route to 239.255.0.1", "ip route add 224.0.0.0/4")));
  EXPECT_THAT(check_network(network, {{"eth0", "10.7.0.1"}}, folder_, routes),
              ElementsAre(is(Verdict::good, "eth0", "")));
  network.discovery = Discovery::peers;
  EXPECT_THAT(check_network(network, {{"can0", "10.8.0.1"}}, folder_, lan_only),
              ElementsAre(is(Verdict::good, "can0", "")));
  EXPECT_THAT(check_network(network, {}, folder_, routes),
              ElementsAre(is(Verdict::bad, "none of eth0, can0, wlan0", "ip address")));
}

TEST(DoctorHost, MeasuresTheRoomOnDisks) {
  constexpr std::uint64_t mebibyte = 1U << 20U;
  EXPECT_THAT(check_disk("/logs", 1000 * mebibyte, 20 * mebibyte),
              is(Verdict::bad, "/logs has 20 MiB left, 2 %", "du -xh /logs"));
  EXPECT_THAT(check_disk("/logs", 20000 * mebibyte, 800 * mebibyte),
              is(Verdict::doubtful, "800 MiB", "du"));
  EXPECT_THAT(check_disk("/logs", 1000 * mebibyte, 800 * mebibyte), is(Verdict::good, "80 %", ""));
}

TEST_F(Doctor, MissesPrograms) {
  for (const KindInfo* kind : kinds().kinds) {
    if (kind->program.empty()) continue;
    fs::permissions(write(kind->program, ""), fs::perms::owner_all);
  }
  EXPECT_THAT(check_programs(folder_), is(Verdict::good, "", ""));
  fs::remove(folder_ / "quoin-replay");
  fs::permissions(folder_ / "quoin-rplidar", fs::perms::owner_read);
  if (::geteuid() == 0) fs::remove(folder_ / "quoin-rplidar");  // who may execute what nobody may
  EXPECT_THAT(check_programs(folder_),
              is(Verdict::bad, "quoin-replay, quoin-rplidar missing", "install"));
}

TEST_F(Doctor, FindsServicesThatNobodyWatches) {
  const auto process = [&](int number, const std::string& program, int parent,
                           const std::string& group) {
    const std::string name = "proc/" + std::to_string(number);
    write(name + "/cmdline", program + '\0' + "--service" + '\0' + "walls" + '\0');
    write(name + "/status", "Name:\tx\nPPid:\t" + std::to_string(parent) + "\n");
    write(name + "/cgroup", "0::" + group + "\n");
  };
  process(10, "/opt/bin/quoin-segmentation", 7, "/user.slice/session-1.scope");
  process(11, "/opt/bin/quoin-segmentation", 1, "/system.slice/quoin-walls.service");
  process(12, "/usr/bin/other", 1, "/");
  EXPECT_THAT(check_orphans(folder_ / "proc"), is(Verdict::good, "", ""));
  process(13, "/opt/bin/quoin-segmentation", 1, "/user.slice/session-1.scope");
  EXPECT_THAT(check_orphans(folder_ / "proc"),
              is(Verdict::doubtful, "walls (process 13)", "kill 13"));
}

TEST_F(Doctor, NoticesASupervisorThatWasStopped) {
  Deployment deployment;
  deployment.name_space = "robot1";
  deployment.domain = 3;
  const fs::path sockets =
      write("unix",
            "Num RefCount Protocol Flags Type St Inode Path\n"
            "0000000000000000: 00000002 00000000 00000000 0001 01 77 @quoin/3/robot10\n"
            "0000000000000000: 00000002 00000000 00000000 0001 01 78 @quoin/3/robot1\n");
  write("proc/20/status", "State:\tS (sleeping)\n");
  fs::create_directories(folder_ / "proc/20/fd");
  fs::create_symlink("socket:[78]", folder_ / "proc/20/fd/4");
  EXPECT_THAT(check_supervisor(deployment, sockets, folder_ / "proc"),
              is(Verdict::good, "process 20", ""));
  write("proc/20/status", "State:\tT (stopped)\n");
  EXPECT_THAT(check_supervisor(deployment, sockets, folder_ / "proc"),
              is(Verdict::bad, "process 20", "kill -CONT 20"));
  deployment.domain = 4;
  EXPECT_THAT(check_supervisor(deployment, sockets, folder_ / "proc"),
              is(Verdict::good, "does not run", ""));
}

HeardProcess heard(const std::string& service, const std::string& host, std::uint32_t process,
                   std::size_t count, std::int64_t delay) {
  HeardProcess result;
  result.service = service;
  result.host = host;
  result.process = process;
  result.heard = count;
  result.delay = delay;
  return result;
}

TEST(DoctorNetwork, ComparesClocksByTheLeastDelayedHeartbeat) {
  EXPECT_THAT(
      check_clocks(
          {heard("r/front", "lidar", 1, 2, 180'000'000), heard("r/other", "lidar", 2, 2, 1'000'000),
           heard("r/walls", "compute", 3, 2, -340'500'000),
           heard("r/late", "compute", 4, 0, -900'000'000), heard("r/map", "base", 5, 2, 65'000'000),
           heard("r/here", "own", 6, 2, 99'000'000)},
          "own"),
      ElementsAre(is(Verdict::doubtful, "clock of base is 65.0 ms behind", "chrony"),
                  is(Verdict::doubtful, "clock of compute is 340.5 ms ahead of", "PTP"),
                  is(Verdict::good, "lidar are 1.0 ms", "")));
}

TEST(DoctorNetwork, NoticesTwoDeploymentsOfOneName) {
  EXPECT_THAT(check_doubles({heard("r/walls@2", "a", 1, 2, 0), heard("r/walls@1", "a", 2, 2, 0),
                             heard("r/front", "a", 3, 2, 0), heard("r/front", "a", 4, 0, 0)}),
              ElementsAre(is(Verdict::good, "3 services", "")));
  EXPECT_THAT(
      check_doubles({heard("r/front", "a", 3, 2, 0), heard("r/front", "b", 9, 1, 0)}),
      ElementsAre(is(Verdict::bad, "r/front runs more than once: process 3 on a and process 9 on b",
                     "another namespace or domain")));
  HeardProcess held = heard("r/front", "a", 4, 2, 0);
  held.active = false;
  EXPECT_THAT(check_doubles({heard("r/front", "a", 3, 2, 0), held}),
              ElementsAre(is(Verdict::good, "services are at work, each once", "")));
  EXPECT_THAT(check_doubles({}), IsEmpty());
}

TEST(DoctorNetwork, TellsEachMismatchOnce) {
  HeardProcess writer = heard("r/walls", "a", 1, 1, 0);
  writer.incompatible_qos = {"r/walls/segments: durability: walls offers volatile, map requests x"};
  EXPECT_THAT(check_qos({writer, writer, heard("r/front", "a", 2, 1, 0)}, {}),
              ElementsAre(is(Verdict::bad, "walls offers volatile", "same QoS")));
  EXPECT_THAT(
      check_qos({}, {"r/status: type: walls offers T with the fields 1, doctor requests 2"}),
      ElementsAre(is(Verdict::bad, "walls offers T", "same version of Quoin")));
}

TEST(DoctorNetwork, ComplainsOfLinesThatScatterMoreOrLessThanModelled) {
  const auto fitting = [](const Interval& reduced, std::size_t lines) {
    HeardProcess process = heard("r/lines", "a", 1, 1, 0);
    process.line_scatter = LineScatter{lines, reduced, 0, {}};
    return process;
  };
  EXPECT_THAT(check_line_scatter({fitting({3.61, 3.5, 3.7}, 4000)}),
              ElementsAre(is(Verdict::doubtful, "r/lines: lines scatter 1.9 times as much",
                             "quoin calibrate")));
  EXPECT_THAT(check_line_scatter({fitting({0.25, 0.2, 0.3}, 4000)}),
              ElementsAre(is(Verdict::doubtful, "0.5 times as much", "quoin calibrate")));
  // True, too few lines, not beyond the interval, and no lines at all.
  EXPECT_THAT(check_line_scatter({fitting({1.02, 0.98, 1.06}, 4000), fitting({3.6, 3.5, 3.7}, 50),
                                  fitting({1.5, 1.1, 2.1}, 200), heard("r/front", "a", 2, 1, 0)}),
              IsEmpty());
}

}  // namespace
}  // namespace quoin::deploy
