// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/deployment/kinds.hpp"
#include "services/deployment/problems.hpp"

namespace quoin {

/// A service as read, before it is known whether it fits the others.
struct DraftService {
  ServiceConfig config;
  const KindInfo* kind = nullptr;  ///< null when the kind is missing or unknown
  Position name_at;
  Position input_at;  ///< of the input's value; line 0 when there is no input
};

/// Checks that names are unique and that inputs exist, fit and do not go in circles; what does not
/// is added to `problems`. Returns the services with inputs before those who read them, else in the
/// order of the file.
[[nodiscard]] std::vector<ServiceConfig> wire(const std::vector<DraftService>& drafts,
                                              Problems& problems);

}  // namespace quoin
