// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace quoin::deploy {

struct SvgElement {
  std::string name;
  std::map<std::string, std::string> attributes;

  [[nodiscard]] double number(const std::string& attribute) const {
    return std::stod(attributes.at(attribute));
  }
  [[nodiscard]] bool has_class(const std::string& name_of_class) const {
    const auto found = attributes.find("class");
    return found != attributes.end() && found->second == name_of_class;
  }
};

/// The elements of an XML text in order. Throws std::invalid_argument when one is not closed where
/// it has to be, or when text holds an unescaped mark.
inline std::vector<SvgElement> svg_elements(const std::string& text) {
  std::vector<SvgElement> elements;
  std::vector<std::string> open;
  std::size_t at = text.find("?>") + 2;
  while (true) {
    const std::size_t start = text.find('<', at);
    if (start == std::string::npos) break;
    if (text.substr(at, start - at).find('>') != std::string::npos)
      throw std::invalid_argument("stray >");
    const std::size_t end = text.find('>', start);
    if (end == std::string::npos) throw std::invalid_argument("tag without end");
    std::string tag = text.substr(start + 1, end - start - 1);
    at = end + 1;
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1))
        throw std::invalid_argument("closes " + tag);
      open.pop_back();
      continue;
    }
    const bool closed = tag.back() == '/';
    if (closed) tag.pop_back();
    SvgElement element;
    std::size_t blank = tag.find(' ');
    element.name = tag.substr(0, blank);
    while (blank != std::string::npos) {
      const std::size_t value = tag.find("=\"", blank);
      const std::size_t quote = tag.find('"', value + 2);
      if (value == std::string::npos || quote == std::string::npos) {
        throw std::invalid_argument("attribute in " + tag);
      }
      element.attributes[tag.substr(blank + 1, value - blank - 1)] =
          tag.substr(value + 2, quote - value - 2);
      blank = tag.find(' ', quote);
    }
    if (!closed) open.push_back(element.name);
    elements.push_back(element);
  }
  if (!open.empty()) throw std::invalid_argument("open " + open.back());
  return elements;
}

/// Those of one class, such as "point".
inline std::vector<SvgElement> svg_elements(const std::string& text,
                                            const std::string& name_of_class) {
  std::vector<SvgElement> found;
  for (const SvgElement& element : svg_elements(text)) {
    if (element.has_class(name_of_class)) found.push_back(element);
  }
  return found;
}

}  // namespace quoin::deploy
