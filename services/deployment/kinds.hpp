// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/parameters/method_list.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// Message types that services exchange.
enum class MessageType { none, scan, segments, lines, corners };

[[nodiscard]] std::string_view message_name(MessageType type);  ///< "scan", "segments", ...

/// A kind of service: which program it is, what it reads and writes, what can be set.
struct KindInfo {
  std::string name;
  std::string description;
  std::string program;  ///< file name of the executable
  MessageType input = MessageType::none;
  MessageType output = MessageType::none;
  std::string qos;                        ///< default preset of the output topic
  std::vector<MethodInfo> methods;        ///< empty for sources
  std::vector<ParameterInfo> parameters;  ///< of the kind itself; empty where methods have them
};

/// All kinds, sources first. A new kind is one more entry.
[[nodiscard]] const std::vector<KindInfo>& kinds();
/// Null when there is no such kind.
[[nodiscard]] const KindInfo* find_kind(std::string_view name);
/// Parameters that a service of this kind and method takes.
[[nodiscard]] const std::vector<ParameterInfo>& parameters_of(const KindInfo& kind,
                                                              std::string_view method);

}  // namespace quoin
