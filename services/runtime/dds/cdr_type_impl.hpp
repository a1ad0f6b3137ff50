// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "services/topics/cdr_codec.hpp"

namespace quoin::runtime {

/// What readers and writers give to DDS in place of a message.
struct CdrSample {
  void* message = nullptr;  ///< of the codec's type; a topics::RawMessage where there is no codec
  const topics::CdrCodec* codec = nullptr;
};

/// DDS type whose samples are CdrSample. A participant registers a type once, whoever comes first;
/// as each sample says how it is written and read, typed and raw endpoints share it.
class CdrType : public eprosima::fastdds::dds::TopicDataType {
 public:
  /// `codec` is null for a type of which only the name is known; it has no key then.
  CdrType(const std::string& name, const topics::CdrCodec* codec);

  bool serialize(void* sample, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* sample) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* sample) override;
  bool getKey(void* sample, eprosima::fastrtps::rtps::InstanceHandle_t* handle,
              bool force_md5) override;
  // Samples that own their message; Fast DDS makes some for loans, and one to find out keys.
  void* createData() override;
  void deleteData(void* sample) override;

 private:
  const topics::CdrCodec* key_codec_;  // null when the type has no key
};

/// A new CdrType.
[[nodiscard]] eprosima::fastdds::dds::TypeSupport type_support(const std::string& name,
                                                               const topics::CdrCodec* codec);

}  // namespace quoin::runtime
