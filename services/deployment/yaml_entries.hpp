// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "services/deployment/deployment.hpp"
#include "services/deployment/problems.hpp"

namespace quoin {

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

/// The value of an entry that is a single text; nothing, and a problem, when it is not.
[[nodiscard]] std::optional<std::string> read_text(const Entry& entry, Problems& problems);

/// The same for one of `choices`; `what` names them in error texts.
[[nodiscard]] std::optional<std::string> read_choice(const Entry& entry, const std::string& what,
                                                     const std::vector<std::string>& choices,
                                                     Problems& problems);

/// The same for an integer from `lowest` to `highest`.
[[nodiscard]] std::optional<int> read_integer(const Entry& entry, const std::string& what,
                                              int lowest, int highest, Problems& problems);

/// Each text of a list, or of a value that stands for a list of one, as an entry with its place.
[[nodiscard]] std::vector<Entry> read_list(const Entry& entry, Problems& problems);

/// Whether `text` has no other characters than those.
[[nodiscard]] bool only_of(std::string_view text, std::string_view allowed);

/// The entries of a YAML map whose keys are plain texts, each once; others become problems.
[[nodiscard]] std::vector<Entry> entries_of(const YAML::Node& map, const std::string& owner,
                                            Problems& problems);

}  // namespace quoin
