// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "sensor_bridge/message_files/message_file.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace quoin::sensor_bridge {

/// A bag of ROS 2 in SQLite (.db3). Its messages come in the order of their times.
class Rosbag2 final : public MessageFile {
 public:
  explicit Rosbag2(const std::filesystem::path& file);
  ~Rosbag2() override;

  [[nodiscard]] bool next(FileMessage& message) override;
  [[nodiscard]] std::map<std::string, FileTopic> topics() const override;
  void skip_until(std::int64_t time) override { skip_until_ = time; }

 private:
  struct Close {
    void operator()(sqlite3* base) const;
    void operator()(sqlite3_stmt* statement) const;
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;

  [[nodiscard]] Statement prepare(const char* text) const;
  [[nodiscard]] bool step(sqlite3_stmt& statement) const;

  std::unique_ptr<sqlite3, Close> base_;
  Statement messages_;
  std::map<std::int64_t, FileTopic> topics_;  // by id
  std::int64_t skip_until_ = 0;
  bool ended_ = false;
};

}  // namespace quoin::sensor_bridge
