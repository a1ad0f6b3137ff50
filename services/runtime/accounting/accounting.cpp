// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/accounting/accounting.hpp"

#include <algorithm>
#include <utility>

#include "services/topics/header.hpp"

namespace quoin::runtime {

namespace {

constexpr std::size_t most_sources = 4;  // processes of one source that are remembered

// [ns] A stage is not later than that, even on a machine that is overloaded, when what it brings is
// older than the present process of the source. An instance of a source that has another clock may
// be, and is heard again.
constexpr std::int64_t latest_repetition = 10'000'000'000;
constexpr std::int64_t latest_of_the_dead = 60'000'000'000;

// Beyond that at once, numbers are compared with the time: no 2D sensor gives 100 000 scans a
// second.
constexpr std::uint64_t most_at_once = 1000;
constexpr double highest_rate = 1e5;  // [Hz]

constexpr std::chrono::milliseconds longest_unused{500};
// Messages after which a jump counts as true, whatever looks like a repetition then.
constexpr std::uint64_t most_of_a_false_jump = 16;
// Processes of sources that are accounted for; the older half of more is settled.
constexpr std::size_t most_accounts = 256;

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
  if (position >= state_.previous->stages.size()) return false;
  const StagePosition& then = state_.previous->stages[position];
  return then.service == now.service() && then.incarnation != now.incarnation() &&
         static_cast<std::int64_t>(now.incarnation()) < then.published;
}

ScanAccounting::Made ScanAccounting::made_since(const msg::Header& header,
                                                std::size_t position) const {
  const msg::StageTrace& now = header.trace()[position];
  if (position < state_.previous->stages.size()) {
    const StagePosition& then = state_.previous->stages[position];
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
  const std::uint64_t first = same_source ? state_.previous->sequence_number + 1 : 0;
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
  if (source.incarnation() == state_.previous->stages[0].incarnation) return true;
  return topics::sequence_number(header) >= source.index() &&
         topics::sequence_number(header) - source.index() > state_.previous->sequence_number;
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
  const StagePosition& present = state_.previous->stages[0];
  if (source.incarnation() == present.incarnation) return false;
  const SourceAccount* const account = find_account(state_.sources, source.incarnation());
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
  return topics::sequence_number(header) == state_.previous->sequence_number + 1 &&
         topics::source(header) == state_.previous->source &&
         std::equal(header.trace().begin(), header.trace().end(), state_.previous->stages.begin(),
                    state_.previous->stages.end(),
                    [](const msg::StageTrace& now, const StagePosition& then) {
                      return now.incarnation() == then.incarnation &&
                             now.index() == then.index + 1 && now.service() == then.service;
                    });
}

void ScanAccounting::remember(const msg::Header& header) {
  if (!state_.previous) state_.previous = Previous{};
  state_.previous->source = topics::source(header);
  state_.previous->sequence_number = topics::sequence_number(header);
  state_.previous->stages.resize(header.trace().size());
  for (std::size_t i = 0; i < header.trace().size(); ++i) {
    const msg::StageTrace& trace = header.trace()[i];
    state_.previous->stages[i].service = trace.service();
    state_.previous->stages[i].incarnation = trace.incarnation();
    state_.previous->stages[i].index = trace.index();
    state_.previous->stages[i].published = trace.published();
  }
}

// When a late message of an earlier process came in between: where the present one stood before.
void ScanAccounting::return_to(const msg::Header& header) {
  const msg::StageTrace& source = header.trace()[0];
  if (source.incarnation() == state_.previous->stages[0].incarnation || took_over(header, 0))
    return;
  for (Previous& earlier : state_.earlier) {
    if (earlier.source == topics::source(header) &&
        earlier.stages[0].incarnation == source.incarnation()) {
      std::swap(earlier, *state_.previous);
      return;
    }
  }
}

// `change` matters where nothing has been heard of the process yet.
void ScanAccounting::account_for(const msg::Header& header, Change change,
                                 const std::vector<Loss>& losses) {
  const msg::StageTrace& source = header.trace()[0];
  SourceAccount* const known = find_account(state_.sources, source.incarnation());
  const std::uint64_t accounted = source.index() + 1;
  const std::uint64_t offset = topics::sequence_number(header) - source.index();
  if (known != nullptr) {
    known->accounted = std::max(known->accounted, accounted);
    known->offset = offset;
    return;
  }
  if (change != Change::begin) {
    // Settled, perhaps, where there were many.
    SourceAccount* const before =
        find_account(state_.sources, state_.previous->stages[0].incarnation);
    std::uint64_t lost = 0;
    for (const Loss& loss : losses) lost += loss.count;
    if (before != nullptr) before->handed_over = change == Change::go_on;
    if (before != nullptr && !before->handed_over && lost > topics::sequence_number(header)) {
      before->accounted += lost - topics::sequence_number(header);
    }
  }
  if (state_.sources.size() == most_accounts) {
    state_.sources.erase(state_.sources.begin(),
                         state_.sources.begin() + static_cast<std::ptrdiff_t>(most_accounts / 2));
  }
  state_.sources.push_back(
      {source.incarnation(), accounted, offset, change == Change::begin, false});
}

// Whether the source can have got so far since the last message.
bool ScanAccounting::plausible(const msg::Header& header) const {
  const std::uint64_t number = topics::sequence_number(header);
  const std::uint64_t before = continues_numbers(header) ? state_.previous->sequence_number : 0;
  if (number <= before || number - before <= most_at_once) return true;
  const std::chrono::duration<double> elapsed = now_() - arrived_;
  return static_cast<double>(number - before) <=
         static_cast<double>(most_at_once) + highest_rate * elapsed.count();
}

// `change`: how a message that is taken stands to the one before.
ScanAccounting::Verdict ScanAccounting::judge(const msg::Header& header, Change& change) {
  change = Change::begin;
  if (!state_.previous || topics::source(header) != state_.previous->source) {
    return Verdict::received;
  }
  return_to(header);
  change = change_to(header);
  if ((change == Change::go_on &&
       topics::sequence_number(header) <= state_.previous->sequence_number) ||
      repeats_earlier_source(header)) {
    return Verdict::duplicate;
  }
  return change == Change::begin || plausible(header) ? Verdict::received : Verdict::implausible;
}

// Whether for some time nothing came but what is not used of that process.
bool ScanAccounting::goes_on_unused(const msg::Header& header) {
  const std::uint64_t incarnation = header.trace()[0].incarnation();
  const std::uint64_t number = topics::sequence_number(header);
  const auto known = std::ranges::find(unused_, incarnation, &Unused::incarnation);
  if (known == unused_.end()) {
    if (unused_.size() == most_sources) unused_.erase(unused_.begin());
    unused_.push_back({incarnation, number, now_()});
    return false;
  }
  if (number <= known->sequence_number) {
    *known = {incarnation, number, now_()};
    return false;
  }
  known->sequence_number = number;
  return now_() - known->since >= longest_unused;
}

// What was taken last stood in the way: as before it, or where that is too long ago, from here on.
void ScanAccounting::rejoin() {
  if (before_jump_ && state_.received - before_jump_->received <= most_of_a_false_jump) {
    state_ = *std::exchange(before_jump_, std::nullopt);
  } else {
    state_.previous.reset();
    state_.earlier.clear();
  }
}

// What does not follow the message before.
std::vector<Loss> ScanAccounting::take(const msg::Header& header, Change change) {
  std::vector<Loss> losses;
  if (!state_.previous) {
    state_.first_sequence = topics::sequence_number(header);
  } else if (topics::source(header) == state_.previous->source) {
    if (change != Change::begin) losses = losses_before(header, change == Change::go_on);
    for (const Loss& loss : losses) state_.lost_by_site[loss.site] += loss.count;
    if (header.trace()[0].incarnation() != state_.previous->stages[0].incarnation) {
      if (state_.earlier.size() == most_sources) state_.earlier.erase(state_.earlier.begin());
      state_.earlier.push_back(*state_.previous);
    }
  }
  accept(header, change, losses);
  return losses;
}

void ScanAccounting::accept(const msg::Header& header, Change change,
                            const std::vector<Loss>& losses) {
  account_for(header, change, losses);
  ++state_.received;
  remember(header);
  unused_.clear();
  arrived_ = now_();
}

std::vector<Loss> ScanAccounting::receive(const msg::Header& header) {
  rejoined_ = false;
  verdict_ = Verdict::received;
  if (header.trace().empty()) return {};  // not from a stage of this project
  if (state_.previous && follows(header)) {
    accept(header, Change::go_on, {});
    return {};
  }
  State before = state_;
  Change change = Change::begin;
  verdict_ = judge(header, change);
  if (verdict_ == Verdict::received) {
    before_jump_ = std::move(before);
    return take(header, change);
  }
  state_ = std::move(before);
  if (!goes_on_unused(header)) {
    ++(verdict_ == Verdict::duplicate ? duplicates_ : implausible_);
    return {};
  }
  rejoined_ = true;
  rejoin();
  if (judge(header, change) != Verdict::received) state_.previous.reset();
  if (!state_.previous) change = Change::begin;
  verdict_ = Verdict::received;
  return take(header, change);
}

std::uint64_t ScanAccounting::lost() const {
  std::uint64_t sum = 0;
  for (const auto& [site, count] : state_.lost_by_site) sum += count;
  return sum;
}

}  // namespace quoin::runtime
