// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "services/runtime/process/run_node.hpp"

namespace quoin {

/// What kind mapping does. `directory`: where paths start. Throws ParameterError, also for a map
/// that cannot be gone on with.
[[nodiscard]] runtime::Method make_mapper(const std::string& method,
                                          const ParameterSettings& settings,
                                          const std::filesystem::path& directory);

/// What kind localization does. Throws ParameterError, also for a map that cannot be read.
[[nodiscard]] runtime::Method make_localizer(const std::string& method,
                                             const ParameterSettings& settings,
                                             const std::filesystem::path& directory);

/// The component of a kind whose methods these are; paths start at the folder of the deployment.
using MakeInFolder = runtime::Method (*)(const std::string&, const ParameterSettings&,
                                         const std::filesystem::path&);
[[nodiscard]] runtime::Component localizer_component(const KindInfo& kind, MakeInFolder make);

}  // namespace quoin
