// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "services/runtime/node/ports.hpp"

namespace quoin::runtime {

/// The two messages of a `by_time` port around the stamp of the one that is handled. Null where
/// there is none: nothing came, or it did not come in time.
template <class T>
struct Around {
  const T* before = nullptr;  ///< the newest that is not younger
  const T* after = nullptr;  ///< the oldest that is not older; the same as before at an equal stamp
};

/// What a method is called with: the message that came by an `each` port, what the other ports have
/// for it, and the messages to fill. Types that do not belong to the kind are std::logic_error.
class Work {
 public:
  struct Partner {
    std::string_view port;
    const Message* before = nullptr;
    const Message* after = nullptr;
  };
  struct Result {
    Output* output = nullptr;
    bool publish = false;  ///< always true for outputs that give one message per input
  };

  Work(const Message& message, std::string_view port, std::vector<Partner>& partners,
       std::vector<Result>& results)
      : message_(message), port_(port), partners_(partners), results_(results) {}

  /// The message to handle.
  template <class T>
  [[nodiscard]] const T& input() const {
    return typed<T>(message_);
  }
  [[nodiscard]] const Message& message() const { return message_; }
  /// The port that it came by.
  [[nodiscard]] std::string_view port() const { return port_; }

  /// The newest message of a `latest` port; null when there is none.
  template <class T>
  [[nodiscard]] const T* latest(std::string_view port) const {
    const Partner& partner = find(port);
    return partner.before == nullptr ? nullptr : &typed<T>(*partner.before);
  }
  template <class T>
  [[nodiscard]] Around<T> around(std::string_view port) const {
    const Partner& partner = find(port);
    return {partner.before == nullptr ? nullptr : &typed<T>(*partner.before),
            partner.after == nullptr ? nullptr : &typed<T>(*partner.after)};
  }

  /// The message of the output of that type; its header is the node's business.
  template <class T>
  [[nodiscard]] T& output() {
    return *static_cast<T*>(find(typeid(T)).output->message());
  }
  /// Of an output at its own rate: the message is to go out when the method returns.
  template <class T>
  void publish() {
    find(typeid(T)).publish = true;
  }
  /// An entry of the heartbeat; replaces the value of that name.
  void set_diagnostic(std::string name, std::string value) {
    diagnostics_.emplace_back(std::move(name), std::move(value));
  }
  using Diagnostics = std::vector<std::pair<std::string, std::string>>;  ///< name, value
  [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }
  /// Parts of the message (segments, say) that gave no result.
  void fail(std::size_t parts) { failures_ += parts; }
  [[nodiscard]] std::size_t failures() const { return failures_; }

 private:
  template <class T>
  static const T& typed(const Message& message) {
    if (const T* found = message.as<T>()) return *found;
    throw std::logic_error("a port of another message type");
  }
  [[nodiscard]] const Partner& find(std::string_view port) const {
    for (const Partner& partner : partners_) {
      if (partner.port == port) return partner;
    }
    throw std::logic_error("no port '" + std::string(port) + "'");
  }
  [[nodiscard]] Result& find(const std::type_info& type) {
    for (Result& result : results_) {
      if (result.output->type() == type) return result;
    }
    throw std::logic_error("no output of that message type");
  }

  const Message& message_;
  std::string_view port_;
  std::vector<Partner>& partners_;
  std::vector<Result>& results_;
  Diagnostics diagnostics_;
  std::size_t failures_ = 0;
};

/// What a method keeps from message to message, in a form that it or another can go on with.
using State = std::vector<std::uint8_t>;

/// A method with its parameters, ready to work.
struct Method {
  /// Handles one message. An exception counts it as lost in processing.
  std::function<void(Work&)> handle;
  /// Name and version of the form of its state, such as "line_map/1"; "" when it keeps none. What
  /// has the same goes on where the other one ended.
  std::string state_form = {};
  std::function<State()> save = {};
  /// Throws std::invalid_argument for what is no state of that form.
  std::function<void(const State&)> restore = {};
};

/// Makes a method. Throws ParameterError.
using MethodFactory =
    std::function<Method(const std::string& method, const ParameterSettings& parameters)>;

}  // namespace quoin::runtime
