// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace quoin::topics {

struct TopicType {
  std::string_view name;
  std::string_view dds_type;
  std::string_view qos;
};

[[nodiscard]] std::span<const TopicType> topic_types();
[[nodiscard]] const TopicType* find_topic_type(std::string_view name);

}  // namespace quoin::topics
