// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/node/local_topics.hpp"
#include "services/runtime/node/ports.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/header.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::runtime {

/// Gives the messages of a writer that does not number them the header that accounting needs: the
/// numbers that DDS has given them.
class StrangerNumbers {
 public:
  /// `service`: what the external service is called in the deployment.
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

/// Messages that come back, from any thread, when nobody keeps them any more, and give their memory
/// to later ones.
template <class T>
class MessagePool {
 public:
  [[nodiscard]] std::shared_ptr<T> take() {
    std::unique_ptr<T> message = free_->take();
    if (!message) message = std::make_unique<T>();
    return {message.release(), [free = free_](T* back) { free->give(std::unique_ptr<T>(back)); }};
  }

 private:
  class Free {
   public:
    std::unique_ptr<T> take() {
      const std::lock_guard lock(mutex_);
      if (messages_.empty()) return nullptr;
      std::unique_ptr<T> message = std::move(messages_.back());
      messages_.pop_back();
      return message;
    }
    void give(std::unique_ptr<T> message) {
      const std::lock_guard lock(mutex_);
      messages_.push_back(std::move(message));
    }

   private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> messages_;
  };
  std::shared_ptr<Free> free_ = std::make_shared<Free>();
};

/// Messages that DDS brings.
template <class T>
class ReaderInput final : public Input {
 public:
  /// `external`: name of the external service that writes; "" for services of the deployment.
  ReaderInput(Participant& participant, const std::string& topic, const TopicQos& qos,
              const std::string& external = "")
      : reader_(participant, topic, qos) {
    if (!external.empty()) numbers_.emplace(external);
  }

  [[nodiscard]] std::optional<Message> take() override {
    if (!next_) next_ = pool_.take();
    if (!reader_.take(*next_)) return std::nullopt;
    msg::Header& header = next_->header();
    if (numbers_) numbers_->number(reader_.last_sample(), header);
    return Message{std::exchange(next_, nullptr), &typeid(T), &header};
  }
  [[nodiscard]] std::size_t matched() const override { return reader_.matched(); }
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override {
    return reader_.incompatible_qos();
  }
  [[nodiscard]] topics::RefusedCounts refused() const override { return reader_.refused(); }
  [[nodiscard]] ReaderBase& reader() { return reader_; }

 private:
  Reader<T> reader_;
  std::optional<StrangerNumbers> numbers_;
  MessagePool<T> pool_;
  std::shared_ptr<T> next_;  // to fill
};

/// What an observer gets: a message of any type as it was sent, and its header.
struct ObservedMessage {
  std::string type;  ///< of the table of topic types
  std::string topic;
  topics::RawMessage raw;
  msg::Header header;
};

/// Messages of any type that DDS brings to an observer. What has no header of ours, or one
/// that cannot be, is left out.
class ObservedInput final : public Input {
 public:
  /// `external`: as above.
  ObservedInput(Participant& participant, const OutputConfig& output, const TopicQos& qos,
                const std::string& external = "")
      : type_(output.type),
        topic_(output.topic),
        reader_(participant, output.topic,
                std::string(topics::find_topic_type(output.type)->dds_type), qos) {
    if (!external.empty()) numbers_.emplace(external);
  }

  [[nodiscard]] std::optional<Message> take() override {
    if (!next_) next_ = pool_.take();
    while (reader_.take(next_->raw)) {
      msg::Header& header = next_->header;
      if (!topics::read_header(next_->raw, header) || !reader_.admit(header)) continue;
      if (numbers_) numbers_->number(reader_.last_sample(), header);
      next_->type = type_;
      next_->topic = topic_;
      return Message{std::exchange(next_, nullptr), &typeid(ObservedMessage), &header};
    }
    return std::nullopt;
  }
  [[nodiscard]] std::size_t matched() const override { return reader_.matched(); }
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override {
    return reader_.incompatible_qos();
  }
  [[nodiscard]] topics::RefusedCounts refused() const override { return reader_.refused(); }
  [[nodiscard]] ReaderBase& reader() { return reader_; }

