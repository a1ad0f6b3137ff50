// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/recorder/recording.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <ctime>
#include <idl/LineMap.h>
#include <idl/Status.h>
#include <system_error>

#include "services/topics/cdr_codec.hpp"
#include "services/topics/protobuf/schemas.hpp"

namespace quoin {

namespace {

namespace fs = std::filesystem;
using sensor_bridge::mcap::WriteError;
using sensor_bridge::mcap::Writer;

struct Unit {
  std::string_view name;
  double seconds;
  double bytes;
};
constexpr std::array units{Unit{"s", 1, 0},           Unit{"min", 60, 0}, Unit{"h", 3600, 0},
                           Unit{"MB", 0, 1e6},        Unit{"GB", 0, 1e9}, Unit{"MiB", 0, 1048576},
                           Unit{"GiB", 0, 1073741824}};

/// run.mcap, run_2.mcap, run_3.mcap ...
fs::path numbered(const fs::path& base, int number) {
  if (number == 1) return base;
  return base.parent_path() /
         (base.stem().string() + "_" + std::to_string(number) + base.extension().string());
}

bool is_taken(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored)) ||
         fs::exists(fs::symlink_status(file.string() + ".part", ignored));
}

std::string utc_time() {
  const std::time_t now = std::time(nullptr);
  std::tm fields{};
  ::gmtime_r(&now, &fields);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H-%M-%SZ", &fields);
  return text.data();
}

}  // namespace

fs::path recording_file(const fs::path& path) {
  if (path.filename().empty() || fs::is_directory(path)) return path / (utc_time() + ".mcap");
  if (path.extension() != ".mcap") {
    throw ParameterError(
        "path", "'" + path.string() + "' must end with .mcap, or with / when it is a folder");
  }
  return path;
}

Split parse_split(std::string_view text) {
  if (text.empty()) return {};
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string_view suffix = text.substr(static_cast<std::size_t>(end - text.data()));
  while (suffix.starts_with(' ')) suffix.remove_prefix(1);
  const auto* unit = std::ranges::find(units, suffix, &Unit::name);
  if (error != std::errc() || unit == units.end() || !(number > 0.0) || !(number < 1e9)) {
    throw ParameterError("split", "'" + std::string(text) +
                                      "' is neither a time (10min, 1h) nor a size (500MB, 1GB)");
  }
  return {number * unit->seconds, static_cast<std::uint64_t>(number * unit->bytes)};
}

Recording::Recording(const fs::path& path, const RecorderParameters& parameters,
                     std::vector<RecordedTopic> topics, RunFacts facts)
    : parameters_(parameters),
      base_(recording_file(path)),
      split_(parse_split(parameters.split)),
      facts_(std::move(facts)) {
  for (RecordedTopic& topic : topics) {
    Topic& added =
        topics_.emplace_back(Topic{std::move(topic), std::nullopt, topics::Views(""), {}, {}});
    if (parameters_.content == RecordedContent::cdr) continue;
    if (added.described.type != &heartbeat_type) {
      added.encoder.emplace(added.described.type->dds_type);
    }
    added.views = topics::Views(added.described.type->name);
  }
  std::error_code ignored;
  fs::create_directories(base_.parent_path(), ignored);  // what is wrong shows when it is opened
  check_room();
  open();
}

