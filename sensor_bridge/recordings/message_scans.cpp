// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/message_scans.hpp"

#include <optional>
#include <utility>

#include "sensor_bridge/message_files/topic_choice.hpp"
#include "sensor_bridge/recordings/laser_scan_message.hpp"
#include "sensor_bridge/recordings/odometry_message.hpp"

namespace quoin::sensor_bridge {

namespace {

class MessageScans final : public ScanReader {
 public:
  MessageScans(const std::filesystem::path& file, const ReplayParameters& parameters)
      : choice_(file, parameters.topic), file_(open_message_file(file)), start_(parameters.start) {
    const auto scans = choice_.find(
        [](const FileTopic& topic) { return scan_message(topic.type, topic.encoding).has_value(); },
        "scans");
    if (!scans) choice_.fail_without("scans");
    scans_ = *scans;
    if (!parameters.odometry) return;
    odometry_ = choice_.find(
        [](const FileTopic& topic) {
          return odometry_message(topic.type, topic.encoding).has_value();
        },
        "odometry");
  }

  bool next(RecordedScan& scan) override {
    std::vector<RecordedOdometry> odometry;
    while (file_->next(message_)) {
      if (!first_time_) first_time_ = message_.log_time;
      const FileTopic& topic = *message_.topic;
      if (topic.name != scans_ && topic.name != odometry_) continue;
      if (static_cast<double>(message_.log_time - *first_time_) * 1e-9 < start_) continue;
      if (topic.name == odometry_) {
        const auto kind = odometry_message(topic.type, topic.encoding);
        if (!kind) continue;  // another channel of that name
        add(*kind, odometry.emplace_back());
        continue;
      }
      const auto kind = scan_message(topic.type, topic.encoding);
      if (!kind) fail("topic '" + scans_ + "' holds no scans, but " + topic.type);
      const std::string wrong = read_scan_message(*kind, message_.data, scan);
      if (!wrong.empty()) file_->fail(message_, wrong);
      scan.odometry = std::move(odometry);
      return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& what) const override { choice_.fail(what); }
  [[nodiscard]] std::optional<double> progress() const override { return file_->progress(); }

 private:
  void add(OdometryMessage kind, RecordedOdometry& odometry) {
    const std::string wrong = read_odometry_message(kind, message_.data, odometry);
    if (!wrong.empty()) file_->fail(message_, wrong);
  }

  TopicChoice choice_;
  std::unique_ptr<MessageFile> file_;
  std::string scans_;                    // topic
  std::optional<std::string> odometry_;  // topic
  double start_;
  std::optional<std::int64_t> first_time_;
  FileMessage message_;
};

}  // namespace

std::unique_ptr<ScanReader> open_message_scans(const std::filesystem::path& file,
                                               const ReplayParameters& parameters) {
  return std::make_unique<MessageScans>(file, parameters);
}

}  // namespace quoin::sensor_bridge
