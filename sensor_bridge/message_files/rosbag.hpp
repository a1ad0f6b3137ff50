// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sensor_bridge/message_files/binary_file.hpp"
#include "sensor_bridge/message_files/message_file.hpp"

namespace quoin::sensor_bridge {

inline constexpr std::string_view rosbag_magic = "#ROSBAG V2.0\n";

/// A bag of ROS 1, format 2.0 (http://wiki.ros.org/Bags/Format/2.0), whose chunks are not
/// compressed, or by bz2 or lz4. Memory is bounded by one chunk.
class Rosbag final : public MessageFile {
 public:
  explicit Rosbag(const std::filesystem::path& file);

  [[nodiscard]] bool next(FileMessage& message) override;
  [[nodiscard]] std::map<std::string, FileTopic> topics() const override;
  void skip_until(std::int64_t time) override { skip_until_ = time; }
  [[nodiscard]] std::optional<double> progress() const override {
    return static_cast<double>(offset_) / static_cast<double>(file_.size());
  }

 private:
  using Fields = std::map<std::string_view, std::string_view>;
  struct Record {
    Fields header;
    std::string_view data;
    std::uint64_t size = 0;  // of all of it
  };

  [[nodiscard]] Record parse(std::string_view bytes) const;
  [[nodiscard]] bool read_record(std::uint64_t offset);
  template <class T>
  [[nodiscard]] T number(const Fields& header, std::string_view name) const;
  void add_connection(const Record& record);
  void open_chunk(const Record& record);
  [[nodiscard]] bool message_of(const Record& record, FileMessage& message);

  BinaryFile file_;
  std::uint64_t offset_;
  std::uint64_t record_offset_ = 0;
  std::string bytes_;
  std::string chunk_;
  std::size_t in_chunk_ = 0;
  std::map<std::uint32_t, FileTopic> connections_;
  std::int64_t skip_until_ = 0;
};

}  // namespace quoin::sensor_bridge
