// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/geometry/pose.hpp"

namespace quoin::topics {

/// A Foxglove message that shows a message of one type to viewers. A new type gets its views in a
/// row of the table in views.cpp.
struct View {
  std::string_view name;    ///< last part of the topic that shows it: "points"
  std::string_view schema;  ///< such as foxglove.PointCloud
  /// Appends the message to `out`; false when this one has no such view. `message` is of the
  /// generated type.
  bool (*append)(const void* message, std::string& out);
};

/// The views of messages of one type.
class Views {
 public:
  /// `type`: of the table of topic types, such as "scan". One without views has none.
  explicit Views(std::string_view type);
  ~Views();
  Views(Views&&) noexcept;
  Views& operator=(Views&&) noexcept;

  [[nodiscard]] std::span<const View> list() const { return views_; }
  /// Reads the message to be shown, which anybody may have sent. False when it is none of the type.
  [[nodiscard]] bool read(std::span<const std::byte> cdr);
  /// Appends what list()[view] shows of the message read last. False when it shows nothing of it.
  [[nodiscard]] bool append(std::size_t view, std::string& out) const;

 private:
  struct Message;

  std::span<const View> views_;
  std::unique_ptr<Message> message_;
};

/// A foxglove.FrameTransform: where the frame `child` stands in the frame `parent`. Viewers show
/// only what is in a frame that one of these names.
[[nodiscard]] std::string frame_transform(std::string_view parent, std::string_view child,
                                          std::int64_t stamp, const Pose2& pose);
inline constexpr std::string_view frame_transform_schema = "foxglove.FrameTransform";

}  // namespace quoin::topics
