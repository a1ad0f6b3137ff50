// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/request.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

Bytes bytes_of(const Request& request) { return to_bytes(request.bytes()); }

// The checksum is the exclusive or of all bytes before it, worked out by hand: A5 ^ 84 = 21,
// 21 ^ 04 = 25, 25 ^ 70 = 55.
TEST(Request, HasTheBytesThatDevicesExpect) {
  EXPECT_EQ(bytes_of(Request(Command::stop)), hex("A5 25"));
  EXPECT_EQ(bytes_of(Request(Command::reset)), hex("A5 40"));
  EXPECT_EQ(bytes_of(Request(Command::scan)), hex("A5 20"));
  EXPECT_EQ(bytes_of(Request(Command::force_scan)), hex("A5 21"));
  EXPECT_EQ(bytes_of(Request(Command::info)), hex("A5 50"));
  EXPECT_EQ(bytes_of(Request(Command::health)), hex("A5 52"));
  EXPECT_EQ(bytes_of(Request(Command::sample_rate)), hex("A5 59"));
  EXPECT_EQ(bytes_of(express_scan_request(0)), hex("A5 82 05 00 00 00 00 00 22"));
  EXPECT_EQ(bytes_of(express_scan_request(1)), hex("A5 82 05 01 00 00 00 00 23"));
  EXPECT_EQ(bytes_of(express_scan_request(1, 0x0201)), hex("A5 82 05 01 01 02 00 00 20"));
  EXPECT_EQ(bytes_of(motor_speed_request(600)), hex("A5 A8 02 58 02 55"));
  EXPECT_EQ(bytes_of(motor_speed_request(0)), hex("A5 A8 02 00 00 0F"));
  EXPECT_EQ(bytes_of(configuration_request(ConfigurationKey::mode_count)),
            hex("A5 84 04 70 00 00 00 55"));
  EXPECT_EQ(bytes_of(configuration_request(ConfigurationKey::typical_mode)),
            hex("A5 84 04 7C 00 00 00 59"));
  EXPECT_EQ(bytes_of(configuration_request(ConfigurationKey::mode_sample_time, 1)),
            hex("A5 84 06 71 00 00 00 01 00 57"));
  EXPECT_EQ(bytes_of(Request(Command::accessory_board, hex("00 00 00 00"))),
            hex("A5 FF 04 00 00 00 00 5E"));
}

TEST(Request, KnowsItsPayload) {
  EXPECT_EQ(to_bytes(motor_speed_request(600).payload()), hex("58 02"));
  EXPECT_TRUE(Request(Command::stop).payload().empty());
  const Bytes largest(Request::largest_payload, 0x11);
  EXPECT_EQ(to_bytes(Request(Command::set_configuration, largest).payload()), largest);
}

TEST(Request, RefusesPayloadsThatDoNotFit) {
  EXPECT_THROW(Request(Command::stop, hex("00")), std::invalid_argument);
  EXPECT_THROW(Request(Command::set_configuration, Bytes(256)), std::invalid_argument);
}

/// Every request in the bytes, given in pieces of this size.
std::vector<Bytes> scan(RequestScanner& scanner, const Bytes& bytes, std::size_t piece) {
  std::vector<Bytes> found;
  for (std::size_t i = 0; i < bytes.size(); i += piece) {
    std::span<const std::uint8_t> part =
        std::span(bytes).subspan(i, std::min(piece, bytes.size() - i));
    while (const auto request = scanner.next(part)) found.push_back(bytes_of(*request));
    EXPECT_TRUE(part.empty());
  }
  return found;
}

TEST(RequestScanner, FindsRequestsInPieces) {
  const Bytes stream = hex("A5 25 A5 A8 02 58 02 55 A5 50 A5 82 05 01 00 00 00 00 23");
  const std::vector<Bytes> expected = {hex("A5 25"), hex("A5 A8 02 58 02 55"), hex("A5 50"),
                                       hex("A5 82 05 01 00 00 00 00 23")};
  for (const std::size_t piece : {1, 2, 3, 7, 100}) {
    RequestScanner scanner;
    EXPECT_EQ(scan(scanner, stream, piece), expected) << "pieces of " << piece;
    EXPECT_EQ(scanner.checksum_errors(), 0u);
  }
}

TEST(RequestScanner, PassesOverWhatIsNoRequest) {
  RequestScanner scanner;
  // The client's probes for the baud rate, a lone sync byte, an unknown command.
  EXPECT_EQ(scan(scanner, hex("41 41 00 A5 A5 25 A5 77 A5 50"), 100),
            (std::vector<Bytes>{hex("A5 25"), hex("A5 50")}));
  EXPECT_EQ(scanner.checksum_errors(), 0u);
}

TEST(RequestScanner, FindsRequestsInsideADamagedOne) {
  RequestScanner scanner;
  // The length 02 became 06, so that the damaged request reaches over three good ones.
  EXPECT_EQ(scan(scanner, hex("A5 A8 06 58 02 55 A5 25 A5 50 A5 52"), 1),
            (std::vector<Bytes>{hex("A5 25"), hex("A5 50"), hex("A5 52")}));
  EXPECT_EQ(scanner.checksum_errors(), 1u);
}

TEST(RequestScanner, RefusesAWrongChecksum) {
  RequestScanner scanner;
  EXPECT_TRUE(scan(scanner, hex("A5 A8 02 58 02 54"), 100).empty());
  EXPECT_EQ(scanner.checksum_errors(), 1u);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
