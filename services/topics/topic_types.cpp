// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/topic_types.hpp"

#include <algorithm>
#include <array>

namespace quoin::topics {

namespace {

constexpr std::array table{
    TopicType{"scan", "quoin::msg::Scan", "sensor", "Scan.idl"},
    TopicType{"segments", "quoin::msg::Segments", "feature", "Segments.idl"},
    TopicType{"lines", "quoin::msg::Lines", "feature", "Lines.idl"},
    TopicType{"corners", "quoin::msg::Corners", "feature", "Corners.idl"},
    TopicType{"circles", "quoin::msg::Circles", "feature", "Circles.idl"},
    TopicType{"odometry", "quoin::msg::Odometry", "feature", "Odometry.idl"},
    TopicType{"pose", "quoin::msg::Pose", "feature", "Pose.idl"},
    TopicType{"line_map", "quoin::msg::LineMap", "state", "LineMap.idl"},
};

const TopicType* find(std::string_view TopicType::*column, std::string_view value) {
  const auto row = std::ranges::find(table, value, column);
  return row == table.end() ? nullptr : &*row;
}

}  // namespace

std::span<const TopicType> topic_types() { return table; }

const TopicType* find_topic_type(std::string_view name) { return find(&TopicType::name, name); }

const TopicType* find_topic_type_by_dds_type(std::string_view dds_type) {
  return find(&TopicType::dds_type, dds_type);
}

std::string_view idl_text(std::string_view file) {
  const auto files = idl_files();
  const auto found = std::ranges::find(files, file, &IdlFile::name);
  return found == files.end() ? std::string_view() : found->text;
}

}  // namespace quoin::topics