 private:
  std::string type_;
  std::string topic_;
  RawReader reader_;
  std::optional<StrangerNumbers> numbers_;
  MessagePool<ObservedMessage> pool_;
  std::shared_ptr<ObservedMessage> next_;  // to fill
};

/// Messages that DDS takes and, in a process of several nodes, those beside this one.
template <class T>
class WriterOutput final : public Output {
 public:
  /// `neighbours`: null in a process of one node.
  WriterOutput(Participant& participant, const std::string& topic, const TopicQos& qos,
               std::shared_ptr<LocalTopic> neighbours)
      : writer_(participant, topic, qos),
        // A late reader wants the newest message.
        always_(qos.preset == QosPreset::state),
        neighbours_(std::move(neighbours)) {}
  ~WriterOutput() override {
    if (neighbours_) neighbours_->close();
  }
  WriterOutput(const WriterOutput&) = delete;
  WriterOutput& operator=(const WriterOutput&) = delete;

  [[nodiscard]] const std::type_info& type() const override { return typeid(T); }
  [[nodiscard]] void* message() override { return current_; }
  void use(void* message) override { current_ = static_cast<T*>(message); }
  [[nodiscard]] msg::Header& header() override { return current_->header(); }
  /// DDS gets the message only when somebody outside the process reads it.
  [[nodiscard]] bool write() override {
    if (!neighbours_) return writer_.write(*current_);
    if (!neighbours_->wait_for_room(longest_wait_for_neighbours)) return false;
    if ((always_ || writer_.matched() > 0) && !writer_.write(*current_)) return false;
    if (!neighbours_->empty()) pass_to_neighbours();
    return true;
  }
  [[nodiscard]] std::size_t matched() const override {
    return writer_.matched() + (neighbours_ ? neighbours_->readers() : 0);
  }
  bool wait_for_acknowledgments(std::chrono::milliseconds timeout) override {
    return writer_.wait_for_acknowledgments(timeout);
  }
  void assert_liveliness() override { writer_.assert_liveliness(); }
  [[nodiscard]] std::vector<std::string> awaited_observers() const override {
    return writer_.awaited_observers();
  }
  [[nodiscard]] std::vector<std::string> check_silent_readers() override {
    std::vector<std::string> silent = writer_.check_silent_readers();
    if (neighbours_) {
      for (std::string& reader : neighbours_->full_readers()) silent.push_back(std::move(reader));
    }
    return silent;
  }
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override {
    return writer_.incompatible_qos();
  }

 private:
  // As DDS waits for its readers.
  static constexpr std::chrono::milliseconds longest_wait_for_neighbours{1000};

  /// The message is theirs from now on, unless it is somebody else's.
  void pass_to_neighbours() {
    const bool own = current_ == own_.get();
    if (!own) *own_ = *current_;
    const std::shared_ptr<T> message = std::exchange(own_, pool_.take());
    if (own) current_ = own_.get();
    neighbours_->publish({message, &typeid(T), &message->header()});
  }

  Writer<T> writer_;
  const bool always_;
  const std::shared_ptr<LocalTopic> neighbours_;
  MessagePool<T> pool_;
  std::shared_ptr<T> own_ = pool_.take();
  T* current_ = own_.get();
};

/// An input with what a wait set waits for.
struct DdsInput {
  std::unique_ptr<Input> input;
  ReaderBase* reader;
};

using MakeInput = DdsInput (*)(Participant&, const std::string& topic, const TopicQos&,
                               const std::string& external);
using MakeOutput = std::unique_ptr<Output> (*)(Participant&, const std::string& topic,
                                               const TopicQos&, std::shared_ptr<LocalTopic>);

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
               const std::string& external) {
            auto input = std::make_unique<ReaderInput<In>>(participant, topic, qos, external);
            ReaderBase* reader = &input->reader();
            return DdsInput{std::move(input), reader};
          }...},
          {+[](Participant& participant, const std::string& topic, const TopicQos& qos,
               std::shared_ptr<LocalTopic> neighbours) -> std::unique_ptr<Output> {
            return std::make_unique<WriterOutput<Out>>(participant, topic, qos,
                                                       std::move(neighbours));
          }...}};
}

}  // namespace quoin::runtime
