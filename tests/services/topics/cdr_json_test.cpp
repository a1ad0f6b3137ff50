// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/cdr_json.hpp"

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace quoin::topics {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::vector<std::byte>;

Bytes bytes(std::initializer_list<int> values) {
  Bytes result;
  for (const int value : values) result.push_back(static_cast<std::byte>(value));
  return result;
}

const IdlTypes& idl() {
  static const IdlTypes types = parse_idl(R"(
    module t {
      enum Color { RED, GREEN };
      struct Small { octet tag; unsigned short number; };
      struct Mixed {
        boolean flag;
        double value;
        string text;
        sequence<Small> items;
        Color color;
        char letter;
        long long big;
        float pair[2];
      };
      struct Text { string text; };
      struct Flag { boolean flag; };
      struct Bounded { sequence<octet, 2> few; string<2> text; };
      struct Floats { sequence<float> values; };
      struct Doubles { double values[3]; };
      struct Colors { sequence<Color> colors; };
      struct Huge { octet values[4000000000][4000000000]; };
    };
  )");
  return types;
}

/// The fault of these bytes as that type; nothing when they have none.
std::optional<CdrFault> fault(const char* type, const Bytes& cdr) {
  try {
    (void)cdr_to_json(idl(), type, cdr);
  } catch (const CdrError& error) {
    EXPECT_LE(error.offset(), cdr.size());
    return error.fault();
  }
  return std::nullopt;
}

// Offsets count from behind the four bytes of encapsulation.
const Bytes mixed_little = bytes({
    0,    1,    0,    0,                             // CDR_LE
    1,    0,    0,    0,    0,    0,    0,    0,     // 0: flag, 7 to align
    0,    0,    0,    0,    0,    0,    0xf8, 0x3f,  // 8: 1.5
    3,    0,    0,    0,    'h',  'i',  0,    0,     // 16: 3 bytes, 1 to align
    2,    0,    0,    0,                             // 24: 2 items
    7,    0,    0x34, 0x12,                          // 28: tag 7, 1 to align, 0x1234
    8,    0,    0x01, 0x00,                          // 32: tag 8, 1
    1,    0,    0,    0,                             // 36: GREEN
    'x',  0,    0,    0,    0,    0,    0,    0,     // 40: letter, 7 to align
    0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,  // 48: -2
    0xcd, 0xcc, 0xcc, 0x3d,                          // 56: 0.1f
    0x00, 0x00, 0x80, 0x7f,                          // 60: infinity
});

const char* const mixed_json =
    R"({"flag":true,"value":1.5,"text":"hi","items":[{"tag":7,"number":4660},)"
    R"({"tag":8,"number":1}],"color":"GREEN","letter":"x","big":-2,"pair":[0.1,null]})";

TEST(CdrJson, EveryFieldUnderItsNameInTheOrderOfTheIdl) {
  EXPECT_EQ(cdr_to_json(idl(), "t::Mixed", mixed_little).dump(), mixed_json);
}

TEST(CdrJson, BothByteOrders) {
  const Bytes mixed_big = bytes({
      0,    0,    0,    0,                             // CDR_BE
      1,    0,    0,    0,    0,    0,    0,    0,     // flag, 7 to align
      0x3f, 0xf8, 0,    0,    0,    0,    0,    0,     // 1.5
      0,    0,    0,    3,    'h',  'i',  0,    0,     // 3 bytes, 1 to align
      0,    0,    0,    2,                             // 2 items
      7,    0,    0x12, 0x34, 8,    0,    0,    1,     //
      0,    0,    0,    1,                             // GREEN
      'x',  0,    0,    0,    0,    0,    0,    0,     // letter, 7 to align
      0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xfe,  // -2
      0x3d, 0xcc, 0xcc, 0xcd,                          // 0.1f
      0x7f, 0x80, 0x00, 0x00,                          // infinity
  });
  EXPECT_EQ(cdr_to_json(idl(), "t::Mixed", mixed_big).dump(), mixed_json);
}

TEST(CdrJson, EveryTruncationIsAnError) {
  for (std::size_t size = 0; size < mixed_little.size(); ++size) {
    EXPECT_EQ(fault("t::Mixed", {mixed_little.data(), mixed_little.data() + size}),
              CdrFault::truncated)
        << size;
  }
}

TEST(CdrJson, PaddingMayFollowMoreMayNot) {
  Bytes cdr = bytes({0, 1, 0, 0, 1});
  for (int padding = 0; padding <= 3; ++padding) {
    EXPECT_EQ(fault("t::Flag", cdr), std::nullopt);
    cdr.push_back(std::byte{0});
  }
  EXPECT_EQ(fault("t::Flag", cdr), CdrFault::bytes_left_over);
}

TEST(CdrJson, FaultsAreNamed) {
  EXPECT_EQ(fault("t::None", mixed_little), CdrFault::unknown_type);
  EXPECT_EQ(fault("t::Color", mixed_little), CdrFault::unknown_type);
  EXPECT_EQ(fault("", mixed_little), CdrFault::unknown_type);
  EXPECT_EQ(fault("t::Flag", bytes({0, 3, 0, 0, 1})), CdrFault::unknown_encapsulation) << "PL_CDR";
  EXPECT_EQ(fault("t::Flag", bytes({0, 7, 0, 0, 1})), CdrFault::unknown_encapsulation) << "XCDR2";
  EXPECT_EQ(fault("t::Flag", bytes({0, 1, 0, 0, 2})), CdrFault::bad_boolean);
  EXPECT_EQ(fault("t::Text", bytes({0, 1, 0, 0, 2, 0, 0, 0, 'h', 'i'})),
            CdrFault::string_not_terminated);
  EXPECT_EQ(fault("t::Text", bytes({0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 'h', 0})),
            CdrFault::truncated);
  EXPECT_EQ(fault("t::Floats", bytes({0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0})),
            CdrFault::truncated);
  EXPECT_EQ(fault("t::Bounded", bytes({0, 1, 0, 0, 3, 0, 0, 0, 1, 2, 3, 0, 1, 0, 0, 0, 0})),
            CdrFault::beyond_bound);
  EXPECT_EQ(fault("t::Bounded", bytes({0, 1, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 'a', 'b', 'c', 0})),
            CdrFault::beyond_bound);
  EXPECT_EQ(
      fault("t::Bounded", bytes({0, 1, 0, 0, 2, 0, 0, 0, 1, 2, 0, 0, 3, 0, 0, 0, 'a', 'b', 0})),
      std::nullopt);
  EXPECT_EQ(fault("t::Huge", bytes({0, 1, 0, 0, 1, 2, 3, 4})), CdrFault::truncated);
  EXPECT_EQ(fault("t::Floats",
                  [] {
                    Bytes cdr = bytes({0, 1, 0, 0, 0x00, 0x09, 0x3d, 0x00});  // 4 000 000
                    cdr.resize(8 + 16'000'000);
                    return cdr;
                  }()),
            CdrFault::too_large);
}

TEST(CdrJson, AnErrorSaysWhereItIs) {
  Bytes cdr = mixed_little;
  cdr[4 + 24] = std::byte{200};  // items
  try {
    (void)cdr_to_json(idl(), "t::Mixed", cdr);
    FAIL();
  } catch (const CdrError& error) {
    EXPECT_EQ(error.fault(), CdrFault::truncated);
    EXPECT_EQ(error.offset(), 32U);
    EXPECT_NE(std::string(error.what()).find("t::Mixed: items: "), std::string::npos);
  }
}

TEST(CdrJson, DeepNestingIsAnError) {
  std::string text = "struct S0 { octet x; };";
  for (int i = 1; i < 40; ++i) {
    text += "struct S" + std::to_string(i) + " { S" + std::to_string(i - 1) + " x; };";
  }
  const IdlTypes deep = parse_idl(text);
  const Bytes cdr = bytes({0, 1, 0, 0, 5});
  EXPECT_NO_THROW((void)cdr_to_json(deep, "S31", cdr));
  try {
    (void)cdr_to_json(deep, "S39", cdr);
    FAIL();
  } catch (const CdrError& error) {
    EXPECT_EQ(error.fault(), CdrFault::nested_too_deeply);
  }
}

TEST(CdrJson, SpecialValues) {
  EXPECT_EQ(
      cdr_to_json(idl(), "t::Doubles",
                  bytes({0,    1,    0,    0,    0,    0,    0,    0,    0, 0, 0xf8, 0x7f,  // NaN
                         0,    0,    0,    0,    0,    0,    0xf0, 0xff,    // -infinity
                         0x9a, 0x99, 0x99, 0x99, 0x99, 0x99, 0xb9, 0x3f}))  // 0.1
          .dump(),
      R"({"values":[null,null,0.1]})");
  EXPECT_EQ(cdr_to_json(idl(), "t::Colors", bytes({0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0}))
                .dump(),
            R"({"colors":["RED",9]})")
      << "a value that a later version may have";
  EXPECT_EQ(cdr_to_json(idl(), "t::Text", bytes({0, 1, 0, 0, 0, 0, 0, 0})).dump(), R"({"text":""})")
      << "without even the terminating zero";
}

TEST(CdrJson, GarbageIsAMessageOrAnError) {
  std::mt19937 random(7);
  int messages = 0;
  for (int round = 0; round < 20'000; ++round) {
    Bytes cdr = mixed_little;
    cdr.resize(random() % (cdr.size() + 8));
    for (std::size_t changes = random() % 6; changes > 0 && cdr.size() > 4; --changes) {
      cdr[4 + random() % (cdr.size() - 4)] = static_cast<std::byte>(random());
    }
    if (!fault("t::Mixed", cdr)) ++messages;
    for (const TopicType& type : topic_types()) {
      try {
        (void)cdr_to_json(type.dds_type, cdr);
      } catch (const CdrError&) {
        continue;
      }
    }
  }
  EXPECT_GT(messages, 0);
}

}  // namespace
}  // namespace quoin::topics
