// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/message_check.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/text/printable.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::topics {

namespace {

constexpr std::size_t encapsulation_size = 4;  // [byte]
constexpr std::size_t filling = 3;             // [byte] writers fill the last word up
constexpr std::size_t most_elements = 100'000;
constexpr std::size_t most_octets = 64U << 20U;  // [byte] states of services
constexpr std::size_t longest_string = 1024;     // [byte] topics are the longest names
constexpr std::size_t most_related_fields = 64;  // of a structure with relations
// Of a product of variances: covariances are sums of products that were rounded.
constexpr double rounding = 1e-9;

bool is_integer(IdlKind kind) { return kind >= IdlKind::int8 && kind <= IdlKind::uint64; }
bool is_real(IdlKind kind) { return kind == IdlKind::float32 || kind == IdlKind::float64; }
bool is_list(IdlKind kind) { return kind == IdlKind::sequence || kind == IdlKind::array; }

std::size_t size_of(IdlKind kind) {
  switch (kind) {
    case IdlKind::int16:
    case IdlKind::uint16:
      return 2;
    case IdlKind::int32:
    case IdlKind::uint32:
    case IdlKind::float32:
    case IdlKind::enumeration:
      return 4;
    case IdlKind::int64:
    case IdlKind::uint64:
    case IdlKind::float64:
      return 8;
    default:
      return 1;
  }
}

/// Whether the symmetric matrix, of which the columns of the upper triangle are given, is positive
/// definite but for rounding, and for what is zero where `zeros` are allowed.
bool is_covariance(std::span<const double> upper, bool zeros) {
  std::array<std::array<double, 6>, 6> factor{};  // Cholesky, of the matrix with unit diagonal
  std::array<double, 6> scale{};
  std::size_t next = 0;
  for (std::size_t j = 0; next < upper.size(); ++j) {
    const double variance = upper[next + j];
    const bool zero = zeros && variance == 0.0;
    if (!zero && (!(variance > 0.0) || !std::isfinite(variance))) return false;
    scale[j] = zero ? 0.0 : 1.0 / std::sqrt(variance);
    double rest = 1.0;
    for (std::size_t i = 0; i < j; ++i) {
      if ((zero || scale[i] == 0.0) && upper[next + i] != 0.0) return false;
      double value = upper[next + i] * scale[i] * scale[j];
      if (!std::isfinite(value)) return false;
      for (std::size_t k = 0; k < i; ++k) value -= factor[i][k] * factor[j][k];
      factor[j][i] = factor[i][i] > 0.0 ? value / factor[i][i] : 0.0;
      rest -= factor[j][i] * factor[j][i];
    }
    if (rest < -rounding) return false;
    factor[j][j] = std::sqrt(std::max(rest, 0.0));
    next += j + 1;
  }
  return true;
}

}  // namespace

class MessageCheck::Builder {
 public:
  Builder(const IdlTypes& types, std::vector<Step>& steps) : types_(types), steps_(steps) {}

  std::size_t add(std::size_t type_index, const std::vector<IdlLimit>& limits) {
    const IdlType& type = types_.types[type_index];
    Step step{.kind = type.kind, .most = most_of(type)};
    if (is_list(type.kind)) {
      step.element = add(type.element, limits_of_elements(limits));
    } else if (type.kind == IdlKind::structure) {
      add_fields(type, step);
    }
    for (const IdlLimit& limit : limits) apply(limit, step);
    steps_.push_back(std::move(step));
    return steps_.size() - 1;
  }

 private:
  [[noreturn]] static void fail(const IdlLimit& limit, const std::string& what) {
    throw std::logic_error("limit @" + limit.name + " of the IDL: " + what);
  }

