// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <tuple>

#include "core/parameters/method_list.hpp"

namespace quoin::tests {

struct CounterParameters {
  std::int64_t every = 10;

  static constexpr auto fields() {
    return std::tuple{field(&CounterParameters::every, "every", "", 1.0, 1e6,
                            "messages that come in for one that goes out")};
  }
};

/// Counts the messages of its life.
struct Counter {
  static constexpr auto name = "count";
  static constexpr auto description = "counts what comes in";
  static constexpr auto source = "";
  static constexpr auto choose = "";
  static constexpr auto state = "count/1";
  using Parameters = CounterParameters;
  explicit Counter(const Parameters& wanted) : parameters(wanted) {}
  Parameters parameters;
};

/// The same with another method's name: it can go on with what the other one has counted.
struct Recounter : Counter {
  static constexpr auto name = "recount";
  using Counter::Counter;
};

/// The same with a state of another form.
struct OtherCounter : Counter {
  static constexpr auto name = "count_otherwise";
  static constexpr auto state = "count/2";
  using Counter::Counter;
};

using Counters = MethodList<Counter, Recounter, OtherCounter>;

}  // namespace quoin::tests
