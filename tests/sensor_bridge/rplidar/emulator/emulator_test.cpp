// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/emulator.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <thread>

#include <gmock/gmock.h>

#include "sensor_bridge/rplidar/emulator/console.hpp"
#include "sensor_bridge/rplidar/emulator/udp_server.hpp"
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/sensor_bridge/rplidar/emulator/plain_client.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using ::testing::HasSubstr;

constexpr std::string_view info_request = "A5 50";
constexpr std::string_view dense_scan_request = "A5 82 05 01 00 00 00 00 23";
constexpr std::string_view info_answer =
    "A5 5A 14 00 00 00 04 61 1C 01 12 7E 11 EA F2 C5 E1 9B CF C2 E1 9F F5 89 C3 45 09";
constexpr std::size_t info_size = 27;

EmulatorSettings quick(const std::string& connection = "pty") {
  EmulatorSettings settings;
  settings.connection = connection;
  settings.spin_up_time = 0.0;
  settings.reset_time = 0.0;
  return settings;
}

/// An emulator that serves in a thread of its own.
class Served {
 public:
  explicit Served(const EmulatorSettings& settings)
      : emulator(settings,
                 [this](double /*time*/, const std::string& what) {
                   const std::lock_guard lock(mutex_);
                   events_.push_back(what);
                 }),
        thread_([this] { emulator.run(); }) {}
  ~Served() { emulator.stop(); }

  [[nodiscard]] std::string endpoint() const { return emulator.status().endpoint; }

  /// Waits for the condition; false when it does not come true.
  bool wait_for(const std::function<bool(const EmulatorStatus&)>& condition) const {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition(emulator.status())) {
      if (std::chrono::steady_clock::now() > limit) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

  bool wait_for_event(const std::string& what) const {
    return wait_for([&](const EmulatorStatus&) {
      const std::lock_guard lock(mutex_);
      return std::find(events_.begin(), events_.end(), what) != events_.end();
    });
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> events_;

 public:
  Emulator emulator;

 private:
  std::jthread thread_;
};

void expect_a_good_stream(PlainClient& client) {
  client.send(info_request);  // behind what is left of the last scan
  EXPECT_TRUE(ends_with(client.receive_until(hex(info_answer)), hex(info_answer)));
  Bytes bytes = client.ask(dense_scan_request, 7 + 84 * 50);
  ASSERT_GE(bytes.size(), 7U + 84U * 50U);
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 7), hex("A5 5A 54 00 00 40 85"));
  SampleDecoder decoder(SampleFormat::dense);
  SampleBlock block;
  std::span<const std::uint8_t> stream(bytes);
  stream = stream.subspan(7);
  while (decoder.next(stream, block)) {
  }
  EXPECT_GE(decoder.counts().frames, 50U);
  EXPECT_EQ(decoder.counts().checksum_errors, 0U);
  EXPECT_EQ(decoder.counts().skipped_bytes, 0U);
}

TEST(Emulator, ServesAPseudoTerminal) {
  Served served(quick());
  PlainClient client(served.endpoint());
  ASSERT_TRUE(client.connected());
  expect_a_good_stream(client);
  const EmulatorStatus status = served.emulator.status();
  EXPECT_EQ(status.state, DeviceState::scanning);
  EXPECT_EQ(status.motor_speed, 10.0);
  EXPECT_EQ(status.client_baud_rate, 256000U);
  EXPECT_EQ(status.counts.requests, 2U);
  EXPECT_GE(status.sent_bytes, 84U * 50U);
  EXPECT_THAT(status_text(status), HasSubstr("scanning, 10.00 rev/s, client at 256000 bit/s"));
}

TEST(Emulator, ServesTcp) {
  Served served(quick("tcp"));
  EXPECT_THAT(served.endpoint(), ::testing::MatchesRegex("tcp://127.0.0.1:[1-9][0-9]*"));
  for (int connection = 0; connection < 3; ++connection) {  // one after the other
    PlainClient client(served.endpoint());
    ASSERT_TRUE(client.connected());
    client.send("A5 25");
    expect_a_good_stream(client);
    client.send("A5 25");
    EXPECT_TRUE(served.wait_for(
        [](const EmulatorStatus& status) { return status.state == DeviceState::idle; }));
  }
}

