// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <idl/Scan.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <typeinfo>

#include "services/deployment/deployment.hpp"
#include "services/runtime/node/dds_ports.hpp"
#include "services/runtime/process/activity.hpp"

namespace quoin::runtime {

/// Input of a source that became unusable: what has been published stays published, the service
/// ends as failed with exit code 3 and is not started again.
class SourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the body of a scan source works with. Numbers the scans, stamps the trace and accounts for
/// them.
class Source : public Activity {
 public:
  /// Publishes a scan whose header.stamp and header.frame are set; the rest of the header is filled
  /// in. With the lossless preset it waits for the readers; false when asked to stop meanwhile.
  virtual bool publish(msg::Scan& scan) = 0;

  /// Readers of the first output that are matched now, observers among them.
  [[nodiscard]] virtual std::size_t readers() const = 0;

  /// Publishes a message of another type of the kind's outputs, at its own rate, with its stamp and
  /// frame. A source without scans publishes all like this.
  template <class T>
  bool publish_also(T& message) {
    return publish_own(typeid(T), &message, message.header());
  }

  /// Takes settings (none: a question) and returns those in force; throws ParameterError.
  using Settings = std::function<ParameterSettings(const ParameterSettings&)>;
  /// Has requests for other settings (`quoin set`) answered by `settings`, in another thread, until
  /// the service ends. False when nobody can ask.
  virtual bool answer_settings(const Settings&) { return false; }

  /// To read topics that no service of the deployment writes.
  [[nodiscard]] virtual Participant& participant() {
    throw std::logic_error("a source without DDS");
  }

 protected:
  virtual bool publish_own(const std::type_info&, void*, msg::Header&) {
    throw std::logic_error("a source with one output");
  }
};

using SourceFactory = BodyFactory<Source>;

/// A kind of scan source. A service of it waits for the readers named in the deployment; the body
/// returns when a finite source has published everything, or when `publish` or `wait_until` says
/// false. `types`: of the kind's outputs, the scans first.
[[nodiscard]] Component source_component(const KindInfo& kind, SourceFactory open,
                                         PortTypes types = port_types(Reads<>(),
                                                                      Writes<msg::Scan>()));

/// The same for one that looks at the whole deployment, which outlives the body.
using DeploymentSourceFactory =
    std::function<std::function<void(Source&)>(const Deployment&, const ServiceConfig&)>;
[[nodiscard]] Component source_component(const KindInfo& kind, DeploymentSourceFactory open,
                                         PortTypes types = port_types(Reads<>(),
                                                                      Writes<msg::Scan>()));

}  // namespace quoin::runtime
