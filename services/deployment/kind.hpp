// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/parameters/method_list.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// How the messages of an input port come to the handler.
enum class Join {
  each,     ///< one call a message, every message accounted for
  latest,   ///< the newest message so far
  by_time,  ///< the two messages around the stamp of the one that came by the `each` port
};

/// How many messages go out on an output port.
enum class Rate {
  per_input,  ///< one for each message of an `each` port, or a source's scans: all accounted for
  own_rate,   ///< as many as the service likes, numbered by itself; only gaps of those are losses
};

struct InputPort {
  std::string name;  ///< as in `inputs:`
  std::string type;  ///< of the table of topic types
  Join join = Join::each;
  bool required = true;
};

struct OutputPort {
  std::string type;  ///< of the table of topic types; no two of a kind have the same
  Rate rate = Rate::per_input;
  /// Parameter of the kind that decides whether there is this output: a switch, or a list of types
  /// that names it. "" for those that always are.
  std::string parameter = {};
};

/// A kind of service: which program it is, what it reads and writes, what can be set.
struct KindInfo {
  std::string name;
  std::string description;
  std::string program = {};            ///< file name of the executable
  std::vector<InputPort> inputs = {};  ///< of those that are `each`, the first decides the origin
  std::vector<OutputPort> outputs = {};
  bool observer = false;  ///< reads all outputs of the services named in `inputs:`, of any type
  /// Of an observer: what kinds that its program does not have give (services/deployment/
  /// known_outputs.hpp), null for those it does not know, which may give any type. Others need
  /// none.
  const KindInfo* (*known_outputs)(std::string_view kind) = nullptr;
  bool exclusive =
      false;  ///< holds something of which there is one: ends before its successor begins
  std::string device = {};  ///< parameter that names what only one service at a time can use
  std::vector<MethodInfo> methods = {};  ///< empty for kinds without methods
  std::vector<ParameterInfo> parameters =
      {};  ///< of the kind itself; empty where methods have them

  [[nodiscard]] bool reads() const { return observer || !inputs.empty(); }
  /// Whether it publishes what no other service gave it.
  [[nodiscard]] bool is_source() const { return !reads() && !outputs.empty(); }
  /// Null when it has no such port.
  [[nodiscard]] const InputPort* input(std::string_view port) const;
  [[nodiscard]] const OutputPort* output(std::string_view type) const;
  /// Whether a service with these parameters, which are valid, has it.
  [[nodiscard]] bool gives(const OutputPort& port, const ParameterSettings& settings) const;
};

/// The kinds that a program knows.
struct KindList {
  std::vector<const KindInfo*> kinds;
  /// A service that knows its own kind only takes others as they are written.
  bool complete = true;

  /// Null when there is no such kind.
  [[nodiscard]] const KindInfo* find(std::string_view name) const;
};

/// A program that writes to a topic without being a service of this project. Its output stands in
/// the deployment file.
[[nodiscard]] const KindInfo& external_kind();

/// Parameters that a service of this kind and method takes. Throws std::out_of_range for an unknown
/// method.
[[nodiscard]] const std::vector<ParameterInfo>& parameters_of(const KindInfo& kind,
                                                              std::string_view method);

}  // namespace quoin
