// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/maps/map_reader.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"
#include "services/maps/occupancy_grid.hpp"

namespace quoin::maps {

namespace {

using Polyline = std::vector<Eigen::Vector2d>;

/// Lines of a plan, numbered as they come.
class PlanLines {
 public:
  explicit PlanLines(std::string file) : file_(std::move(file)) {}

  void add(const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
    constexpr double farthest = 1e6;  // [m]
    if (!start.allFinite() || !end.allFinite() || start.cwiseAbs().maxCoeff() > farthest ||
        end.cwiseAbs().maxCoeff() > farthest) {
      throw MapError(file_ + ": a line beyond 1000 km; is the scale right?");
    }
    if ((end - start).norm() < 1e-6) return;
    if (lines_.size() == most_lines) {
      throw MapError(file_ + ": more than a million lines; take out what are no walls");
    }
    MapLine line;
    line.id = lines_.size();
    line.start = start;
    line.end = end;
    lines_.push_back(line);
  }
  void add(const Polyline& points, bool closed) {
    for (std::size_t i = 1; i < points.size(); ++i) add(points[i - 1], points[i]);
    if (closed && points.size() > 2) add(points.back(), points.front());
  }
  [[nodiscard]] std::vector<MapLine> take() { return std::move(lines_); }

 private:
  std::string file_;
  std::vector<MapLine> lines_;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::size_t line_number(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::size_t>(std::ranges::count(text.substr(0, at), '\n'));
}

/// One start tag of an SVG.
class Tag {
 public:
  Tag(std::string_view text, const std::string& file, std::size_t line)
      : text_(text), place_(file + ":" + std::to_string(line) + ": ") {}

  [[nodiscard]] std::string_view name() const {
    return text_.substr(0, text_.find_first_of(" \t\r\n/>"));
  }
  [[nodiscard]] std::optional<std::string_view> attribute(std::string_view name) const {
    for (std::size_t at = text_.find(name); at != std::string_view::npos;
         at = text_.find(name, at + 1)) {
      const bool begins = at > 0 && is_blank(text_[at - 1]);
      std::size_t next = text_.find_first_not_of(" \t\r\n", at + name.size());
      if (!begins || next == std::string_view::npos || text_[next] != '=') continue;
      next = text_.find_first_not_of(" \t\r\n", next + 1);
      if (next == std::string_view::npos || (text_[next] != '"' && text_[next] != '\'')) continue;
      const std::size_t end = text_.find(text_[next], next + 1);
      if (end == std::string_view::npos) continue;
      return text_.substr(next + 1, end - next - 1);
    }
    return std::nullopt;
  }
  [[nodiscard]] double number(std::string_view name) const {
    const auto value = attribute(name);
    if (!value) return 0.0;
    const auto number = sensor_bridge::parse_number<double>(*value);
    if (!number) {
      fail(std::string(name) + " is " + sensor_bridge::excerpt(*value) +
           ", not a number without a unit");
    }
    return *number;
  }
  /// Numbers that blanks and commas part, and in paths letters, which `letter` gets.
  template <class Letter>
  void read_numbers(std::string_view text, std::vector<double>& numbers, Letter letter) const {
    std::size_t at = 0;
    while (at < text.size()) {
      const char c = text[at];
      if (is_blank(c) || c == ',') {
        ++at;
      } else if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
        letter(c);
        ++at;
      } else {
        double value = 0.0;
        const char* const begin = text.data() + at + (c == '+' ? 1 : 0);
        const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
        if (error != std::errc{}) fail(sensor_bridge::excerpt(text.substr(at)) + " is no number");
        numbers.push_back(value);
        at = static_cast<std::size_t>(end - text.data());
      }
    }
  }
  [[noreturn]] void fail(const std::string& what) const { throw MapError(place_ + what); }

 private:
  std::string_view text_;
  std::string place_;
};

/// The polylines of a path; curves are left out.
class PathReader {
 public:
  PathReader(const Tag& tag, const std::function<void(const Polyline&, bool)>& give)
      : tag_(tag), give_(give) {}

  void read(std::string_view path) {
    tag_.read_numbers(path, numbers_, [this](char letter) {
      finish_command();
      command_ = letter;
      if (letter == 'z' || letter == 'Z') close();
    });
    finish_command();
    end();
  }

