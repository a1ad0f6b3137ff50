// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/topic_types.hpp"

#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/topics/idl_parser.hpp"
#include "services/topics/type_digest.hpp"

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

TEST(TypeDigest, StandsForTheFieldsAndTheirOrderAndNotForWhatTheyMayHold) {
  const auto digest = [](const std::string& fields) {
    return digest_of(
        parse_idl("enum E { a, b };\nstruct Inner { long x; };\nstruct S { " + fields + "\n};"),
        "S");
  };
  const std::string fields = "long a; sequence<double> b; Inner c; E d; float e[3];";
  EXPECT_EQ(digest(fields).size(), 8U);
  EXPECT_EQ(digest(fields), digest(fields));
  EXPECT_EQ(digest("long a; //@range(0, 1)"), digest("long a; // of something"));
  for (const char* other : {"long a; sequence<double> b; Inner c; E d; float e[3]; long f;",
                            "long a; sequence<double> b; Inner c; E d;",
                            "sequence<double> b; long a; Inner c; E d; float e[3];",
                            "long A; sequence<double> b; Inner c; E d; float e[3];",
                            "unsigned long a; sequence<double> b; Inner c; E d; float e[3];",
                            "long a; sequence<double, 5> b; Inner c; E d; float e[3];",
                            "long a; sequence<double> b; long c; E d; float e[3];",
                            "long a; sequence<double> b; Inner c; E d; float e[4];"}) {
    EXPECT_NE(digest(fields), digest(other)) << other;
  }
}

TEST(TypeDigest, OfEachTopicTypeIsAnotherOneAndOfForeignTypesThereIsNone) {
  std::set<std::string_view> digests{type_digest("quoin::msg::ServiceStatus")};
  for (const TopicType& row : topic_types()) {
    EXPECT_EQ(type_digest(row.dds_type), digest_of(parse_idl(idl_text(row.idl)), row.dds_type));
    EXPECT_TRUE(digests.insert(type_digest(row.dds_type)).second) << row.name;
  }
  EXPECT_FALSE(digests.contains(""));
  EXPECT_EQ(type_digest("sensor_msgs::msg::dds_::LaserScan_"), "");
}

}  // namespace
}  // namespace quoin::topics
