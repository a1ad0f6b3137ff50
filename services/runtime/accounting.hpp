// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Common.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace quoin::runtime {

/// Scans missing between two messages of a topic, and the stage that did not deliver them.
struct Loss {
  std::uint64_t first_sequence = 0;
  std::uint64_t last_sequence = 0;  ///< included
  std::uint64_t count = 0;          ///< scans of this range that the stage did not deliver
  std::string stage;  ///< service name; the reader's own input link has the name "link"
};

/// Tells for each scan whether it arrived, and if not, where it was lost, from nothing but the
/// headers of the messages that did arrive. Every stage numbers what it publishes
/// (StageTrace.index), so the difference of two headers says how many results each stage made of
/// the scans in between: the first stage that made fewer than its predecessor lost the others.
///
/// Exact as long as the stages live. When one is restarted, or another takes its place or takes
/// over from it, scans missing between the last result of the one and the first of the other are
/// put to its account. When another instance of a source takes over, which numbers scans of its
/// own, nothing is counted as lost: of what the two saw nobody can say whether it was the same.
/// What comes of an earlier process of the source when its successor has been heard is a
/// repetition, as a stage that was late may make it.
class ScanAccounting {
 public:
  /// Takes note of a message; returns the losses since the one before (usually none). Scans before
  /// the first message of a sensor are not lost: nobody was listening.
  std::vector<Loss> receive(const msg::Header& header);

  /// From here to the next message nobody listens: nothing in between is lost.
  void interrupt() {
    previous_.reset();
    earlier_.clear();
  }

  /// Losses behind the last message, when the source is known to have numbered `scans` scans.
  std::vector<Loss> finish(std::uint64_t scans);

  /// Whether the last message was of a scan that had been received before, or was older.
  [[nodiscard]] bool last_was_duplicate() const { return last_was_duplicate_; }
  [[nodiscard]] std::uint64_t received() const { return received_; }
  [[nodiscard]] std::uint64_t duplicates() const { return duplicates_; }
  [[nodiscard]] std::uint64_t lost() const;
  /// Lost scans by stage; "link" is the link from the last stage to this reader.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& lost_by_stage() const {
    return lost_by_stage_;
  }
  /// Number of the first scan received; nothing before that.
  [[nodiscard]] std::optional<std::uint64_t> first_sequence() const { return first_sequence_; }

 private:
  // Where a stage stood at the last message.
  struct StagePosition {
    std::string service;
    std::uint64_t incarnation = 0;
    std::uint64_t index = 0;
    std::int64_t published = 0;  // [ns since the Unix epoch]
  };
  struct Previous {
    std::string sensor;
    std::uint64_t sequence_number = 0;
    std::vector<StagePosition> stages;
  };
  struct Made;

  [[nodiscard]] bool continues_numbers(const msg::Header& header) const;
  [[nodiscard]] bool repeats_earlier_source(const msg::Header& header) const;
  [[nodiscard]] bool took_over(const msg::Header& header, std::size_t position) const;
  [[nodiscard]] bool follows(const msg::Header& header) const;
  [[nodiscard]] Made made_since(const msg::Header& header, std::size_t position) const;
  [[nodiscard]] std::vector<Loss> losses_before(const msg::Header& header, bool same_source) const;
  void remember(const msg::Header& header);

  std::optional<Previous> previous_;
  std::vector<Previous> earlier_;  // the last messages of the processes of the source before that
  std::optional<std::uint64_t> first_sequence_;
  std::uint64_t received_ = 0;
  std::uint64_t duplicates_ = 0;
  bool last_was_duplicate_ = false;
  std::map<std::string, std::uint64_t> lost_by_stage_;
};

}  // namespace quoin::runtime
