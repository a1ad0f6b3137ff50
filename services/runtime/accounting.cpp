// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/accounting.hpp"

#include <algorithm>

namespace quoin::runtime {

namespace {

constexpr std::size_t most_sources = 4;  // processes of one source that are remembered

// [ns] A stage is not later than that. An instance of a source that has another clock may be, and
// is heard again.
constexpr std::int64_t latest_repetition = 10'000'000'000;

}  // namespace

// Results that a stage made between the last message and a new one, without the new one.
struct ScanAccounting::Made {
  std::uint64_t count = 0;
  bool restarted = false;  // only estimated: the end of the old process is not known
};

// Whether a stage is another process than before, which lived already while the old one did.
bool ScanAccounting::took_over(const msg::Header& header, std::size_t position) const {
  const msg::StageTrace& now = header.trace()[position];
  if (position >= previous_->stages.size()) return false;
  const StagePosition& then = previous_->stages[position];
  return then.service == now.service() && then.incarnation != now.incarnation() &&
         static_cast<std::int64_t>(now.incarnation()) < then.published;
}

ScanAccounting::Made ScanAccounting::made_since(const msg::Header& header,
                                                std::size_t position) const {
  const msg::StageTrace& now = header.trace()[position];
  if (position < previous_->stages.size()) {
    const StagePosition& then = previous_->stages[position];
    if (then.service == now.service() && then.incarnation == now.incarnation()) {
      return {now.index() > then.index ? now.index() - then.index - 1 : 0, false};
    }
  }
  // What stands by makes results all the time, but nobody took them.
  return {took_over(header, position) ? 0 : now.index(), true};
}

std::vector<Loss> ScanAccounting::losses_before(const msg::Header& header, bool same_source) const {
  std::vector<Loss> losses;
  std::vector<Made> made;
  for (std::size_t i = 0; i < header.trace().size(); ++i) made.push_back(made_since(header, i));
  // What a later stage made, the earlier ones must have made too.
  for (std::size_t i = made.size() - 1; i-- > 0;) {
    if (made[i].restarted) made[i].count = std::max(made[i].count, made[i + 1].count);
  }
  const std::uint64_t first = same_source ? previous_->sequence_number + 1 : 0;
  // What took the place of another stage may have made more, but not of these scans.
  std::uint64_t given = header.sequence_number() - first;
  for (Made& stage : made) {
    if (stage.restarted) stage.count = std::min(stage.count, given);
    given = stage.count;
  }
  const auto add = [&](std::uint64_t had, std::uint64_t made_of_it, const std::string& stage) {
    if (made_of_it >= had) return;
    losses.push_back({first, header.sequence_number() - 1, had - made_of_it, stage});
  };
  // Scans that were taken but never written are the source's own loss.
  add(header.sequence_number() - first, made[0].count, header.trace()[0].service());
  for (std::size_t i = 1; i < made.size(); ++i) {
    add(made[i - 1].count, made[i].count, header.trace()[i].service());
  }
  add(made.back().count, 0, "link");
  return losses;
}

// Whether the source is the same process as before, or one that took over from it: a restarted one
// begins again with scan 0.
bool ScanAccounting::continues_numbers(const msg::Header& header) const {
  const msg::StageTrace& source = header.trace()[0];
  if (source.incarnation() == previous_->stages[0].incarnation) return true;
  return header.sequence_number() >= source.index() &&
         header.sequence_number() - source.index() > previous_->sequence_number;
}

// Whether this is of a process of the source that was heard before the present one, and older than
// what that one has sent: from a stage that is late.
bool ScanAccounting::repeats_earlier_source(const msg::Header& header) const {
  const msg::StageTrace& source = header.trace()[0];
  const std::int64_t late = previous_->stages[0].published - source.published();
  const bool heard = std::any_of(earlier_.begin(), earlier_.end(), [&](const Previous& earlier) {
    return earlier.sensor == header.sensor() &&
           earlier.stages[0].incarnation == source.incarnation();
  });
  return heard && source.incarnation() != previous_->stages[0].incarnation && late > 0 &&
         late < latest_repetition;
}

// The usual case: the next result of every stage.
bool ScanAccounting::follows(const msg::Header& header) const {
  return header.sequence_number() == previous_->sequence_number + 1 &&
         header.sensor() == previous_->sensor &&
         std::equal(header.trace().begin(), header.trace().end(), previous_->stages.begin(),
                    previous_->stages.end(),
                    [](const msg::StageTrace& now, const StagePosition& then) {
                      return now.incarnation() == then.incarnation &&
                             now.index() == then.index + 1 && now.service() == then.service;
                    });
}

void ScanAccounting::remember(const msg::Header& header) {
  if (!previous_) previous_ = Previous{};
  previous_->sensor = header.sensor();
  previous_->sequence_number = header.sequence_number();
  previous_->stages.resize(header.trace().size());
  for (std::size_t i = 0; i < header.trace().size(); ++i) {
    const msg::StageTrace& trace = header.trace()[i];
    previous_->stages[i].service = trace.service();
    previous_->stages[i].incarnation = trace.incarnation();
    previous_->stages[i].index = trace.index();
    previous_->stages[i].published = trace.published();
  }
}

std::vector<Loss> ScanAccounting::receive(const msg::Header& header) {
  std::vector<Loss> losses;
  last_was_duplicate_ = false;
  if (header.trace().empty()) return losses;  // not from a stage of this project
  if (!previous_) {
    first_sequence_ = header.sequence_number();
  } else if (header.sensor() == previous_->sensor && !follows(header)) {
    const bool same_source = continues_numbers(header);
    if ((same_source && header.sequence_number() <= previous_->sequence_number) ||
        repeats_earlier_source(header)) {
      ++duplicates_;
      last_was_duplicate_ = true;
      return losses;
    }
    if (same_source || !took_over(header, 0)) losses = losses_before(header, same_source);
    for (const Loss& loss : losses) lost_by_stage_[loss.stage] += loss.count;
    if (header.trace()[0].incarnation() != previous_->stages[0].incarnation) {
      if (earlier_.size() == most_sources) earlier_.erase(earlier_.begin());
      earlier_.push_back(*previous_);
    }
  }
  ++received_;
  remember(header);
  return losses;
}

std::vector<Loss> ScanAccounting::finish(std::uint64_t scans) {
  if (!previous_ || previous_->sequence_number + 1 >= scans) return {};
  const std::uint64_t first = previous_->sequence_number + 1;
  const Loss loss{first, scans - 1, scans - first, "end"};
  lost_by_stage_[loss.stage] += loss.count;
  return {loss};
}

std::uint64_t ScanAccounting::lost() const {
  std::uint64_t sum = 0;
  for (const auto& [stage, count] : lost_by_stage_) sum += count;
  return sum;
}

}  // namespace quoin::runtime
