// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/accounting/accounting.hpp"

#include <algorithm>

#include "services/topics/header.hpp"

namespace quoin::runtime {

namespace {

constexpr std::size_t most_sources = 4;  // processes of one source that are remembered

// [ns] A stage is not later than that, even on a machine that is overloaded, when what it brings is
// older than the present process of the source. An instance of a source that has another clock may
// be, and is heard again.
constexpr std::int64_t latest_repetition = 10'000'000'000;
constexpr std::int64_t latest_of_the_dead = 60'000'000'000;

// Of a process of the source; null when nothing was heard of it.
template <class Accounts>
auto* find_account(Accounts& accounts, std::uint64_t incarnation) {
  const auto account = std::find_if(accounts.rbegin(), accounts.rend(), [&](const auto& known) {
    return known.incarnation == incarnation;
  });
  return account == accounts.rend() ? nullptr : &*account;
}

}  // namespace

std::string to_text(const LossSite& site) {
  switch (site.place) {
    case LossPlace::service:
      return site.service;
    case LossPlace::link:
      return "the link";
    case LossPlace::start:
      return "the start";
    case LossPlace::end:
      return "the end";
  }
  return "unknown";
}

// How a message stands to the one before.
enum class ScanAccounting::Change {
  begin,    // nothing is to be said of the scans in between
  restart,  // a process of the source that began with its own numbers
  go_on,    // the same numbers
};

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
  std::uint64_t given = topics::sequence_number(header) - first;
  for (Made& stage : made) {
    if (stage.restarted || same_source) stage.count = std::min(stage.count, given);
    given = stage.count;
  }
  const auto add = [&](std::uint64_t had, std::uint64_t made_of_it, LossSite site) {
    if (made_of_it >= had) return;
    losses.push_back(
        {first, topics::sequence_number(header) - 1, had - made_of_it, std::move(site)});
  };
  // Scans that were taken but never written are the source's own loss.
  add(topics::sequence_number(header) - first, made[0].count,
      {LossPlace::service, header.trace()[0].service()});
  for (std::size_t i = 1; i < made.size(); ++i) {
    add(made[i - 1].count, made[i].count, {LossPlace::service, header.trace()[i].service()});
  }
  add(made.back().count, 0, {LossPlace::link});
  return losses;
}

// Whether the source is the same process as before, or one that took over from it: a restarted one
// begins again with scan 0.
bool ScanAccounting::continues_numbers(const msg::Header& header) const {
  const msg::StageTrace& source = header.trace()[0];
  if (source.incarnation() == previous_->stages[0].incarnation) return true;
  return topics::sequence_number(header) >= source.index() &&
         topics::sequence_number(header) - source.index() > previous_->sequence_number;
}

// How a message of the same source stands to the one before.
ScanAccounting::Change ScanAccounting::change_to(const msg::Header& header) const {
  if (continues_numbers(header)) return Change::go_on;
  return took_over(header, 0) ? Change::begin : Change::restart;
}

// Whether this is of an earlier process of the source than the present one, and was accounted for
// or is older than what that one has sent: from a stage that is late.
bool ScanAccounting::repeats_earlier_source(const msg::Header& header) const {
  const msg::StageTrace& source = header.trace()[0];
  const StagePosition& present = previous_->stages[0];
  if (source.incarnation() == present.incarnation) return false;
  const SourceAccount* const account = find_account(sources_, source.incarnation());
  if (account != nullptr && (account->handed_over || source.index() < account->accounted)) {
    return true;
  }
  const std::int64_t late = present.published - source.published();
  if (late <= 0) return false;
  const bool of_the_dead = source.published() < static_cast<std::int64_t>(present.incarnation);
  return (of_the_dead && late < latest_of_the_dead) ||
         (account != nullptr && late < latest_repetition);
}

