// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/harness/deployment.hpp"

#include "deploy/kinds/kinds.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace quoin::tests {

TestDeployment::TestDeployment(const std::string& services, const std::string& head,
                               std::string tool, const std::string& suffix)
    : tool_(std::move(tool)),
      head_("version: 1\nnamespace: " + test_namespace() + suffix +
            "\ndomain: " + std::to_string(test_domain()) + "\n" + head + "services:\n"),
      file_(write("deployment.yaml", services)),
      deployment_(deploy::load_deployment(file_)) {}

std::filesystem::path TestDeployment::write(const std::string& name,
                                            const std::string& services) const {
  return directory_.write(name, head_ + services);
}

Process TestDeployment::start(const std::string& service, int observers) const {
  const KindInfo* kind = deploy::find_kind(deployment_.service(service).kind);
  return Process(kind->program,
                 {"--deployment", file_.string(), "--service", service, "--observers",
                  std::to_string(observers)},
                 directory_.path());
}

Process TestDeployment::quoin(std::vector<std::string> arguments) const {
  for (std::string& argument : arguments) {
    if (argument == "FILE") argument = file_.string();
  }
  return Process(tool_, arguments, directory_.path());
}

StatusRecorder::StatusRecorder(runtime::Participant& participant, const TestDeployment& deployment)
    : reader_(participant, status_topic(deployment.deployment().name_space),
              runtime::QosPreset::state) {}

void StatusRecorder::poll() {
  msg::ServiceStatus status;
  while (reader_.take(status)) latest_[status.service()] = status;
}

}  // namespace quoin::tests
