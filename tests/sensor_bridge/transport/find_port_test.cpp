// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/find_port.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A port as the kernel shows it below `root`.
void plug_in(const fs::path& root, const std::string& name, const std::string& vendor,
             const std::string& product) {
  fs::create_directories(root / "dev");
  std::ofstream(root / "dev" / name) << "";
  const fs::path adapter = root / "sys/devices" / ("usb-" + name);
  fs::create_directories(adapter / "interface" / "tty");
  std::ofstream(adapter / "idVendor") << vendor << '\n';
  std::ofstream(adapter / "idProduct") << product << '\n';
  fs::create_directories(root / "sys/class/tty" / name);
  fs::create_directory_symlink(adapter / "interface", root / "sys/class/tty" / name / "device");
}

std::string refusal(const fs::path& root) {
  try {
    (void)find_endpoint("auto", root);
  } catch (const EndpointError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FindPort, TakesTheOnlyUsualAdapter) {
  const quoin::tests::TemporaryFolder folder;
  plug_in(folder.path(), "ttyUSB0", "0403", "6001");
  plug_in(folder.path(), "ttyUSB1", "10c4", "ea60");
  EXPECT_EQ(find_endpoint("auto", folder.path()).path, "/dev/ttyUSB1");
}

TEST(FindPort, NamesTheChoiceWhenItCannotChoose) {
  const quoin::tests::TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.path()), HasSubstr("plug the device in"));
  plug_in(folder.path(), "ttyUSB0", "0403", "6001");
  EXPECT_THAT(refusal(folder.path()), AllOf(HasSubstr("usual type"), HasSubstr("/dev/ttyUSB0")));
  plug_in(folder.path(), "ttyUSB1", "10c4", "ea60");
  plug_in(folder.path(), "ttyUSB2", "10c4", "ea60");
  EXPECT_THAT(refusal(folder.path()), AllOf(HasSubstr("several"), HasSubstr("/dev/ttyUSB2")));
}

TEST(FindPort, ReadsWhatIsNamed) {
  EXPECT_EQ(find_endpoint("udp://10.0.0.2:8089").kind, Endpoint::Kind::udp);
  EXPECT_EQ(find_endpoint("/dev/ttyS0").path, "/dev/ttyS0");
}

}  // namespace
}  // namespace quoin::sensor_bridge
