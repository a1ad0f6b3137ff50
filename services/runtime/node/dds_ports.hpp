// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/reader.hpp"
#include "services/runtime/dds/writer.hpp"
#include "services/runtime/node/ports.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/header.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::runtime {

/// Gives the messages of a writer that does not number them the header that accounting needs: the
/// numbers that DDS has given them.
class StrangerNumbers {
 public:
  /// `service`: what the stranger is called in the deployment.
  explicit StrangerNumbers(std::string service) : service_(std::move(service)) {}

  /// Leaves a header as it is that has what accounting needs.
  void number(const ReaderBase::Sample& sample, msg::Header& header) const {
    if (!header.trace().empty() && !header.origins().empty()) return;
    // Another writer counts from 1 again, as a process does that was started again. All readers of
    // a writer must give it the same incarnation, whenever they begin; as a time, which it is of
    // our own services, it is so long ago that nobody concludes from it when the writer began.
    const std::uint64_t incarnation = 1 + (sample.writer & 0xFFFF'FFFFU);
    const std::uint64_t index =
        sample.sequence_number - std::min<std::uint64_t>(1, sample.sequence_number);
    topics::set_origin(header, service_, incarnation, index);
    header.trace().resize(1);
    msg::StageTrace& trace = header.trace().front();
    trace.service(service_);
    trace.incarnation(incarnation);
    trace.index(index);
    trace.received(header.stamp());
    trace.published(sample.sent);
  }

 private:
  std::string service_;
};

/// Messages that nobody keeps any more give their memory to later ones.
template <class T>
class MessagePlaces {
 public:
  [[nodiscard]] const std::shared_ptr<T>& free() {
    for (const std::shared_ptr<T>& place : places_) {
      if (place.use_count() == 1) return place;
    }
    return places_.emplace_back(std::make_shared<T>());
  }

 private:
  std::vector<std::shared_ptr<T>> places_;
};

/// Messages that DDS brings.
template <class T>
class ReaderInput final : public Input {
 public:
  /// `stranger`: name of the external service that writes; "" for services of the deployment.
  ReaderInput(Participant& participant, const std::string& topic, const TopicQos& qos,
              const std::string& stranger = "")
      : reader_(participant, topic, qos) {
    if (!stranger.empty()) numbers_.emplace(stranger);
  }

  [[nodiscard]] std::optional<Message> take() override {
    const std::shared_ptr<T>& free = places_.free();
    if (!reader_.take(*free)) return std::nullopt;
    if (numbers_) numbers_->number(reader_.last_sample(), free->header());
    return Message{free, &typeid(T), &free->header()};
  }
  [[nodiscard]] std::size_t matched() const override { return reader_.matched(); }
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override {
    return reader_.incompatible_qos();
  }
  [[nodiscard]] ReaderBase& reader() { return reader_; }

 private:
  Reader<T> reader_;
  std::optional<StrangerNumbers> numbers_;
  MessagePlaces<T> places_;
};

/// What an observer gets: a message of any type as it was sent, and its header.
struct ObservedMessage {
  std::string type;  ///< of the table of topic types
  std::string topic;
  topics::RawMessage raw;
  msg::Header header;
};

/// Messages of any type that DDS brings to an observer. What has no header of ours is left out.
class ObservedInput final : public Input {
 public:
  /// `stranger`: as above.
  ObservedInput(Participant& participant, const OutputConfig& output, const TopicQos& qos,
                const std::string& stranger = "")
      : type_(output.type),
        topic_(output.topic),
        reader_(participant, output.topic,
                std::string(topics::find_topic_type(output.type)->dds_type), qos) {
    if (!stranger.empty()) numbers_.emplace(stranger);
  }

  [[nodiscard]] std::optional<Message> take() override {
    const std::shared_ptr<ObservedMessage>& free = places_.free();
    while (reader_.take(free->raw)) {
      if (!topics::read_header(free->raw, free->header)) continue;
      if (numbers_) numbers_->number(reader_.last_sample(), free->header);
      free->type = type_;
      free->topic = topic_;
      return Message{free, &typeid(ObservedMessage), &free->header};
    }
    return std::nullopt;
  }
  [[nodiscard]] std::size_t matched() const override { return reader_.matched(); }
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override {
    return reader_.incompatible_qos();
  }
  [[nodiscard]] ReaderBase& reader() { return reader_; }

 private:
  std::string type_;
  std::string topic_;
  RawReader reader_;
  std::optional<StrangerNumbers> numbers_;
  MessagePlaces<ObservedMessage> places_;
};

/// Messages that DDS takes.
template <class T>
class WriterOutput final : public Output {
 public:
  WriterOutput(Participant& participant, const std::string& topic, const TopicQos& qos)
      : writer_(participant, topic, qos) {}

  [[nodiscard]] const std::type_info& type() const override { return typeid(T); }
  [[nodiscard]] void* message() override { return current_; }
  void use(void* message) override { current_ = static_cast<T*>(message); }
  [[nodiscard]] msg::Header& header() override { return current_->header(); }
  [[nodiscard]] bool write() override { return writer_.write(*current_); }
  [[nodiscard]] std::size_t matched() const override { return writer_.matched(); }
  bool wait_for_acknowledgments(std::chrono::milliseconds timeout) override {
    return writer_.wait_for_acknowledgments(timeout);
  }
  void assert_liveliness() override { writer_.assert_liveliness(); }
  [[nodiscard]] std::vector<std::string> awaited_observers() const override {
    return writer_.awaited_observers();
  }
  [[nodiscard]] std::vector<std::string> check_silent_readers() override {
    return writer_.check_silent_readers();
  }
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override {
    return writer_.incompatible_qos();
  }

 private:
  Writer<T> writer_;
  T own_;
  T* current_ = &own_;
};

/// An input with what a wait set waits for.
struct DdsInput {
  std::unique_ptr<Input> input;
  ReaderBase* reader;
};

using MakeInput = DdsInput (*)(Participant&, const std::string& topic, const TopicQos&,
                               const std::string& stranger);
using MakeOutput = std::unique_ptr<Output> (*)(Participant&, const std::string& topic,
                                               const TopicQos&);

/// The message types of a kind's ports, in their order.
struct PortTypes {
  std::vector<MakeInput> inputs;
  std::vector<MakeOutput> outputs;
};

template <class... T>
struct Reads {};
template <class... T>
struct Writes {};

template <class... In, class... Out>
[[nodiscard]] PortTypes port_types(Reads<In...>, Writes<Out...>) {
  return {{+[](Participant& participant, const std::string& topic, const TopicQos& qos,
               const std::string& stranger) {
            auto input = std::make_unique<ReaderInput<In>>(participant, topic, qos, stranger);
            ReaderBase* reader = &input->reader();
            return DdsInput{std::move(input), reader};
          }...},
          {+[](Participant& participant, const std::string& topic,
               const TopicQos& qos) -> std::unique_ptr<Output> {
            return std::make_unique<WriterOutput<Out>>(participant, topic, qos);
          }...}};
}

}  // namespace quoin::runtime
