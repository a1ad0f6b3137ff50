// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::runtime {

class Participant;
struct Service;

/// A kind, and what a service of it does.
struct Component {
  /// The work of one service, in a thread of its own, until it is done or asked to stop. Returns
  /// the exit code: 0 done or stopped, 3 the input of a source became unusable.
  using Body = std::function<int(Service&)>;

  const KindInfo* kind = nullptr;
  /// Opens what the service works on, before DDS is touched. Exceptions are errors in the
  /// configuration.
  std::function<Body(const Deployment&, const ServiceConfig&)> open;
};

/// What `open` returns; its exceptions become errors of the deployment file at the place of the
/// service.
template <class Open>
[[nodiscard]] auto opened(const Deployment& deployment, const ServiceConfig& config, Open open) {
  try {
    return open();
  } catch (const std::exception& error) {
    throw DeploymentError({deployment.file.string() + ":" + std::to_string(config.position.line) +
                           ":" + std::to_string(config.position.column) + ": service '" +
                           config.name + "': " + error.what()});
  }
}

/// Makes a kind known to the main function of the program that this is linked into. One in the main
/// file of a kind; the program of a kind has one, that of composed processes one of each.
class Registration {
 public:
  explicit Registration(Component component);
};
[[nodiscard]] const std::vector<Component>& registered_components();

/// What stands beside the services of every process of a program, whatever their kinds are; made
/// known as a Registration does.
class Companion {
 public:
  struct Functions {
    /// What the participant announces as its user data; "" for nothing. One companion of a process
    /// may have some.
    std::function<std::string(const Deployment&)> user_data;
    /// Made once there is a participant, and kept until the services have ended; null where there
    /// is nothing to do.
    std::function<std::shared_ptr<void>(Participant&, const Deployment&,
                                        const std::vector<const ServiceConfig*>& services)>
        open;
  };
  explicit Companion(Functions functions);
};

/// The main function of a process with one service (--service), or those that the deployment puts
/// into one process (--process): command line, log, deployment file, signals. On SIGTERM and SIGINT
/// each service ends when those before it in the process have. Returns the exit code: 0 stopped or
/// finished, 2 wrong configuration, 3 the input of a source became unusable, 1 anything else.
int run_process(int argc, char** argv, const std::vector<Component>& components);

}  // namespace quoin::runtime
