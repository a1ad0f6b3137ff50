// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/excerpt.hpp"

#include <gtest/gtest.h>

namespace quoin::sensor_bridge {
namespace {

TEST(Excerpt, KeepsMessagesShortAndPrintable) {
  EXPECT_EQ(excerpt("2.x5"), "'2.x5'");
  EXPECT_EQ(excerpt(""), "''");
  EXPECT_EQ(excerpt(std::string_view("a\0b\x1B[2J\xC3", 8)), "'a\\x00b\\x1B[2J\\xC3'");
  EXPECT_EQ(excerpt(std::string(40, 'x')), "'" + std::string(40, 'x') + "'");
  EXPECT_EQ(excerpt(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace quoin::sensor_bridge
