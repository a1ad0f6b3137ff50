// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Common.h>
#include <idl/Corners.h>
#include <idl/LineMap.h>
#include <idl/Pose.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics/order_statistics.hpp"
#include "deploy/observation/figures.hpp"
#include "services/deployment/graph.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/accounting/source_ledger.hpp"
#include "services/topics/line_map.hpp"

namespace quoin::deploy {

/// An instance of what numbers messages: a source, or an output at its own rate.
struct SourceInstance {
  std::string label;
  std::string service;
  std::string type;              ///< of the numbered messages
  runtime::SourceLedger ledger;  ///< has learned from all watches
};

/// The corners that an output has given, as far as one looks at them.
class CornerStatistics {
 public:
  void add(const msg::Corners& message);
  [[nodiscard]] CornerFigures figures(std::uint64_t scans) const;

 private:
  std::uint64_t corners_ = 0;
  QuantileHistogram sigma_;
  QuantileHistogram ellipse_area_;
};

/// The message that arrived at an end, where it is of a type that is looked into.
struct EndMessage {
  EndMessage() = default;
  EndMessage(const msg::Corners* of_corners) : corners(of_corners) {}  // NOLINT: as what it is
  EndMessage(const msg::Pose* of_pose) : pose(of_pose) {}              // NOLINT
  EndMessage(const msg::LineMap* of_map) : map(of_map) {}              // NOLINT

  const msg::Corners* corners = nullptr;
  const msg::Pose* pose = nullptr;
  const msg::LineMap* map = nullptr;
};

/// Accounts for each message of the source of an output that no service reads, whatever its type,
/// from the headers of what arrives there.
class EndWatch {
 public:
  /// `name`: what its figures are called. `joined_late`: the deployment ran before, the scans so
  /// far are for nobody.
  EndWatch(const Connection& end, std::string name, bool joined_late);

  [[nodiscard]] const std::string& service() const { return service_; }
  [[nodiscard]] const std::string& type() const { return type_; }
  /// The way of its messages, from the output that numbers them on.
  void set_path(const std::vector<Connection>& path);
  /// Of the messages of that output.
  [[nodiscard]] const std::string& source_type() const { return source_type_; }
  /// The topic that a service of that way writes; "" of another service.
  [[nodiscard]] std::string topic_of(const std::string& service) const;
  /// Of the last message: the source's part.
  [[nodiscard]] const msg::StageTrace& source_trace() const { return source_trace_; }

  /// A message arrived. False when it is a repetition, which counts for nothing.
  bool receive(const msg::Header& header, const EndMessage& message = {});

  /// It is no part of the deployment. Should it come back, what happens meanwhile is for nobody.
  void interrupt();
  [[nodiscard]] bool heard_nothing() const { return accounting_.received() == 0; }
  /// The source has ended: what has not come will not.
  void end() { ended_ = true; }
  [[nodiscard]] const std::vector<runtime::SourceAccount>& sources() const {
    return accounting_.sources();
  }

  /// `instances`: of all sources.
  [[nodiscard]] EndFigures figures(const std::vector<SourceInstance>& instances) const;

 private:
  [[nodiscard]] std::uint64_t lost_at_start(const std::vector<SourceInstance>& instances) const;

  std::string name_;
  std::string service_;
  std::string type_;
  std::string source_;                         // service that numbers the messages
  std::string source_type_;                    // of what it numbers
  std::map<std::string, std::string> topics_;  // by service on the way
  msg::StageTrace source_trace_;
  runtime::ScanAccounting accounting_;
  bool joined_late_;
  bool ended_ = false;
  std::uint64_t first_number_ = 0;  // of the first message, unless nobody waited for it
  QuantileHistogram latency_;
  bool gives_corners_;
  bool newest_counts_;  // of what is overwritten nothing is lost
  std::optional<PoseFigures> pose_;
  std::optional<topics::ReceivedLineMap> map_;
  CornerStatistics corners_;
};

}  // namespace quoin::deploy
