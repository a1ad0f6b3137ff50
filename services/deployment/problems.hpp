// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text/printable.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin {

/// Collects what is wrong with a file, so that its author sees everything at once.
class Problems {
 public:
  /// With "" for `file`, messages name no place.
  explicit Problems(std::filesystem::path file) : file_(std::move(file)) {}

  /// `what` may quote the file, whoever wrote it.
  void add(Position where, std::string_view what) {
    problems_.emplace_back(where, printable(what, Lines::one, longest_problem));
  }
  [[nodiscard]] bool empty() const { return problems_.empty(); }

  /// Throws DeploymentError with all problems in the order of the file, if there are any.
  void raise() const;

 private:
  static constexpr std::size_t longest_problem = 1000;  // [byte]

  std::filesystem::path file_;
  std::vector<std::pair<Position, std::string>> problems_;
};

}  // namespace quoin
