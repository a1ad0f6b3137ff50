// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/endpoints.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <fastdds/dds/core/condition/GuardCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "services/runtime/dds/entities.hpp"
#include "services/runtime/dds/fast_dds.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;
using Duration_t = fast_dds::Duration;

namespace {

constexpr const char* other_fields = "type: of another version, with other fields";

/// The same, with what is announced of the type behind what is announced already.
TopicQos with_type(TopicQos qos, const std::string& type_name) {
  qos.user_data += type_announcement(type_name);
  return qos;
}

}  // namespace

ReaderBase::Impl::Impl(Participant& owner, const std::string& topic, const std::string& type_name,
                       const topics::CdrCodec* codec, const TopicQos& qos)
    : participant(owner),
      topic_name(topic),
      check(codec != nullptr ? topics::message_check(type_name) : nullptr) {
  reader = owner.impl().subscriber->create_datareader(owner.impl().topic(topic, type_name, codec),
                                                      reader_qos(with_type(qos, type_name)), this,
                                                      dds::StatusMask::subscription_matched());
  if (reader == nullptr) throw std::runtime_error("cannot create DDS reader for '" + topic + "'");
  reader->get_statuscondition().set_enabled_statuses(dds::StatusMask::data_available());
  if (!qos.owner.empty()) owner.impl().owned.add({guid_of(reader->guid()), qos.owner, false});
}

ReaderBase::Impl::~Impl() {
  if (reader == nullptr) return;
  participant.impl().owned.remove(guid_of(reader->guid()));
  participant.impl().subscriber->delete_datareader(reader);
}

void ReaderBase::Impl::on_subscription_matched(dds::DataReader*,
                                               const dds::SubscriptionMatchedStatus& status) {
  match.set_matched(status.current_count);
}

ReaderBase::ReaderBase(Participant& participant, const std::string& topic,
                       const std::string& type_name, const topics::CdrCodec* codec,
                       const TopicQos& qos)
    : impl_(std::make_unique<Impl>(participant, topic, type_name, codec, qos)) {}
ReaderBase::~ReaderBase() = default;

std::size_t ReaderBase::matched() const { return impl_->match.matched(); }

bool ReaderBase::wait_for_writers(std::size_t count, std::chrono::milliseconds timeout) const {
  return impl_->match.wait(count, timeout);
}

void ReaderBase::Impl::refuse(const std::string& reason) {
  const std::lock_guard lock(mutex);
  ++refused[reason];
}

ReaderBase::Impl::Writer ReaderBase::Impl::announced_by(std::uint64_t hash,
                                                        const fast_dds::rtps::GUID_t& writer) {
  if (hash == last_writer.hash) return last_writer;
  const auto announced = participant.impl().endpoints->announced_by_writer(guid_of(writer));
  if (!announced) return {hash};
  last_writer = {hash, announced->incarnation,
                 differ(announced->digest, policies_of(*reader).digest)};
  return last_writer;
}

bool ReaderBase::admit(const msg::Header& header) {
  if (!header.trace().empty()) {
    return admit(header.trace().back().service(), header.trace().back().incarnation());
  }
  // Services name themselves.
  if (last_sample_.incarnation == 0 && impl_->writers.hears_strangers()) return true;
  impl_->refuse("trace: of another writer");
  return false;
}

bool ReaderBase::admit(const std::string& service, std::uint64_t incarnation) {
  if (impl_->writers.admit(service, incarnation, last_sample_.writer, last_sample_.incarnation)) {
    return true;
  }
  impl_->refuse("incarnation: of another writer");
  return false;
}

topics::RefusedCounts ReaderBase::refused() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->refused;
}

std::vector<std::string> ReaderBase::incompatible_qos() const {
  return impl_->participant.impl().endpoints->mismatches_of_reader(impl_->topic_name,
                                                                   policies_of(*impl_->reader));
}

bool ReaderBase::take_sample(void* message, const topics::CdrCodec* codec) {
  CdrSample sample{message, codec, impl_->check};
  dds::SampleInfo info;
  while (fast_dds::succeeded(impl_->reader->take_next_sample(&sample, &info))) {
    const topics::Refusal refusal = std::exchange(sample.refusal, std::nullopt);
    if (!refusal && !info.valid_data) continue;  // the end of an instance
    const auto& writer = info.sample_identity.writer_guid();
    std::uint64_t hash = 14695981039346656037U;  // FNV-1a
    for (const auto octet : writer.guidPrefix.value) hash = (hash ^ octet) * 1099511628211U;
    for (const auto octet : writer.entityId.value) hash = (hash ^ octet) * 1099511628211U;
    const Impl::Writer announced = impl_->announced_by(hash, writer);
    if (announced.other_fields || refusal) {
      impl_->refuse(announced.other_fields ? other_fields : *refusal);
      continue;
    }
    last_sample_ = {hash, announced.incarnation, info.sample_identity.sequence_number().to64long(),
                    info.source_timestamp.to_ns(), info.reception_timestamp.to_ns()};
    return true;
  }
  return false;
}

bool RawReader::take(topics::RawMessage& message) {
  if (!take_sample(&message, nullptr)) return false;
  message.published = last_sample().sent;
  message.received = last_sample().received;
  return true;
}

