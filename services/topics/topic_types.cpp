// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/topic_types.hpp"

#include <array>

namespace quoin::topics {

std::span<const TopicType> topic_types() {
  static constexpr std::array<TopicType, 4> all{{{"scan", "quoin::msg::Scan", "sensor"},
                                                 {"segments", "quoin::msg::Segments", "feature"},
                                                 {"lines", "quoin::msg::Lines", "feature"},
                                                 {"corners", "quoin::msg::Corners", "feature"}}};
  return all;
}

const TopicType* find_topic_type(std::string_view name) {
  for (const TopicType& type : topic_types()) {
    if (type.name == name) return &type;
  }
  return nullptr;
}

}  // namespace quoin::topics
