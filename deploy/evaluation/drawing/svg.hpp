// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quoin::deploy {

/// `value` with at most `digits` digits behind the point and no trailing zeros.
[[nodiscard]] std::string number(double value, int digits);

/// Text that XML and HTML take as it is; control characters, which XML forbids, become blanks.
[[nodiscard]] std::string escaped(std::string_view text);

/// Rules for the classes of one kind of picture, and what is different on a dark background.
struct StyleSheet {
  std::string_view rules;
  std::string_view dark_rules;
};

/// `rules` with `scope` in front of each selector, so that several pictures can stand in one page.
[[nodiscard]] std::string scoped(std::string_view scope, std::string_view rules);

/// Writes the few SVG elements that a picture is made of. Lengths are pixels, y points down;
/// `style` names are classes of the style sheet.
class Svg {
 public:
  /// `kind` is the class of the picture, to which its style sheet is confined.
  Svg(double width, double height, const std::string& kind, const StyleSheet& style_sheet);

  using Attributes = std::vector<std::pair<std::string_view, std::string>>;
  void open(std::string_view element, const Attributes& attributes);
  void close(std::string_view element);
  void line(std::string_view style, double x1, double y1, double x2, double y2);
  void circle(std::string_view style, double x, double y, double radius);
  /// `rotation` [degree] turns clockwise on the screen.
  void ellipse(std::string_view style, double x, double y, double rx, double ry, double rotation);
  void rectangle(std::string_view style, double x, double y, double width, double height);
  /// `commands` are those of the attribute d.
  void path(std::string_view style, const std::string& commands);
  void text(std::string_view style, double x, double y, std::string_view text);
  /// Text that runs upwards.
  void vertical_text(std::string_view style, double x, double y, std::string_view text);

  /// Ends the document and returns it.
  [[nodiscard]] std::string finish();

 private:
  void element(std::string_view name, const Attributes& attributes, std::string_view end);

  std::string text_;
};

}  // namespace quoin::deploy