 private:
  void finish_command() {
    const bool relative = std::islower(static_cast<unsigned char>(command_)) != 0;
    char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command_)));
    const std::vector<double> values = std::exchange(numbers_, {});
    if (kind == 'H' || kind == 'V') {
      for (const double value : values) {
        Eigen::Vector2d to = at_;
        double& moved = kind == 'H' ? to.x() : to.y();
        moved = relative ? moved + value : value;
        line_to(to);
      }
    } else if (kind == 'M' || kind == 'L') {
      if (values.size() % 2 != 0) tag_.fail("a path with an odd number of coordinates");
      for (std::size_t i = 0; i < values.size(); i += 2) {
        const Eigen::Vector2d given(values[i], values[i + 1]);
        const Eigen::Vector2d to = relative ? Eigen::Vector2d(at_ + given) : given;
        if (kind == 'M') {
          end();
          at_ = to;
          points_ = {to};
          kind = 'L';
        } else {
          line_to(to);
        }
      }
    } else if (!values.empty()) {
      // The end of a curve is where the next line begins.
      const std::size_t each = kind == 'C'                  ? 6
                               : kind == 'S' || kind == 'Q' ? 4
                               : kind == 'T'                ? 2
                               : kind == 'A'                ? 7
                                                            : 0;
      if (each == 0 || values.size() % each != 0) tag_.fail("a path with wrong numbers");
      end();
      for (std::size_t i = each; i <= values.size(); i += each) {
        const Eigen::Vector2d given(values[i - 2], values[i - 1]);
        at_ = relative ? Eigen::Vector2d(at_ + given) : given;
      }
      points_ = {at_};
    }
  }
  void line_to(const Eigen::Vector2d& to) {
    at_ = to;
    points_.push_back(to);
  }
  void close() {
    if (points_.empty()) return;
    give_(points_, true);
    at_ = points_.front();
    points_ = {at_};
  }
  void end() {
    if (points_.size() > 1) give_(points_, false);
    points_.clear();
  }

  const Tag& tag_;
  const std::function<void(const Polyline&, bool)>& give_;
  std::vector<double> numbers_;
  char command_ = ' ';
  Eigen::Vector2d at_ = Eigen::Vector2d::Zero();
  Polyline points_;
};

Polyline pairs(const Tag& tag, std::string_view text) {
  std::vector<double> numbers;
  tag.read_numbers(text, numbers, [&](char) { tag.fail("letters among coordinates"); });
  if (numbers.size() % 2 != 0) tag.fail("an odd number of coordinates");
  Polyline points;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    points.emplace_back(numbers[i], numbers[i + 1]);
  return points;
}

