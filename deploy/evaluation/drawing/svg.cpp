// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/svg.hpp"

#include <array>
#include <cstdio>

namespace quoin::deploy {

namespace {

std::string pixels(double value) { return number(value, 2); }

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char character : text) {
    switch (character) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += character >= 0 && character < ' ' ? ' ' : character;
    }
  }
  return result;
}

std::string number(double value, int digits) {
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value);
  std::string text = buffer.data();
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string scoped(std::string_view scope, std::string_view rules) {
  std::string result;
  while (!rules.empty()) {
    const std::size_t brace = rules.find('{');
    const std::size_t end = rules.find('}');
    if (brace == std::string_view::npos || end == std::string_view::npos) break;
    std::string_view selectors = rules.substr(0, brace);
    while (true) {
      const std::size_t comma = selectors.find(',');
      result.append(scope).append(" ").append(selectors.substr(0, comma));
      if (comma == std::string_view::npos) break;
      result += ',';
      selectors.remove_prefix(comma + 1);
    }
    result += rules.substr(brace, end + 1 - brace);
    rules.remove_prefix(end + 1);
  }
  return result;
}

Svg::Svg(double width, double height, const std::string& kind, const StyleSheet& style_sheet) {
  text_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
               {"class", kind},
               {"width", pixels(width)},
               {"height", pixels(height)},
               {"viewBox", "0 0 " + pixels(width) + " " + pixels(height)}});
  text_ += "<style>" + scoped("." + kind, style_sheet.rules);
  if (!style_sheet.dark_rules.empty()) {
    text_ +=
        "\n@media (prefers-color-scheme:dark){" + scoped("." + kind, style_sheet.dark_rules) + "}";
  }
  text_ += "</style>\n";
  element("rect",
          {{"class", "background"}, {"width", "100%"}, {"height", "100%"}, {"fill", "#ffffff"}},
          "/>\n");
}

void Svg::element(std::string_view name, const Attributes& attributes, std::string_view end) {
  text_ += '<';
  text_ += name;
  for (const auto& [attribute, value] : attributes) {
    text_ += ' ';
    text_ += attribute;
    text_ += "=\"" + escaped(value) + '"';
  }
  text_ += end;
}

void Svg::open(std::string_view name, const Attributes& attributes) {
  element(name, attributes, ">\n");
}

void Svg::close(std::string_view name) {
  text_ += "</";
  text_ += name;
  text_ += ">\n";
}

void Svg::line(std::string_view style, double x1, double y1, double x2, double y2) {
  element("line",
          {{"class", std::string(style)},
           {"x1", pixels(x1)},
           {"y1", pixels(y1)},
           {"x2", pixels(x2)},
           {"y2", pixels(y2)}},
          "/>\n");
}

void Svg::circle(std::string_view style, double x, double y, double radius) {
  element(
      "circle",
      {{"class", std::string(style)}, {"cx", pixels(x)}, {"cy", pixels(y)}, {"r", pixels(radius)}},
      "/>\n");
}

void Svg::ellipse(std::string_view style, double x, double y, double rx, double ry,
                  double rotation) {
  element("ellipse",
          {{"class", std::string(style)},
           {"cx", pixels(x)},
           {"cy", pixels(y)},
           {"rx", pixels(rx)},
           {"ry", pixels(ry)},
           {"transform", "rotate(" + pixels(rotation) + " " + pixels(x) + " " + pixels(y) + ")"}},
          "/>\n");
}

void Svg::rectangle(std::string_view style, double x, double y, double width, double height) {
  element("rect",
          {{"class", std::string(style)},
           {"x", pixels(x)},
           {"y", pixels(y)},
           {"width", pixels(width)},
           {"height", pixels(height)}},
          "/>\n");
}

void Svg::path(std::string_view style, const std::string& commands) {
  element("path", {{"class", std::string(style)}, {"d", commands}}, "/>\n");
}

void Svg::text(std::string_view style, double x, double y, std::string_view text) {
  element("text", {{"class", std::string(style)}, {"x", pixels(x)}, {"y", pixels(y)}}, ">");
  text_ += escaped(text);
  close("text");
}

void Svg::vertical_text(std::string_view style, double x, double y, std::string_view text) {
  element("text",
          {{"class", std::string(style)},
           {"x", pixels(x)},
           {"y", pixels(y)},
           {"transform", "rotate(-90 " + pixels(x) + " " + pixels(y) + ")"}},
          ">");
  text_ += escaped(text);
  close("text");
}

std::string Svg::finish() {
  close("svg");
  return std::move(text_);
}

}  // namespace quoin::deploy
