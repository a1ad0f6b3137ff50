// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace quoin::tests {

/// Counts what is allocated from its making on, by operator new and, where it is called by our code
/// or by Eigen, malloc. For test programs with allocations.cpp and LINK_OPTIONS of
/// quoin_count_allocations.
class Allocations {
 public:
  Allocations();
  [[nodiscard]] std::size_t count() const;

 private:
  std::size_t before_;
};

}  // namespace quoin::tests