struct WaitSet::Impl {
  dds::WaitSet wait_set;
  dds::GuardCondition woken;
  dds::ConditionSeq active;
};

WaitSet::WaitSet() : impl_(std::make_unique<Impl>()) {
  impl_->wait_set.attach_condition(impl_->woken);
}

WaitSet::~WaitSet() = default;

void WaitSet::add(ReaderBase& reader) {
  impl_->wait_set.attach_condition(reader.impl().reader->get_statuscondition());
}

void WaitSet::remove(ReaderBase& reader) {
  impl_->wait_set.detach_condition(reader.impl().reader->get_statuscondition());
}

bool WaitSet::wait(std::chrono::milliseconds timeout) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(timeout - seconds);
  const bool active = fast_dds::succeeded(
      impl_->wait_set.wait(impl_->active, Duration_t(static_cast<std::int32_t>(seconds.count()),
                                                     static_cast<std::uint32_t>(rest.count()))));
  impl_->woken.set_trigger_value(false);
  return active;
}

void WaitSet::wake() { impl_->woken.set_trigger_value(true); }

WriterBase::Impl::Impl(Participant& owner, const std::string& topic, const std::string& type_name,
                       const topics::CdrCodec* codec, const TopicQos& qos)
    : participant(owner), topic_name(topic) {
  // The listener is given at creation: one that is set later misses the first match.
  writer = owner.impl().publisher->create_datawriter(owner.impl().topic(topic, type_name, codec),
                                                     writer_qos(with_type(qos, type_name)), this,
                                                     dds::StatusMask::publication_matched());
  if (writer == nullptr) throw std::runtime_error("cannot create DDS writer for '" + topic + "'");
  if (!qos.owner.empty()) owner.impl().owned.add({guid_of(writer->guid()), qos.owner, true});
}

WriterBase::Impl::~Impl() {
  if (writer == nullptr) return;
  participant.impl().owned.remove(guid_of(writer->guid()));
  participant.impl().publisher->delete_datawriter(writer);
}

void WriterBase::Impl::on_publication_matched(dds::DataWriter*,
                                              const dds::PublicationMatchedStatus& status) {
  Guid reader{};
  std::copy_n(static_cast<const std::uint8_t*>(status.last_subscription_handle.value),
              reader.size(), reader.begin());
  {
    const std::lock_guard lock(mutex);
    if (status.current_count_change > 0) {
      readers.insert(reader);
    } else {
      readers.erase(reader);
    }
  }
  match.set_matched(status.current_count);
}

std::set<KnownEndpoints::Prefix> WriterBase::Impl::reading_participants() const {
  std::set<KnownEndpoints::Prefix> participants;
  const std::lock_guard lock(mutex);
  for (const Guid& reader : readers) {
    KnownEndpoints::Prefix prefix{};
    std::copy_n(reader.begin(), prefix.size(), prefix.begin());
    participants.insert(prefix);
  }
  return participants;
}

WriterBase::WriterBase(Participant& participant, const std::string& topic,
                       const std::string& type_name, const topics::CdrCodec* codec,
                       const TopicQos& qos)
    : impl_(std::make_unique<Impl>(participant, topic, type_name, codec, qos)) {}
WriterBase::~WriterBase() = default;

std::size_t WriterBase::matched() const { return impl_->match.matched(); }

bool WriterBase::wait_for_readers(std::size_t count, std::chrono::milliseconds timeout) const {
  return impl_->match.wait(count, timeout);
}

bool WriterBase::wait_for_acknowledgments(std::chrono::milliseconds timeout) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(timeout - seconds);
  return fast_dds::succeeded(impl_->writer->wait_for_acknowledgments(Duration_t(
      static_cast<std::int32_t>(seconds.count()), static_cast<std::uint32_t>(rest.count()))));
}

std::vector<std::string> WriterBase::incompatible_qos() const {
  return impl_->participant.impl().endpoints->mismatches_of_writer(impl_->topic_name,
                                                                   policies_of(*impl_->writer));
}

std::vector<std::string> WriterBase::awaited_observers() const {
  return impl_->participant.impl().endpoints->awaited_observers(
      impl_->topic_name, policies_of(*impl_->writer), impl_->reading_participants());
}

std::vector<std::string> WriterBase::check_silent_readers() {
  auto silent = impl_->participant.impl().endpoints->check_silent(
      impl_->reading_participants(), *impl_->participant.impl().participant);
  impl_->found_silent = !silent.empty();
  return silent;
}

void WriterBase::assert_liveliness() { impl_->writer->assert_liveliness(); }

bool WriterBase::write_sample(const void* message, const topics::CdrCodec* codec) {
  CdrSample sample{const_cast<void*>(message), codec};  // DDS only reads it
  const bool written = fast_dds::write(*impl_->writer, &sample);
  // The check of one that spoke again just in time must end, or it would end an idle pair.
  if (written && impl_->found_silent) (void)check_silent_readers();
  return written;
}

bool RawWriter::write(const topics::RawMessage& message) {
  return topics::is_plain_cdr(message.cdr.data(), message.cdr.size()) &&
         write_sample(&message, nullptr);
}

}  // namespace quoin::runtime
