// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/deployment/kind.hpp"
#include "services/deployment/problems.hpp"

namespace quoin {

/// A service as read, before it is known whether it fits the others.
struct DraftService {
  ServiceConfig config;
  Position name_at;
  bool inputs_are_wrong = false;  ///< something has been said of them already
};

/// Checks that names are unique and that inputs exist, fit and do not go in circles; what does not
/// is added to `problems`. Fills in the topics. Returns the services with inputs before those who
/// read them, else in the order of the file.
[[nodiscard]] std::vector<ServiceConfig> wire(const std::vector<DraftService>& drafts,
                                              std::string_view name_space, const KindList& kinds,
                                              Problems& problems);

}  // namespace quoin
