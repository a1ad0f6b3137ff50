// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/statistics/line_scatter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

constexpr std::size_t fewest_lines = 100;
// What noise is known to at best; less is not worth a word.
constexpr double worth_a_word = 1.1;

// The same for to_text and parse_line_scatter.
constexpr const char* format =
    "%.3f [%.3f, %.3f] of %zu lines; odd and even points agree in %.1f %% [%.1f, %.1f] of %zu";
constexpr const char* scanned =
    "%lf [%lf, %lf] of %zu lines; odd and even points agree in %lf %% [%lf, %lf] of %zu%n";

}  // namespace

void RunningScatter::trim(std::deque<Value>& values, double time) {
  while (!values.empty() && (values.front().time < time - window || values.size() > most_lines)) {
    values.pop_front();
  }
}

void RunningScatter::add(double time, double chi_square, std::size_t points) {
  if (points < 3 || !std::isfinite(chi_square)) return;
  const auto freedom = static_cast<double>(points - 2);
  reduced_.push_back({time, chi_square / median_chi_square(freedom)});
  trim(reduced_, time);
}

void RunningScatter::add_split(double time, double squared) {
  if (!std::isfinite(squared)) return;
  splits_.push_back({time, squared});
  trim(splits_, time);
}

void RunningScatter::clear() {
  reduced_.clear();
  splits_.clear();
}

LineScatter RunningScatter::scatter(double time) {
  trim(reduced_, time);
  trim(splits_, time);
  LineScatter scatter;
  scatter.lines = reduced_.size();
  if (!reduced_.empty()) {
    std::vector<double> values;
    for (const Value& value : reduced_) values.push_back(value.value);
    std::ranges::sort(values);
    const auto count = static_cast<double>(values.size());
    // The ranks between which the median lies in 95 % of all samples.
    const double half = 0.5 * normal_97_5 * std::sqrt(count);
    const auto at = [&](double rank) {
      return values[static_cast<std::size_t>(std::clamp(rank, 0.0, count - 1.0))];
    };
    scatter.reduced_chi_square = {at(0.5 * count), at(0.5 * count - half),
                                  at(std::ceil(0.5 * count + half))};
  }
  scatter.split_lines = splits_.size();
  scatter.split_inside95 =
      proportion(static_cast<std::size_t>(std::ranges::count_if(
                     splits_, [](const Value& value) { return value.value <= chi_square_2_95; })),
                 splits_.size());
  return scatter;
}

std::string to_text(const LineScatter& scatter) {
  std::array<char, 256> text{};
  const Interval& reduced = scatter.reduced_chi_square;
  const Interval& inside = scatter.split_inside95;
  std::snprintf(text.data(), text.size(), format, reduced.value, reduced.low, reduced.high,
                scatter.lines, 100.0 * inside.value, 100.0 * inside.low, 100.0 * inside.high,
                scatter.split_lines);
  return text.data();
}

std::optional<LineScatter> parse_line_scatter(std::string_view text) {
  const std::string copy(text);
  LineScatter scatter;
  Interval& reduced = scatter.reduced_chi_square;
  Interval& inside = scatter.split_inside95;
  int end = 0;
  const int read = std::sscanf(copy.c_str(), scanned, &reduced.value, &reduced.low, &reduced.high,
                               &scatter.lines, &inside.value, &inside.low, &inside.high,
                               &scatter.split_lines, &end);
  if (read != 8 || static_cast<std::size_t>(end) != copy.size()) return std::nullopt;
  for (double* value : {&inside.value, &inside.low, &inside.high}) *value *= 0.01;
  return scatter;
}

std::string complaint(const LineScatter& scatter) {
  if (scatter.lines < fewest_lines) return "";
  const Interval& reduced = scatter.reduced_chi_square;
  const bool more = std::sqrt(reduced.low) > worth_a_word;
  const bool less = std::sqrt(reduced.high) < 1.0 / worth_a_word;
  if (!more && !less) return "";
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(),
                "lines scatter %.2g times as much as the sensor model (range_stddev) says",
                std::sqrt(reduced.value));
  return std::string(text.data()) +
         (more ? ": covariances are too small" : ": covariances are too large");
}

}  // namespace quoin
