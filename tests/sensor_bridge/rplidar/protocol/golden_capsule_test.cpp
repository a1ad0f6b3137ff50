// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames written by hand from the tables of the formats; how stands beside each. Capsules carry the
// exclusive or of all bytes but the first two in the low halves of these, its low half first.
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"
#include "tests/sensor_bridge/rplidar/protocol/sample_stream.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::uint32_t degrees(double value) { return static_cast<std::uint32_t>(value * 65536); }

TEST(GoldenFrames, StandardNodes) {
  // Start of scan, quality 47 = 0xBC >> 2: BC | 1. 0.5 degrees = 32/64: 32 * 2 + 1 = 0x0041.
  // 1000 mm = 4000/4 = 0x0FA0.
  const Bytes first = hex("BD 41 00 A0 0F");
  // Quality 15: 3C | 2. 23039/64 degrees: 23039 * 2 + 1 = 0xB3FF. No return.
  const Bytes second = hex("3E FF B3 00 00");
  // Quality 0. 360 degrees = 23040/64: 23040 * 2 + 1 = 0xB401, the same as zero. The farthest.
  const Bytes third = hex("02 01 B4 FF FF");
  // Waits for one more, which confirms it.
  EXPECT_EQ(decode(SampleFormat::standard, first + second + third + first),
            (DecodedSamples{{degrees(0.5), 4000, 188, true},
                            {degrees(359.984375), 0, 60, false},
                            {0, 65535, 0, false}}));
}

TEST(GoldenFrames, DenseCapsules) {
  // 10 degrees = 640/64 = 0x0280, first of its stream: 0x8280. 1000 mm = 0x03E8, nothing, 65535 mm
  // and 37 times 0x1234 = 4660 mm. Checksum: 80 ^ 82 = 02; E8 ^ 03 = EB; FF ^ FF = 00; 34 ^ 12 = 26
  // an odd number of times; 02 ^ EB ^ 26 = CF.
  const Bytes first = hex("AF 5C 80 82 E8 03 00 00 FF FF") + hex("34 12", 37);
  // 14 degrees = 896/64 = 0x0380; 40 times 2000 mm = 0x07D0. Checksum: 80 ^ 03 = 83.
  const Bytes second = hex("A3 58 80 03") + hex("D0 07", 40);
  const DecodedSamples samples = decode(SampleFormat::dense, first + second);
  ASSERT_EQ(samples.size(), 40u);
  // 4 degrees / 40 = 6553.6/65536, of which the vendor's software keeps 6553.
  EXPECT_EQ(samples[0], (DecodedSample{degrees(10), 4000, 188, true}));
  EXPECT_EQ(samples[1], (DecodedSample{degrees(10) + 6553, 0, 0, false}));
  EXPECT_EQ(samples[2], (DecodedSample{degrees(10) + 2 * 6553, 262140, 188, false}));
  for (std::uint32_t k = 3; k < 40; ++k) {
    EXPECT_EQ(samples[k], (DecodedSample{degrees(10) + k * 6553, 18640, 188, false}));
  }
}

TEST(GoldenFrames, DenseCapsulesAcrossZero) {
  // 358 degrees = 22912/64 = 0x5980: checksum 80 ^ 59 = D9. 2 degrees = 128/64 = 0x0080.
  const Bytes first = hex("A9 5D 80 59") + hex("00 00", 40);
  const Bytes second = hex("A0 58 80 00") + hex("00 00", 40);
  const DecodedSamples samples = decode(SampleFormat::dense, first + second);
  ASSERT_EQ(samples.size(), 40u);
  EXPECT_EQ(samples[0].angle_q16, degrees(358));
  // 20 * 6553 = 131060 is below, 21 * 6553 = 137613 above the 2 * 65536 = 131072 up to zero.
  EXPECT_EQ(samples[20].angle_q16, degrees(358) + 131060);
  EXPECT_EQ(samples[21].angle_q16, 137613u - 131072u);
  EXPECT_EQ(samples[39].angle_q16, 39u * 6553u - 131072u);
}

