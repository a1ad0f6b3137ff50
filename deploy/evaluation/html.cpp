// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/html.hpp"

#include "deploy/evaluation/drawing/svg.hpp"

namespace quoin::deploy {

namespace {

constexpr auto style =
    ":root{color-scheme:light dark;--text:#24292f;--soft:#57606a;--line:#d8dee4;--ground:#ffffff;"
    "--band:#f6f8fa}"
    "@media (prefers-color-scheme:dark){:root{--text:#e4e6ea;--soft:#a9b1bb;--line:#39414b;"
    "--ground:#14171c;--band:#1a1e24}}"
    "body{font:16px/1.5 system-ui,sans-serif;color:var(--text);background:var(--ground);"
    "max-width:1060px;margin:0 auto;padding:24px}"
    "h1{margin-bottom:0}h2{margin-top:2.4em;border-bottom:1px solid var(--line)}"
    ".subtitle,figcaption{color:var(--soft)}figcaption{font-size:14px}"
    "figure{margin:1.2em 0}figure svg{max-width:100%;height:auto}"
    ".wide{overflow-x:auto}table{border-collapse:collapse;font-size:14px;"
    "font-variant-numeric:tabular-nums}"
    "th,td{padding:3px 10px;text-align:right;white-space:nowrap}"
    "th{border-bottom:1px solid var(--line);font-weight:600}"
    ".text{text-align:left}.group{text-align:center;border-left:1px solid var(--line)}"
    "tbody tr:nth-child(even){background:var(--band)}"
    ".total td{border-top:1px solid var(--line);font-weight:600}"
    "nav ul{padding-left:20px}a{color:inherit}";

std::string cell(std::string_view tag, bool text, std::string_view content) {
  std::string result = "<" + std::string(tag) + (text ? " class=\"text\">" : ">");
  return result + escaped(content) + "</" + std::string(tag) + ">";
}

}  // namespace

HtmlPage::HtmlPage(std::string_view title, std::string_view subtitle) {
  head_ =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>" +
      escaped(title) + "</title>\n<style>" + style + "</style></head>\n<body><h1>" +
      escaped(title) + "</h1>\n<p class=\"subtitle\">" + escaped(subtitle) + "</p>\n";
}

void HtmlPage::heading(int level, std::string_view text) {
  const std::string tag = "h" + std::to_string(level);
  const std::string id = "s" + std::to_string(++headings_);
  body_ += "<" + tag + " id=\"" + id + "\">" + escaped(text) + "</" + tag + ">\n";
  if (level == 2) contents_ += "<li><a href=\"#" + id + "\">" + escaped(text) + "</a></li>\n";
}

void HtmlPage::paragraph(std::string_view text) { body_ += "<p>" + escaped(text) + "</p>\n"; }

void HtmlPage::table(const HtmlTable& table) {
  body_ += "<div class=\"wide\"><table><thead>";
  if (!table.groups.empty()) {
    body_ += "<tr>";
    for (const auto& [name, columns] : table.groups) {
      body_ += "<th class=\"group\" colspan=\"" + std::to_string(columns) + "\">" + escaped(name) +
               "</th>";
    }
    body_ += "</tr>\n";
  }
  body_ += "<tr>";
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    body_ += cell("th", i < table.text_columns, table.head[i]);
  }
  body_ += "</tr></thead>\n<tbody>";
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const bool total = table.last_row_is_summary && k + 1 == table.rows.size();
    body_ += total ? "<tr class=\"total\">" : "<tr>";
    for (std::size_t i = 0; i < table.rows[k].size(); ++i) {
      body_ += cell("td", i < table.text_columns, table.rows[k][i]);
    }
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void HtmlPage::figure(std::string_view svg, std::string_view caption) {
  const std::size_t start = svg.find("<svg");
  if (start == std::string_view::npos) return;
  body_ += "<figure>";
  body_ += svg.substr(start);
  body_ += "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string HtmlPage::finish() {
  return head_ + "<nav><ul>\n" + contents_ + "</ul></nav>\n" + body_ + "</body></html>\n";
}

}  // namespace quoin::deploy
