// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/deployment/kind.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/node/method_exchange.hpp"
#include "services/runtime/node/ports.hpp"
#include "services/runtime/node/succession.hpp"

namespace quoin::runtime {

/// One service at work: takes messages from its inputs, has its method handle each that comes by an
/// `each` port together with what the other ports have for it, publishes the results and accounts
/// for every message. Knows no DDS. One thread calls step(); requests come by another, to
/// exchange() and succession().
class Node {
 public:
  using Clock = std::chrono::steady_clock;

  struct InputPart {
    InputPort port;
    std::string writer;  ///< name of the service that is read
    std::string topic;
    std::unique_ptr<Input> input;
  };
  struct OutputPart {
    OutputPort port;
    std::string topic;
    bool lossless = false;  ///< slow readers slow the node down
    std::unique_ptr<Output> output;
  };
  struct Settings {
    std::string service;  ///< its name
    std::string method = {};
    ParameterSettings parameters = {};
    bool held = false;  ///< it is to take over from another process
    /// How long a message waits for those around its stamp on a `by_time` port.
    std::chrono::milliseconds join_timeout{200};
    std::chrono::milliseconds longest_handover{5000};
    /// For a message to exchange the method at, before the request is answered.
    std::chrono::milliseconds longest_exchange{2000};
  };

  /// Makes the method. Throws ParameterError.
  Node(Settings settings, MethodFactory make, std::vector<OutputPart> outputs, DataThread thread);
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Begins to read.
  void open(std::vector<InputPart> inputs);

  /// Takes what has come and handles what is complete. False when there was nothing to do.
  bool step();
  /// When step() has something to do though nothing more comes; nothing when it has not.
  [[nodiscard]] std::optional<Clock::time_point> due() const;
  /// Whether it has no room for what still comes, which stays with DDS.
  [[nodiscard]] bool full() const;
  /// Whether its successor does the work now: it handles nothing more.
  [[nodiscard]] bool has_left() const { return left_; }
  /// Handles what has been received, waiting for nothing; for a second and a half at most.
  void drain();
  /// After the last result has arrived: informs the successor where to begin.
  void leave();
  /// Asserts its liveliness to the readers.
  void assert_liveliness();

  [[nodiscard]] MethodExchange& exchange() { return exchange_; }
  [[nodiscard]] Succession& succession() { return succession_; }
  [[nodiscard]] const std::vector<OutputPart>& outputs() const { return outputs_; }
  [[nodiscard]] std::size_t matched_readers() const;
  [[nodiscard]] std::size_t matched_writers() const;
  /// Fills in what the endpoints know.
  void report_endpoints(msg::ServiceStatus& status) const;

 private:
  struct Pending {
    Message message;
    std::int64_t received = 0;   // [ns since the Unix epoch]
    Clock::time_point deadline;  // of its joins
  };
  struct Port {
    InputPart part;
    ScanAccounting accounting;
    std::deque<Pending> queue;                // of an `each` port
    Partners partners;                        // of the others
    std::optional<std::uint64_t> begin_with;  // until that message has come
    std::uint64_t incarnation = 0;            // of the source before that; 0 when nothing came
    std::uint64_t next = 0;                   // behind the last one that was handled
    bool missed = false;                      // the last result was made without it
    bool left = false;                        // what comes is for the successor
    bool newest_counts = false;               // only: of what is overwritten nothing is lost
    [[nodiscard]] bool each() const { return part.port.join == Join::each; }
  };

  bool take_partners();
  bool hold();
  void begin(const Succession::Begin& from);
  bool take_each(std::size_t index);
  bool account(std::size_t index, const msg::Header& header);
  [[nodiscard]] bool complete(const Pending& pending) const;
  bool handle_next(std::size_t index);
  void handle(std::size_t index, const Pending& pending);
  [[nodiscard]] std::int64_t last_stamp(const Message& message) const;
  void join(const Message& message, std::vector<Work::Partner>& partners);
  void publish(std::size_t index, const Pending& pending, const Work& work);
  /// When it was published [ns]; 0 when it was not taken.
  std::int64_t write(std::size_t output, std::size_t index, const Pending& pending,
                     std::string_view frame);
  void write_header(std::size_t output, std::size_t index, const Pending& pending,
                    std::string_view frame);
  void note_missing(std::size_t index, bool missing);
  void look_whether_left();

  const Settings settings_;
  DataThread thread_;
  MethodExchange exchange_;
  Succession succession_;
  std::vector<OutputPart> outputs_;
  std::vector<std::uint64_t> next_index_;   // by output
  std::vector<std::uint64_t> next_number_;  // likewise, what could not be written counted, too
  std::vector<Work::Result> results_;       // by output
  std::vector<std::unique_ptr<Port>> ports_;
  std::vector<Work::Partner> joined_;  // for the present message
  bool joins_by_time_ = false;
  bool draining_ = false;
  bool left_ = false;
};

/// Fills in the readers of each output; returns those that do not fit, with both sides' values.
[[nodiscard]] std::vector<std::string> report_outputs(const std::vector<Node::OutputPart>& outputs,
                                                      msg::ServiceStatus& status);

}  // namespace quoin::runtime