TEST(GoldenFrames, ExpressCapsules) {
  // 0 degrees, first of its stream. First cabin: 1000 mm << 2 = 0x0FA0 with correction 18 =
  // 0b010010, whose high bits 01 go into the word and low bits 2 into the low half of the last
  // byte; 500 mm
  // << 2 = 0x07D0 with 63 = 0b111111: 11 and F. The other 15: nothing, and 1000 mm.
  // Checksum: 80; A1 ^ 0F ^ D3 ^ 07 ^ F2 = 88; A0 ^ 0F = AF an odd number of times:
  // 80 ^ 88 ^ AF = A7.
  const Bytes first = hex("A7 5A 00 80 A1 0F D3 07 F2") + hex("00 00 A0 0F 00", 15);
  // 8 degrees = 512/64 = 0x0200.
  const Bytes second = hex("A2 50 00 02") + hex("00 00 00 00 00", 16);
  const DecodedSamples samples = decode(SampleFormat::express, first + second);
  ASSERT_EQ(samples.size(), 32u);
  // 8 degrees / 32 = 0.25; corrections 18/8 and 63/8 degrees.
  EXPECT_EQ(samples[0], (DecodedSample{degrees(360 - 2.25), 4000, 188, true}));
  EXPECT_EQ(samples[1], (DecodedSample{degrees(360 + 0.25 - 7.875), 2000, 188, false}));
  for (std::uint32_t k = 2; k < 32; ++k) {
    EXPECT_EQ(samples[k], (DecodedSample{k * degrees(0.25), k % 2 * 4000, k % 2 * 188, false}));
  }
}

// A word: major code | first prediction << 12 | second << 22, both of ten bits with a sign.
Bytes first_ultra_capsule() {
  return hex("AD 5E 00 85")        // 20 degrees = 1280/64 = 0x0500, first of its stream
         + hex("58 32 00 19")      // 600 = 0x258 | +3 << 12 | +100 << 22
         + hex("00 F0 3F 80")      // 0 | -1 = 0x3FF << 12 | -512 = 0x200 << 22
         + hex("14 F5 1F 00")      // 1300 = 0x514 | 511 = 0x1FF << 12 | 0
         + hex("08 B7 BF 00")      // 1800 = 0x708 | -5 = 0x3FB << 12 | +2 << 22
         + hex("02 0D 00 00")      // 3330 = 0xD02 | 0 | 0
         + hex("64 00 00 00", 26)  // 100 = 0x064 | 0 | 0
         + hex("64 00 C0 01");     // 100 | 0 | +7 << 22
  // Checksum: 00^85 = 85, 58^32^00^19 = 73, 00^F0^3F^80 = 4F, 14^F5^1F = FE, 08^B7^BF = 00,
  // 02^0D = 0F, 64 an even number of times, 64^C0^01 = A5;
  // 85 ^ 73 ^ 4F ^ FE ^ 0F ^ A5 = ED.
}

TEST(GoldenFrames, UltraCapsules) {
  // 32 degrees = 2048/64 = 0x0800; 700 = 0x2BC. Checksum: 08 ^ BC ^ 02 = B6.
  const Bytes second = hex("A6 5B 00 08 BC 02 00 00") + hex("00 00 00 00", 31);
  const DecodedSamples samples = decode(SampleFormat::ultra, first_ultra_capsule() + second);
  ASSERT_EQ(samples.size(), 96u);
  // Codes from 512 on: 512 + 2 mm each; from 1280 on: 2048 + 4 mm each; from 1792 on: 4096 + 8 mm
  // each; from 3328 on: 16384 + 16 mm each.
  const std::uint32_t millimetres[] = {
      688,   694,   100,    // 512 + 88 * 2; + 3 * 2; from the next, which is 0 mm: 100 * 1
      0,     2124,  0,      // none; from the next in its place: 2128 - 4; -512: none
      2128,  0,     4160,   // 2048 + 20 * 4; 511: none; the next: 4096 + 8 * 8
      4160,  4120,  16448,  // - 5 * 8; the next, 16384 + 2 * 16, + 2 * 16
      16416, 16416, 100,    // + 0; the next + 0
  };
  for (std::size_t k = 0; k < 95; ++k) {
    const std::uint32_t expected = k < std::size(millimetres) ? millimetres[k] : 100;
    EXPECT_EQ(samples[k].distance_q2, 4 * expected) << k;
    EXPECT_EQ(samples[k].quality, expected != 0 ? 188u : 0u) << k;
  }
  // 512 + 188 * 2 of the capsule behind, + 7 * 2.
  EXPECT_EQ(samples[95].distance_q2, 4u * 902u);

  // 12 degrees / 96 = 0.125 a point, less the offset: in radians/65536 it is 8578 (7.5 degrees)
  // below 50 mm, and 9150 (8 degrees) - 64 q - q * q * q / 98304 with q = 98361 / (4 d) at d mm:
  // 688 mm: q = 35: 9150 - 2240 = 6910; 16416 mm: q = 1: 9086; 100 mm: q = 245: 9150 - 15680 - 149
  // = -6679. Times 180 / pi, in degrees/65536: 491483, 395913, 520589, -382678.
  EXPECT_EQ(samples[0].angle_q16, degrees(20) - 395913);
  EXPECT_EQ(samples[3].angle_q16, degrees(20) + 3 * 8192 - 491483);
  EXPECT_EQ(samples[12].angle_q16, degrees(20) + 12 * 8192 - 520589);
  EXPECT_EQ(samples[94].angle_q16, degrees(20) + 94 * 8192 + 382678);
}

