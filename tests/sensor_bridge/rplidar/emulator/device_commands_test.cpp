// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include <gmock/gmock.h>

#include "tests/sensor_bridge/rplidar/emulator/device_on_bench.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using ::testing::IsEmpty;

constexpr std::string_view info_answer =
    "A5 5A 14 00 00 00 04 61 1C 01 12 7E 11 EA F2 C5 E1 9B CF C2 E1 9F F5 89 C3 45 09";

struct Exchange {
  std::string_view what;
  std::string_view request;
  std::string_view answer;
};

// What a real S1 with firmware 1.28 answers.
constexpr Exchange exchanges[] = {
    {"info", "A5 50", info_answer},
    {"health", "A5 52", "A5 5A 03 00 00 00 06 00 00 00"},
    {"sample rate", "A5 59", "A5 5A 04 00 00 00 15 F4 00 6C 00"},
    {"accessory board", "A5 FF 04 00 00 00 00 5E", "A5 5A 04 00 00 00 FF 00 00 00 00"},
    {"stop", "A5 25", ""},
    {"motor speed", "A5 A8 02 58 02 55", ""},
    {"motor idle", "A5 A8 02 00 00 0F", ""},
    {"motor PWM", "A5 F0 02 94 02 C1", ""},
    {"baud rate confirmation", "A5 90 08 5F 5F 00 E8 03 00 00 00 DE", ""},
    {"desired speed", "A5 84 04 01 00 00 00 24", "A5 5A 08 00 00 00 20 01 00 00 00 58 02 00 00"},
    {"smallest speed", "A5 84 04 04 00 00 00 21", "A5 5A 06 00 00 00 20 04 00 00 00 E0 01"},
    {"largest speed", "A5 84 04 05 00 00 00 20", "A5 5A 06 00 00 00 20 05 00 00 00 84 03"},
    {"mode count", "A5 84 04 70 00 00 00 55", "A5 5A 06 00 00 00 20 70 00 00 00 02 00"},
    {"typical mode", "A5 84 04 7C 00 00 00 59", "A5 5A 06 00 00 00 20 7C 00 00 00 01 00"},
    {"sample time of mode 0", "A5 84 06 71 00 00 00 00 00 56",
     "A5 5A 08 00 00 00 20 71 00 00 00 00 F4 00 00"},
    {"sample time of mode 1", "A5 84 06 71 00 00 00 01 00 57",
     "A5 5A 08 00 00 00 20 71 00 00 00 00 6C 00 00"},
    {"range of mode 1", "A5 84 06 74 00 00 00 01 00 52",
     "A5 5A 08 00 00 00 20 74 00 00 00 00 28 00 00"},
    {"format of mode 0", "A5 84 06 75 00 00 00 00 00 52", "A5 5A 05 00 00 00 20 75 00 00 00 81"},
    {"format of mode 1", "A5 84 06 75 00 00 00 01 00 53", "A5 5A 05 00 00 00 20 75 00 00 00 85"},
    {"name of mode 0", "A5 84 06 7F 00 00 00 00 00 58",
     "A5 5A 0D 00 00 00 20 7F 00 00 00 53 74 61 6E 64 61 72 64 00"},
    {"name of mode 1", "A5 84 06 7F 00 00 00 01 00 59",
     "A5 5A 0F 00 00 00 20 7F 00 00 00 44 65 6E 73 65 42 6F 6F 73 74 00"},
    {"address", "A5 84 04 79 00 00 00 5C", "A5 5A 04 00 00 00 20 79 00 00 00"},
    {"model name", "A5 84 04 81 00 00 00 A4", "A5 5A 09 00 00 00 20 81 00 00 00 53 31 4D 31 00"},
    {"angle range", "A5 84 04 00 00 00 00 25", "A5 5A 04 00 00 00 20 00 00 00 00"},
    {"scan commands", "A5 84 04 02 00 00 00 27", "A5 5A 04 00 00 00 20 02 00 00 00"},
    {"largest distance", "A5 84 04 60 00 00 00 45", "A5 5A 08 00 00 00 20 60 00 00 00 00 28 00 00"},
    {"model revision", "A5 84 04 80 00 00 00 A5", "A5 5A 04 00 00 00 20 80 00 00 00"},
    {"detected baud rate", "A5 84 04 A1 00 00 00 84",
     "A5 5A 08 00 00 00 20 A1 00 00 00 00 E8 03 00"},
    {"unknown entry", "A5 84 04 33 00 00 00 16", ""},
    {"entry of a mode that is not there", "A5 84 06 71 00 00 00 02 00 54", ""},
    {"setting what cannot be set", "A5 85 08 00 00 01 00 01 00 00 00 28",
     "A5 5A 08 00 00 00 21 00 00 01 00 04 80 00 80"},
    {"a wrong checksum", "A5 84 04 70 00 00 00 54", ""},
    {"HQ scan", "A5 83 00 26", ""},
    {"a scan mode that is not there", "A5 82 05 02 00 00 00 00 20", ""},
};

