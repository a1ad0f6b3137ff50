// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace quoin::ros2 {

/// The .msg file of a type.
struct Definition {
  std::string_view type;  ///< "geometry_msgs/Pose"
  std::string_view text;
};

/// Those of idl/ros2/quoin_msgs.
[[nodiscard]] std::span<const Definition> own_definitions();

/// The fields of a type ("geometry_msgs/msg/Pose") and, behind it, those of all types that it is
/// made of, as a recording of ROS 2 keeps them (encoding ros2msg): without constants and comments,
/// types with their packages. "" for a type that none of our kinds reads or writes.
[[nodiscard]] std::string definition(std::string_view type);

}  // namespace quoin::ros2
