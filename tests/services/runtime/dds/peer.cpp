// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// A process of its own for tests that kill one:
//   dds_peer server DOMAIN PORT LEASE
//   dds_peer reader DOMAIN PORT LEASE TOPIC PAUSE
// LEASE in seconds, PAUSE after each message in milliseconds. It prints "ready", and of each
// message the sequence number, a line each.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <idl/Scan.h>
#include <string>
#include <sys/prctl.h>
#include <thread>
#include <vector>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/header.hpp"

int main(int argc, char** argv) {
  using namespace quoin;
  using namespace std::chrono_literals;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool server = arguments.at(0) == "server";
  runtime::ParticipantConfig config{std::stoi(arguments.at(1)), arguments.at(0)};
  config.network.discovery = Discovery::server;
  config.network.servers = {{"127.0.0.1", static_cast<std::uint16_t>(std::stoi(arguments.at(2)))}};
  config.network.lease = std::stod(arguments.at(3));
  if (server) config.server = 0;
  runtime::Participant participant(config);
  if (server) {
    std::puts("ready");
    std::fflush(stdout);
    while (true) std::this_thread::sleep_for(1h);
  }
  runtime::Reader<msg::Scan> reader(participant, arguments.at(4), runtime::QosPreset::lossless);
  const std::chrono::milliseconds pause(std::stoi(arguments.at(5)));
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  std::puts("ready");
  std::fflush(stdout);
  msg::Scan scan;
  while (true) {
    wait_set.wait(1s);
    while (reader.take(scan)) {
      std::printf("%llu\n",
                  static_cast<unsigned long long>(topics::sequence_number(scan.header())));
      std::fflush(stdout);
      if (pause > 0ms) std::this_thread::sleep_for(pause);
    }
  }
}