TEST(DeviceCommands, AreAnsweredAsByAnS1) {
  for (const Exchange& exchange : exchanges) {
    DeviceOnBench bench;
    EXPECT_EQ(bench.ask(exchange.request), hex(exchange.answer)) << exchange.what;
    EXPECT_EQ(bench.device().state(), DeviceState::idle) << exchange.what;
    // It answers the next one as well.
    EXPECT_EQ(bench.ask("A5 50"), hex(info_answer)) << exchange.what;
  }
}

TEST(DeviceCommands, MayArriveInAnyPieces) {
  DeviceOnBench bench;
  Bytes all;
  Bytes answers;
  for (const Exchange& exchange : exchanges) {
    all = all + hex(exchange.request);
    answers = answers + hex(exchange.answer);
  }
  Bytes received;
  for (const std::uint8_t byte : all) {
    received = received + bench.ask(std::span(&byte, 1), 0.01);
  }
  EXPECT_EQ(received, answers);
}

TEST(DeviceCommands, KeepTheNetworkAddressThatIsSet) {
  DeviceOnBench bench;
  EXPECT_EQ(bench.ask(Request(Command::set_configuration,
                              hex("C0 CC 01 00 C0 A8 00 07 FF FF FF 00 C0 A8 00 01"))
                          .bytes()),
            hex("A5 5A 08 00 00 00 21 C0 CC 01 00 00 00 00 00"));
  EXPECT_EQ(bench.ask(Request(Command::get_configuration, hex("C0 CC 01 00 00 00")).bytes()),
            hex("A5 5A 10 00 00 00 20 C0 CC 01 00 C0 A8 00 07 FF FF FF 00 C0 A8 00 01"));
  EXPECT_EQ(bench.ask(Request(Command::set_configuration, hex("C0 CC 01 00 C0 A8 00 07")).bytes()),
            hex("A5 5A 08 00 00 00 21 C0 CC 01 00 00 80 00 80"));
}

TEST(DeviceCommands, TakeTheSerialNumberOfTheSettings) {
  EmulatorSettings settings;
  settings.serial_number = "000102030405060708090a0B0C0D0E0F";
  DeviceOnBench bench(settings);
  EXPECT_EQ(
      bench.ask("A5 50"),
      hex("A5 5A 14 00 00 00 04 61 1C 01 12 00 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F"));
}