  [[nodiscard]] std::size_t most_of(const IdlType& type) const {
    switch (type.kind) {
      case IdlKind::array:
        return type.bound;
      case IdlKind::enumeration:
        return type.enumerators.size();
      case IdlKind::string:
        return type.bound != 0 ? type.bound : longest_string;
      case IdlKind::sequence:
        if (type.bound != 0) return type.bound;
        return size_of(types_.types[type.element].kind) == 1 &&
                       is_integer(types_.types[type.element].kind)
                   ? most_octets
                   : most_elements;
      default:
        return 0;
    }
  }

  static bool is_of_value(const IdlLimit& limit) {
    return limit.name == "range" || limit.name == "min" || limit.name == "max" ||
           limit.name == "any" || limit.name == "text";
  }

  static std::vector<IdlLimit> limits_of_elements(const std::vector<IdlLimit>& limits) {
    std::vector<IdlLimit> result;
    std::ranges::copy_if(limits, std::back_inserter(result), is_of_value);
    return result;
  }

  static double number(const IdlLimit& limit, std::size_t argument) {
    if (argument >= limit.arguments.size()) fail(limit, "an argument is missing");
    const std::string& text = limit.arguments[argument];
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) fail(limit, "'" + text + "'");
    return value;
  }

  static void apply(const IdlLimit& limit, Step& step) {
    const bool number_like = is_integer(step.kind) || is_real(step.kind);
    if (limit.name == "range" || limit.name == "min" || limit.name == "max") {
      if (is_list(step.kind)) return;
      if (!number_like) fail(limit, "of no number");
      if (limit.name != "max") step.lowest = number(limit, 0);
      if (limit.name != "min") step.highest = number(limit, limit.name == "max" ? 0 : 1);
    } else if (limit.name == "any") {
      if (is_list(step.kind)) return;
      if (!is_real(step.kind)) fail(limit, "of no floating-point number");
      step.any = true;
    } else if (limit.name == "length" || limit.name == "text") {
      const bool text = limit.name == "text";
      if (text && is_list(step.kind)) return;
      if (step.kind != IdlKind::string && (text || step.kind != IdlKind::sequence)) {
        fail(limit, "of what has no length");
      }
      step.most = static_cast<std::size_t>(number(limit, 0));
      step.several_lines = text;
    }
  }

  void add_fields(const IdlType& type, Step& step) {
    for (const IdlField& field : type.fields) {
      step.fields.push_back({field.name, add(field.type, field.limits)});
    }
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      for (const IdlLimit& limit : type.fields[i].limits) relate(limit, i, step);
    }
    if (!step.relations.empty() && step.fields.size() > most_related_fields) {
      throw std::logic_error(type.name + " has too many fields");
    }
  }

  void relate(const IdlLimit& limit, std::size_t field, Step& step) const {
    static constexpr std::pair<std::string_view, Rule> rules[] = {
        {"same_length", Rule::same_length},   {"same_length_or_none", Rule::same_length_or_none},
        {"at_most", Rule::at_most},           {"index_ranges", Rule::index_ranges},
        {"semidefinite", Rule::semidefinite}, {"apart", Rule::apart},
        {"covariance", Rule::covariance}};
    if (is_of_value(limit) || limit.name == "length") return;
    const auto* rule =
        std::ranges::find(rules, limit.name, &std::pair<std::string_view, Rule>::first);
    if (rule == std::end(rules)) fail(limit, "is not known");
    Relation relation{rule->second, {}};
    const bool of_matrix = relation.rule == Rule::covariance || relation.rule == Rule::semidefinite;
    if (!of_matrix) relation.fields.push_back(field);
    for (const std::string& name : limit.arguments) {
      const auto found = std::ranges::find(step.fields, name, &Field::name);
      if (found == step.fields.end()) fail(limit, "there is no field '" + name + "'");
      const std::size_t other = static_cast<std::size_t>(found - step.fields.begin());
      const IdlKind kind = steps_[step.fields[other].step].kind;
      if (of_matrix ? !is_real(kind) : kind != IdlKind::sequence) {
        fail(limit, "field '" + name + "' is of another kind");
      }
      relation.fields.push_back(other);
    }
    const bool of_ranges = relation.rule == Rule::index_ranges || relation.rule == Rule::apart;
    if (of_ranges && !has_index_ranges(step.fields[field])) fail(limit, "of no index ranges");
    const std::size_t count = relation.fields.size();
    const bool matrix = count == 3 || count == 6 || count == 10 || count == 15 || count == 21;
    if (of_matrix ? !matrix : count != 2) fail(limit, "arguments");
    step.relations.push_back(std::move(relation));
  }

  /// Pairs of 32-bit numbers.
  [[nodiscard]] bool has_index_ranges(const Field& field) const {
    const Step& list = steps_[field.step];
    if (list.kind != IdlKind::sequence) return false;
    const std::vector<Field>& pair = steps_[list.element].fields;
    return pair.size() == 2 && std::ranges::all_of(pair, [&](const Field& number) {
             return steps_[number.step].kind == IdlKind::uint32;
           });
  }

  const IdlTypes& types_;
  std::vector<Step>& steps_;
};

