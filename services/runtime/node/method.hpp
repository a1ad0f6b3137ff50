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
/// for it, and the messages to fill. Types that do not belong to the kind are std::logic_error. An
/// optional port that is not wired is like one by which nothing comes.
class Work {
 public:
  struct Partner {
    std::string_view port;
    const Message* before = nullptr;
    const Message* after = nullptr;
    const Partners* all = nullptr;  ///< of a `by_time` port
  };
  struct Result {
    Output* output = nullptr;
    bool publish = false;  ///< always true for outputs that give one message per input
    std::function<bool(void*)> next = {};  ///< fills one message after the other
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

  /// The messages of a `by_time` port from the newest that is not younger than the input on, up to
  /// the oldest that is not older than `last` [ns], in the order of their stamps.
  template <class T>
  [[nodiscard]] std::vector<const T*> through(std::string_view port, std::int64_t last) const {
    std::vector<const T*> found;
    const Partner& partner = find(port);
    if (partner.all == nullptr) return found;
    for (const Message& message : partner.all->messages()) {
      found.push_back(&typed<T>(message));
      if (message.header->stamp() >= last) break;
    }
    return found;
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
  /// Of an output at its own rate: when the method returns, messages go out for as long as `fill`
  /// fills one and returns true.
  template <class T>
  void publish_while(std::function<bool(T&)> fill) {
    find(typeid(T)).next = [fill = std::move(fill)](void* message) {
      return fill(*static_cast<T*>(message));
    };
  }
  /// The frame of what goes out, by a name that outlives the method; without this that of the
  /// input.
  void set_frame(std::string_view frame) { frame_ = frame; }
  [[nodiscard]] std::string_view frame() const { return frame_; }
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
    static const Partner not_wired;
    return not_wired;
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
  std::string_view frame_;
  std::size_t failures_ = 0;
};

/// What a method keeps from message to message, in a form that it or another can go on with.
using State = std::vector<std::uint8_t>;

/// A method with its parameters, ready to work.
struct Method {
  /// Handles one message. An exception counts it as lost in processing.
  std::function<void(Work&)> handle;
  /// Up to which stamp [ns] it wants the messages of `by_time` ports; without this up to the stamp
  /// of the message.
  std::function<std::int64_t(const Message&)> last_stamp = {};
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
