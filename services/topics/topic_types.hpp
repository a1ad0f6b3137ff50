// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace quoin::topics {

/// A type of message that services exchange. A new type is a file in idl/ and a row of the table;
/// its JSON is made of the IDL, and so is its text, unless message_text.cpp has a better one.
struct TopicType {
  std::string_view name;      ///< last part of a topic's name: "scan"
  std::string_view dds_type;  ///< full name of the structure in the IDL: "quoin::msg::Scan"
  std::string_view qos;       ///< preset of its topics unless the deployment names another
  std::string_view idl;       ///< file that declares it: "Scan.idl"; see idl_text
};

/// The table.
[[nodiscard]] std::span<const TopicType> topic_types();

/// Null when there is no such row.
[[nodiscard]] const TopicType* find_topic_type(std::string_view name);
[[nodiscard]] const TopicType* find_topic_type_by_dds_type(std::string_view dds_type);

/// A file of idl/ with the files that it includes in place of its #include lines: a complete
/// declaration of its types, as a recording keeps it.
struct IdlFile {
  std::string_view name;  ///< "Scan.idl"
  std::string_view text;
};

/// All files of idl/, as they were when this program was built.
[[nodiscard]] std::span<const IdlFile> idl_files();

/// Empty when there is no such file.
[[nodiscard]] std::string_view idl_text(std::string_view file);

}  // namespace quoin::topics