TEST(DeviceCommands, OfferFurtherScanModesWhenTold) {
  EmulatorSettings settings;
  settings.all_formats = true;
  DeviceOnBench bench(settings);
  EXPECT_EQ(bench.ask("A5 84 04 70 00 00 00 55"), hex("A5 5A 06 00 00 00 20 70 00 00 00 06 00"));
  std::vector<std::string> names;
  std::vector<unsigned> formats;
  for (std::uint16_t mode = 2; mode < 6; ++mode) {
    const Bytes name = bench.ask(configuration_request(ConfigurationKey::mode_name, mode).bytes());
    names.push_back(parse_text(std::span(name).subspan(11)));
    formats.push_back(
        bench.ask(configuration_request(ConfigurationKey::mode_format, mode).bytes()).back());
  }
  EXPECT_THAT(names, ::testing::ElementsAre("Express", "HQ", "Boost", "UltraDense"));
  EXPECT_THAT(formats, ::testing::ElementsAre(0x82, 0x83, 0x84, 0x86));
}

TEST(DeviceCommands, RefuseSettingsThatCannotBe) {
  const auto made_with = [](auto change) {
    EmulatorSettings settings;
    change(settings);
    return EmulatedDevice(settings, small_room(), DeviceOnBench::start);
  };
  EXPECT_THROW(made_with([](auto& settings) { settings.serial_number = "12"; }),
               std::invalid_argument);
  EXPECT_THROW(made_with([](auto& settings) { settings.frequency = 0.9; }), std::invalid_argument);
  EXPECT_THROW(made_with([](auto& settings) { settings.baud_rate = -1; }), std::invalid_argument);
  EXPECT_THROW(made_with([](auto& settings) { settings.reset_time = -1.0; }),
               std::invalid_argument);
  EXPECT_THROW(made_with([](auto& settings) { settings.clock_error = 0.1; }),
               std::invalid_argument);
  EXPECT_THROW(made_with([](auto& settings) { settings.faults = "silense"; }), FaultError);
}

// Lines of the vendor's software, in its order, with what it expects.
TEST(DeviceCommands, SuitTheVendorsSoftware) {
  DeviceOnBench bench;
  EXPECT_EQ(bench.ask("A5 50"), hex(info_answer));  // connect
  EXPECT_EQ(bench.ask("A5 50", 0.01), hex(info_answer));
  EXPECT_EQ(bench.ask("A5 52", 0.01).size(), 10U);
  EXPECT_EQ(bench.ask("A5 84 04 01 00 00 00 24", 0.01).size(), 15U);
  EXPECT_THAT(bench.ask("A5 A8 02 58 02 55", 0.01), IsEmpty());
  EXPECT_THAT(bench.ask("A5 25"), IsEmpty());
  EXPECT_EQ(bench.ask("A5 50", 0.01), hex(info_answer));
  EXPECT_EQ(bench.ask("A5 84 04 7C 00 00 00 59", 0.01).size(), 13U);
  EXPECT_THAT(bench.ask("A5 25"), IsEmpty());
  EXPECT_EQ(bench.ask("A5 84 06 71 00 00 00 01 00 57", 0.01).size(), 15U);
  EXPECT_EQ(bench.ask("A5 84 06 74 00 00 00 01 00 52", 0.01).size(), 15U);
  EXPECT_EQ(bench.ask("A5 84 06 75 00 00 00 01 00 53", 0.01).size(), 12U);
  EXPECT_EQ(bench.ask("A5 84 06 7F 00 00 00 01 00 59", 0.01).size(), 22U);
  EXPECT_EQ(bench.ask("A5 84 04 79 00 00 00 5C", 0.01).size(), 11U);
  EXPECT_THAT(bench.ask("A5 A8 02 58 02 55", 0.01), IsEmpty());
  EXPECT_EQ(bench.ask(dense_scan_request, 0.01), hex("A5 5A 54 00 00 40 85"));
  EXPECT_GT(bench.wait(2.0).size(), 18000U);
  EXPECT_EQ(bench.device().state(), DeviceState::scanning);
  (void)bench.ask("A5 25", 0.3);  // ends with what was on the line
  EXPECT_THAT(bench.ask("A5 A8 02 00 00 0F"), IsEmpty());
  EXPECT_EQ(bench.device().state(), DeviceState::idle);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