TEST(Emulator, ServesUdp) {
  Served served(quick("udp"));
  EXPECT_THAT(served.endpoint(), ::testing::MatchesRegex("udp://127.0.0.1:[1-9][0-9]*"));
  PlainClient client(served.endpoint());
  expect_a_good_stream(client);
  const PlainClient stray(served.endpoint());
  stray.send("52 54 50 53");
  // A few capsules make a datagram; what was sent meanwhile waits in the socket.
  std::size_t bytes = 0;
  for (int i = 0; i < 50; ++i) {
    const Bytes datagram = client.read();
    ASSERT_FALSE(datagram.empty());
    EXPECT_LE(datagram.size(), UdpServer::largest_datagram);
    bytes += datagram.size();
  }
  EXPECT_GT(bytes, 84U * 75U);
  client.send("A5 25");
  EXPECT_TRUE(served.wait_for(
      [](const EmulatorStatus& status) { return status.state == DeviceState::idle; }));
  // Whoever asks last is answered.
  PlainClient other(served.endpoint());
  other.send(info_request);
  EXPECT_TRUE(ends_with(other.receive_until(hex(info_answer)), hex(info_answer)));
}

TEST(Emulator, GivesAndUnderstandsGarbageAtAnotherBaudRate) {
  Served served(quick());
  PlainClient client(served.endpoint(), 115200);
  client.send(info_request);
  client.send(dense_scan_request);
  // Not before it was read does the rate change again.
  EXPECT_TRUE(served.wait_for([](const EmulatorStatus& status) {
    return status.client_baud_rate == 115200 && status.misread_bytes == 11;
  }));
  EXPECT_EQ(served.emulator.status().counts.requests, 0U);
  client.set_baud_rate(256000);
  EXPECT_EQ(client.ask(info_request, info_size), hex(info_answer));
  (void)client.ask(dense_scan_request, 7 + 840);
  client.set_baud_rate(115200);
  (void)client.receive(8400);  // what was on the way
  const Bytes garbage = client.receive(84 * 50);
  SampleDecoder decoder(SampleFormat::dense);
  SampleBlock block;
  std::span<const std::uint8_t> stream(garbage);
  while (decoder.next(stream, block)) {
  }
  EXPECT_EQ(decoder.counts().samples, 0U);
  EXPECT_GT(decoder.counts().skipped_bytes, 84U * 40U);
}

TEST(Emulator, LosesWhatNobodyReads) {
  Served served(quick());
  PlainClient client(served.endpoint());
  (void)client.ask(dense_scan_request, 7);
  EXPECT_TRUE(
      served.wait_for([](const EmulatorStatus& status) { return status.lost_bytes > 1000; }));
  client.send("A5 25");  // is heard all the same
  EXPECT_TRUE(served.wait_for(
      [](const EmulatorStatus& status) { return status.state == DeviceState::idle; }));
}

TEST(Emulator, SurvivesAClientThatDiesInMidScan) {
  Served served(quick());
  for (int life = 0; life < 3; ++life) {
    PlainClient client(served.endpoint());
    client.send("A5 25");
    EXPECT_TRUE(served.wait_for(
        [](const EmulatorStatus& status) { return status.state == DeviceState::idle; }));
    expect_a_good_stream(client);
  }
}

TEST(Emulator, GivesANewClientNothingOld) {
  Served served(quick());
  {
    const PlainClient client(served.endpoint());
    client.send(info_request);
    EXPECT_TRUE(served.wait_for(
        [](const EmulatorStatus& status) { return status.sent_bytes == info_size; }));
  }
  EXPECT_TRUE(served.wait_for_event("no client has the port open any more"));
  PlainClient client(served.endpoint());
  EXPECT_EQ(client.ask("A5 52", 10), hex("A5 5A 03 00 00 00 06 00 00 00"));
}

TEST(Emulator, MakesALinkThatFollowsThePlug) {
  const TemporaryFolder folder;
  EmulatorSettings settings = quick();
  settings.link = folder.path() / "lidar";
  const auto is_link = [&] { return std::filesystem::is_symlink(settings.link); };
  {
    Served served(settings);
    EXPECT_EQ(served.endpoint(), settings.link);
    PlainClient client(settings.link);
    ASSERT_TRUE(client.connected());
    EXPECT_EQ(client.ask(info_request, info_size), hex(info_answer));

    served.emulator.apply(parse_typed_fault("unplug"));
    EXPECT_TRUE(client.read().empty());
    EXPECT_TRUE(client.ended());
    EXPECT_FALSE(is_link());
    EXPECT_FALSE(PlainClient(settings.link).connected());

    served.emulator.clear_faults();
    EXPECT_TRUE(served.wait_for([&](const EmulatorStatus& status) {
      return is_link() && status.state == DeviceState::idle;
    }));
    PlainClient again(settings.link);
    ASSERT_TRUE(again.connected());
    EXPECT_EQ(again.ask(info_request, info_size), hex(info_answer));
  }
  EXPECT_FALSE(is_link());
}

