// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/qos.hpp"

#include <stdexcept>
#include <string>

#include "services/runtime/dds/entities.hpp"
#include "services/runtime/dds/fast_dds.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;
using Duration_t = fast_dds::Duration;

QosPreset qos_preset(std::string_view name) {
  if (name == "sensor") return QosPreset::sensor;
  if (name == "feature") return QosPreset::feature;
  if (name == "state") return QosPreset::state;
  if (name == "control") return QosPreset::control;
  if (name == "lossless") return QosPreset::lossless;
  if (name == "best_effort") return QosPreset::best_effort;
  throw std::invalid_argument("unknown QoS preset '" + std::string(name) + "'");
}

TopicQos output_qos(const ServiceConfig& service, const OutputConfig& output) {
  TopicQos qos = qos_preset(output.qos);
  qos.strength = service.strength;
  qos.lease = service.lease;
  return qos;
}

TopicQos observer_qos(const ServiceConfig& service, const OutputConfig& output) {
  TopicQos qos = output_qos(service, output);
  if (qos.preset == QosPreset::lossless) qos.preset = QosPreset::observer;
  return qos;
}

namespace {

// Services that share the status topic. A deployment has 256 at most; who invents others is to
// leave room for them.
constexpr int max_instances = 16384;
// Samples a lossless endpoint holds before the writer has to wait.
constexpr int lossless_samples = 256;
// Samples that an observer may be behind a writer that does not wait for it: a recording of some
// minutes that is replayed at full speed. With 32, one of 5000 scans lost a third to two thirds.
constexpr int observer_samples = 4096;

}  // namespace

std::size_t queue_depth(QosPreset preset) {
  return preset == QosPreset::state ? static_cast<std::size_t>(max_instances)
                                    : static_cast<std::size_t>(history_depth(preset));
}

int history_depth(QosPreset preset) {
  switch (preset) {
    case QosPreset::sensor:
      return 5;
    case QosPreset::feature:
    case QosPreset::best_effort:
      return 32;
    case QosPreset::state:
      return 1;
    case QosPreset::control:
      return 256;
    case QosPreset::observer:
      return observer_samples;
    case QosPreset::lossless:
      break;
  }
  return lossless_samples;
}

namespace {

// The policies that writer and reader share.
template <class Qos>
Qos common_qos(Qos qos, const TopicQos& topic) {
  const QosPreset preset = topic.preset;
  const bool keyed = preset == QosPreset::state;
  const int samples = topic.depth.value_or(history_depth(preset));
  qos.reliability().kind = preset == QosPreset::best_effort ? dds::BEST_EFFORT_RELIABILITY_QOS
                                                            : dds::RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = Duration_t(1, 0);
  qos.durability().kind =
      keyed ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind =
      preset == QosPreset::lossless ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = samples;
  // Fast DDS refuses what goes beyond its own small defaults, so all limits are set.
  qos.resource_limits().max_instances = keyed ? max_instances : 1;
  qos.resource_limits().max_samples_per_instance = samples;
  qos.resource_limits().max_samples = keyed ? max_instances * samples : samples;
  qos.resource_limits().allocated_samples = 1;
  qos.user_data().setValue({topic.user_data.begin(), topic.user_data.end()});
  if (topic.strength) {
    qos.ownership().kind = dds::EXCLUSIVE_OWNERSHIP_QOS;
    // With the other two kinds of liveliness Fast DDS 2.9 never gives up a writer that was killed
    // while another one of the topic lives.
    qos.liveliness().kind = dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    const auto lease = std::chrono::nanoseconds(topic.lease).count();
    qos.liveliness().lease_duration = Duration_t(static_cast<std::int32_t>(lease / 1'000'000'000),
                                                 static_cast<std::uint32_t>(lease % 1'000'000'000));
  }
  return qos;
}

// From noticing that a sample is missing to asking for it, and from being asked to sending it
// again. A full lossless reader rejects samples all the time: asked for at once they would be
// rejected again.
Duration_t repeat_delay(QosPreset preset) {
  return Duration_t(0, preset == QosPreset::lossless ? 5'000'000 : 1'000'000);
}

}  // namespace

dds::DataWriterQos writer_qos(const TopicQos& topic) {
  dds::DataWriterQos qos = common_qos(dds::DataWriterQos(dds::DATAWRITER_QOS_DEFAULT), topic);
  // What a service writes keeps its memory from scan to scan. Requests may be of any size.
  qos.endpoint().history_memory_policy =
      topic.preset == QosPreset::control ? fast_dds::rtps::DYNAMIC_RESERVE_MEMORY_MODE
                                         : fast_dds::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  if (topic.strength) qos.ownership_strength().value = static_cast<std::uint32_t>(*topic.strength);
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  // A lost datagram is noticed by the next heartbeat; the default of 3 s would be 30 scans.
  auto& times = qos.reliable_writer_qos().times;
  fast_dds::heartbeat_period(times) = Duration_t(0, 50'000'000);
  fast_dds::nack_response_delay(times) = repeat_delay(topic.preset);
  return qos;
}

dds::DataReaderQos reader_qos(const TopicQos& topic) {
  dds::DataReaderQos qos = common_qos(dds::DataReaderQos(dds::DATAREADER_QOS_DEFAULT), topic);
  // What arrives may come from anybody: were its memory kept, a few oversized messages would leave
  // every place of the history as large as the largest of them.
  qos.endpoint().history_memory_policy = fast_dds::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  fast_dds::heartbeat_response_delay(qos.reliable_reader_qos().times) = repeat_delay(topic.preset);
  return qos;
}

}  // namespace quoin::runtime
