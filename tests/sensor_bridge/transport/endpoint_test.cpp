// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/endpoint.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/error_of.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string reason(const std::string& text) {
  return error_of<EndpointError>([&] { (void)parse_endpoint(text); });
}

TEST(Endpoint, IsASerialPortWhenItIsAPath) {
  const Endpoint endpoint = parse_endpoint("/dev/serial/by-id/usb-Silicon_Labs_CP2102-if00-port0");
  EXPECT_EQ(endpoint.kind, Endpoint::Kind::serial);
  EXPECT_EQ(endpoint.path, "/dev/serial/by-id/usb-Silicon_Labs_CP2102-if00-port0");
}

TEST(Endpoint, IsAHostWithItsUsualPortOrAnother) {
  EXPECT_EQ(parse_endpoint("tcp://lidar.local"),
            (Endpoint{Endpoint::Kind::tcp, "", "lidar.local", 20108}));
  EXPECT_EQ(parse_endpoint("tcp://192.168.0.7:4001"),
            (Endpoint{Endpoint::Kind::tcp, "", "192.168.0.7", 4001}));
  EXPECT_EQ(parse_endpoint("udp://192.168.11.2"),
            (Endpoint{Endpoint::Kind::udp, "", "192.168.11.2", 8089}));
  EXPECT_EQ(parse_endpoint("udp://[fe80::1%eth0]:65535"),
            (Endpoint{Endpoint::Kind::udp, "", "fe80::1%eth0", 65535}));
  EXPECT_EQ(parse_endpoint("tcp://[::1]"), (Endpoint{Endpoint::Kind::tcp, "", "::1", 20108}));
}

TEST(Endpoint, IsWrittenAsItIsRead) {
  for (const char* text :
       {"/dev/ttyUSB0", "tcp://lidar:20108", "udp://192.168.11.2:1", "tcp://[::1]:20108"}) {
    EXPECT_EQ(to_text(parse_endpoint(text)), text);
  }
}

TEST(Endpoint, SaysWhatIsWrongAndWhatWouldBeRight) {
  EXPECT_THAT(reason("ttyUSB0"),
              AllOf(StartsWith("endpoint 'ttyUSB0': of no known kind"), HasSubstr("/dev/ttyUSB0")));
  EXPECT_THAT(reason(""), HasSubstr("it is empty"));
  EXPECT_THAT(reason("http://lidar"), HasSubstr("of no known kind"));
  EXPECT_THAT(reason("/dev/tty USB0"), HasSubstr("a space or control character"));
  EXPECT_THAT(reason(std::string("/dev/tty\0", 9)),
              HasSubstr("'/dev/tty\\x00': a space or control"));
  EXPECT_THAT(reason("tcp://"), HasSubstr("no host"));
  EXPECT_THAT(reason("tcp://:20108"), HasSubstr("no host"));
  EXPECT_THAT(reason("tcp://lidar:0"), HasSubstr("port '0' is not within 1..65535"));
  EXPECT_THAT(reason("tcp://lidar:65536"), HasSubstr("port '65536' is not within"));
  EXPECT_THAT(reason("tcp://lidar:"), HasSubstr("port '' is not within"));
  EXPECT_THAT(reason("udp://lidar:80a"), HasSubstr("port '80a' is not within"));
  EXPECT_THAT(reason("udp://user@lidar"), HasSubstr("'user@lidar' is no host name or address"));
  EXPECT_THAT(reason("tcp://::1:20108"), HasSubstr("no host"));
  EXPECT_THAT(reason("tcp://fe80::1"), HasSubstr("stands in brackets"));
  EXPECT_THAT(reason("tcp://[::1"), HasSubstr("']' is missing"));
  EXPECT_THAT(reason("tcp://[::1]20108"), HasSubstr("'20108' after the host"));
}

}  // namespace
}  // namespace quoin::sensor_bridge
