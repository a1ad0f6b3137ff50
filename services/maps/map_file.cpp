// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/maps/map_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include <zlib.h>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"
#include "services/files/atomic_file.hpp"
#include "services/files/regular_file.hpp"

namespace quoin::maps {

namespace {

constexpr std::string_view title = "quoin-map";
constexpr int version = 1;

std::uint32_t crc_of(std::string_view text) {
  return static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size())));
}

template <class T>
void append(std::string& text, T value) {
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end).push_back(' ');
}

std::string hexadecimal(std::uint32_t value) {
  std::array<char, 16> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x", value);
  return digits.data();
}

/// Lines of words, with their number for messages.
class Words {
 public:
  Words(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void next_line() {
    const std::size_t end = text_.find('\n');
    if (end == std::string_view::npos) fail("the file ends here; it is cut off");
    line_ = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    ++number_;
  }
  std::string_view word() {
    line_.remove_prefix(std::min(line_.find_first_not_of(' '), line_.size()));
    const std::string_view word = line_.substr(0, line_.find(' '));
    line_.remove_prefix(word.size());
    return word;
  }
  template <class T>
  T number() {
    const std::string_view text = word();
    const auto value = sensor_bridge::parse_number<T>(text);
    if (!value) fail(sensor_bridge::excerpt(text) + " is not a number");
    return *value;
  }
  void expect(std::string_view name) {
    const std::string_view found = word();
    if (found != name) {
      fail("'" + std::string(name) + "' is expected, not " + sensor_bridge::excerpt(found));
    }
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw MapError(file_ + ":" + std::to_string(number_) + ": " + what);
  }

 private:
  std::string_view text_;
  std::string_view line_;
  const std::string& file_;
  std::size_t number_ = 0;
};

std::vector<std::uint8_t> bytes_of(std::string_view digits, const Words& words) {
  std::vector<std::uint8_t> bytes;
  if (digits.size() % 2 != 0) words.fail("a state of an odd number of digits");
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    std::uint8_t value = 0;
    const char* const end = digits.data() + i + 2;
    if (std::from_chars(digits.data() + i, end, value, 16).ptr != end) {
      words.fail("a state that is not hexadecimal");
    }
    bytes.push_back(value);
  }
  return bytes;
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::string text;
  const std::string problem = read_regular(file, largest_file, text);
  if (text.size() > largest_file) {
    throw MapError(file.string() + ": is larger than " + std::to_string(largest_file >> 20U) +
                   " MB; it is no map of lines");
  }
  if (!problem.empty()) throw MapError(file.string() + ": cannot be read: " + problem);
  return text;
}

void write_whole(const std::filesystem::path& file, std::string_view content) {
  const int error = write_atomically(file, content, 0644);
  if (error != 0) throw MapError(file.string() + ": cannot be written: " + std::strerror(error));
}

std::string map_text(const SavedMap& map) {
  std::string text = std::string(title) + " " + std::to_string(version) + "\n";
  text += "frame " + map.frame + "\n";
  text += "begun " + std::to_string(map.begun) + "\n";
  text += "method " + (map.method.empty() ? "-" : map.method) + " " +
          (map.state_form.empty() ? "-" : map.state_form) + "\n";
  text += "state ";
  constexpr std::string_view digits = "0123456789abcdef";
  for (const std::uint8_t byte : map.state) {
    text += digits[byte >> 4U];
    text += digits[byte & 15U];
  }
  text += "\nwalls " + std::to_string(map.lines.size()) + "\n";
  for (const MapLine& line : map.lines) {
    append(text, line.id);
    for (const double value : {line.start.x(), line.start.y(), line.end.x(), line.end.y(),
                               line.covariance(0, 0), line.covariance(0, 1), line.covariance(1, 1)})
      append(text, value);
    append(text, line.observations);
    text.back() = '\n';
  }
  return text + "checksum " + hexadecimal(crc_of(text)) + "\n";
}

SavedMap parse_map(std::string_view text, const std::string& file) {
  Words words(text, file);
  if (!text.starts_with(title)) {
    throw MapError(file + ":1: this is no map of Quoin, which begins with '" + std::string(title) +
                   "'");
  }
  words.next_line();
  words.expect(title);
  const int found = words.number<int>();
  if (found != version) {
    words.fail("a map of version " + std::to_string(found) + "; this program reads version " +
               std::to_string(version) + "; use the program that wrote it, or name another file");
  }
  const std::size_t end = text.rfind("\nchecksum ");
  if (end == std::string_view::npos ||
      text.substr(end + 1) != "checksum " + hexadecimal(crc_of(text.substr(0, end + 1))) + "\n") {
    throw MapError(file +
                   ": the checksum at its end is missing or wrong: the file is damaged or was "
                   "edited; restore a copy, or name another file");
  }
  SavedMap map;
  words.next_line();
  words.expect("frame");
  map.frame = words.word();
  words.next_line();
  words.expect("begun");
  map.begun = words.number<std::uint64_t>();
  words.next_line();
  words.expect("method");
  const auto name = [&] {
    const std::string_view word = words.word();
    return word == "-" ? std::string() : std::string(word);
  };
  map.method = name();
  map.state_form = name();
  words.next_line();
  words.expect("state");
  map.state = bytes_of(words.word(), words);
  words.next_line();
  words.expect("walls");
  const auto count = words.number<std::size_t>();
  if (count > most_lines) words.fail("more than a million walls");
  for (std::size_t i = 0; i < count; ++i) {
    words.next_line();
    MapLine& line = map.lines.emplace_back();
    line.id = words.number<std::uint64_t>();
    std::array<double, 7> values{};
    for (double& value : values) {
      value = words.number<double>();
      if (!std::isfinite(value)) words.fail("a number that is not finite");
    }
    line.start = {values[0], values[1]};
    line.end = {values[2], values[3]};
    line.covariance << values[4], values[5], values[5], values[6];
    line.observations = words.number<std::size_t>();
  }
  return map;
}

}  // namespace quoin::maps
