// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <set>
#include <string>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>

#include "services/runtime/dds/participant_impl.hpp"
#include "services/runtime/dds/writer.hpp"

namespace quoin::runtime {

struct WriterBase::Impl : eprosima::fastdds::dds::DataWriterListener {
  Impl(Participant& owner, const std::string& topic, const std::string& type_name,
       const topics::CdrCodec* codec, const TopicQos& qos);
  ~Impl() override;

  void on_publication_matched(
      eprosima::fastdds::dds::DataWriter*,
      const eprosima::fastdds::dds::PublicationMatchedStatus& status) override;

  /// Participants of the matched readers.
  [[nodiscard]] std::set<KnownEndpoints::Prefix> reading_participants() const;

  Participant& participant;
  std::string topic_name;
  MatchState match;
  mutable std::mutex mutex;
  std::set<KnownEndpoints::Guid> readers;  // matched
  bool found_silent = false;               // by the last check
  eprosima::fastdds::dds::DataWriter* writer = nullptr;
};

}  // namespace quoin::runtime
