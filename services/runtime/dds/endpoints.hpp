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
#include "services/topics/message_check.hpp"

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

  /// What came and is no message of the type, breaks what its IDL promises (topics::MessageCheck),
  /// or is of a process that another writer speaks for (ProcessWriters). What a raw reader takes is
  /// as it was sent.
  [[nodiscard]] topics::RefusedCounts refused() const;

  /// Where the message that was taken last came from, as DDS counts.
  struct Sample {
    std::uint64_t writer = 0;           ///< another one for another writer
    std::uint64_t incarnation = 0;      ///< of the process that the writer announces; 0: of none
    std::uint64_t sequence_number = 0;  ///< of the sample among those of that writer, from 1
    std::int64_t sent = 0;              ///< [ns since the Unix epoch], by the writer's clock
    std::int64_t received = 0;          ///< [ns since the Unix epoch], by the clock of this host
  };
  [[nodiscard]] const Sample& last_sample() const { return last_sample_; }

  /// Whether the message that was taken last, with this header, is of the writer that speaks for
  /// its process; counts it as refused if not.
  [[nodiscard]] bool admit(const msg::Header& header);
  [[nodiscard]] bool admit(const std::string& service, std::uint64_t incarnation);

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
  /// Next message that is not refused into `message`, whose memory is reused; false when there is
  /// none.
  bool take(T& message) {
    while (take_sample(&message, &topics::cdr_codec<T>())) {
      if constexpr (requires(const msg::Header& header) { header == message.header(); }) {
        if (!admit(message.header())) continue;
      } else if constexpr (requires { message.service(), message.incarnation(), message.pid(); }) {
        if (!admit(message.service(), message.incarnation())) continue;
      }
      return true;
    }
    return false;
  }
};

/// Reads the bytes of messages of any type, of which only the name needs to be known. Of types with
/// a key those of idl/ can be read: a raw reader matches no writer of another one. Throws
/// std::runtime_error when DDS refuses to create the entities.
class RawReader : public ReaderBase {
 public:
  RawReader(Participant& participant, const std::string& topic, const std::string& dds_type,
            const TopicQos& qos)
      : ReaderBase(participant, topic, dds_type, topics::keyed_codec(dds_type), qos) {}
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

  /// The reader must outlive the wait set, or be removed. From the thread that waits.
  void add(ReaderBase& reader);
  void remove(ReaderBase& reader);
  /// True when something may be there to take or `wake` was called; false after `timeout`.
  bool wait(std::chrono::milliseconds timeout);
  /// Ends the present or the next `wait`; from any thread.
  void wake();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

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
  /// Asserts the liveliness of this writer to the readers of a topic with strengths; so does
  /// writing.
  void assert_liveliness();
  /// Names of the participants that announced that they observe this topic and have no matched
  /// reader yet; without those whose reader does not fit. To be waited for before the first
  /// message, see Participant::discovery_complete.
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

/// Writes messages of any type without key, or with one of idl/, as bytes. Throws
/// std::runtime_error when DDS refuses to create the entities. One thread at a time writes.
class RawWriter : public WriterBase {
 public:
  RawWriter(Participant& participant, const std::string& topic, const std::string& dds_type,
            const TopicQos& qos)
      : WriterBase(participant, topic, dds_type, topics::keyed_codec(dds_type), qos) {}
  /// Only the bytes are sent, filled up with zeros to a multiple of four; the times are those of
  /// now. False, too, when they do not begin as XCDR1 does; the rest is not checked.
  bool write(const topics::RawMessage& message);
};

}  // namespace quoin::runtime
