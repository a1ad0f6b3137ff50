// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "services/deployment/problems.hpp"
#include "services/deployment/wiring.hpp"
#include "services/deployment/yaml_entries.hpp"

namespace quoin {

/// Reads `processes: {NAME: [SERVICE, ...]}` into the services that it names; what is wrong is
/// added to `problems`.
void read_processes(const Entry& entry, std::vector<DraftService>& drafts, Problems& problems);

}  // namespace quoin
