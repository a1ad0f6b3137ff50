// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/png.hpp"

#include <gmock/gmock.h>

#include "deploy/evaluation/drawing/drawing.hpp"

namespace quoin::deploy {
namespace {

using testing::StartsWith;

unsigned big_endian(const std::string& bytes, std::size_t at) {
  unsigned value = 0;
  for (std::size_t i = at; i < at + 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

TEST(Png, IsAsLargeAsThePicture) {
  const std::string svg = R"(<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30"/>)";
  const std::string png = png_of(svg);
  EXPECT_THAT(png, StartsWith("\x89PNG\r\n\x1a\n"));
  EXPECT_EQ(big_endian(png, 16), 40U);
  EXPECT_EQ(big_endian(png, 20), 30U);
  EXPECT_EQ(big_endian(png_of(svg, 2.0), 16), 80U);
}

TEST(Png, DrawsTheDrawingOfAScan) {
  Drawing drawing;
  const std::size_t empty = png_of(draw_svg(drawing)).size();
  drawing.lines.push_back({{0.0, 0.0}, {1.0, 1.0}});
  EXPECT_GT(png_of(draw_svg(drawing)).size(), empty);
}

TEST(Png, WhatIsNoPictureIsAnError) {
  EXPECT_THROW((void)png_of("no picture"), std::runtime_error);
  EXPECT_THROW(
      (void)png_of(R"(<svg xmlns="http://www.w3.org/2000/svg" width="40000" height="3"/>)"),
      std::runtime_error);
}

}  // namespace
}  // namespace quoin::deploy
