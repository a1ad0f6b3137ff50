// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/deployment/yaml_entries.hpp"

#include <map>

namespace quoin::deploy {

Position position_of(const YAML::Mark& mark) {
  if (mark.is_null()) return {1, 1};
  return {mark.line + 1, mark.column + 1};
}

std::string what_is(const YAML::Node& node) {
  if (node.IsMap()) return "a map";
  if (node.IsSequence()) return "a list";
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  return "nothing";
}

std::optional<YAML::Node> load_yaml(const std::string& text, Problems& problems) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) {
      problems.add(position_of(documents[1].Mark()),
                   "a second document; a file describes one deployment");
    } else if (documents.empty() || documents.front().IsNull()) {
      problems.add({1, 1}, "the file is empty; see deploy/examples for how one looks");
    } else {
      return documents.front();
    }
  } catch (const YAML::Exception& error) {
    problems.add(position_of(error.mark), "not valid YAML: " + error.msg);
  } catch (const std::exception& error) {
    problems.add({1, 1}, std::string("not valid YAML: ") + error.what());
  }
  return std::nullopt;
}

std::vector<Entry> entries_of(const YAML::Node& map, const std::string& owner, Problems& problems) {
  std::vector<Entry> entries;
  std::map<std::string, Position> seen;
  for (const auto& pair : map) {
    const Position key_at = position_of(pair.first.Mark());
    if (!pair.first.IsScalar()) {
      problems.add(key_at, "a key of " + owner + " must be a name, not " + what_is(pair.first));
      continue;
    }
    const std::string key = pair.first.Scalar();
    const auto [first, inserted] = seen.emplace(key, key_at);
    if (!inserted) {
      problems.add(key_at, "duplicate key '" + key + "' of " + owner + "; the first is at " +
                               std::to_string(first->second.line) + ":" +
                               std::to_string(first->second.column));
      continue;
    }
    // A missing value has no place of its own.
    const Position value_at = pair.second.IsNull() ? key_at : position_of(pair.second.Mark());
    entries.push_back({key, key_at, pair.second, value_at});
  }
  return entries;
}

}  // namespace quoin::deploy
