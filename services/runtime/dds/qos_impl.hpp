// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "services/runtime/dds/qos.hpp"

namespace quoin::runtime {

[[nodiscard]] eprosima::fastdds::dds::DataWriterQos writer_qos(const TopicQos& topic);
[[nodiscard]] eprosima::fastdds::dds::DataReaderQos reader_qos(const TopicQos& topic);

}  // namespace quoin::runtime
