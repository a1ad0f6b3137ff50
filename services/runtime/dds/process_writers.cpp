// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/process_writers.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace quoin::runtime {

namespace {

constexpr std::chrono::seconds longest_silence{2};
// One that invents processes makes nobody forget those of others.
constexpr std::ptrdiff_t most_of_a_writer = 64;
constexpr std::size_t most_entries = 1024;

constexpr std::string_view announcement = "quoin process ";

}  // namespace

std::string writer_announcement(std::uint64_t incarnation) {
  return std::string(announcement) + std::to_string(incarnation) + ";";
}

std::uint64_t announced_incarnation(std::string_view user_data) {
  if (!user_data.starts_with(announcement)) return 0;
  user_data.remove_prefix(announcement.size());
  std::uint64_t incarnation = 0;
  const auto* const end = user_data.data() + user_data.size();
  const auto [stop, error] = std::from_chars(user_data.data(), end, incarnation);
  return error == std::errc() && stop != end && *stop == ';' ? incarnation : 0;
}

bool ProcessWriters::admit(const std::string& service, std::uint64_t incarnation,
                           std::uint64_t writer, std::uint64_t announced) {
  if (announced != 0) {
    if (announced != incarnation) return false;
    announced_heard_ = now_();
    return true;
  }
  if (!hears_strangers()) return false;
  for (Entry& entry : entries_) {
    if (entry.incarnation != incarnation || entry.service != service) continue;
    if (entry.writer == writer) {
      entry.contested.reset();
      return true;
    }
    if (!entry.contested) entry.contested = now_();
    if (now_() - *entry.contested < longest_silence) return false;
    entry.writer = writer;
    entry.contested.reset();
    return true;
  }
  remember(service, incarnation, writer);
  return true;
}

bool ProcessWriters::hears_strangers() const {
  return !announced_heard_ || now_() - *announced_heard_ >= longest_silence;
}

void ProcessWriters::remember(const std::string& service, std::uint64_t incarnation,
                              std::uint64_t writer) {
  const auto of_writer = [&](const Entry& entry) { return entry.writer == writer; };
  if (std::ranges::count_if(entries_, of_writer) >= most_of_a_writer) {
    entries_.erase(std::ranges::find_if(entries_, of_writer));
  } else if (entries_.size() == most_entries) {
    entries_.erase(entries_.begin());
  }
  entries_.push_back({service, incarnation, writer});
}

}  // namespace quoin::runtime
