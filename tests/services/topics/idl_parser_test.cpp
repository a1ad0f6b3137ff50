// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/idl_parser.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::topics {
namespace {

/// Line of the error, 0 when there is none.
std::size_t error_line(const std::string& text) {
  try {
    (void)parse_idl(text);
  } catch (const IdlError& error) {
    return error.line();
  }
  return 0;
}

TEST(IdlParser, FieldsKeepOrderNamesAndTypes) {
  const IdlTypes idl = parse_idl(R"(
    /* of two
       lines */
    module a { module b {
      enum Color { RED, GREEN };  // no semicolon, no } here
      @final struct Inner { double x, y; };
      @final @topic(name = "outer") struct Outer {
        @key string<8> name;
        unsigned long long big;
        octet bytes[3][2];
        sequence<Inner, 5> points;
        sequence<sequence<float> > nested;
        ::a::b::Color color;
        b::Inner one;
      };
    }; };
  )");
  const IdlType* outer = idl.find("a::b::Outer");
  ASSERT_NE(outer, nullptr);
  const auto field = [&](std::size_t i) -> const IdlType& {
    return idl.types[outer->fields.at(i).type];
  };
  ASSERT_EQ(outer->fields.size(), 7U);
  EXPECT_EQ(outer->fields[0].name, "name");
  EXPECT_EQ(field(0).kind, IdlKind::string);
  EXPECT_EQ(field(0).bound, 8U);
  EXPECT_EQ(field(1).kind, IdlKind::uint64);
  EXPECT_EQ(field(2).kind, IdlKind::array);
  EXPECT_EQ(field(2).bound, 3U);
  EXPECT_EQ(idl.types[field(2).element].bound, 2U);
  EXPECT_EQ(field(3).bound, 5U);
  EXPECT_EQ(idl.types[field(3).element].name, "a::b::Inner");
  EXPECT_EQ(idl.types[idl.types[field(4).element].element].kind, IdlKind::float32);
  EXPECT_THAT(field(5).enumerators, testing::ElementsAre("RED", "GREEN"));
  EXPECT_THAT(field(6).fields, testing::ElementsAre(testing::Field(&IdlField::name, "x"),
                                                    testing::Field(&IdlField::name, "y")));
}

TEST(IdlParser, WhatItDoesNotKnowIsAnErrorWithItsLine) {
  EXPECT_EQ(error_line("struct A { long x; };"), 0U);
  for (const char* text : {
           "\nconst long n = 3;",
           "\ntypedef long n;",
           "\nunion U switch (long) { case 0: long x; };",
           "\n#include \"Common.idl\"",
           "\n@mutable struct A { long x; };",
           "struct A {\n @optional long x; };",
           "struct A {\n long double x; };",
           "struct A {\n wstring x; };",
           "struct A {\n B x; };",
           "struct A {\n A x; };",
           "struct A { long x;\n long x; };",
           "struct A { long x; };\nstruct A { long x; };",
           "struct A {\n };",
           "struct A { long x; };\nstruct B : A { long y; };",
           "struct A {\n long x[0]; };",
           "struct A {\n long x[99999999999]; };",
           "struct A {\n long x[n]; };",
           "struct A {\n unsigned x; };",
           "struct A {\n sequence<long x; };",
           "enum E {\n };",
           "struct A { long x; }\nstruct B { long x; };",
           "\n/* not closed",
           "@topic(\n",
           "module m {\n",
       }) {
    EXPECT_EQ(error_line(text), 2U) << text;
  }
}

TEST(IdlParser, NestingIsLimited) {
  std::string modules;
  std::string sequences = "struct A { ";
  for (int i = 0; i < 100'000; ++i) {
    modules += "module m { ";
    sequences += "sequence< ";
  }
  EXPECT_EQ(error_line(modules), 1U);
  EXPECT_EQ(error_line(sequences), 1U);
}

}  // namespace
}  // namespace quoin::topics
