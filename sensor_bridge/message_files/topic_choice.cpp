// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/message_files/topic_choice.hpp"

#include <algorithm>

#include "core/parameters/parameter.hpp"
#include "sensor_bridge/excerpt.hpp"

namespace quoin::sensor_bridge {

TopicChoice::TopicChoice(const std::filesystem::path& file, const std::string& names)
    : file_(file.string()), names_(list_entries(names)) {
  const auto messages = open_message_file(file);
  topics_ = messages->topics();
  if (!topics_.empty()) return;
  FileMessage message;
  try {
    while (messages->next(message)) {
    }
  } catch (const ScanFileError&) {
    // Reported when the messages before it have been read.
  }
  topics_ = messages->topics();
}

std::optional<std::string> TopicChoice::find(const Fits& fits, const std::string& what) const {
  std::optional<std::string> found;
  for (const auto& [name, topic] : topics_) {
    if (!names_.empty() && std::ranges::count(names_, name) == 0) continue;
    if (!fits(topic)) continue;
    if (found) fail("several topics hold " + what + "; name one with 'topic'");
    found = name;
  }
  return found;
}

void TopicChoice::fail_without(const std::string& what) const {
  for (const std::string& name : names_) {
    const auto topic = topics_.find(name);
    if (topic == topics_.end()) fail("there is no topic '" + name + "'");
    if (names_.size() == 1) fail("topic '" + name + "' holds no " + what);
  }
  fail("no topic holds " + what);
}

void TopicChoice::fail(const std::string& what) const {
  std::string text = topics_.empty() ? "; the file has no topics" : "; its topics are ";
  for (const auto& [name, topic] : topics_) {
    const bool plain = topic.encoding == "cdr" || topic.encoding == "ros1";
    text += (name == topics_.begin()->first ? "" : ", ") + name + " (" + topic.type +
            (plain ? "" : " as " + topic.encoding) + ")";
  }
  throw ScanFileError(file_ + ": " + printable(what + text));
}

}  // namespace quoin::sensor_bridge
