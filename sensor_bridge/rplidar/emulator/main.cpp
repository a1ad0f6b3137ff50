// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>

#include "sensor_bridge/rplidar/emulator/command_line.hpp"
#include "sensor_bridge/rplidar/emulator/console.hpp"
#include "sensor_bridge/rplidar/emulator/emulator.hpp"

int main(int argc, char** argv) {
  using namespace quoin::sensor_bridge::rplidar;
  CLI::App app{"An RPLIDAR without hardware: talks byte by byte as the real one does"};
  app.footer(
      "On standard input: status, clear, quit, or a fault such as 'unplug 5s'.\n"
      "Exit codes: 0 ok, 1 failure, 2 wrong usage");
  CommandLine line;
  add_options(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  // Taken from a descriptor, so that everything is cleaned up. A client that goes is no reason to
  // end, nor is a terminal that this process is in the background of.
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int signal : {SIGINT, SIGTERM, SIGTTIN, SIGPIPE}) sigaddset(&blocked, signal);
  pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
  try {
    const auto print = [](const std::string& text) {
      std::printf("%s\n", text.c_str());
      std::fflush(stdout);
    };
    Emulator emulator(line.settings, [&](double time, const std::string& what) {
      char stamp[32];
      std::snprintf(stamp, sizeof stamp, "%10.3f s  ", time);
      if (!line.quiet) print(stamp + what);
    });
    print(emulator.status().endpoint);
    const std::jthread thread([&](const std::stop_token& stop) {
      const std::stop_callback on_stop(stop, [&] { emulator.stop(); });
      emulator.run();
    });
    run_console(emulator, print);
    return 0;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "quoin-rplidar-emulator: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "quoin-rplidar-emulator: %s\n", error.what());
    return 1;
  }
}
