// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/serial_ports.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <system_error>
#include <tuple>

namespace quoin::sensor_bridge {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    entries.push_back(entry->path());
  }
  return entries;
}

std::string first_line(const fs::path& file) {
  std::string line;
  std::ifstream stream(file);
  std::getline(stream, line);
  return line;
}

std::optional<std::uint16_t> hexadecimal(const std::string& text) {
  std::uint16_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return {};
  return value;
}

/// The adapter is a few folders above its port, by the number of interfaces that it has.
std::optional<UsbIdentity> usb_of(const fs::path& root, const std::string& name) {
  std::error_code error;
  fs::path folder = fs::canonical(root / "sys/class/tty" / name / "device", error);
  for (int level = 0; !error && level < 4 && folder.has_relative_path(); ++level) {
    const auto vendor = hexadecimal(first_line(folder / "idVendor"));
    const auto product = hexadecimal(first_line(folder / "idProduct"));
    if (vendor && product) {
      return UsbIdentity{.vendor = *vendor,
                         .product = *product,
                         .product_name = first_line(folder / "product"),
                         .serial_number = first_line(folder / "serial")};
    }
    folder = folder.parent_path();
  }
  return std::nullopt;
}

std::map<std::string, std::string> links_by_device(const fs::path& root) {
  std::map<std::string, std::string> links;
  for (const fs::path& link : entries_of(root / "dev/serial/by-id")) {
    std::error_code error;
    const fs::path target = fs::read_symlink(link, error);
    if (!error) links[target.filename()] = "/dev/serial/by-id/" + link.filename().native();
  }
  return links;
}

}  // namespace

bool is_usual_adapter(const UsbIdentity& usb) {
  return usb.vendor == 0x10C4 && usb.product == 0xEA60;
}

std::vector<SerialPortEntry> list_serial_ports(const fs::path& root) {
  const auto links = links_by_device(root);
  std::vector<SerialPortEntry> ports;
  for (const fs::path& file : entries_of(root / "dev")) {
    const std::string name = file.filename();
    if (!name.starts_with("ttyUSB") && !name.starts_with("ttyACM")) continue;
    const auto link = links.find(name);
    ports.push_back({.device = "/dev/" + name,
                     .link = link == links.end() ? "" : link->second,
                     .usb = usb_of(root, name)});
  }
  std::ranges::sort(ports, {}, [](const SerialPortEntry& port) {
    return std::tuple(!(port.usb && is_usual_adapter(*port.usb)), port.device.size(), port.device);
  });
  return ports;
}

std::vector<SerialPortEntry> usual_adapters(std::vector<SerialPortEntry> ports) {
  std::erase_if(ports, [](const SerialPortEntry& port) {
    return !(port.usb && is_usual_adapter(*port.usb));
  });
  return ports;
}

}  // namespace quoin::sensor_bridge
