// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/pose.hpp"

namespace quoin {

/// What a localizer keeps, as bytes and back. A type describes itself once, for both directions:
///
///     template <class Archive, class Self>
///     static void transfer(Archive& archive, Self& self) { archive(self.a, self.b); }
///
/// Numbers are little-endian, as all machines are that Quoin runs on; lists begin with their
/// length.
template <class T>
struct StateFields {};  // specialised for types that do not describe themselves

template <>
struct StateFields<Pose2> {
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& pose) {
    archive(pose.x, pose.y, pose.theta);
  }
};

namespace detail {
template <class T>
inline constexpr bool is_dense =
    std::is_base_of_v<Eigen::DenseBase<std::remove_const_t<T>>, std::remove_const_t<T>>;
}  // namespace detail

class StateWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (detail::is_dense<T>) {
      if constexpr (T::SizeAtCompileTime == Eigen::Dynamic) {
        put(static_cast<std::uint64_t>(value.rows()));
        put(static_cast<std::uint64_t>(value.cols()));
      }
      for (Eigen::Index c = 0; c < value.cols(); ++c) {
        for (Eigen::Index r = 0; r < value.rows(); ++r) put(value(r, c));
      }
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
      bytes_.insert(bytes_.end(), first, first + sizeof(T));
    } else if constexpr (requires { StateFields<T>::transfer(*this, value); }) {
      StateFields<T>::transfer(*this, value);
    } else {
      T::transfer(*this, value);
    }
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class A, class B>
  void put(const std::pair<A, B>& value) {
    (*this)(value.first, value.second);
  }

  std::vector<std::uint8_t> bytes_;
};

/// Throws std::invalid_argument for bytes that end early, go on, or hold what cannot be.
class StateReader {
 public:
  explicit StateReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  void expect_end() const {
    if (!bytes_.empty()) throw std::invalid_argument("the state goes on behind its end");
  }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (detail::is_dense<T>) {
      if constexpr (T::SizeAtCompileTime == Eigen::Dynamic) {
        const std::size_t rows = length(0);
        const std::size_t columns = length(0);
        if (columns != 0 && rows > bytes_.size() / sizeof(typename T::Scalar) / columns) {
          throw std::invalid_argument("the state ends early");
        }
        value.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
      }
      for (Eigen::Index c = 0; c < value.cols(); ++c) {
        for (Eigen::Index r = 0; r < value.rows(); ++r) get(value(r, c));
      }
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      if (bytes_.size() < sizeof(T)) throw std::invalid_argument("the state ends early");
      if constexpr (std::is_same_v<T, bool>) {
        value = bytes_.front() != 0;
      } else {
        std::memcpy(&value, bytes_.data(), sizeof(T));
      }
      if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value)) throw std::invalid_argument("the state has no finite number");
      }
      bytes_ = bytes_.subspan(sizeof(T));
    } else if constexpr (requires { StateFields<T>::transfer(*this, value); }) {
      StateFields<T>::transfer(*this, value);
    } else {
      T::transfer(*this, value);
    }
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.clear();
    const std::size_t count = length(1);
    for (std::size_t i = 0; i < count; ++i) get(values.emplace_back());
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool has_value = false;
    get(has_value);
    value.reset();
    if (has_value) get(value.emplace());
  }
  template <class A, class B>
  void get(std::pair<A, B>& value) {
    (*this)(value.first, value.second);
  }
  /// A length whose elements, of at least so many bytes each, still fit.
  std::size_t length(std::size_t least) {
    std::uint64_t count = 0;
    get(count);
    if (count * least > bytes_.size() || count > 0xffffffffU) {
      throw std::invalid_argument("the state ends early");
    }
    return static_cast<std::size_t>(count);
  }

  std::span<const std::uint8_t> bytes_;
};

/// The state of something that describes itself, and back. What is restored is a new value: when it
/// throws, nothing has changed.
template <class T>
[[nodiscard]] std::vector<std::uint8_t> save_state(const T& value) {
  StateWriter writer;
  writer(value);
  return writer.take();
}
template <class T>
void restore_state(std::span<const std::uint8_t> bytes, T& value) {
  StateReader reader(bytes);
  T restored = value;
  reader(restored);
  reader.expect_end();
  value = std::move(restored);
}

}  // namespace quoin
