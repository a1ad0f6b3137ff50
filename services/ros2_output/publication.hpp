// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "services/ros2/topics.hpp"
#include "services/runtime/dds/endpoints.hpp"

namespace quoin {

/// A topic of ROS 2 that is written.
class Publication {
 public:
  virtual ~Publication() = default;
  [[nodiscard]] virtual std::size_t readers() const = 0;
  [[nodiscard]] std::uint64_t written() const { return written_; }

 protected:
  std::uint64_t written_ = 0;
};

/// Of messages that are made here.
template <class T>
class TypedPublication final : public Publication {
 public:
  /// `owner`: label of the service. `latched`: late readers get the newest message, whatever the
  /// type's default is.
  TypedPublication(runtime::Participant& participant, const std::string& owner,
                   const std::string& topic, bool latched)
      : type_(ros2::topic_type<T>()),
        latched_(latched || type_.qos == runtime::QosPreset::state),
        writer_(participant, ros2::dds_topic(topic), qos(owner)) {}

  [[nodiscard]] std::size_t readers() const override { return writer_.matched(); }
  /// Whether a message that is written now can be of use.
  [[nodiscard]] bool wanted() const { return latched_ || writer_.matched() > 0; }
  /// To be filled, with the memory of the one before.
  [[nodiscard]] T& message() { return message_; }
  void write() {
    if (writer_.write(message_)) ++written_;
  }

 private:
  [[nodiscard]] runtime::TopicQos qos(const std::string& owner) const {
    runtime::TopicQos qos = ros2::writer_qos(type_, owner);
    if (latched_) {
      qos.preset = runtime::QosPreset::state;
      qos.depth = 1;
    }
    return qos;
  }

  const ros2::TopicType& type_;
  const bool latched_;
  runtime::Writer<T> writer_;
  T message_;
};

/// Of our own messages under the names of quoin_msgs: the bytes are the same.
class RawPublication final : public Publication {
 public:
  RawPublication(runtime::Participant& participant, const std::string& owner,
                 const std::string& topic, const ros2::TopicType& type)
      : writer_(participant, ros2::dds_topic(topic), ros2::dds_type_name(type.name),
                ros2::writer_qos(type, owner)) {}

  [[nodiscard]] std::size_t readers() const override { return writer_.matched(); }
  void write(const topics::RawMessage& raw) {
    if (writer_.matched() > 0 && writer_.write(raw)) ++written_;
  }

 private:
  runtime::RawWriter writer_;
};

}  // namespace quoin
