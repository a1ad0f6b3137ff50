// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <idl/Corners.h>
#include <string>
#include <vector>

#include "core/statistics/quantile_histogram.hpp"
#include "services/deployment/deployment.hpp"
#include "deploy/observation/figures.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/reader.hpp"
#include "services/runtime/accounting/source_ledger.hpp"

namespace quoin::deploy {

/// An instance of a source.
struct SourceInstance {
  std::string label;
  std::string service;
  runtime::SourceLedger ledger;  ///< has learned from all watches
};

/// Takes what one corner service publishes, and accounts for each scan of its source.
class CornerWatch {
 public:
  /// `joined_late`: the deployment ran before, the scans so far are for nobody. Throws
  /// std::runtime_error when DDS refuses.
  CornerWatch(runtime::Participant& participant, const Deployment& deployment,
              const ServiceConfig& service, bool joined_late);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] runtime::ReaderBase& reader() { return reader_; }
  /// Name of the service that its scans come from.
  void set_source(const std::string& name) { source_ = name; }
  /// Of the last message: the source's part.
  [[nodiscard]] const msg::StageTrace& source_trace() const { return source_trace_; }

  /// Takes all that has come; `on_scan` gets the header of each new scan. False when there was
  /// nothing.
  bool take_all(const std::function<void(const msg::Header&)>& on_scan);

  /// It is no part of the deployment. Should it come back, what happens meanwhile is for nobody.
  void interrupt();
  [[nodiscard]] bool heard_nothing() const { return accounting_.received() == 0; }
  /// The source has ended: what has not come will not.
  void end() { ended_ = true; }
  [[nodiscard]] const std::vector<runtime::SourceAccount>& sources() const {
    return accounting_.sources();
  }

  /// `instances`: of all sources.
  [[nodiscard]] CornerFigures figures(const std::vector<SourceInstance>& instances) const;

 private:
  void add(const msg::Corners& message);
  [[nodiscard]] std::uint64_t lost_at_start(const std::vector<SourceInstance>& instances) const;

  std::string name_;
  std::string source_;
  msg::StageTrace source_trace_;
  runtime::Reader<msg::Corners> reader_;
  runtime::ScanAccounting accounting_;
  bool joined_late_;
  bool ended_ = false;
  std::uint64_t first_number_ = 0;  // of the first scan that came, unless nobody waited for it
  std::uint64_t corners_ = 0;
  QuantileHistogram sigma_;
  QuantileHistogram ellipse_area_;
  msg::Corners message_;  // memory is kept from scan to scan
};

}  // namespace quoin::deploy
