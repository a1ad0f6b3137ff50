// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/recordings/message_table.hpp"

#include <utility>

namespace quoin::deploy {

namespace {

using Json = nlohmann::ordered_json;
using Cells = std::vector<std::pair<std::string, std::string>>;

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

std::string cell(const Json& value) {
  if (value.is_null()) return "nan";
  if (value.is_string()) return quoted(value.get<std::string>());
  return value.dump();
}

/// Single values, those of structures with the name of their field before them.
void add_cells(const Json& object, const std::string& prefix, Cells& cells) {
  for (const auto& [name, value] : object.items()) {
    if (value.is_object()) {
      add_cells(value, prefix + name + '.', cells);
    } else if (!value.is_array()) {
      cells.emplace_back(prefix + name, cell(value));
    }
  }
}

const Json* list_of(const Json& message) {
  for (const auto& [name, value] : message.items()) {
    if (value.is_array() && (value.empty() || value[0].is_object())) return &value;
  }
  return nullptr;
}

std::string joined(const Cells& cells, std::string Cells::value_type::*part) {
  std::string line;
  for (const auto& each : cells) line += (line.empty() ? "" : ",") + each.*part;
  return line;
}

}  // namespace

std::vector<std::string> MessageTable::rows(const Json& message) {
  Cells begin;
  if (const auto header = message.find("header"); header != message.end()) {
    begin.emplace_back("stamp_ns", cell(header->value("stamp", Json())));
    begin.emplace_back("frame", cell(header->value("frame", Json(""))));
    const Json origins = header->value("origins", Json::array());
    if (!origins.empty()) {
      begin.emplace_back("source", cell(origins[0].value("source", Json(""))));
      begin.emplace_back("sequence_number", cell(origins[0].value("sequence_number", Json())));
    }
  }
  std::vector<std::string> lines;
  const auto add = [&](const Json& row) {
    Cells cells = begin;
    add_cells(row, "", cells);
    if (columns_.empty()) {
      for (const auto& [name, value] : cells) columns_.push_back(name);
      lines.push_back(joined(cells, &Cells::value_type::first));
    }
    lines.push_back(joined(cells, &Cells::value_type::second));
  };
  if (const Json* list = list_of(message)) {
    for (const Json& element : *list) add(element);
  } else {
    Json rest = message;
    rest.erase("header");
    add(rest);
  }
  return lines;
}

}  // namespace quoin::deploy