// The usual case: the next result of every stage.
bool ScanAccounting::follows(const msg::Header& header) const {
  return topics::sequence_number(header) == previous_->sequence_number + 1 &&
         topics::source(header) == previous_->source &&
         std::equal(header.trace().begin(), header.trace().end(), previous_->stages.begin(),
                    previous_->stages.end(),
                    [](const msg::StageTrace& now, const StagePosition& then) {
                      return now.incarnation() == then.incarnation &&
                             now.index() == then.index + 1 && now.service() == then.service;
                    });
}

void ScanAccounting::remember(const msg::Header& header) {
  if (!previous_) previous_ = Previous{};
  previous_->source = topics::source(header);
  previous_->sequence_number = topics::sequence_number(header);
  previous_->stages.resize(header.trace().size());
  for (std::size_t i = 0; i < header.trace().size(); ++i) {
    const msg::StageTrace& trace = header.trace()[i];
    previous_->stages[i].service = trace.service();
    previous_->stages[i].incarnation = trace.incarnation();
    previous_->stages[i].index = trace.index();
    previous_->stages[i].published = trace.published();
  }
}

// When a late message of an earlier process came in between: where the present one stood before.
void ScanAccounting::return_to(const msg::Header& header) {
  const msg::StageTrace& source = header.trace()[0];
  if (source.incarnation() == previous_->stages[0].incarnation || took_over(header, 0)) return;
  for (Previous& earlier : earlier_) {
    if (earlier.source == topics::source(header) &&
        earlier.stages[0].incarnation == source.incarnation()) {
      std::swap(earlier, *previous_);
      return;
    }
  }
}

// `change` matters where nothing has been heard of the process yet.
void ScanAccounting::account_for(const msg::Header& header, Change change,
                                 const std::vector<Loss>& losses) {
  const msg::StageTrace& source = header.trace()[0];
  SourceAccount* const known = find_account(sources_, source.incarnation());
  const std::uint64_t accounted = source.index() + 1;
  const std::uint64_t offset = topics::sequence_number(header) - source.index();
  if (known != nullptr) {
    known->accounted = std::max(known->accounted, accounted);
    known->offset = offset;
    return;
  }
  if (change != Change::begin) {
    SourceAccount& before = *find_account(sources_, previous_->stages[0].incarnation);
    before.handed_over = change == Change::go_on;
    std::uint64_t lost = 0;
    for (const Loss& loss : losses) lost += loss.count;
    if (!before.handed_over && lost > topics::sequence_number(header)) {
      before.accounted += lost - topics::sequence_number(header);
    }
  }
  sources_.push_back({source.incarnation(), accounted, offset, change == Change::begin, false});
}

std::vector<Loss> ScanAccounting::receive(const msg::Header& header) {
  std::vector<Loss> losses;
  last_was_duplicate_ = false;
  if (header.trace().empty()) return losses;  // not from a stage of this project
  Change change = Change::begin;
  if (!previous_) {
    first_sequence_ = topics::sequence_number(header);
  } else if (topics::source(header) == previous_->source && !follows(header)) {
    return_to(header);
    change = change_to(header);
    if ((change == Change::go_on &&
         topics::sequence_number(header) <= previous_->sequence_number) ||
        repeats_earlier_source(header)) {
      ++duplicates_;
      last_was_duplicate_ = true;
      return losses;
    }
    if (change != Change::begin) losses = losses_before(header, change == Change::go_on);
    for (const Loss& loss : losses) lost_by_site_[loss.site] += loss.count;
    if (header.trace()[0].incarnation() != previous_->stages[0].incarnation) {
      if (earlier_.size() == most_sources) earlier_.erase(earlier_.begin());
      earlier_.push_back(*previous_);
    }
  }
  account_for(header, change, losses);
  ++received_;
  remember(header);
  return losses;
}

std::uint64_t ScanAccounting::lost() const {
  std::uint64_t sum = 0;
  for (const auto& [site, count] : lost_by_site_) sum += count;
  return sum;
}

}  // namespace quoin::runtime
