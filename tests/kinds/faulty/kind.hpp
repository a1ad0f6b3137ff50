// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <tuple>

#include "core/parameters/parameter.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::tests {

struct FaultParameters {
  std::int64_t throw_every = 0;  ///< 0: never
  std::int64_t hang_at = 0;      ///< that message; 0: never

  static constexpr auto fields() {
    using P = FaultParameters;
    return std::tuple{field(&P::throw_every, "throw_every", "", 0.0, 1e6, "messages"),
                      field(&P::hang_at, "hang_at", "", 0.0, 1e6, "messages")};
  }
};

/// A method that is not well made.
[[nodiscard]] inline const KindInfo& faulty_kind() {
  static const KindInfo kind{.name = "test_faulty",
                             .description = "passes corners on, or throws, or hangs",
                             .program = "quoin-test-faulty",
                             .inputs = {{"corners", "corners"}},
                             .outputs = {{"corners"}},
                             .parameters = describe_parameters<FaultParameters>()};
  return kind;
}

}  // namespace quoin::tests