/// Goes once through the bytes of a message.
template <bool swapped>
class MessageCheck::Walker {
 public:
  Walker(const std::vector<Step>& steps, std::span<const std::byte> cdr)
      : steps_(steps), cdr_(cdr), offset_(encapsulation_size) {}

  /// False with a refusal.
  bool walk(std::size_t step) {
    double value = 0.0;
    return check(steps_[step], value);
  }
  [[nodiscard]] std::size_t left() const { return cdr_.size() - offset_; }
  [[nodiscard]] std::string refusal() const {
    std::string text;
    for (auto name = path_.rbegin(); name != path_.rend(); ++name) {
      if (!text.empty()) text += '.';
      text += **name;
    }
    return (text.empty() ? "" : text + ": ") + fault_;
  }

 private:
  // Names come when the walk returns, the innermost first.
  bool refuse(const char* fault) {
    fault_ = fault;
    return false;
  }

  bool align(std::size_t size) {
    const std::size_t padding = (size - (offset_ - encapsulation_size) % size) % size;
    if (padding > left()) return refuse("truncated");
    offset_ += padding;
    return true;
  }

  // `offset` is inside the bytes.
  template <class T>
  [[nodiscard]] T read(std::size_t offset) const {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), cdr_.data() + offset, sizeof(T));
    if constexpr (swapped) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }

  [[nodiscard]] double number(IdlKind kind, std::size_t offset) const {
    switch (kind) {
      case IdlKind::int8:
        return static_cast<double>(read<std::int8_t>(offset));
      case IdlKind::uint8:
        return static_cast<double>(read<std::uint8_t>(offset));
      case IdlKind::int16:
        return static_cast<double>(read<std::int16_t>(offset));
      case IdlKind::uint16:
        return static_cast<double>(read<std::uint16_t>(offset));
      case IdlKind::int32:
        return static_cast<double>(read<std::int32_t>(offset));
      case IdlKind::uint32:
        return static_cast<double>(read<std::uint32_t>(offset));
      case IdlKind::int64:
        return static_cast<double>(read<std::int64_t>(offset));
      case IdlKind::uint64:
        return static_cast<double>(read<std::uint64_t>(offset));
      case IdlKind::float32:
        return static_cast<double>(read<float>(offset));
      default:
        return read<double>(offset);
    }
  }

  bool length(std::size_t most, std::uint32_t& count) {
    if (!align(4)) return false;
    if (left() < 4) return refuse("truncated");
    count = read<std::uint32_t>(offset_);
    offset_ += 4;
    return count <= most || refuse("too long");
  }

  /// `count` numbers one after the other.
  bool numbers(const Step& step, std::size_t count, double& last) {
    const std::size_t size = size_of(step.kind);
    if (count == 0) return true;
    if (!align(size)) return false;
    if (count > left() / size) return refuse("truncated");
    for (std::size_t i = 0; i < count; ++i) {
      last = number(step.kind, offset_ + i * size);
      if (step.any) continue;
      // NaN is in no range.
      if (!(last >= step.lowest && last <= step.highest)) {
        return refuse(std::isfinite(last) ? "out of range" : "not finite");
      }
    }
    offset_ += count * size;
    return true;
  }

  bool string(const Step& step) {
    std::uint32_t count = 0;  // with the terminating zero; some write empty strings without
    if (!length(step.most + 1, count) || count == 0) return fault_ == nullptr;
    if (count > left()) return refuse("truncated");
    const auto* begin = reinterpret_cast<const char*>(cdr_.data() + offset_);
    if (begin[count - 1] != '\0') return refuse("a string without end");
    const std::string_view text(begin, count - 1);
    offset_ += count;
    const bool ascii = std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
    return ascii || is_printable(text, step.several_lines ? Lines::many : Lines::one) ||
           refuse("not printable");
  }

  bool choice(const Step& step) {
    if (step.kind == IdlKind::enumeration) {
      if (!align(4)) return false;
      if (left() < 4) return refuse("truncated");
      const auto value = read<std::uint32_t>(offset_);
      offset_ += 4;
      return value < step.most || refuse("out of range");
    }
    if (left() < 1) return refuse("truncated");
    const std::byte value = cdr_[offset_++];
    return step.kind != IdlKind::boolean || value <= std::byte{1} || refuse("out of range");
  }

  bool list(const Step& step, std::uint32_t count) {
    const Step& element = steps_[step.element];
    double last = 0.0;
    if (is_integer(element.kind) || is_real(element.kind)) return numbers(element, count, last);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!check(element, last)) return false;
    }
    return true;
  }

  /// `value` becomes the number, or how many elements there are.
  bool check(const Step& step, double& value) {
    switch (step.kind) {
      case IdlKind::boolean:
      case IdlKind::character:
      case IdlKind::enumeration:
        return choice(step);
      case IdlKind::string:
        return string(step);
      case IdlKind::array:
        return list(step, static_cast<std::uint32_t>(step.most));
      case IdlKind::sequence: {
        std::uint32_t count = 0;
        if (!length(step.most, count)) return false;
        value = count;
        return list(step, count);
      }
      case IdlKind::structure:
        return structure(step);
      default:
        return numbers(step, 1, value);
    }
  }

  // Of the fields of a structure.
  struct Values {
    std::array<double, most_related_fields> value;
    std::array<std::size_t, most_related_fields> offset;
  };

  bool structure(const Step& step) {
    if (step.relations.empty()) {
      double value = 0.0;
      for (const Field& field : step.fields) {
        if (!check(steps_[field.step], value)) return named(field);
      }
      return true;
    }
    Values values;
    for (std::size_t i = 0; i < step.fields.size(); ++i) {
      values.offset[i] = offset_;
      if (!check(steps_[step.fields[i].step], values.value[i])) return named(step.fields[i]);
    }
    return std::ranges::all_of(step.relations, [&](const Relation& relation) {
      return holds(relation, values) || named(step.fields[relation.fields.front()]);
    });
  }

  bool named(const Field& field) {
    path_.push_back(&field.name);
    return false;
  }

  bool holds(const Relation& relation, const Values& values) {
    const auto value = [&](std::size_t i) { return values.value[relation.fields[i]]; };
    switch (relation.rule) {
      case Rule::same_length:
        return value(0) == value(1) || refuse("of another length");
      case Rule::same_length_or_none:
        return value(0) == value(1) || value(0) == 0.0 || refuse("of another length");
      case Rule::at_most:
        return value(0) <= value(1) || refuse("out of range");
      case Rule::index_ranges:
        return ascending(ranges_at(relation.fields[0], values), value(1));
      case Rule::apart:
        return disjoint(ranges_at(relation.fields[0], values),
                        ranges_at(relation.fields[1], values));
      case Rule::covariance:
      case Rule::semidefinite: {
        std::array<double, 21> upper{};
        for (std::size_t i = 0; i < relation.fields.size(); ++i) upper[i] = value(i);
        return is_covariance(std::span(upper).first(relation.fields.size()),
                             relation.rule == Rule::semidefinite) ||
               refuse("no covariance");
      }
    }
    return true;
  }

  // Pairs of 32-bit numbers one after the other.
  struct Ranges {
    std::size_t offset = 0;
    std::size_t count = 0;
  };
  [[nodiscard]] Ranges ranges_at(std::size_t field, const Values& values) const {
    const std::size_t at = values.offset[field] - encapsulation_size;
    return {encapsulation_size + (at + 3) / 4 * 4 + 4,  // behind the length
            static_cast<std::size_t>(values.value[field])};
  }
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> range(const Ranges& ranges,
                                                              std::size_t i) const {
    return {read<std::uint32_t>(ranges.offset + 8 * i),
            read<std::uint32_t>(ranges.offset + 8 * i + 4)};
  }

  bool ascending(const Ranges& ranges, double points) {
    std::uint32_t free_from = 0;
    for (std::size_t i = 0; i < ranges.count; ++i) {
      const auto [begin, end] = range(ranges, i);
      if (begin < free_from || end < begin) return refuse("not ascending");
      free_from = end;
    }
    return free_from <= points || refuse("out of range");
  }

  // Both are ascending.
  bool disjoint(const Ranges& first, const Ranges& second) {
    std::size_t j = 0;
    for (std::size_t i = 0; i < first.count; ++i) {
      const auto [begin, end] = range(first, i);
      while (j < second.count && range(second, j).second <= begin) ++j;
      if (j < second.count && range(second, j).first < end) return refuse("not apart");
    }
    return true;
  }

  const std::vector<Step>& steps_;
  const std::span<const std::byte> cdr_;
  std::size_t offset_;
  const char* fault_ = nullptr;
  std::vector<const std::string*> path_;
};

