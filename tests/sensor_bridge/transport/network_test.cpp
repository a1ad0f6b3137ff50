// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/network.hpp"

#include <chrono>
#include <netdb.h>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/error_of.hpp"
#include "tests/sensor_bridge/transport/loopback.hpp"
#include "tests/sensor_bridge/transport/transport_reading.hpp"

namespace quoin::sensor_bridge {
namespace {

using namespace std::chrono_literals;
using quoin::tests::accept_from;
using quoin::tests::bound;
using quoin::tests::error_of;
using quoin::tests::listening;
using quoin::tests::LoopbackSocket;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Kind = TransportError::Kind;

Endpoint tcp(std::uint16_t port) { return {Endpoint::Kind::tcp, "", "127.0.0.1", port}; }
Endpoint udp(std::uint16_t port) { return {Endpoint::Kind::udp, "", "127.0.0.1", port}; }

TEST(TcpConnection, PassesBytesBothWays) {
  const LoopbackSocket listener = listening();
  const auto transport = open_transport(tcp(listener.port()), 0, 10s);
  const LoopbackSocket device = accept_from(listener);
  device.send({1, 2, 3});
  EXPECT_THAT(read_all(*transport, 3), ElementsAre(1, 2, 3));
  transport->write(std::vector<std::uint8_t>{0xA5, 0x50}, in(10s));
  std::uint8_t bytes[2];
  ASSERT_EQ(::recv(device.number(), bytes, 2, MSG_WAITALL), 2);
  EXPECT_THAT(bytes, ElementsAre(0xA5, 0x50));
  transport->hold_motor(true);  // has no such line
  EXPECT_EQ(transport->read(bytes, in(1ms)), 0u);
}

TEST(TcpConnection, FindsTheHostByName) {
  addrinfo* found = nullptr;
  if (::getaddrinfo("localhost", nullptr, nullptr, &found) != 0) {
    GTEST_SKIP() << "this machine has no address for localhost";
  }
  ::freeaddrinfo(found);
  const LoopbackSocket listener = listening();
  const Endpoint endpoint{Endpoint::Kind::tcp, "", "localhost", listener.port()};
  EXPECT_NE(connect_tcp(endpoint, 10s), nullptr);  // though ::1 refuses
}

TEST(TcpConnection, IsClosedWhenTheOtherEndGoes) {
  const LoopbackSocket listener = listening();
  const auto transport = connect_tcp(tcp(listener.port()), 10s);
  accept_from(listener).close();
  std::uint8_t bytes[2]{};
  EXPECT_EQ(kind_of([&] { (void)transport->read(bytes, in(10s)); }), Kind::closed);
  // The first bytes after the end are answered by a reset; no signal may end the program.
  EXPECT_EQ(kind_of([&] {
              for (int i = 0; i < 1000; ++i) transport->write(bytes, in(10s));
            }),
            Kind::closed);
}

TEST(TcpConnection, IsRefusedWhereNobodyListens) {
  const LoopbackSocket socket = bound(SOCK_STREAM);
  const auto connect = [&] { (void)connect_tcp(tcp(socket.port()), 10s); };
  EXPECT_EQ(kind_of(connect), Kind::refused);
  EXPECT_THAT(error_of<TransportError>(connect),
              AllOf(HasSubstr("tcp://127.0.0.1:" + std::to_string(socket.port())),
                    HasSubstr("Connection refused"), HasSubstr("power")));
}

TEST(TcpConnection, GivesUpInTime) {
  LoopbackSocket listener = bound(SOCK_STREAM);
  ASSERT_EQ(::listen(listener.number(), 0), 0);
  // With the queue of a listener that never accepts full, further ones get no answer.
  const auto first = connect_tcp(tcp(listener.port()), 10s);
  EXPECT_EQ(kind_of([&] {
              std::vector<std::unique_ptr<Transport>> more;
              for (int i = 0; i < 8; ++i) more.push_back(connect_tcp(tcp(listener.port()), 20ms));
            }),
            Kind::timed_out);
}

TEST(TcpConnection, TellsThatAHostIsUnknown) {
  // A label may have 63 letters at most, so that no server is asked.
  const Endpoint endpoint{Endpoint::Kind::tcp, "", std::string(64, 'a'), 1};
  EXPECT_EQ(kind_of([&] { (void)connect_tcp(endpoint, 10s); }), Kind::unknown_host);
}

class UdpPair : public ::testing::Test {
 protected:
  UdpPair() : device_(bound(SOCK_DGRAM)), transport_(open_transport(udp(device_.port()), 0, 1s)) {
    transport_->write(std::vector<std::uint8_t>{0xA5, 0x25}, in(10s));
    sockaddr_in address{};
    socklen_t size = sizeof(address);
    std::uint8_t bytes[16];
    EXPECT_EQ(::recvfrom(device_.number(), bytes, sizeof(bytes), 0,
                         reinterpret_cast<sockaddr*>(&address), &size),
              2);
    EXPECT_EQ(::connect(device_.number(), reinterpret_cast<sockaddr*>(&address), size), 0);
  }

  LoopbackSocket device_;
  std::unique_ptr<Transport> transport_;
};

TEST_F(UdpPair, JoinsDatagramsToAStream) {
  device_.send({1, 2, 3});
  device_.send({});
  device_.send({4, 5});
  std::uint8_t two[2];
  ASSERT_EQ(transport_->read(two, in(10s)), 2u);
  EXPECT_THAT(two, ElementsAre(1, 2));
  EXPECT_THAT(read_all(*transport_, 3), ElementsAre(3, 4, 5));
  EXPECT_EQ(transport_->read(two, in(1ms)), 0u);
}

TEST_F(UdpPair, DiscardsWhatIsLeftOfADatagramToo) {
  device_.send({1, 2, 3});
  std::uint8_t one[1];
  ASSERT_EQ(transport_->read(one, in(10s)), 1u);
  device_.send({4});
  transport_->discard_input();
  device_.send({5});
  EXPECT_THAT(read_all(*transport_, 1), ElementsAre(5));
}

TEST_F(UdpPair, IsRefusedWhenTheDeviceGoes) {
  device_.close();
  transport_->write(std::vector<std::uint8_t>{0xA5, 0x50}, in(10s));
  std::uint8_t bytes[16];
  EXPECT_EQ(kind_of([&] { (void)transport_->read(bytes, in(10s)); }), Kind::refused);
}

}  // namespace
}  // namespace quoin::sensor_bridge
