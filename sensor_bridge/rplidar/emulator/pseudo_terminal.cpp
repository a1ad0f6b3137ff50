// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/pseudo_terminal.hpp"

#include <algorithm>
#include <array>
#include <asm/termbits.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace quoin::sensor_bridge::rplidar {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), "pseudo-terminal: " + what);
}

// No echo and no translation, before a client can see it. The baud rate is that of a new port, so
// that a client has to set its own.
void make_raw(int descriptor) {
  termios2 mode{};
  if (::ioctl(descriptor, TCGETS2, &mode) != 0) fail("cannot read its mode");
  mode.c_iflag = 0;
  mode.c_oflag = 0;
  mode.c_lflag = 0;
  mode.c_cflag = B9600 | CS8 | CREAD | CLOCAL;
  mode.c_cc[VMIN] = 1;
  mode.c_cc[VTIME] = 0;
  if (::ioctl(descriptor, TCSETS2, &mode) != 0) fail("cannot set its mode");
}

}  // namespace

PseudoTerminal::PseudoTerminal(std::filesystem::path link, Report report)
    : link_(std::move(link)), report_(std::move(report)) {}

PseudoTerminal::~PseudoTerminal() { unplug(); }

void PseudoTerminal::plug_in() {
  FileDescriptor master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  std::array<char, 128> name{};
  if (!master || ::grantpt(master.get()) != 0 || ::unlockpt(master.get()) != 0 ||
      ::ptsname_r(master.get(), name.data(), name.size()) != 0) {
    fail("cannot be made");
  }
  FileDescriptor slave(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (!slave) fail(std::string("cannot open ") + name.data());
  make_raw(slave.get());
  slave_path_ = name.data();
  // A system that does not notify serves its clients all the same.
  openings_ = FileDescriptor(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
  if (openings_ && ::inotify_add_watch(openings_.get(), name.data(), IN_OPEN | IN_CLOSE) < 0) {
    openings_.reset();
  }
  clients_ = 0;
  make_link();
  master_ = std::move(master);
  slave_ = std::move(slave);
}

void PseudoTerminal::unplug() {
  if (!master_) return;
  remove_link();
  master_.reset();
  slave_.reset();
  openings_.reset();
}

std::string PseudoTerminal::endpoint() const {
  return link_.empty() ? slave_path_.string() : link_.string();
}

void PseudoTerminal::watch(std::vector<pollfd>& descriptors) const {
  if (master_) descriptors.push_back({master_.get(), POLLIN, 0});
  if (openings_) descriptors.push_back({openings_.get(), POLLIN, 0});
}

void PseudoTerminal::read(std::vector<std::uint8_t>& bytes) {
  if (!master_) return;
  follow_clients();
  std::array<std::uint8_t, 1024> piece;
  const ssize_t size = ::read(master_.get(), piece.data(), piece.size());
  if (size <= 0) return;
  bytes.insert(bytes.end(), piece.begin(), piece.begin() + size);
  clients_ = std::max(clients_, 1);  // should the system not have notified
}

// A real port is new to each client. This one is kept open, so that what the last client left has
// to be taken away: bytes that it did not read, and its claim to be the only one.
void PseudoTerminal::follow_clients() {
  alignas(inotify_event) std::array<char, 1024> events;
  ssize_t size = 0;
  while (openings_ && (size = ::read(openings_.get(), events.data(), events.size())) > 0) {
    inotify_event event;
    for (std::size_t offset = 0; offset + sizeof event <= static_cast<std::size_t>(size);
         offset += sizeof event + event.len) {
      std::memcpy(&event, events.data() + offset, sizeof event);
      if ((event.mask & IN_OPEN) != 0 && clients_++ == 0) {
        ::ioctl(slave_.get(), TCFLSH, TCIFLUSH);
        report_("a client opened the port");
      } else if ((event.mask & IN_CLOSE) != 0 && clients_ > 0 && --clients_ == 0) {
        ::ioctl(slave_.get(), TIOCNXCL);
        ::ioctl(slave_.get(), TCFLSH, TCIFLUSH);
        report_("no client has the port open any more");
      }
    }
  }
}

void PseudoTerminal::write(std::span<const std::uint8_t> bytes, TimePoint /*now*/) {
  if (bytes.empty()) return;
  const bool heard = master_ && (clients_ > 0 || !openings_);
  const ssize_t size = heard ? ::write(master_.get(), bytes.data(), bytes.size()) : 0;
  count(bytes.size(), size > 0 ? static_cast<std::size_t>(size) : 0);
}

std::optional<unsigned> PseudoTerminal::baud_rate() const {
  termios2 mode{};
  // The master has the mode of the slave.
  if (!master_ || ::ioctl(master_.get(), TCGETS2, &mode) != 0) return std::nullopt;
  return mode.c_ospeed;
}

// A link that is left over from an emulator that was killed is replaced, anything else is not.
void PseudoTerminal::make_link() const {
  if (link_.empty()) return;
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(link_, error))) {
    const std::filesystem::path target = std::filesystem::read_symlink(link_, error);
    if (error || !target.string().starts_with("/dev/pts/")) {
      throw std::runtime_error("link '" + link_.string() +
                               "' is there already and is not one to a pseudo-terminal; remove it "
                               "or choose another path");
    }
  }
  // By way of another name, so that there is no moment without a link.
  std::filesystem::path fresh = link_;
  fresh += "." + std::to_string(::getpid());
  std::filesystem::create_symlink(slave_path_, fresh);
  std::filesystem::rename(fresh, link_);
}

void PseudoTerminal::remove_link() const {
  std::error_code error;  // when another program has taken it away or replaced it, that is right
  if (!link_.empty() && std::filesystem::read_symlink(link_, error) == slave_path_) {
    std::filesystem::remove(link_, error);
  }
}

}  // namespace quoin::sensor_bridge::rplidar
