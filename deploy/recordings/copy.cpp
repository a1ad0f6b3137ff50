// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/recordings/copy.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <system_error>
#include <tuple>

#include "sensor_bridge/message_files/mcap_reader.hpp"
#include "sensor_bridge/message_files/mcap_writer.hpp"

namespace quoin::deploy {

namespace {

namespace fs = std::filesystem;
namespace mcap = sensor_bridge::mcap;
using sensor_bridge::ScanFileError;

constexpr std::uint64_t messages_between_questions = 256;

/// One of the inputs, with the message that comes next.
class Input {
 public:
  Input(const fs::path& file, bool recover, std::vector<std::string>& damages)
      : reader_(file), recover_(recover), damages_(damages) {
    advance();
  }

  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] const mcap::RecordedMessage& message() const { return message_; }
  [[nodiscard]] const mcap::Reader& reader() const { return reader_; }
  void advance() {
    while (true) {
      try {
        ended_ = !reader_.next(message_);
        return;
      } catch (const ScanFileError& error) {
        if (!recover_) throw;
        damages_.emplace_back(error.what());
        if (!reader_.resume()) {
          ended_ = true;
          return;
        }
      }
    }
  }

 private:
  mcap::Reader reader_;
  bool recover_;
  std::vector<std::string>& damages_;
  mcap::RecordedMessage message_;
  bool ended_ = false;
};

/// The output, which gets each schema and channel once.
class Output {
 public:
  explicit Output(const fs::path& file)
      : part_(file.string() + ".part"), writer_(file, mcap::WriterOptions{}) {}
  ~Output() {
    std::error_code ignored;
    if (!finished_) fs::remove(part_, ignored);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void write(const mcap::RecordedMessage& message) {
    writer_.write({channel(message),
                   message.sequence,
                   message.log_time,
                   message.publish_time,
                   {message.data}});
  }
  void add_metadata(const mcap::Metadata& metadata) {
    if (metadata_.insert({metadata.name, metadata.entries}).second) {
      writer_.add_metadata(metadata.name, metadata.entries);
    }
  }
  void add_attachment(const mcap::AttachmentIndex& index, const std::string& data) {
    writer_.add_attachment(index.name, index.media_type, data, index.log_time);
  }
  void finish() {
    writer_.finish();
    finished_ = true;
    if (writer_.dropped() > 0) {
      throw mcap::WriteError("the disk is full: " + std::to_string(writer_.dropped()) +
                             " messages are not in '" + writer_.path().string() + "'");
    }
  }

 private:
  std::uint16_t channel(const mcap::RecordedMessage& message) {
    const auto known = by_address_.find(message.channel);
    if (known != by_address_.end()) return known->second;
    std::uint16_t schema = 0;
    if (message.schema != nullptr) {
      const mcap::Schema& described = *message.schema;
      const auto [entry, added] =
          schemas_.try_emplace({described.name, described.encoding, described.data}, 0);
      if (added) {
        entry->second = writer_.add_schema(described.name, described.encoding, described.data);
      }
      schema = entry->second;
    }
    const mcap::Channel& described = *message.channel;
    const auto [entry, added] =
        channels_.try_emplace({described.topic, described.message_encoding, schema}, 0);
    if (added) {
      entry->second = writer_.add_channel(schema, described.topic, described.message_encoding,
                                          described.metadata);
    }
    return by_address_[message.channel] = entry->second;
  }

  fs::path part_;
  mcap::Writer writer_;
  bool finished_ = false;
  std::map<const mcap::Channel*, std::uint16_t> by_address_;
  std::map<std::tuple<std::string, std::string, std::string>, std::uint16_t> schemas_;
  std::map<std::tuple<std::string, std::string, std::uint16_t>, std::uint16_t> channels_;
  std::map<std::string, mcap::Text> metadata_;
};

void copy_rest(const Input& input, Output& output, bool recover) {
  for (const mcap::Metadata& metadata : input.reader().metadata()) output.add_metadata(metadata);
  try {
    if (const auto summary = input.reader().summary()) {
      for (const mcap::AttachmentIndex& index : summary->attachments) {
        output.add_attachment(index, input.reader().attachment_at(index));
      }
    }
  } catch (const ScanFileError&) {
    if (!recover) throw;  // the messages are what matters
  }
}

}  // namespace

CopyOutcome copy_messages(const CopyRequest& request,
                          const std::function<bool(std::uint64_t messages)>& go_on) {
  CopyOutcome outcome;
  std::vector<std::unique_ptr<Input>> inputs;
  for (const fs::path& file : request.inputs) {
    inputs.push_back(std::make_unique<Input>(file, request.recover, outcome.damages));
  }
  Output output(request.output);
  const auto next = [&]() -> Input* {
    Input* earliest = nullptr;
    for (const auto& input : inputs) {
      if (input->ended()) continue;
      if (earliest == nullptr || input->message().log_time < earliest->message().log_time) {
        earliest = input.get();
      }
    }
    return earliest;
  };
  const Input* first = next();
  const std::uint64_t start = first == nullptr ? 0 : first->message().log_time;
  for (std::uint64_t count = 0; Input* input = next(); ++count) {
    const std::uint64_t time = input->message().log_time;
    const double seconds = time < start ? 0.0 : static_cast<double>(time - start) * 1e-9;
    if (seconds >= request.from && seconds <= request.to) {
      output.write(input->message());
      ++outcome.messages;
    }
    input->advance();
    if (count % messages_between_questions == 0 && !go_on(outcome.messages)) {
      outcome.interrupted = true;
      return outcome;
    }
  }
  for (const auto& input : inputs) copy_rest(*input, output, request.recover);
  output.finish();
  return outcome;
}

}  // namespace quoin::deploy