TEST(GoldenFrames, UltraCapsulesWithLessThanNothing) {
  // 50 = 0x032 | -100 = 0x39C << 12: 50 mm less 100. Checksum: 85 ^ 32 ^ C0 ^ 39 = 4E.
  const Bytes first = hex("AE 54 00 85 32 C0 39 00") + hex("00 00 00 00", 31);
  // 32 degrees: 00 ^ 08.
  const Bytes second = hex("A8 50 00 08") + hex("00 00 00 00", 32);
  const DecodedSamples samples = decode(SampleFormat::ultra, first + second);
  ASSERT_EQ(samples.size(), 96u);
  EXPECT_EQ(samples[0].distance_q2, 200u);
  EXPECT_EQ(samples[1].distance_q2, 0u);
  EXPECT_EQ(samples[1].quality, 0u);
}

TEST(GoldenFrames, UltraDenseCapsules) {
  // Time 0x01020304, status 0, 30 degrees = 1920/64 = 0x0780, first of its stream. Words of 20
  // bits: 557D0: quality 55, 0x7D0 * 2 = 4000.     544F9: quality 2A << 1, 0x4F8 * 3 + 8184 =
  // 12000. 54716: quality 15 << 2, 0x714 * 4 + 32748 = 39996. 51003: quality 0A << 3, 0x1000 * 5 +
  // 98268 = 118748. 017D0: quality 1, 4000.                  017D4: quality 1, 4008: 2 mm behind
  // the last point. 017D8: quality 1, 4016.                  00000: none. Checksum:
  // 04^03^02^01^80^87 = 03, 6F, 17, 04 and CF for the cabins: 03^6F^17^04^CF = B0.
  const Bytes first = hex("A0 5B 04 03 02 01 00 00 80 87") + hex("D0 57 F9 44 55") +
                      hex("16 47 03 10 55") + hex("D0 17 D4 17 00") + hex("D8 17 00 00 00") +
                      hex("00 00 00 00 00", 28);
  // 46 degrees = 2944/64 = 0x0B80: 80 ^ 0B = 8B.
  const Bytes second = hex("AB 58 00 00 00 00 00 00 80 0B") + hex("00 00 00 00 00", 32);
  const DecodedSamples samples = decode(SampleFormat::ultra_dense, first + second);
  ASSERT_EQ(samples.size(), 64u);
  // 16 degrees / 64 = 0.25.
  const DecodedSample expected[] = {{degrees(30), 4000, 0x55, true},
                                    {degrees(30.25), 12000, 0x54, false},
                                    {degrees(30.5), 39996, 0x54, false},
                                    {degrees(30.75), 118748, 0x50, false},
                                    {degrees(31), 4000, 1, false},
                                    {degrees(31.25), 4004, 1, false},  // mean of 4000 and 4008
                                    {degrees(31.5), 4016, 1, false},   // 12 from 4004: as it is
                                    {degrees(31.75), 0, 0, false}};
  for (std::size_t k = 0; k < std::size(expected); ++k) EXPECT_EQ(samples[k], expected[k]) << k;
  EXPECT_EQ(samples[63], (DecodedSample{degrees(45.75), 0, 0, false}));
}

TEST(GoldenFrames, HqCapsule) {
  // Time 0x0807060504030201; 90 degrees = 0x4000, 1000 mm = 4000/4 = 0x0FA0, quality 200, start of
  // scan; the last angle, no return; 94 empty nodes. CRC-32 by Python's
  // zlib.crc32(content + bytes(3)) = 0x55F097A7.
  const Bytes capsule = hex("A5 01 02 03 04 05 06 07 08") + hex("00 40 A0 0F 00 00 C8 01") +
                        hex("FF FF 00 00 00 00 00 02") + hex("00 00 00 00 00 00 00 00", 94) +
                        hex("A7 97 F0 55");
  const DecodedSamples samples = decode(SampleFormat::hq, capsule);
  ASSERT_EQ(samples.size(), 96u);
  EXPECT_EQ(samples[0], (DecodedSample{degrees(90), 4000, 200, true}));
  EXPECT_EQ(samples[1], (DecodedSample{65535u * 360u, 0, 0, false}));
  EXPECT_EQ(samples[95], (DecodedSample{0, 0, 0, false}));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
