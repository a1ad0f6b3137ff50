// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/serial_port.hpp"

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/transport/port_holders.hpp"
#include "sensor_bridge/transport/serial_line.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/sensor_bridge/transport/pseudo_terminal.hpp"
#include "tests/sensor_bridge/transport/transport_reading.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using namespace std::chrono_literals;
using quoin::tests::error_of;
using quoin::tests::PseudoTerminal;
using quoin::tests::TemporaryFolder;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using Kind = TransportError::Kind;

std::vector<std::uint8_t> every_byte() {
  std::vector<std::uint8_t> bytes(256);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
  return bytes;
}

TEST(SerialPort, RunsAtAnyBaudRate) {
  const PseudoTerminal terminal;
  for (const unsigned baud_rate : {115200u, 256000u, 460800u, 1000000u, 123457u}) {
    const auto port = open_serial(terminal.path(), baud_rate);
    EXPECT_EQ(baud_rate_of(terminal.master()), baud_rate);
  }
}

TEST(SerialPort, PassesEveryByteAsItIsBothWays) {
  const PseudoTerminal terminal;
  const auto port = open_serial(terminal.path(), 256000);
  terminal.send(every_byte());
  EXPECT_EQ(read_all(*port, 256), every_byte());
  port->write(every_byte(), in(10s));
  EXPECT_EQ(terminal.receive(256), every_byte());
}

TEST(SerialPort, ReturnsNothingAtTheDeadline) {
  const PseudoTerminal terminal;
  const auto port = open_serial(terminal.path(), 256000);
  std::uint8_t bytes[16];
  EXPECT_EQ(port->read(bytes, in(1ms)), 0u);
  EXPECT_EQ(port->read(bytes, in(-1s)), 0u);
}

TEST(SerialPort, ForgetsWhatArrivedBeforeItWasOpened) {
  const PseudoTerminal terminal;
  // A descriptor keeps what was sent; without one the terminal forgets it by itself.
  const int keeper = ::open(terminal.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_EQ(set_raw_mode(keeper, 256000), 0);
  terminal.send({1, 2, 3});
  const auto port = open_serial(terminal.path(), 256000);
  terminal.send({4});
  EXPECT_THAT(read_all(*port, 1), ElementsAre(4));
  ::close(keeper);
}

TEST(SerialPort, DiscardsInput) {
  const PseudoTerminal terminal;
  const auto port = open_serial(terminal.path(), 256000);
  terminal.send(every_byte());
  port->discard_input();
  terminal.send({7});
  EXPECT_THAT(read_all(*port, 1), ElementsAre(7));
}

TEST(SerialPort, IsForOneUserAtATime) {
  const PseudoTerminal terminal;
  auto port = open_serial(terminal.path(), 256000);
  EXPECT_EQ(kind_of([&] { (void)open_serial(terminal.path(), 256000); }), Kind::busy);
  port.reset();
  EXPECT_NE(open_serial(terminal.path(), 256000), nullptr);
}

TEST(SerialPort, NamesTheProgramThatUsesIt) {
  const PseudoTerminal terminal;
  int ready[2];
  int done[2];
  ASSERT_EQ(::pipe(ready), 0);
  ASSERT_EQ(::pipe(done), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(done[1]);
    const auto port = open_serial(terminal.path(), 256000);
    char byte = 0;
    (void)!::write(ready[1], &byte, 1);
    (void)!::read(done[0], &byte, 1);  // until the parent closes its end
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  const std::string process = "process " + std::to_string(child);
  EXPECT_THAT(error_of<TransportError>([&] { (void)open_serial(terminal.path(), 256000); }),
              AllOf(HasSubstr(terminal.path() + ": in use by " + process), HasSubstr("end the")));
  EXPECT_THAT(holders_of(terminal.path()), Contains(Field(&PortHolder::process, child)));
  for (const int end : {ready[0], ready[1], done[0], done[1]}) ::close(end);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
}

TEST(SerialPort, TellsThatItIsNotThere) {
  const auto open = [] { (void)open_serial("/dev/ttyUSB_none", 256000); };
  EXPECT_EQ(kind_of(open), Kind::no_such_port);
  EXPECT_THAT(error_of<TransportError>(open),
              AllOf(HasSubstr("/dev/ttyUSB_none: cannot open: No such file"), HasSubstr("cable")));
}

TEST(SerialPort, TellsThatItIsNone) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "text");
  EXPECT_EQ(kind_of([&] { (void)open_serial(file, 256000); }), Kind::not_a_serial_port);
  EXPECT_EQ(kind_of([&] { (void)open_serial("/dev/null", 256000); }), Kind::not_a_serial_port);
  EXPECT_EQ(kind_of([&] { (void)open_serial(folder.path(), 256000); }), Kind::not_a_serial_port);
}

/// A user without rights while it lives, when the test is run by the superuser.
class WithoutRights {
 public:
  WithoutRights() {
    if (::geteuid() == 0) {
      EXPECT_EQ(::seteuid(65534), 0);
    }
  }
  ~WithoutRights() {
    if (::getuid() == 0) {
      EXPECT_EQ(::seteuid(0), 0);
    }
  }
};

TEST(SerialPort, TellsTheWayOutWhenItMayNotBeOpened) {
  const PseudoTerminal terminal;
  ASSERT_EQ(::chmod(terminal.path().c_str(), 0), 0);
  const WithoutRights user;
  const auto open = [&] { (void)open_serial(terminal.path(), 256000); };
  EXPECT_EQ(kind_of(open), Kind::no_permission);
  EXPECT_THAT(error_of<TransportError>(open), HasSubstr("dialout"));
}

TEST(SerialPort, IsClosedWhenItIsUnplugged) {
  PseudoTerminal terminal;
  const auto port = open_serial(terminal.path(), 256000);
  terminal.unplug();
  std::uint8_t bytes[16];
  EXPECT_EQ(kind_of([&] { (void)port->read(bytes, in(10s)); }), Kind::closed);
  EXPECT_EQ(kind_of([&] { port->write(bytes, in(10s)); }), Kind::closed);
  port->discard_input();
}

TEST(SerialPort, DoesNotWaitForeverForAnEndThatTakesNothing) {
  const PseudoTerminal terminal;
  const auto port = open_serial(terminal.path(), 256000);
  const std::vector<std::uint8_t> flood(1 << 20);
  EXPECT_EQ(kind_of([&] { port->write(flood, in(20ms)); }), Kind::timed_out);
}

}  // namespace
}  // namespace quoin::sensor_bridge
