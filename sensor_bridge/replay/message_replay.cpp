// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/message_replay.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/LineMap.h>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "sensor_bridge/message_files/topic_choice.hpp"
#include "sensor_bridge/recordings/scan_files.hpp"
#include "sensor_bridge/replay/playback_control.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/message_check.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::sensor_bridge {

namespace {

using topics::TopicType;

/// Gives all messages of one stamp of the recording the same stamp of now.
class StampsOfNow {
 public:
  std::int64_t operator()(std::int64_t recorded) {
    const auto known =
        std::ranges::find(given_, recorded, &std::pair<std::int64_t, std::int64_t>::first);
    if (known != given_.end()) return known->second;
    const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
    if (given_.size() == most_stamps) given_.pop_front();
    return given_.emplace_back(recorded, now.count()).second;
  }

 private:
  static constexpr std::size_t most_stamps = 64;  // that stages are behind each other, at most
  std::deque<std::pair<std::int64_t, std::int64_t>> given_;
};

/// Publishes bytes that are a message of the type. False when asked to stop.
using Publish = std::function<bool(std::string_view cdr, const std::function<void(msg::Header&)>&,
                                   runtime::Source&)>;

template <class T>
Publish publisher() {
  return [message = std::make_shared<T>()](std::string_view cdr, const auto& adapt,
                                           runtime::Source& source) {
    const auto* bytes = reinterpret_cast<const std::byte*>(cdr.data());
    if (!topics::decode(topics::cdr_codec<T>(), bytes, cdr.size(), message.get())) {
      throw ScanFileError("its bytes are no message of that type");
    }
    adapt(message->header());
    return source.publish_also(*message);
  };
}

struct Replayed {
  std::string_view type;  // of the table of topic types
  Publish (*make)();
};
constexpr std::array replayed{
    Replayed{"scan", publisher<msg::Scan>},       Replayed{"segments", publisher<msg::Segments>},
    Replayed{"lines", publisher<msg::Lines>},     Replayed{"corners", publisher<msg::Corners>},
    Replayed{"circles", publisher<msg::Circles>}, Replayed{"odometry", publisher<msg::Odometry>},
    Replayed{"pose", publisher<msg::Pose>},       Replayed{"line_map", publisher<msg::LineMap>}};

std::vector<std::string> types_of(const ReplayParameters& parameters) {
  std::vector<std::string> types = list_entries(parameters.messages);
  if (parameters.odometry) types.emplace_back("odometry");
  return types;
}

/// The messages of the files, one file after the other.
class RecordedMessages {
 public:
  RecordedMessages(const ReplayParameters& parameters, const std::filesystem::path& path)
      : parameters_(parameters), files_(list_scan_files(path)) {
    for (const std::string& type : types_of(parameters)) {
      const auto row = std::ranges::find(replayed, type, &Replayed::type);
      types_.push_back({topics::find_topic_type(type), row->make(), {}});
    }
    open(0);
  }

  /// False after the last, or when asked to stop. Throws ScanFileError.
  bool publish_next(PlaybackControl& control, runtime::Source& source) {
    FileMessage message;
    while (true) {
      if (!file_->next(message)) {
        if (index_ + 1 == files_.size()) return false;
        open(index_ + 1);
        continue;
      }
      if (!first_time_) first_time_ = message.log_time;
      if (static_cast<double>(message.log_time - *first_time_) * 1e-9 < parameters_.start) continue;
      const auto type = std::ranges::find(types_, message.topic->name, &Type::topic);
      if (type == types_.end() || message.topic->type != type->row->dds_type) continue;
      const std::span bytes(reinterpret_cast<const std::byte*>(message.data.data()),
                            message.data.size());
      const topics::MessageCheck* check = topics::message_check(type->row->dds_type);
      if (const auto wrong = check->refusal(bytes)) file_->fail(message, *wrong);
      control.note_progress(progress());
      if (!control.wait_for(message.log_time)) return false;
      const auto adapt = [&](msg::Header& header) {
        if (parameters_.stamps == ReplayStamps::recorded) return;
        header.stamp(stamps_(header.stamp()));
      };
      try {
        return type->publish(message.data, adapt, source);
      } catch (const ScanFileError& error) {
        file_->fail(message, error.what());
      }
    }
  }

  void rewind() { open(0); }

 private:
  struct Type {
    const TopicType* row;
    Publish publish;
    std::string topic;  // of the file that is open
  };

  void open(std::size_t index) {
    index_ = index;
    if (index == 0) first_time_.reset();
    const std::filesystem::path& path = files_[index];
    const TopicChoice choice(path, parameters_.topic);
    for (Type& type : types_) {
      const std::string what =
          "messages '" + std::string(type.row->name) + "' of a recording of ours";
      const auto topic = choice.find(
          [&](const FileTopic& each) {
            return each.type == type.row->dds_type && each.encoding == "cdr";
          },
          what);
      if (!topic) choice.fail_without(what);
      type.topic = *topic;
    }
    file_ = open_message_file(path);
  }

  [[nodiscard]] std::optional<double> progress() const {
    const auto in_file = file_->progress();
    if (!in_file) return std::nullopt;
    return (static_cast<double>(index_) + *in_file) / static_cast<double>(files_.size());
  }

  ReplayParameters parameters_;
  std::vector<std::filesystem::path> files_;
  std::vector<Type> types_;
  std::unique_ptr<MessageFile> file_;
  std::size_t index_ = 0;  // of the file that is open
  std::optional<std::int64_t> first_time_;
  StampsOfNow stamps_;
};

void publish_messages(RecordedMessages& messages, const ReplayParameters& parameters,
                      runtime::Source& source) try {
  PlaybackControl control(parameters, source);
  std::int64_t in_this_round = 0;
  for (std::int64_t count = 0; parameters.scans == 0 || count < parameters.scans; ++count) {
    if (messages.publish_next(control, source)) {
      ++in_this_round;
      continue;
    }
    if (!parameters.loop || in_this_round == 0) return;
    if (!source.wait_until(std::chrono::steady_clock::now())) return;
    messages.rewind();
    in_this_round = 0;
    --count;
  }
} catch (const ScanFileError& error) {
  throw runtime::SourceError(error.what());
}

}  // namespace

bool replays_messages(const ReplayParameters& parameters) {
  const std::vector<std::string> types = list_entries(parameters.messages);
  if (types.empty()) throw ParameterError("messages", "names no type, such as scan or lines");
  std::vector<std::string> known;
  for (const Replayed& row : replayed) {
    if (row.type != "odometry") known.emplace_back(row.type);
  }
  for (const std::string& type : types) {
    if (type == "odometry") {
      throw ParameterError("messages", "odometry is published by odometry: true");
    }
    if (std::ranges::count(known, type) == 0) {
      throw ParameterError("messages", "'" + type + "' is no type" + suggestion(type, known));
    }
    if (std::ranges::count(types, type) > 1) {
      throw ParameterError("messages", "names " + type + " twice");
    }
  }
  return types.size() > 1 || types.front() != "scan";
}

std::function<void(runtime::Source&)> open_message_replay(
    const ReplayParameters& parameters, const std::filesystem::path& base_directory) {
  const auto messages =
      std::make_shared<RecordedMessages>(parameters, base_directory / parameters.path);
  return [parameters, messages](runtime::Source& source) {
    publish_messages(*messages, parameters, source);
  };
}

}  // namespace quoin::sensor_bridge
