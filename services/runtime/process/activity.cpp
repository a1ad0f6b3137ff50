// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/activity.hpp"

#include "services/deployment/deployment.hpp"
#include "services/runtime/process/service_activity.hpp"

namespace quoin::runtime {

Component activity_component(const KindInfo& kind, ActivityFactory open) {
  return {&kind,
          [open = std::move(open)](const Deployment& deployment,
                                   const ServiceConfig& config) -> Component::Body {
            return [body = open_body(open, deployment, config)](Service& service) {
              service.record.set_state(msg::ServiceState::STATE_ACTIVE);
              ServiceActivity<Activity> activity(service);
              body(activity);
              service.process.heartbeat.finish(
                  service.record, service.stop.requested() ? msg::ServiceState::STATE_STOPPED
                                                           : msg::ServiceState::STATE_FINISHED);
              return exit_ok;
            };
          }};
}

}  // namespace quoin::runtime
