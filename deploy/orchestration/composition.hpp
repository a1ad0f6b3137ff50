// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <idl/Control.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deploy/orchestration/changeover.hpp"
#include "deploy/orchestration/frozen_file.hpp"
#include "deploy/orchestration/instruction.hpp"
#include "deploy/orchestration/supervisor.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// What to change the composition to, and how.
struct ApplyRequest {
  std::filesystem::path file;
  std::optional<std::uint64_t> checksum = std::nullopt;  ///< of the text that the requester means
  bool dry_run = false;
  std::chrono::milliseconds timeout{10'000};  ///< for new processes to be ready
  NextInstruction next_instruction =
      nullptr;  ///< for who changes other hosts, too: asked once everything is ready
};

struct ApplyOutcome {
  bool accepted = false;
  bool rolled_back = false;
  std::string detail;  ///< why not
  std::vector<msg::ControlStep> steps;
};

/// The deployment that runs: as it was read, whatever has become of its file since.
class Composition {
 public:
  /// `host` as host_to_run takes it. Throws DeploymentError, or std::runtime_error when a program
  /// is missing.
  Composition(const std::filesystem::path& file, const std::string& host);

  [[nodiscard]] const Deployment& deployment() const { return deployment_; }
  /// Whose share of it runs here.
  [[nodiscard]] const std::string& host() const { return host_; }
  /// How its processes are started.
  [[nodiscard]] const std::vector<ProcessPlan>& plans() const { return plans_; }

  /// Reads the file and changes what runs to what it describes, or changes nothing. `on_plan` is
  /// told the plan before anything is done.
  [[nodiscard]] ApplyOutcome apply(const Changeover::World& world, const ApplyRequest& request,
                                   const std::function<void(const Plan&)>& on_plan);

 private:
  void carry_out(const Changeover::World& world, const ApplyRequest& request,
                 const std::function<void(const Plan&)>& on_plan, ApplyOutcome& outcome);

  Deployment deployment_;
  std::string host_;
  std::vector<ProcessPlan> plans_;
  std::unique_ptr<FrozenFile> copy_;
  std::unique_ptr<FrozenFile> previous_copy_;  // a process may just be about to read it
};

/// The plan as it is reported to who asked for it.
[[nodiscard]] std::vector<msg::ControlStep> steps_of(const Plan& plan);

}  // namespace quoin::deploy
