// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include <zlib.h>

#include "sensor_bridge/message_files/mcap_records.hpp"

namespace quoin::sensor_bridge::mcap {

/// CRC-32 of zlib; `crc` is that of the bytes before.
inline std::uint32_t crc_of(std::string_view bytes, std::uint32_t crc = 0) {
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

static_assert(std::endian::native == std::endian::little, "MCAP is little-endian");

template <class T>
requires std::is_integral_v<T>
void append_value(T value, std::string& out) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

inline void append_value(const std::string& text, std::string& out) {
  append_value(static_cast<std::uint32_t>(text.size()), out);
  out += text;
}
inline void append_value(const LongBytes& value, std::string& out) {
  append_value(std::uint64_t{value.bytes.size()}, out);
  out += value.bytes;
}
inline void append_value(const Rest& value, std::string& out) { out += value.bytes; }

/// Maps and arrays of pairs: the length of their entries in bytes goes before them.
template <class Pairs>
requires requires(const Pairs& pairs) { pairs.begin()->second; }
void append_value(const Pairs& pairs, std::string& out) {
  const std::size_t begin = out.size();
  append_value(std::uint32_t{0}, out);
  for (const auto& [first, second] : pairs) {
    append_value(first, out);
    append_value(second, out);
  }
  const auto length = static_cast<std::uint32_t>(out.size() - begin - sizeof(std::uint32_t));
  std::memcpy(out.data() + begin, &length, sizeof length);
}

template <class Record>
void append_fields(const Record& record, std::string& out) {
  std::apply([&](auto... field) { (append_value(record.*field, out), ...); }, Record::fields());
}

/// Appends the record with its number and length. Returns its size.
template <class Record>
std::size_t append_record(const Record& record, std::string& out) {
  const std::size_t begin = out.size();
  append_value(static_cast<std::uint8_t>(Record::op), out);
  append_value(std::uint64_t{0}, out);
  append_fields(record, out);
  const std::uint64_t length = out.size() - begin - prefix_size;
  std::memcpy(out.data() + begin + 1, &length, sizeof length);
  return out.size() - begin;
}

/// Reads the fields of a record; every length is checked against what is there.
class FieldReader {
 public:
  explicit FieldReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_integral_v<T>
  [[nodiscard]] bool read(T& value) {
    if (bytes_.size() - at_ < sizeof(T)) return false;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return true;
  }
  [[nodiscard]] bool read(std::string& text) {
    std::uint32_t length = 0;
    std::string_view found;
    if (!read(length) || !take(length, found)) return false;
    text = found;
    return true;
  }
  [[nodiscard]] bool read(LongBytes& value) {
    std::uint64_t length = 0;
    return read(length) && take(length, value.bytes);
  }
  [[nodiscard]] bool read(Rest& value) { return take(bytes_.size() - at_, value.bytes); }
  template <class First, class Second>
  [[nodiscard]] bool read(std::map<First, Second>& pairs) {
    pairs.clear();
    return read_pairs<First, Second>(
        [&](First first, Second second) { pairs[std::move(first)] = std::move(second); });
  }
  template <class First, class Second>
  [[nodiscard]] bool read(std::vector<std::pair<First, Second>>& pairs) {
    pairs.clear();
    return read_pairs<First, Second>([&](First first, Second second) {
      pairs.emplace_back(std::move(first), std::move(second));
    });
  }

 private:
  [[nodiscard]] bool take(std::uint64_t count, std::string_view& out) {
    if (bytes_.size() - at_ < count) return false;
    out = bytes_.substr(at_, count);
    at_ += count;
    return true;
  }
  template <class First, class Second, class Add>
  [[nodiscard]] bool read_pairs(Add add) {
    std::uint32_t length = 0;
    std::string_view entries;
    if (!read(length) || !take(length, entries)) return false;
    FieldReader inner(entries);
    while (inner.at_ < entries.size()) {
      First first{};
      Second second{};
      if (!inner.read(first) || !inner.read(second)) return false;
      add(std::move(first), std::move(second));
    }
    return true;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// Reads what is behind the number and length of a record. False when its lengths go beyond that;
/// what follows the known fields is left to later versions of the format.
template <class Record>
[[nodiscard]] bool read_record(std::string_view bytes, Record& record) {
  FieldReader reader(bytes);
  return std::apply([&](auto... field) { return (reader.read(record.*field) && ...); },
                    Record::fields());
}

}  // namespace quoin::sensor_bridge::mcap