/// The pairs of group code and value of a text DXF.
class DxfGroups {
 public:
  DxfGroups(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool next() {
    std::string_view code_text;
    if (!line(code_text)) return false;
    const auto parsed = sensor_bridge::parse_number<int>(code_text);
    if (!parsed) fail(sensor_bridge::excerpt(code_text) + " is no group code of a text DXF");
    code = *parsed;
    if (!line(value)) fail("the file ends here; it is cut off");
    return true;
  }
  [[nodiscard]] double number() const {
    const auto number = sensor_bridge::parse_number<double>(value);
    if (!number) fail(sensor_bridge::excerpt(value) + " is not a number");
    return *number;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw MapError(file_ + ":" + std::to_string(number_) + ": " + what);
  }

  int code = 0;
  std::string_view value;

 private:
  bool line(std::string_view& out) {
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    out = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    const std::size_t first = out.find_first_not_of(" \t\r");
    out = first == std::string_view::npos
              ? std::string_view()
              : out.substr(first, out.find_last_not_of(" \t\r") + 1 - first);
    ++number_;
    return true;
  }

  std::string_view text_;
  std::string file_;
  std::size_t number_ = 0;
};

/// [m] of $INSUNITS; nothing for a drawing without a unit.
std::optional<double> dxf_unit(int code) {
  switch (code) {
    case 1:
      return 0.0254;
    case 2:
      return 0.3048;
    case 4:
      return 0.001;
    case 5:
      return 0.01;
    case 6:
      return 1.0;
    case 14:
      return 0.1;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::vector<MapLine> parse_svg(std::string_view text, const std::string& file, double scale) {
  if (text.find("<svg") == std::string_view::npos) throw MapError(file + ":1: this is no SVG");
  PlanLines lines(file);
  const auto here = [scale](const Eigen::Vector2d& point) {
    return Eigen::Vector2d(scale * point.x(), -scale * point.y());
  };
  const std::function<void(const Polyline&, bool)> give = [&](const Polyline& points, bool closed) {
    Polyline moved;
    for (const Eigen::Vector2d& point : points) moved.push_back(here(point));
    lines.add(moved, closed);
  };
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    if (text.substr(at).starts_with("<!--")) {
      at = std::min(text.find("-->", at), text.size());
      continue;
    }
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos) {
      throw MapError(file + ":" + std::to_string(line_number(text, at)) +
                     ": a tag that does not end; the file is cut off");
    }
    const Tag tag(text.substr(at + 1, end - at - 1), file, line_number(text, at));
    at = end;
    const std::string_view name = tag.name();
    const bool drawn = name == "line" || name == "polyline" || name == "polygon" ||
                       name == "rect" || name == "path";
    if ((drawn || name == "g") && tag.attribute("transform")) {
      tag.fail("a transform, which is not applied; flatten the transforms of the drawing first");
    }
    if (name == "line") {
      give({{tag.number("x1"), tag.number("y1")}, {tag.number("x2"), tag.number("y2")}}, false);
    } else if (name == "rect" && tag.attribute("class") == "background") {
      continue;  // of our own drawings
    } else if (name == "rect") {
      const double x = tag.number("x"), y = tag.number("y");
      const double width = tag.number("width"), height = tag.number("height");
      give({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, true);
    } else if (name == "polyline" || name == "polygon") {
      give(pairs(tag, tag.attribute("points").value_or("")), name == "polygon");
    } else if (name == "path") {
      PathReader(tag, give).read(tag.attribute("d").value_or(""));
    }
  }
  return lines.take();
}

std::vector<MapLine> parse_dxf(std::string_view text, const std::string& file, double scale) {
  if (text.starts_with("AutoCAD Binary DXF")) {
    throw MapError(file + ":1: a binary DXF; save it as text (ASCII)");
  }
  PlanLines lines(file);
  DxfGroups group(text, file);
  std::string_view section, entity, variable;
  bool in_polyline = false, closed = false;
  Eigen::Vector2d first = Eigen::Vector2d::Zero(), second = Eigen::Vector2d::Zero();
  Polyline points;
  double unit = scale;
  const auto finish = [&] {
    if (entity == "LINE") lines.add(unit * first, unit * second);
    if (entity == "VERTEX" && in_polyline) points.push_back(unit * first);
    if (entity == "LWPOLYLINE" || entity == "SEQEND") {
      lines.add(points, closed);
      points.clear();
      in_polyline = false;
    }
  };
  while (group.next()) {
    if (group.code == 0) {
      if (section == "ENTITIES") finish();
      entity = group.value;
      first = second = Eigen::Vector2d::Zero();
      if (entity == "POLYLINE") in_polyline = true;
      if (entity == "POLYLINE" || entity == "LWPOLYLINE") {
        closed = false;
        points.clear();
      }
      if (entity == "ENDSEC") section = {};
    } else if (group.code == 2 && entity == "SECTION") {
      section = group.value;
    } else if (group.code == 9) {
      variable = group.value;
    } else if (section == "HEADER" && variable == "$INSUNITS" && group.code == 70) {
      unit = dxf_unit(static_cast<int>(group.number())).value_or(scale);
    } else if (section == "ENTITIES") {
      if (group.code == 10) first.x() = group.number();
      if (group.code == 20) first.y() = group.number();
      if (group.code == 11) second.x() = group.number();
      if (group.code == 21) second.y() = group.number();
      if (group.code == 20 && entity == "LWPOLYLINE") points.push_back(unit * first);
      if (group.code == 70 && (entity == "LWPOLYLINE" || entity == "POLYLINE")) {
        closed = (static_cast<int>(group.number()) & 1) != 0;
      }
    }
  }
  return lines.take();
}

SavedMap read_map(const std::filesystem::path& file, double scale) {
  const std::string name = file.string();
  SavedMap map;
  if (name.ends_with(".qmap")) {
    map = parse_map(read_text(file), name);
  } else if (name.ends_with(".svg")) {
    map.lines = parse_svg(read_text(file), name, scale);
  } else if (name.ends_with(".dxf")) {
    map.lines = parse_dxf(read_text(file), name, scale);
  } else if (name.ends_with(".yaml") || name.ends_with(".yml")) {
    map.lines = vectorized(read_grid(file));
  } else {
    throw MapError(name +
                   ": a map is a .qmap, .svg or .dxf file, or the .yaml of an occupancy grid");
  }
  if (map.lines.empty()) throw MapError(name + ": there are no lines in it");
  return map;
}

}  // namespace quoin::maps
