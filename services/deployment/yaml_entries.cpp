// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/yaml_entries.hpp"

#include <charconv>
#include <map>
#include <sstream>

#include <yaml-cpp/eventhandler.h>

#include "core/parameters/parameter.hpp"
#include "core/text/printable.hpp"

namespace quoin {

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

namespace {

/// The usual mistake behind a syntax error on line `number`; "" when it is none of those known.
std::string hint(const std::string& text, int number) {
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < number; ++i) std::getline(lines, line);
  if (line.substr(0, line.find_first_not_of(" \t")).find('\t') != std::string::npos) {
    return "; indent with spaces, not with tabs";
  }
  if (line.find("${") != std::string::npos && line.find('{') < line.find("${")) {
    return "; inside { } put values with ${NAME} in quotes";
  }
  return "";
}

/// Notes where documents start, and nothing else.
class DocumentStarts final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override { starts.push_back(position_of(mark)); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

  std::vector<Position> starts;
};

/// The first two at most: yaml-cpp makes endless documents of stray text such as a comma at the
/// start, and its LoadAll takes all memory there is.
std::vector<Position> document_starts(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts handler;
  for (int i = 0; i < 2 && parser.HandleNextDocument(handler); ++i) {
  }
  return handler.starts;
}

}  // namespace

std::optional<YAML::Node> load_yaml(const std::string& text, Problems& problems) {
  try {
    const std::vector<Position> starts = document_starts(text);
    const YAML::Node document = YAML::Load(text);
    if (starts.size() > 1) {
      problems.add(starts[1], "a second document or stray text; a file describes one deployment");
    } else if (document.IsNull()) {
      problems.add({1, 1}, "the file is empty; see deploy/examples for how one looks");
    } else {
      return document;
    }
  } catch (const YAML::Exception& error) {
    const Position at = position_of(error.mark);
    problems.add(at, "not valid YAML: " + error.msg + hint(text, at.line));
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

std::optional<std::string> read_text(const Entry& entry, Problems& problems) {
  if (!entry.value.IsScalar()) {
    problems.add(entry.value_at,
                 "'" + entry.key + "' must be a single value, not " + what_is(entry.value));
    return std::nullopt;
  }
  // Escapes make what the file itself does not have.
  if (!is_printable(entry.value.Scalar())) {
    problems.add(entry.value_at, "'" + entry.key + "' must be one line of printable characters");
    return std::nullopt;
  }
  return entry.value.Scalar();
}

std::optional<std::string> read_choice(const Entry& entry, const std::string& what,
                                       const std::vector<std::string>& choices,
                                       Problems& problems) {
  const auto text = read_text(entry, problems);
  if (!text) return std::nullopt;
  for (const std::string& choice : choices) {
    if (*text == choice) return text;
  }
  problems.add(entry.value_at, "unknown " + what + " '" + *text + "'" + suggestion(*text, choices));
  return std::nullopt;
}

std::optional<int> read_integer(const Entry& entry, const std::string& what, int lowest,
                                int highest, Problems& problems) {
  const auto text = read_text(entry, problems);
  if (!text) return std::nullopt;
  int number = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
  if (error != std::errc{} || end != text->data() + text->size() || number < lowest ||
      number > highest) {
    problems.add(entry.value_at, what + " must be an integer from " + std::to_string(lowest) +
                                     " to " + std::to_string(highest) + ", not '" + *text + "'");
    return std::nullopt;
  }
  return number;
}

std::vector<Entry> read_list(const Entry& entry, Problems& problems) {
  std::vector<Entry> entries;
  if (!entry.value.IsSequence()) {
    if (read_text(entry, problems)) entries.push_back(entry);
    return entries;
  }
  for (const YAML::Node& node : entry.value) {
    const Entry element{entry.key, entry.key_at, node, position_of(node.Mark())};
    if (node.IsScalar()) {
      entries.push_back(element);
    } else {
      problems.add(element.value_at, "an element of '" + entry.key +
                                         "' must be a single value, not " + what_is(node));
    }
  }
  return entries;
}

bool only_of(std::string_view text, std::string_view allowed) {
  return text.find_first_not_of(allowed) == std::string_view::npos;
}

}  // namespace quoin