void Recording::open() {
  do {
    ++number_;
  } while (is_taken(numbered(base_, number_)));
  writer_ = std::make_unique<Writer>(
      numbered(base_, number_),
      sensor_bridge::mcap::WriterOptions{.compression = parameters_.compression});
  schemas_.clear();
  transforms_ = 0;
  frames_.clear();
  opened_at_ = 0;
  for (Topic& topic : topics_) topic.channels = {};
  for (const auto& [name, entries] : facts_.metadata) writer_->add_metadata(name, entries);
  if (!facts_.deployment_text.empty()) {
    writer_->add_attachment(facts_.deployment_name, "application/yaml", facts_.deployment_text,
                            static_cast<std::uint64_t>(std::time(nullptr)) * 1'000'000'000U);
  }
}

std::uint16_t Recording::schema(std::string_view name, std::string_view encoding,
                                std::string_view idl) {
  const auto [entry, added] =
      schemas_.try_emplace(std::string(encoding) + ' ' + std::string(name), 0);
  if (added) {
    entry->second = writer_->add_schema(
        std::string(name), std::string(encoding),
        encoding == "protobuf" ? topics::protobuf_descriptor_set(name) : std::string(idl));
  }
  return entry->second;
}

void Recording::write(const MessageToRecord& message) {
  const std::int64_t log_time = message.received;
  split_if_due(log_time);
  if (opened_at_ == 0) opened_at_ = log_time;
  Topic& topic = topics_.at(message.topic);
  write_to_file(topic, message, log_time);
  if (topic.described.qos == "state") topic.last[key_of(topic, message)] = message;
}

/// Of the instance that the message is of: late readers get the newest of each.
std::string Recording::key_of(const Topic& topic, const MessageToRecord& message) {
  if (topic.described.type == &heartbeat_type) {
    msg::ServiceStatus status;
    (void)topics::decode(topics::cdr_codec<msg::ServiceStatus>(), message.cdr.data(),
                         message.cdr.size(), &status);
    return status.service();
  }
  if (topic.described.type->name != "line_map") return "";
  msg::LineMap map;
  if (!topics::decode(topics::cdr_codec<msg::LineMap>(), message.cdr.data(), message.cdr.size(),
                      &map)) {
    return "";
  }
  return std::to_string(map.part());
}

void Recording::split_if_due(std::int64_t now) {
  const bool late = split_.seconds > 0.0 && opened_at_ != 0 &&
                    static_cast<double>(now - opened_at_) * 1e-9 >= split_.seconds;
  const bool large = split_.bytes > 0 && writer_->size() >= split_.bytes;
  if (!late && !large) return;
  finish({});
  open();
  opened_at_ = now;
  for (Topic& topic : topics_) {
    for (const auto& [key, message] : topic.last) write_to_file(topic, message, now);
  }
}

void Recording::write_to_file(Topic& topic, const MessageToRecord& message, std::int64_t log_time) {
  const RecordedTopic& described = topic.described;
  const std::map<std::string, std::string> metadata{{"service", described.service},
                                                    {"type", std::string(described.type->name)},
                                                    {"qos", described.qos}};
  sensor_bridge::mcap::Message record{
      0,
      static_cast<std::uint32_t>(message.sequence_number),
      static_cast<std::uint64_t>(log_time),
      static_cast<std::uint64_t>(message.published == 0 ? log_time : message.published),
      {}};
  const auto write = [&](std::uint16_t& channel, const std::string& name,
                         std::string_view schema_name, std::string_view encoding,
                         std::string_view data) {
    if (channel == 0) {
      const bool cdr = encoding == "cdr";
      channel = writer_->add_channel(
          schema(schema_name, cdr ? "omgidl" : "protobuf",
                 cdr ? topics::idl_text(described.type->idl) : std::string_view()),
          name, std::string(encoding), metadata);
    }
    record.channel_id = channel;
    record.data = {data};
    writer_->write(record);
  };
  Channels& channels = topic.channels;
  if (parameters_.content != RecordedContent::protobuf) {
    write(channels.cdr, described.topic, described.type->dds_type, "cdr",
          {reinterpret_cast<const char*>(message.cdr.data()), message.cdr.size()});
  }
  if (topic.encoder) {
    buffer_.clear();
    try {
      topic.encoder->encode(message.cdr, buffer_);
    } catch (const topics::CdrError&) {
      return;  // no message of its type: the CDR keeps what came
    }
    write(channels.protobuf, described.topic + "/protobuf",
          topics::protobuf_name(described.type->dds_type), "protobuf", buffer_);
  }
  if (topic.views.list().empty() || !topic.views.read(message.cdr)) return;
  write_frame(message, log_time);
  channels.views.resize(topic.views.list().size(), 0);
  for (std::size_t i = 0; i < topic.views.list().size(); ++i) {
    buffer_.clear();
    if (!topic.views.append(i, buffer_)) continue;
    const topics::View& view = topic.views.list()[i];
    write(channels.views[i], described.topic + "/" + std::string(view.name), view.schema,
          "protobuf", buffer_);
  }
}

/// Viewers show what is in a frame only when a transform names it. This one leaves it free to have
/// a parent: where the sensor is, a pose may tell.
void Recording::write_frame(const MessageToRecord& message, std::int64_t log_time) {
  if (message.frame.empty() || frames_.contains(message.frame)) return;
  frames_.insert(message.frame);
  if (transforms_ == 0) {
    transforms_ =
        writer_->add_channel(schema(topics::frame_transform_schema, "protobuf"), "tf", "protobuf");
  }
  const std::string transform =
      topics::frame_transform(message.frame, message.frame + "/origin", message.stamp, Pose2());
  const auto time = static_cast<std::uint64_t>(log_time);
  writer_->write({transforms_, 0, time, time, {transform}});
}

void Recording::check_room() const {
  std::error_code error;
  const fs::space_info space =
      fs::space(base_.parent_path().empty() ? "." : base_.parent_path(), error);
  if (error || static_cast<double>(space.available) >= parameters_.keep_free * 1e6) return;
  throw WriteError("the disk of '" + base_.string() + "' has " +
                   std::to_string(space.available / 1'000'000) +
                   " MB left, less than keep_free leaves to others");
}

void Recording::flush() {
  if (writer_->chunk_empty()) return;
  check_room();
  writer_->flush();
}

void Recording::finish(const std::map<std::string, std::map<std::string, std::string>>& last) {
  try {
    writer_->flush();
    for (const auto& [name, entries] : last) writer_->add_metadata(name, entries);
  } catch (const WriteError&) {
    // Without what the disk did not take; the file is whole all the same.
  }
  writer_->finish();
  finished_size_ += writer_->size();
  dropped_ += writer_->dropped();
  files_.push_back(writer_->path());
}

}  // namespace quoin
