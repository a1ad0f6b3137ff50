// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <idl/Control.h>
#include <string>
#include <vector>

#include "deploy/orchestration/requester.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// What the supervisor of a host's share says in the end.
struct HostOutcome {
  std::string host;  ///< "" for a deployment that names no hosts
  msg::ControlReply reply;
  bool answered = true;  ///< false when the end is not known
};

/// Has the supervisors of `hosts` carry out `request`, which is of action CONTROL_APPLY: all of
/// them, or none; none, too, when `interrupted` says so in time. When each is ready the changes are
/// done one after the other, wherever they are, so that no scan is lost between hosts. From there
/// on a host that fails does not hold up the others.
[[nodiscard]] std::vector<HostOutcome> apply_on(const std::vector<std::string>& hosts,
                                                const Deployment& wanted, Requester& requester,
                                                const msg::ControlRequest& request,
                                                const std::function<bool()>& interrupted);

}  // namespace quoin::deploy
