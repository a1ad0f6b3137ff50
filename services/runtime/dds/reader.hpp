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

  struct Impl;
  [[nodiscard]] Impl& impl() { return *impl_; }

 protected:
  /// `codec` is null for raw messages.
  ReaderBase(Participant& participant, const std::string& topic, const std::string& type_name,
             const topics::CdrCodec* codec, const TopicQos& qos);
  bool take_typed(void* message, const topics::CdrCodec& codec);
  bool take_raw(topics::RawMessage& message);

 private:
  std::unique_ptr<Impl> impl_;
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
  bool take(T& message) { return take_typed(&message, topics::cdr_codec<T>()); }
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
  bool take(topics::RawMessage& message) { return take_raw(message); }
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
