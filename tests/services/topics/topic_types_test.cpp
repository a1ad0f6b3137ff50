// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/topic_types.hpp"

#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/topics/idl_parser.hpp"

namespace quoin::topics {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(TopicTypes, EachRowNamesAStructureOfItsIdlFileThatBeginsWithAHeader) {
  for (const TopicType& row : topic_types()) {
    SCOPED_TRACE(row.name);
    const IdlTypes idl = parse_idl(idl_text(row.idl));
    const IdlType* type = idl.find(row.dds_type);
    ASSERT_NE(type, nullptr);
    ASSERT_EQ(type->kind, IdlKind::structure);
    EXPECT_EQ(type->fields.at(0).name, "header");
    EXPECT_EQ(idl.types[type->fields.at(0).type].name, "quoin::msg::Header");
  }
}

TEST(TopicTypes, EachRowIsFoundByBothItsNames) {
  std::set<std::string_view> names;
  for (const TopicType& row : topic_types()) {
    EXPECT_EQ(find_topic_type(row.name), &row);
    EXPECT_EQ(find_topic_type_by_dds_type(row.dds_type), &row);
    EXPECT_TRUE(names.insert(row.name).second);
  }
  EXPECT_EQ(find_topic_type("scam"), nullptr);
  EXPECT_EQ(find_topic_type(""), nullptr);
  EXPECT_EQ(find_topic_type_by_dds_type("scan"), nullptr);
}

TEST(TopicTypes, AnIdlTextIsCompleteAndHasWhatItIncludesOnce) {
  for (const IdlFile& file : idl_files()) {
    SCOPED_TRACE(file.name);
    EXPECT_THAT(std::string(file.text), Not(HasSubstr("#include")));
    EXPECT_NO_THROW((void)parse_idl(file.text));
  }
  const std::string_view scan = idl_text("Scan.idl");
  EXPECT_THAT(std::string(scan), HasSubstr("sequence<float> ranges;"));
  const std::size_t header = scan.find("struct Header {");
  ASSERT_NE(header, std::string_view::npos);
  EXPECT_EQ(scan.find("struct Header {", header + 1), std::string_view::npos);
  EXPECT_EQ(idl_text("Scam.idl"), "");
}

}  // namespace
}  // namespace quoin::topics
