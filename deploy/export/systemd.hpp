// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/export/export_plan.hpp"

namespace quoin::deploy {

/// Whom the services of a deployment with `security:` run as; has to be made, and given the keys.
inline constexpr const char* user_with_keys = "quoin";

struct UnitFile {
  std::string name;
  std::string text;
};

/// A hardened unit for each service, and the target that stands for all of them, first. `programs`
/// is the folder of the services' executables. Throws std::invalid_argument for paths that systemd
/// cannot take.
[[nodiscard]] std::vector<UnitFile> systemd_units(const ExportPlan& plan,
                                                  const std::filesystem::path& programs);

}  // namespace quoin::deploy