MessageCheck::MessageCheck(const IdlTypes& types, std::string_view type) {
  const IdlType* const found = types.find(type);
  if (found == nullptr || found->kind != IdlKind::structure) {
    throw std::logic_error("the IDL has no structure " + std::string(type));
  }
  root_ = Builder(types, steps_).add(static_cast<std::size_t>(found - types.types.data()), {});
}

Refusal MessageCheck::refusal(std::span<const std::byte> cdr) const { return check(cdr, filling); }

Refusal MessageCheck::refusal_of_beginning(std::span<const std::byte> cdr) const {
  return check(cdr, cdr.size());
}

Refusal MessageCheck::check(std::span<const std::byte> cdr, std::size_t most_left) const {
  if (cdr.size() < encapsulation_size) return "truncated";
  if (cdr[0] != std::byte{0} || cdr[1] > std::byte{1}) return "unknown encapsulation";
  const auto walk = [&](auto walker) -> Refusal {
    if (!walker.walk(root_)) return walker.refusal();
    if (walker.left() > most_left) return "bytes left over";
    return std::nullopt;
  };
  const bool little = cdr[1] == std::byte{1};
  return little == (std::endian::native == std::endian::little) ? walk(Walker<false>(steps_, cdr))
                                                                : walk(Walker<true>(steps_, cdr));
}

const MessageCheck* message_check(std::string_view dds_type) {
  static const std::map<std::string, MessageCheck, std::less<>> checks = [] {
    std::map<std::string, MessageCheck, std::less<>> all;
    const auto add = [&](std::string_view type, std::string_view file) {
      all.try_emplace(std::string(type), parse_idl(idl_text(file)), type);
    };
    for (const TopicType& type : topic_types()) add(type.dds_type, type.idl);
    add("quoin::msg::ServiceStatus", "Status.idl");
    add("quoin::msg::Header", "Common.idl");
    return all;
  }();
  const auto found = checks.find(dds_type);
  return found == checks.end() ? nullptr : &found->second;
}

}  // namespace quoin::topics
