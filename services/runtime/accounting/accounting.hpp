// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <idl/Common.h>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quoin::runtime {

/// Where scans get lost.
enum class LossPlace {
  service,  ///< in a service, which received them and gave no result
  link,     ///< between the last service and the reader that counts
  start,    ///< before the first message that this reader got
  end,      ///< behind the last one
};

struct LossSite {
  LossPlace place = LossPlace::service;
  std::string service = {};  ///< "" unless the place is a service

  friend auto operator<=>(const LossSite&, const LossSite&) = default;
};

/// "walls", "the link", "the start", "the end": for people, who know which services there are.
[[nodiscard]] std::string to_text(const LossSite& site);

using LossCounts = std::map<LossSite, std::uint64_t>;

/// Scans missing between two messages of a topic, and where they were lost.
struct Loss {
  std::uint64_t first_sequence = 0;
  std::uint64_t last_sequence = 0;  ///< included
  std::uint64_t count = 0;          ///< scans of this range that the stage did not deliver
  LossSite site;
};

/// What a reader has accounted for of one process of a source.
struct SourceAccount {
  std::uint64_t incarnation = 0;
  /// What it published and was delivered, is lost, or was for nobody. Losses that are known to be
  /// behind its last scan that arrived are among them, even when they are of processes after it of
  /// which nothing ever arrived.
  std::uint64_t accounted = 0;
  std::uint64_t offset = 0;  ///< of its numbers from its results, at the last one that arrived
  bool begins = true;        ///< what earlier processes published was for nobody
  bool handed_over = false;  ///< another one went on with its numbers: all are accounted for
};

/// Finds for each scan whether it arrived, and if not, where it was lost, from nothing but the
/// headers of the messages that did arrive. Every stage numbers what it publishes
/// (StageTrace.index), so the difference of two headers says how many results each stage made of
/// the scans in between: the first stage that made fewer than its predecessor lost the others.
///
/// Exact as long as the stages live. When one is restarted, or another takes its place or takes
/// over from it, scans missing between the last result of the one and the first of the other are
/// put to its account. When another instance of a source takes over, which numbers scans of its
/// own, nothing is counted as lost: of what the two saw nobody can say whether it was the same.
/// What comes of an earlier process of the source when its successor has been heard is a
/// repetition, as a stage that was late may make it. How many scans a process of the source
/// published behind the last one that arrived cannot be known from headers; who knows it compares
/// it with `sources` (`SourceLedger`).
///
/// Anybody may have made a header. A number that no sensor can have reached since the last message
/// is refused. Should one that was taken have been false all the same, all that comes after it
/// looks like repetitions; when for half a second nothing else comes, they are taken for the
/// stream, and the jump before them for what it was.
class ScanAccounting {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ScanAccounting(std::function<Clock::time_point()> now = Clock::now)
      : now_(std::move(now)) {}

  /// What became of a message.
  enum class Verdict {
    received,
    duplicate,    ///< received before, or older: not to be used
    implausible,  ///< with a number that cannot be: not to be used
  };

  /// Takes note of a message; returns the losses since the one before (usually none). Scans before
  /// the first message of a source are not lost: nobody was listening.
  std::vector<Loss> receive(const msg::Header& header);

  /// From here to the next message nobody listens: nothing in between is lost.
  void interrupt() {
    state_.previous.reset();
    state_.earlier.clear();
    before_jump_.reset();
    unused_.clear();
  }

  /// On the last message.
  [[nodiscard]] Verdict verdict() const { return verdict_; }
  /// Whether the last message was taken although it looked like a repetition; then the figures
  /// below may have gone down: those of a false jump are not among them any more.
  [[nodiscard]] bool rejoined() const { return rejoined_; }
  [[nodiscard]] std::uint64_t received() const { return state_.received; }
  [[nodiscard]] std::uint64_t duplicates() const { return duplicates_; }
  [[nodiscard]] std::uint64_t implausible() const { return implausible_; }
  [[nodiscard]] std::uint64_t lost() const;
  [[nodiscard]] const LossCounts& lost_by_site() const { return state_.lost_by_site; }
  /// Number of the first scan received; nothing before that.
  [[nodiscard]] std::optional<std::uint64_t> first_sequence() const {
    return state_.first_sequence;
  }
  /// The processes of sources in the order in which they were first heard; of hundreds the last
  /// ones.
  [[nodiscard]] const std::vector<SourceAccount>& sources() const { return state_.sources; }

 private:
  // Where a stage stood at the last message.
  struct StagePosition {
    std::string service;
    std::uint64_t incarnation = 0;
    std::uint64_t index = 0;
    std::int64_t published = 0;  // [ns since the Unix epoch]
  };
  struct Previous {
    std::string source;
    std::uint64_t sequence_number = 0;
    std::vector<StagePosition> stages;
  };
  struct State {
    std::optional<Previous> previous;
    std::vector<Previous> earlier;  // the last messages of the processes of the source before that
    std::vector<SourceAccount> sources;
    std::optional<std::uint64_t> first_sequence;
    std::uint64_t received = 0;
    LossCounts lost_by_site;
  };
  // Messages of one process of a source that were not used, with ascending numbers, and nothing
  // else in between.
  struct Unused {
    std::uint64_t incarnation = 0;
    std::uint64_t sequence_number = 0;  // of the last
    Clock::time_point since;
  };
  struct Made;
  enum class Change;

  [[nodiscard]] bool continues_numbers(const msg::Header& header) const;
  [[nodiscard]] Change change_to(const msg::Header& header) const;
  [[nodiscard]] bool repeats_earlier_source(const msg::Header& header) const;
  [[nodiscard]] bool took_over(const msg::Header& header, std::size_t position) const;
  [[nodiscard]] bool follows(const msg::Header& header) const;
  [[nodiscard]] Made made_since(const msg::Header& header, std::size_t position) const;
  [[nodiscard]] std::vector<Loss> losses_before(const msg::Header& header, bool same_source) const;
  [[nodiscard]] bool plausible(const msg::Header& header) const;
  [[nodiscard]] Verdict judge(const msg::Header& header, Change& change);
  [[nodiscard]] bool goes_on_unused(const msg::Header& header);
  void rejoin();
  std::vector<Loss> take(const msg::Header& header, Change change);
  void accept(const msg::Header& header, Change change, const std::vector<Loss>& losses);
  void remember(const msg::Header& header);
  void return_to(const msg::Header& header);
  void account_for(const msg::Header& header, Change change, const std::vector<Loss>& losses);

  std::function<Clock::time_point()> now_;
  State state_;
  std::optional<State> before_jump_;  // the last time that the numbers did not follow each other
  std::vector<Unused> unused_;
  Clock::time_point arrived_;  // the last message that was taken
  std::uint64_t duplicates_ = 0;
  std::uint64_t implausible_ = 0;
  Verdict verdict_ = Verdict::received;
  bool rejoined_ = false;
};

}  // namespace quoin::runtime
