// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/topics/cdr_codec.hpp"

namespace quoin::runtime {

class ReaderBase {
 public:
  ~ReaderBase();
  ReaderBase(const ReaderBase&) = delete;
  ReaderBase& operator=(const ReaderBase&) = delete;

  /// Writers matched now.
  [[nodiscard]] std::size_t matched() const;
  [[nodiscard]] bool wait_for_writers(std::size_t count, std::chrono::milliseconds timeout) const;
  /// Writers of this topic that do not fit, each with topic, policy and both sides' values.
  [[nodiscard]] std::vector<std::string> incompatible_qos() const;

  /// Where the message that was taken last came from, as DDS counts.
  struct Sample {
    std::uint64_t writer = 0;           ///< another one for another writer
    std::uint64_t sequence_number = 0;  ///< of the sample among those of that writer, from 1
    std::int64_t sent = 0;              ///< [ns since the Unix epoch], by the writer's clock
    std::int64_t received = 0;          ///< [ns since the Unix epoch], by the clock of this host
  };
  [[nodiscard]] const Sample& last_sample() const { return last_sample_; }

  struct Impl;
  [[nodiscard]] Impl& impl() { return *impl_; }

 protected:
  /// `codec` is null for raw messages.
  ReaderBase(Participant& participant, const std::string& topic, const std::string& type_name,
             const topics::CdrCodec* codec, const TopicQos& qos);
  /// The next sample into a message of the codec's type, or into a topics::RawMessage.
  bool take_sample(void* message, const topics::CdrCodec* codec);

 private:
  std::unique_ptr<Impl> impl_;
  Sample last_sample_;
};

/// Reads messages of one of the idl types from a topic. Throws std::runtime_error when DDS refuses
/// to create the entities.
template <class T>
class Reader : public ReaderBase {
 public:
  Reader(Participant& participant, const std::string& topic, const TopicQos& qos)
      : ReaderBase(participant, topic, topics::cdr_codec<T>().type_name, &topics::cdr_codec<T>(),
                   qos) {}
  /// Next message into `message`, whose memory is reused; false when there is none.
  bool take(T& message) { return take_sample(&message, &topics::cdr_codec<T>()); }
};

/// Reads the bytes of messages of any type, of which only the name needs to be known. It must be a
/// type without key: a raw reader matches no writer of a type that has one. Throws
/// std::runtime_error when DDS refuses to create the entities.
class RawReader : public ReaderBase {
 public:
  RawReader(Participant& participant, const std::string& topic, const std::string& dds_type,
            const TopicQos& qos)
      : ReaderBase(participant, topic, dds_type, nullptr, qos) {}
  /// Next message into `message`, whose memory is reused; false when there is none. The bytes are
  /// as they were sent, by whomever: decode, read_header and cdr_to_json check them.
  bool take(topics::RawMessage& message);
};

/// Waits for any of several readers, or to be woken.
class WaitSet {
 public:
  WaitSet();
  ~WaitSet();
  WaitSet(const WaitSet&) = delete;
  WaitSet& operator=(const WaitSet&) = delete;

  /// The reader must outlive the wait set.
  void add(ReaderBase& reader);
  /// True when something may be there to take or `wake` was called; false after `timeout`.
  bool wait(std::chrono::milliseconds timeout);
  /// Ends the present or the next `wait`; from any thread.
  void wake();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quoin::runtime
