// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <vector>

#include <nlohmann/json.hpp>

namespace quoin::benchmarks {

inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(share * last + 0.5)];
}

/// A line each, or JSON.
inline void print(const nlohmann::ordered_json& figures, bool json) {
  if (json) {
    std::cout << figures.dump(2) << '\n';
    return;
  }
  for (const auto& [name, value] : figures.items()) {
    std::cout << std::left << std::setw(30) << name << "  " << value << '\n';
  }
}

}  // namespace quoin::benchmarks
