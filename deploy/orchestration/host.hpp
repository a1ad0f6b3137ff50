// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// The host whose share of `deployment` is to be run: `asked`, or when that is "" the one called
/// like this machine; "" for a deployment that names no hosts. Throws DeploymentError, with the
/// hosts that there are, when there is no such host.
[[nodiscard]] std::string host_to_run(const Deployment& deployment, const std::string& asked);

/// The hosts whose shares are to be changed: `asked`, as above, or when that is "" all; one "" for
/// a deployment that names no hosts.
[[nodiscard]] std::vector<std::string> hosts_to_change(const Deployment& deployment,
                                                       const std::string& asked);

}  // namespace quoin::deploy
