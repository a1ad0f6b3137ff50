// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/descriptor.hpp"

#include <gtest/gtest.h>

#include "sensor_bridge/rplidar/protocol/sample_format.hpp"
#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

struct Example {
  const char* bytes;
  Descriptor descriptor;
};

// Length in the lower 30 bits, 0x40 in the fourth byte for repeated payloads.
constexpr Example examples[] = {
    {"A5 5A 14 00 00 00 04", {20, false, 0x04}}, {"A5 5A 03 00 00 00 06", {3, false, 0x06}},
    {"A5 5A 04 00 00 00 15", {4, false, 0x15}},  {"A5 5A 06 00 00 00 20", {6, false, 0x20}},
    {"A5 5A 08 00 00 00 21", {8, false, 0x21}},  {"A5 5A 04 00 00 00 FF", {4, false, 0xFF}},
    {"A5 5A 05 00 00 40 81", {5, true, 0x81}},   {"A5 5A 54 00 00 40 82", {84, true, 0x82}},
    {"A5 5A 0D 03 00 40 83", {781, true, 0x83}}, {"A5 5A 84 00 00 40 84", {132, true, 0x84}},
    {"A5 5A 54 00 00 40 85", {84, true, 0x85}},  {"A5 5A AA 00 00 40 86", {170, true, 0x86}}};

TEST(Descriptor, HasTheBytesOfTheTable) {
  for (const Example& example : examples) {
    EXPECT_EQ(to_bytes(encode(example.descriptor)), hex(example.bytes));
  }
}

TEST(DescriptorScanner, ReadsTheTableInPieces) {
  for (const Example& example : examples) {
    DescriptorScanner scanner;
    const Bytes bytes = hex(example.bytes);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      std::span<const std::uint8_t> piece = std::span(bytes).subspan(i, 1);
      const auto found = scanner.next(piece);
      ASSERT_EQ(found.has_value(), i + 1 == bytes.size()) << example.bytes;
      if (!found) continue;
      EXPECT_EQ(*found, example.descriptor);
    }
    EXPECT_EQ(scanner.skipped_bytes(), 0u);
  }
}

TEST(DescriptorScanner, LeavesThePayload) {
  DescriptorScanner scanner;
  const Bytes bytes = hex("A5 5A 03 00 00 00 06 00 01 02");
  std::span<const std::uint8_t> rest = bytes;
  EXPECT_EQ(scanner.next(rest), (Descriptor{3, false, 0x06}));
  EXPECT_EQ(to_bytes(rest), hex("00 01 02"));
}

TEST(DescriptorScanner, PassesOverWhatLooksLikeOne) {
  const char* const false_ones[] = {
      "A5 5A 13 00 00 00 04",  // device info of 21 bytes
      "A5 5A 14 00 00 40 04",  // repeated device info
      "A5 5A 54 00 00 00 85",  // one single dense capsule
      "A5 5A 54 00 00 80 85",  // another mode alone
      "A5 5A 55 00 00 40 85",  // a dense capsule of 85 bytes
      "A5 5A 03 00 00 00 20",  // configuration without its key
      "A5 5A 00 10 00 00 20",  // configuration of 4 kB
      "A5 5A 14 00 00 00 05",  // unknown type
      "A5 A5 5A A5 5A 14 00",  // cut off
  };
  for (const char* const bytes : false_ones) {
    DescriptorScanner scanner;
    const Bytes stream = hex(bytes) + hex("A5 5A 03 00 00 00 06");
    std::span<const std::uint8_t> rest = stream;
    EXPECT_EQ(scanner.next(rest), (Descriptor{3, false, 0x06})) << bytes;
    EXPECT_EQ(scanner.skipped_bytes(), 7u) << bytes;
  }
}

TEST(DescriptorScanner, FindsOneBehindTheBeginOfAnother) {
  DescriptorScanner scanner;
  const Bytes stream = hex("A5 5A 54 A5 5A 03 00 00 00 06");
  std::span<const std::uint8_t> rest = stream;
  EXPECT_EQ(scanner.next(rest), (Descriptor{3, false, 0x06}));
  EXPECT_EQ(scanner.skipped_bytes(), 3u);
}

TEST(SampleFormat, IsTheTypeOfTheDescriptor) {
  EXPECT_EQ(sample_format(0x85), SampleFormat::dense);
  EXPECT_EQ(sample_format(0x81), SampleFormat::standard);
  EXPECT_EQ(sample_format(0x87), std::nullopt);
  EXPECT_EQ(sample_format(0x04), std::nullopt);
  EXPECT_EQ(format_name(SampleFormat::dense), "dense (0x85)");
  EXPECT_EQ(format_name(SampleFormat::ultra_dense), "ultra dense (0x86)");
}

TEST(DescriptorScanner, TakesLongerAnswersAndBitsAboveTheLengthOfFrames) {
  const auto found = [](const char* text) {
    const Bytes bytes = hex(text);
    std::span<const std::uint8_t> rest = bytes;
    DescriptorScanner scanner;
    return scanner.next(rest);
  };
  EXPECT_EQ(found("A5 5A 18 00 00 00 04"), (Descriptor{24, false, 0x04}));
  EXPECT_EQ(found("A5 5A 04 00 00 00 06"), (Descriptor{4, false, 0x06}));
  EXPECT_EQ(found("A5 5A 54 00 00 C0 85"), (Descriptor{84, true, 0x85}));
  EXPECT_EQ(found("A5 5A 54 00 01 40 85"), (Descriptor{84, true, 0x85}));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
