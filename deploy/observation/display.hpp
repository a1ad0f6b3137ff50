// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "deploy/observation/figures.hpp"

namespace quoin::deploy {

/// What there is to see at one moment, made only where it is shown.
struct View {
  /// Lines of at most that many characters.
  std::function<std::vector<std::string>(std::size_t width)> table;
  std::function<std::string()> footer;  ///< below the table
  std::function<std::string()> line;    ///< the same in one line, for logs
};

/// Shows a running deployment: a table that is redrawn in place on a terminal, with log lines
/// scrolling above it, or a line a second elsewhere.
class Display {
 public:
  enum class Mode {
    automatic,  ///< the table when standard output is a terminal, else lines on standard output
    errors,     ///< lines on standard error; standard output is left to the result
    quiet,      ///< log lines only
  };

  explicit Display(Mode mode);
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  /// A line of a service's log; gets the service's name in front unless that is in it.
  void log(const std::string& service, const std::string& line);
  /// Whether it is time to show something.
  [[nodiscard]] bool due() const { return (live_ || lines_) && Clock::now() >= next_; }
  /// Shows `view` if it is time to.
  void show(const View& view);
  void show(const DeploymentFigures& figures);
  /// Shows the last figures and leaves the table standing.
  void finish(const View& view);
  void finish(const DeploymentFigures& figures);

 private:
  using Clock = std::chrono::steady_clock;

  void erase_table();
  void draw_table();

  bool live_ = false;
  bool lines_ = false;
  bool to_errors_ = false;
  Clock::time_point next_;
  std::vector<std::string> table_;
  std::size_t drawn_ = 0;  ///< lines of the table on the screen
};

}  // namespace quoin::deploy
