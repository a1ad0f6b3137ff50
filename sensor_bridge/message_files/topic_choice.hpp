// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sensor_bridge/message_files/message_file.hpp"

namespace quoin::sensor_bridge {

/// Which topics of a recording are meant.
class TopicChoice {
 public:
  using Fits = std::function<bool(const FileTopic&)>;

  /// `names`: topics, with commas between; "": whichever is the only one of what is looked for.
  /// Reads the whole file where its topics do not stand at its end. Throws ScanFileError when the
  /// file cannot be opened.
  TopicChoice(const std::filesystem::path& file, const std::string& names);

  /// The one that fits; nothing when there is none. Throws ScanFileError when there are several.
  /// `what`: what they hold, "scans".
  [[nodiscard]] std::optional<std::string> find(const Fits& fits, const std::string& what) const;

  /// Throws ScanFileError, with all topics and their types.
  [[noreturn]] void fail(const std::string& what) const;
  /// When find() finds nothing that has to be there.
  [[noreturn]] void fail_without(const std::string& what) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::map<std::string, FileTopic> topics_;
};

}  // namespace quoin::sensor_bridge
