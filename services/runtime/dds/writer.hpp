// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/topics/cdr_codec.hpp"

namespace quoin::runtime {

class WriterBase {
 public:
  ~WriterBase();
  WriterBase(const WriterBase&) = delete;
  WriterBase& operator=(const WriterBase&) = delete;

  /// Readers matched now.
  [[nodiscard]] std::size_t matched() const;
  /// True once `count` readers are matched; false after `timeout`.
  [[nodiscard]] bool wait_for_readers(std::size_t count, std::chrono::milliseconds timeout) const;
  /// True once all matched readers have everything; false after `timeout`.
  bool wait_for_acknowledgments(std::chrono::milliseconds timeout);
  /// Tells the readers of a topic with strengths that this writer still lives; writing does, too.
  void assert_liveliness();
  /// Names of the participants that announced that they observe this topic and have no matched
  /// reader yet; without those whose reader does not fit. To be waited for before the first
  /// message, see Participant::discovery_settled.
  [[nodiscard]] std::vector<std::string> awaited_observers() const;
  /// Names of the participants of matched readers that have been silent for longer than their
  /// lease; DDS then drops them. For a writer that is blocked, once a second: readers answer a
  /// blocked writer as long as they live, but an idle one hears from nobody.
  [[nodiscard]] std::vector<std::string> check_silent_readers();
  /// Readers of this topic that do not fit, each with topic, policy and both sides' values.
  [[nodiscard]] std::vector<std::string> incompatible_qos() const;

  struct Impl;

 protected:
  /// `codec` is null for raw messages.
  WriterBase(Participant& participant, const std::string& topic, const std::string& type_name,
             const topics::CdrCodec* codec, const TopicQos& qos);
  /// False when the sample could not be taken (lossless: the history stayed full for a second).
  bool write_sample(const void* message, const topics::CdrCodec* codec);

 private:
  std::unique_ptr<Impl> impl_;
};

/// Writes messages of one of the idl types to a topic. Throws std::runtime_error when DDS refuses
/// to create the entities. One thread at a time writes.
template <class T>
class Writer : public WriterBase {
 public:
  Writer(Participant& participant, const std::string& topic, const TopicQos& qos)
      : WriterBase(participant, topic, topics::cdr_codec<T>().type_name, &topics::cdr_codec<T>(),
                   qos) {}
  bool write(const T& message) { return write_sample(&message, &topics::cdr_codec<T>()); }
};

/// Writes messages of any type without key, as bytes. Throws std::runtime_error when DDS refuses to
/// create the entities. One thread at a time writes.
class RawWriter : public WriterBase {
 public:
  RawWriter(Participant& participant, const std::string& topic, const std::string& dds_type,
            const TopicQos& qos)
      : WriterBase(participant, topic, dds_type, nullptr, qos) {}
  /// Only the bytes are sent, filled up with zeros to a multiple of four; the times are those of
  /// now. False, too, when they do not begin as XCDR1 does; the rest is not checked.
  bool write(const topics::RawMessage& message);
};

}  // namespace quoin::runtime
