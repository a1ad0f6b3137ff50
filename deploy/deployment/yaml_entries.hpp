// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "deploy/deployment/deployment.hpp"
#include "deploy/deployment/problems.hpp"

namespace quoin::deploy {

[[nodiscard]] Position position_of(const YAML::Mark& mark);

/// How an error text calls a value: "a map", "a list", "'text'" or "nothing".
[[nodiscard]] std::string what_is(const YAML::Node& node);

/// The single document in `text`; nothing, and a problem, when there is none.
[[nodiscard]] std::optional<YAML::Node> load_yaml(const std::string& text, Problems& problems);

/// One entry of a YAML map with its places in the file.
struct Entry {
  std::string key;
  Position key_at;
  YAML::Node value;
  Position value_at;
};

/// The entries of a YAML map whose keys are plain texts, each once; others become problems.
[[nodiscard]] std::vector<Entry> entries_of(const YAML::Node& map, const std::string& owner,
                                            Problems& problems);

}  // namespace quoin::deploy
