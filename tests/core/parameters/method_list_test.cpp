// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/method_list.hpp"

#include <functional>
#include <tuple>

#include <gmock/gmock.h>

namespace quoin {
namespace {

struct Times {
  static constexpr const char* name = "times";
  static constexpr const char* description = "multiplies";
  static constexpr const char* source = "textbook";
  static constexpr const char* choose = "To make more.";
  struct Parameters {
    int factor = 3;
    static constexpr auto fields() {
      return std::make_tuple(field(&Parameters::factor, "factor", "", 1, 9, "how often"));
    }
  };
  explicit Times(const Parameters& parameters) : factor(parameters.factor) {}
  int operator()(int value) const { return factor * value; }
  int factor;
};

struct Negate {
  static constexpr const char* name = "negate";
  static constexpr const char* description = "changes the sign";
  static constexpr const char* source = "everyday life";
  static constexpr const char* choose = "To make less.";
  struct Parameters {
    static constexpr auto fields() { return std::make_tuple(); }
  };
  explicit Negate(const Parameters&) {}
  int operator()(int value) const { return -value; }
};

using Functions = MethodList<Times, Negate>;
using Function = std::function<int(int)>;

TEST(MethodList, DescribesEachMethodInOrder) {
  const std::vector<MethodInfo> methods = Functions::descriptions();
  ASSERT_EQ(methods.size(), 2U);
  EXPECT_EQ(methods[0].name, "times");
  EXPECT_EQ(methods[0].description, "multiplies");
  EXPECT_EQ(methods[0].source, "textbook");
  EXPECT_EQ(methods[0].choose, "To make more.");
  ASSERT_EQ(methods[0].parameters.size(), 1U);
  EXPECT_EQ(methods[0].parameters[0].default_value, "3");
  EXPECT_EQ(methods[1].name, "negate");
  EXPECT_EQ(methods[1].choose, "To make less.");
  EXPECT_THAT(methods[1].parameters, testing::IsEmpty());
}

TEST(MethodList, MakesTheNamedMethodWithItsSettings) {
  EXPECT_EQ(Functions::make<Function>("times", {})(2), 6);
  EXPECT_EQ(Functions::make<Function>("times", {{"factor", "5"}})(2), 10);
  EXPECT_EQ(Functions::make<Function>("negate", {})(2), -2);
  EXPECT_THROW((void)Functions::make<Function>("times", {{"factor", "10"}}), ParameterError);
  EXPECT_THROW((void)Functions::make<Function>("negate", {{"factor", "5"}}), ParameterError);
}

TEST(MethodList, SuggestsTheNearestName) {
  try {
    (void)Functions::make<Function>("negat", {});
    FAIL() << "no error";
  } catch (const ParameterError& error) {
    EXPECT_STREQ(error.what(), "unknown method 'negat'; did you mean 'negate'?");
  }
}

TEST(MethodList, TellsTheValueInForce) {
  EXPECT_EQ(Functions::setting("times", {}, "factor"), "3");
  EXPECT_EQ(Functions::setting("times", {{"factor", "4"}}, "factor"), "4");
  EXPECT_EQ(Functions::setting("negate", {}, "factor"), "");
}

TEST(ParameterInfo, IsEqualWhenAllIsTheSame) {
  const ParameterInfo info = describe_parameters<Times::Parameters>().front();
  ParameterInfo other = info;
  EXPECT_EQ(info, other);
  other.default_value = "4";
  EXPECT_NE(info, other);
}

}  // namespace
}  // namespace quoin
