// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/display.hpp"

#include <cstdlib>
#include <iostream>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/text/printable.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::chrono::milliseconds table_period{500};
constexpr std::chrono::milliseconds line_period{1000};

struct TerminalSize {
  std::size_t width = 80;
  std::size_t height = 24;
};

TerminalSize terminal_size() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0)
    return {};
  return {size.ws_col, size.ws_row};
}

bool has_live_terminal() {
  const char* type = std::getenv("TERM");
  return ::isatty(STDOUT_FILENO) == 1 && type != nullptr && std::string_view(type) != "dumb";
}

View view_of(const DeploymentFigures& figures) {
  return {.table = [&figures](std::size_t width) { return table_lines(figures, width); },
          .footer =
              [&figures] {
                return fixed(figures.duration, 1) + " s, " +
                       std::to_string(figures.scans_published) + " scans";
              },
          .line = [&figures] { return progress_line(figures); }};
}

}  // namespace

Display::Display(Mode mode)
    : live_(mode == Mode::automatic && has_live_terminal()),
      lines_(mode != Mode::quiet && !live_),
      to_errors_(mode == Mode::errors) {}

Display::~Display() {
  if (live_) std::cout << std::flush;
}

void Display::log(const std::string& service, const std::string& line) {
  const bool named = line.find("[" + service + "]") != std::string::npos;
  // What comes from another process must not move the cursor.
  const std::string text = printable(named ? line : "[" + service + "] " + line, Lines::many);
  if (!live_) {
    std::cerr << text << std::endl;
    return;
  }
  erase_table();
  std::cout << text << '\n';
  draw_table();
}

void Display::show(const View& view) {
  if (!due()) return;
  next_ = Clock::now() + (live_ ? table_period : line_period);
  if (lines_) {
    (to_errors_ ? std::cerr : std::cout) << view.line() << std::endl;
    return;
  }
  erase_table();
  table_ = view.table(terminal_size().width);
  table_.push_back(view.footer() + "; Ctrl-C stops");
  draw_table();
}

void Display::show(const DeploymentFigures& figures) { show(view_of(figures)); }

void Display::finish(const View& view) {
  if (!live_ && !lines_) return;
  if (live_) erase_table();
  const std::size_t width = live_ ? terminal_size().width : std::string::npos;
  std::ostream& out = to_errors_ ? std::cerr : std::cout;
  for (const std::string& line : view.table(width)) out << line << '\n';
  out << view.footer() << std::endl;
  table_.clear();
  live_ = false;
  lines_ = false;
}

void Display::finish(const DeploymentFigures& figures) { finish(view_of(figures)); }

void Display::erase_table() {
  // Up to the first line of the table, then clear everything below.
  if (drawn_ > 0) std::cout << "\r\033[" << drawn_ << "A\033[J";
  drawn_ = 0;
}

void Display::draw_table() {
  // A table higher than the screen could not be erased again.
  const std::size_t height = terminal_size().height;
  for (const std::string& line : table_) {
    if (drawn_ + 1 >= height) break;
    std::cout << line << '\n';
    ++drawn_;
  }
  std::cout << std::flush;
}

}  // namespace quoin::deploy
