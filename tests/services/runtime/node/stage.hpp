// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "services/runtime/node/clock.hpp"
#include "services/runtime/node/node.hpp"
#include "services/topics/header.hpp"
#include "tests/services/runtime/node/memory_ports.hpp"

namespace quoin::runtime {

/// A clock that stands still until a test moves it.
class ManualClock {
 public:
  [[nodiscard]] std::chrono::steady_clock::time_point now() const { return now_; }
  void advance(std::chrono::milliseconds time) { now_ += time; }

 private:
  std::chrono::steady_clock::time_point now_{std::chrono::seconds(1000)};
};

inline constexpr std::int64_t millisecond = 1'000'000;  // [ns]

/// Numbers messages as a source does, one each 100 ms of its stamps.
template <class T>
class Numbered {
 public:
  explicit Numbered(std::string source)
      : source_(std::move(source)), incarnation_(static_cast<std::uint64_t>(now_ns())) {}

  [[nodiscard]] T next() {
    const auto stamp = static_cast<std::int64_t>(next_) * 100 * millisecond;
    return next_at(stamp);
  }
  [[nodiscard]] T next_at(std::int64_t stamp) {
    T message;
    msg::Header& header = message.header();
    topics::set_origin(header, source_, incarnation_, next_++);
    header.stamp(stamp);
    header.frame("laser");
    msg::StageTrace& trace = header.trace().emplace_back();
    trace.service(source_);
    trace.incarnation(incarnation_);
    trace.index(index_++);
    trace.published(now_ns());
    return message;
  }
  /// A number for which nothing goes out: the source could not write it.
  void lose() { ++next_; }
  /// Another process, which begins anew.
  void restart() {
    incarnation_ = static_cast<std::uint64_t>(now_ns());
    next_ = index_ = 0;
  }
  [[nodiscard]] std::uint64_t published() const { return index_; }
  [[nodiscard]] std::uint64_t incarnation() const { return incarnation_; }

 private:
  std::string source_;
  std::uint64_t incarnation_;
  std::uint64_t next_ = 0;
  std::uint64_t index_ = 0;
};

/// A node in memory: what it is made of besides its ports.
class Stage {
 public:
  Stage(Node::Settings settings, MethodFactory make, std::vector<Node::OutputPart> outputs = {})
      : record_(config_of(settings)),
        node_(std::move(settings), std::move(make), std::move(outputs),
              {record_, pulse_, [this] { return stopping_; }, [this] { return clock_.now(); }}) {}

  /// Does what there is to do now.
  void run() {
    while (node_.step()) {
    }
  }
  [[nodiscard]] Node& node() { return node_; }
  [[nodiscard]] ServiceRecord& record() { return record_; }
  [[nodiscard]] ManualClock& clock() { return clock_; }
  [[nodiscard]] msg::ServiceStatus status() { return record_.snapshot(); }
  void request_stop() { stopping_ = true; }

  /// Losses by cause.
  [[nodiscard]] std::map<std::string, std::uint64_t> losses() {
    std::map<std::string, std::uint64_t> counts;
    const msg::ServiceStatus now = status();
    for (const msg::LossCount& loss : now.losses()) counts[loss.cause()] = loss.count();
    return counts;
  }

 private:
  static ServiceConfig config_of(const Node::Settings& settings) {
    ServiceConfig config;
    config.name = settings.service;
    config.method = settings.method;
    return config;
  }

  ManualClock clock_;
  bool stopping_ = false;
  ServiceRecord record_;
  Pulse pulse_;
  Node node_;
};

template <class T>
[[nodiscard]] Node::InputPart input_part(InputPort port, const std::string& writer,
                                         std::shared_ptr<MemoryQueue<T>> queue) {
  const std::string topic = "test/" + writer + "/" + port.name;
  return {std::move(port), writer, topic, std::make_unique<MemoryInput<T>>(std::move(queue))};
}

template <class T>
[[nodiscard]] Node::OutputPart output_part(std::shared_ptr<MemoryTopic<T>> topic,
                                           Rate rate = Rate::per_input, bool lossless = false) {
  const std::string type(typeid(T).name());
  return {
      {type, rate}, "test/" + type, lossless, std::make_unique<MemoryOutput<T>>(std::move(topic))};
}

template <class T>
[[nodiscard]] std::vector<Node::InputPart> inputs(T first, auto... more) {
  std::vector<Node::InputPart> parts;
  parts.push_back(std::move(first));
  (parts.push_back(std::move(more)), ...);
  return parts;
}

[[nodiscard]] std::vector<Node::OutputPart> outputs(auto... part) {
  std::vector<Node::OutputPart> parts;
  (parts.push_back(std::move(part)), ...);
  return parts;
}

/// A factory that makes the same method whatever is asked for.
[[nodiscard]] inline MethodFactory always(std::function<void(Work&)> handle) {
  return [handle = std::move(handle)](const std::string&, const ParameterSettings&) {
    return Method{.handle = handle};
  };
}

[[nodiscard]] inline MethodFactory nothing_to_do() {
  return always([](Work&) {});
}

template <class T>
[[nodiscard]] std::vector<std::uint64_t> numbers(const std::vector<T>& messages) {
  std::vector<std::uint64_t> numbers;
  for (const T& message : messages) {
    numbers.push_back(topics::sequence_number(message.header()));
  }
  return numbers;
}

/// Of the last stage that they passed.
template <class T>
[[nodiscard]] std::vector<std::uint64_t> indices(const std::vector<T>& messages) {
  std::vector<std::uint64_t> indices;
  for (const T& message : messages) indices.push_back(message.header().trace().back().index());
  return indices;
}

}  // namespace quoin::runtime
