// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/extraction/explanation.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin {

/// The services that make lines, and corners of them, with their methods.
struct ExplainedServices {
  const ServiceConfig* source = nullptr;
  const ServiceConfig* segmentation = nullptr;
  const ServiceConfig* line_fitting = nullptr;
  const ServiceConfig* corners = nullptr;  ///< null when nobody makes corners of these lines
  MethodChain chain;
};

/// `name`: of a service for lines, or for corners of lines. Goes by the kinds as they are written,
/// which a service does not know of others. Throws std::out_of_range when it is none.
[[nodiscard]] ExplainedServices explained_services(const Deployment& deployment,
                                                   const std::string& name);

/// What was found out, for scripts and people: `summary` says it in sentences; `changes` name the
/// service and the parameter with its value and the one that would have let the points pass.
[[nodiscard]] nlohmann::ordered_json to_json(const ExplainedServices& services, const Place& place,
                                             const Explanation& explanation);

/// The same as lines of text.
[[nodiscard]] std::string to_text(const nlohmann::ordered_json& report);

}  // namespace quoin
