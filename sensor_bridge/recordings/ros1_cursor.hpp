// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace quoin::sensor_bridge {

/// Values one behind the other, little-endian, as ROS 1 writes them, with the functions of
/// topics::CdrCursor. Throws std::runtime_error where the bytes end.
class Ros1Cursor {
 public:
  explicit Ros1Cursor(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  [[nodiscard]] T primitive() {
    T value{};
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  [[nodiscard]] std::string_view string(std::size_t) { return take(primitive<std::uint32_t>()); }
  [[nodiscard]] std::size_t sequence_length(std::size_t) { return primitive<std::uint32_t>(); }
  void floats(std::size_t count, std::vector<float>& out) {
    const std::string_view bytes = take(count * sizeof(float));
    out.resize(count);
    if (count > 0) std::memcpy(out.data(), bytes.data(), bytes.size());
  }
  void finish() const {
    if (!bytes_.empty())
      throw std::runtime_error(std::to_string(bytes_.size()) + " bytes too many");
  }

 private:
  std::string_view take(std::size_t count) {
    if (bytes_.size() < count) throw std::runtime_error("it is cut off");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view bytes_;
};

/// Where a message of ROS says that it belongs: time [ns since the Unix epoch] and frame.
struct RosHeader {
  std::int64_t stamp = 0;
  std::string_view frame;
};

/// std_msgs/Header; that of ROS 1 begins with a number. `Cursor`: Ros1Cursor or CdrCursor.
template <class Cursor>
[[nodiscard]] RosHeader read_ros_header(Cursor& cursor, bool numbered) {
  if (numbered) (void)cursor.template primitive<std::uint32_t>();
  const auto seconds = cursor.template primitive<std::uint32_t>();
  const auto nanoseconds = cursor.template primitive<std::uint32_t>();
  return {std::int64_t{seconds} * 1'000'000'000 + nanoseconds, cursor.string(0)};
}

}  // namespace quoin::sensor_bridge
