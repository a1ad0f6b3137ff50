// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <exception>
#include <string>

#include <spdlog/spdlog.h>

#include "services/runtime/process/activity.hpp"
#include "services/runtime/process/service.hpp"

namespace quoin::runtime {

/// What Activity promises, on a service; `Base` is Activity or derived from it.
template <class Base>
class ServiceActivity : public Base {
 public:
  explicit ServiceActivity(Service& service) : service_(service) {}

  [[nodiscard]] bool wait_until(std::chrono::steady_clock::time_point time) override {
    Pulse& pulse = service_.pulse;
    pulse.wait_until(time);
    const bool go_on = service_.stop.wait_until(time);
    pulse.beat();
    return go_on;
  }

  void warn(const std::string& text) override {
    spdlog::warn("{}", text);
    service_.record.set_detail(text);
  }

  void clear_warning(const std::string& text) override {
    spdlog::info("{}", text);
    service_.record.set_detail("");
  }

  void set_diagnostic(const std::string& name, const std::string& value) override {
    service_.record.set_diagnostic(name, value);
  }

 protected:
  Service& service_;
};

template <class Context>
[[nodiscard]] std::function<void(Context&)> open_body(const BodyFactory<Context>& open,
                                                      const Deployment& deployment,
                                                      const ServiceConfig& config) {
  return opened(deployment, config, [&] { return open(config, deployment.file.parent_path()); });
}

}  // namespace quoin::runtime
