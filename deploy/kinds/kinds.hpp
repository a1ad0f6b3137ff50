// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "services/deployment/deployment.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::deploy {

/// All kinds that this program knows, sources first.
[[nodiscard]] const KindList& kinds();
/// Null when there is no such kind.
[[nodiscard]] inline const KindInfo* find_kind(std::string_view name) { return kinds().find(name); }

/// File name of the program that runs several services of these kinds in one process.
[[nodiscard]] const char* process_program();

/// Of services of these kinds. Throw DeploymentError with all that is wrong.
[[nodiscard]] inline Deployment load_deployment(const std::filesystem::path& file) {
  return quoin::load_deployment(file, kinds());
}
[[nodiscard]] inline Deployment parse_deployment(const std::string& text,
                                                 const std::filesystem::path& file) {
  return quoin::parse_deployment(text, file, kinds());
}

}  // namespace quoin::deploy