TEST(Emulator, ReplacesALinkThatIsLeftOverAndNothingElse) {
  const TemporaryFolder folder;
  EmulatorSettings settings = quick();
  settings.link = folder.path() / "lidar";
  std::filesystem::create_symlink("/dev/pts/999999", settings.link);
  {
    Served served(settings);
    EXPECT_TRUE(PlainClient(settings.link).connected());
  }
  folder.write("lidar", "precious");
  EXPECT_THAT(error_of<std::runtime_error>([&] { const Emulator emulator(settings); }),
              HasSubstr("is there already and is not one to a pseudo-terminal"));
  EXPECT_TRUE(std::filesystem::is_regular_file(settings.link));
}

TEST(Emulator, UnplugsTcp) {
  Served served(quick("tcp"));
  PlainClient client(served.endpoint());
  EXPECT_EQ(client.ask(info_request, info_size), hex(info_answer));
  served.emulator.apply(parse_typed_fault("unplug"));
  EXPECT_TRUE(client.read().empty());
  EXPECT_TRUE(client.ended());
  EXPECT_FALSE(PlainClient(served.endpoint()).connected());
  served.emulator.clear_faults();
  EXPECT_TRUE(served.wait_for(
      [&](const EmulatorStatus&) { return PlainClient(served.endpoint()).connected(); }));
  PlainClient again(served.endpoint());  // at the same port
  EXPECT_EQ(again.ask(info_request, info_size), hex(info_answer));
}

TEST(Emulator, TakesItsFaultsFromTheSettings) {
  EmulatorSettings settings = quick("tcp");
  settings.faults = "health_error";
  Served served(settings);
  PlainClient client(served.endpoint());
  EXPECT_EQ(client.ask("A5 52", 10), hex("A5 5A 03 00 00 00 06 02 01 00"));
}

TEST(Emulator, RefusesSettingsThatCannotBe) {
  const auto error_with = [](auto change) {
    EmulatorSettings settings = quick("tcp");
    change(settings);
    return error_of<std::exception>([&] { const Emulator emulator(settings); });
  };
  EXPECT_THAT(error_with([](auto& settings) { settings.environment = "domestic_rom"; }),
              HasSubstr("did you mean 'domestic_room'?"));
  EXPECT_THAT(error_with([](auto& settings) { settings.connection = "usb"; }),
              HasSubstr("unknown connection 'usb'"));
  EXPECT_THAT(error_with([](auto& settings) { settings.address = "here"; }),
              HasSubstr("address 'here' is none"));
  EXPECT_THAT(error_with([](auto& settings) { settings.port = 65536; }),
              HasSubstr("port 65536 is not between"));
  Served other(quick("tcp"));
  const std::string endpoint = other.endpoint();
  EXPECT_THAT(error_with([&](auto& settings) {
                settings.port = std::stoll(endpoint.substr(endpoint.rfind(':') + 1));
              }),
              HasSubstr("Address already in use"));
}

TEST(Emulator, CarriesOutWhatIsTyped) {
  Served served(quick());
  bool quit = false;
  EXPECT_EQ(carry_out(served.emulator, "  ", quit), "");
  EXPECT_THAT(carry_out(served.emulator, "status", quit), HasSubstr(": idle, 0.00 rev/s"));
  EXPECT_EQ(carry_out(served.emulator, " unplug 10s\r", quit), "");
  EXPECT_THAT(carry_out(served.emulator, "status", quit), HasSubstr("unplugged"));
  EXPECT_EQ(carry_out(served.emulator, "clear", quit), "");
  EXPECT_TRUE(served.wait_for(
      [](const EmulatorStatus& status) { return status.state == DeviceState::idle; }));
  EXPECT_THAT(carry_out(served.emulator, "unplugg", quit), HasSubstr("did you mean 'unplug'?"));
  EXPECT_THAT(carry_out(served.emulator, "help", quit), HasSubstr("wrong_checksums"));
  EXPECT_FALSE(quit);
  EXPECT_EQ(carry_out(served.emulator, "quit", quit), "");
  EXPECT_TRUE(quit);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
