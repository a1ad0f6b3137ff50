// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/html.hpp"

#include <gmock/gmock.h>

namespace quoin::deploy {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(HtmlPage, EscapesAndLinksItsHeadings) {
  HtmlPage page("a < b", "x & y");
  page.heading(2, "Fitters");
  page.heading(3, "utls");
  page.paragraph("<script>");
  const std::string html = page.finish();
  EXPECT_THAT(html, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(html, HasSubstr("x &amp; y"));
  EXPECT_THAT(html, HasSubstr("<a href=\"#s1\">Fitters</a>"));
  EXPECT_THAT(html, HasSubstr("<h2 id=\"s1\">Fitters</h2>"));
  EXPECT_THAT(html, Not(HasSubstr("<a href=\"#s2\">")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(html, HasSubstr("prefers-color-scheme:dark"));
}

TEST(HtmlPage, TablesHaveGroupsAndASummary) {
  HtmlPage page("", "");
  page.table({{{"", 1}, {"here", 2}},
              {"corner", "x", "y"},
              {{"1", "2.0", "3.0"}, {"median", "4.0", "5.0"}},
              1,
              true});
  const std::string html = page.finish();
  EXPECT_THAT(html, HasSubstr("<th class=\"group\" colspan=\"2\">here</th>"));
  EXPECT_THAT(html, HasSubstr("<th class=\"text\">corner</th><th>x</th>"));
  EXPECT_THAT(html, HasSubstr("<tr><td class=\"text\">1</td><td>2.0</td>"));
  EXPECT_THAT(html, HasSubstr("<tr class=\"total\"><td class=\"text\">median</td>"));
}

TEST(HtmlPage, FiguresLoseTheirDeclaration) {
  HtmlPage page("", "");
  page.figure("<?xml version=\"1.0\"?>\n<svg class=\"plot\"></svg>\n", "a plot");
  const std::string html = page.finish();
  EXPECT_THAT(html, Not(HasSubstr("<?xml")));
  EXPECT_THAT(html, HasSubstr("<figure><svg class=\"plot\"></svg>"));
  EXPECT_THAT(html, HasSubstr("<figcaption>a plot</figcaption>"));
}

}  // namespace
}  // namespace quoin::deploy
