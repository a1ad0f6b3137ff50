// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/serial_ports.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/transport/port_holders.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

namespace fs = std::filesystem;
using quoin::tests::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

void write(const fs::path& file, const std::string& content) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << content;
}

/// A port of an adapter, laid out as the kernel and udev do.
void plug(const fs::path& root, const std::string& name, const std::string& interface,
          const std::string& vendor, const std::string& product) {
  write(root / "dev" / name, "");
  const fs::path adapter = root / "sys/devices/usb1" / ("1-" + name);
  write(adapter / "idVendor", vendor + "\n");
  write(adapter / "idProduct", product + "\n");
  write(adapter / "product", "Adapter of " + name + "\n");
  write(adapter / "serial", "0001\n");
  fs::create_directories(adapter / interface);
  fs::create_directories(root / "sys/class/tty" / name);
  fs::create_symlink("../../../devices/usb1/1-" + name + "/" + interface,
                     root / "sys/class/tty" / name / "device");
}

TEST(SerialPorts, AreListedWithTheUsualAdapterFirst) {
  const TemporaryFolder root;
  plug(root.path(), "ttyACM0", "1-1:1.0", "2341", "0043");
  plug(root.path(), "ttyUSB0", "1-1:1.0/ttyUSB0", "0403", "6001");
  plug(root.path(), "ttyUSB10", "1-1:1.0/ttyUSB10", "10c4", "ea60");
  plug(root.path(), "ttyUSB2", "1-1:1.0/ttyUSB2", "10c4", "ea60");
  write(root.path() / "dev/ttyS0", "");
  write(root.path() / "dev/ttyUSB7", "");
  fs::create_directories(root.path() / "dev/serial/by-id");
  fs::create_symlink("../../ttyUSB2", root.path() / "dev/serial/by-id/usb-Silicon_Labs_CP2102");

  const auto usb = [](std::uint16_t vendor, std::uint16_t product, const std::string& name) {
    return UsbIdentity{vendor, product, "Adapter of " + name, "0001"};
  };
  EXPECT_THAT(
      list_serial_ports(root.path()),
      ElementsAre(SerialPortEntry{"/dev/ttyUSB2", "/dev/serial/by-id/usb-Silicon_Labs_CP2102",
                                  usb(0x10C4, 0xEA60, "ttyUSB2")},
                  SerialPortEntry{"/dev/ttyUSB10", "", usb(0x10C4, 0xEA60, "ttyUSB10")},
                  SerialPortEntry{"/dev/ttyACM0", "", usb(0x2341, 0x0043, "ttyACM0")},
                  SerialPortEntry{"/dev/ttyUSB0", "", usb(0x0403, 0x6001, "ttyUSB0")},
                  SerialPortEntry{"/dev/ttyUSB7", "", std::nullopt}));
}

TEST(SerialPorts, AreNoneWhereThereIsNothing) {
  const TemporaryFolder root;
  EXPECT_THAT(list_serial_ports(root.path()), IsEmpty());
}

TEST(PortHolders, AreFoundBehindLinks) {
  const TemporaryFolder root;
  const fs::path port = root.write("ttyUSB0", "");
  fs::create_symlink(port, root.path() / "lidar");
  write(root.path() / "proc/4711/comm", "ModemManager\n");
  fs::create_directories(root.path() / "proc/4711/fd");
  fs::create_directories(root.path() / "proc/12/fd");
  fs::create_directories(root.path() / "proc/self/fd");
  fs::create_symlink("/dev/null", root.path() / "proc/4711/fd/0");
  fs::create_symlink(fs::canonical(port), root.path() / "proc/4711/fd/3");
  fs::create_symlink(fs::canonical(port), root.path() / "proc/12/fd/5");
  fs::create_symlink(fs::canonical(port), root.path() / "proc/self/fd/3");

  const auto holders = holders_of(root.path() / "lidar", root.path());
  EXPECT_THAT(holders, ElementsAre(PortHolder{12, ""}, PortHolder{4711, "ModemManager"}));
  EXPECT_EQ(to_text(holders[0]), "process 12");
  EXPECT_EQ(to_text(holders[1]), "process 4711 (ModemManager)");
}

}  // namespace
}  // namespace quoin::sensor_bridge
