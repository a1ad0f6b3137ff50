// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>

#include "services/runtime/dds/participant_impl.hpp"
#include "services/runtime/dds/reader.hpp"

namespace quoin::runtime {

struct ReaderBase::Impl : eprosima::fastdds::dds::DataReaderListener {
  Impl(Participant& owner, const std::string& topic, const std::string& type_name,
       const topics::CdrCodec* codec, const TopicQos& qos);
  ~Impl() override;

  void on_subscription_matched(
      eprosima::fastdds::dds::DataReader*,
      const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override;

  Participant& participant;
  std::string topic_name;
  MatchState match;
  eprosima::fastdds::dds::DataReader* reader = nullptr;
};

}  // namespace quoin::runtime
