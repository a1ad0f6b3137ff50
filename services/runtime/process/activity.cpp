// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/activity.hpp"

#include "services/runtime/process/service_activity.hpp"

namespace quoin::runtime {

int run_activity(int argc, char** argv, const KindInfo& kind, const ActivityFactory& open) {
  std::function<void(Activity&)> body;
  return run_service(
      argc, argv, kind,
      [&](const Deployment& deployment, const ServiceConfig& config) {
        body = open_body(open, deployment, config);
      },
      [&](Service& service) {
        service.record.set_state(msg::ServiceState::STATE_ACTIVE);
        ServiceActivity<Activity> activity(service);
        body(activity);
        service.heartbeat.finish(service.stop.requested() ? msg::ServiceState::STATE_STOPPED
                                                          : msg::ServiceState::STATE_FINISHED);
        return exit_ok;
      });
}

}  // namespace quoin::runtime
