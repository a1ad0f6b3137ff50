// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/parameter.hpp"

#include <string>

#include <gmock/gmock.h>

#include "core/fitting/fitters.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

using testing::HasSubstr;

ParameterInfo real(const char* unit, double minimum, double maximum) {
  ParameterInfo info;
  info.name = "value";
  info.type = ParameterType::real;
  info.unit = unit;
  info.minimum = minimum;
  info.maximum = maximum;
  return info;
}

std::string error_of(const ParameterInfo& info, const std::string& text) {
  try {
    check_parameter(info, text);
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.parameter(), info.name);
    return error.what();
  }
  return "no error";
}

TEST(ParseReal, AcceptsUnitsOfItsQuantity) {
  const auto value = [](const char* unit, const char* text) {
    return detail::parse_real(real(unit, -no_limit, no_limit), text);
  };
  EXPECT_DOUBLE_EQ(value("m", "0.04"), 0.04);
  EXPECT_DOUBLE_EQ(value("m", "40 mm"), 0.04);
  EXPECT_DOUBLE_EQ(value("m", "40mm"), 0.04);
  EXPECT_DOUBLE_EQ(value("m", " +4 cm "), 0.04);
  EXPECT_DOUBLE_EQ(value("m", "1e3um"), 1e-3);
  EXPECT_DOUBLE_EQ(value("rad", "180 deg"), 3.14159265358979323846);
  EXPECT_DOUBLE_EQ(value("m/m", "2 %"), 0.02);
  EXPECT_DOUBLE_EQ(value("m/m", "10 mm/m"), 0.01);
  EXPECT_DOUBLE_EQ(value("rad", "5 mrad"), 0.005);
  EXPECT_DOUBLE_EQ(value("s", "2 min"), 120.0);
  EXPECT_DOUBLE_EQ(value("s", "15ms"), 0.015);
  EXPECT_DOUBLE_EQ(value("Hz", "0.01 kHz"), 10.0);
  EXPECT_DOUBLE_EQ(value("m/s", "500 mm/s"), 0.5);
  EXPECT_DOUBLE_EQ(value("rad/s", "90 deg/s"), 1.5707963267948966);
  EXPECT_DOUBLE_EQ(value("", "-3"), -3.0);
}

TEST(ParseReal, NamesWhatIsWrong) {
  const ParameterInfo length = real("m", 0.001, 0.5);
  EXPECT_EQ(error_of(length, "0.1 s"), "unit 's' is not a length; write m, cm or mm");
  EXPECT_EQ(error_of(length, "0.9"), "0.9 is outside 0.001..0.5 m");
  EXPECT_EQ(error_of(length, "90 cm"), "90 cm is outside 0.001..0.5 m");
  EXPECT_EQ(error_of(length, "0.5 m"), "no error");
  EXPECT_EQ(error_of(real("rad", 0, 1), "1 m"), "unit 'm' is not an angle; write rad, mrad or deg");
  EXPECT_EQ(error_of(real("m/m", 0, 1), "1 mm"), "unit 'mm' is not a share; write %, mm/m or m/m");
  EXPECT_EQ(error_of(real("m", 0, 1), "1 %"), "unit '%' is not a length; write m, cm or mm");
  EXPECT_EQ(error_of(real("", 0, 1), "1 m"), "a number without a unit is needed, not 'm'");
  EXPECT_EQ(error_of(real("s", 0, no_limit), "-1"), "-1 is less than 0 s");
  for (const char* text :
       {"", "nan", "inf", "-inf", "1.2.3", "ten", "1e999", "0x10", "--1", "+-1", "1,5"}) {
    EXPECT_NE(error_of(real("m", -no_limit, no_limit), text), "no error") << text;
  }
}

TEST(ParseOthers, NameWhatIsWrong) {
  ParameterInfo integer = real("", 2, 10);
  integer.type = ParameterType::integer;
  EXPECT_EQ(error_of(integer, "6"), "no error");
  EXPECT_EQ(error_of(integer, "1"), "1 is outside 2..10");
  EXPECT_EQ(error_of(integer, "6.5"), "'6.5' is not a whole number");
  EXPECT_EQ(error_of(integer, "99999999999999999999"),
            "'99999999999999999999' is not a whole number");
  ParameterInfo boolean;
  boolean.name = "value";
  boolean.type = ParameterType::boolean;
  EXPECT_EQ(error_of(boolean, "true"), "no error");
  EXPECT_EQ(error_of(boolean, "yes"), "'yes' is neither true nor false");
  ParameterInfo choice;
  choice.name = "value";
  choice.type = ParameterType::choice;
  choice.choices = {"propagated", "as_published"};
  EXPECT_EQ(error_of(choice, "propagatd"),
            "'propagatd' is not a choice; did you mean 'propagated'?");
  EXPECT_EQ(error_of(choice, "xyz"), "'xyz' is not a choice; known are propagated, as_published");
}

TEST(NumberText, IsShortestAndReadsBack) {
  EXPECT_EQ(detail::number_text(0.05), "0.05");
  EXPECT_EQ(detail::number_text(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(detail::number_text(-7.0), "-7");
  EXPECT_EQ(std::stod(detail::number_text(1.0 / 3.0)), 1.0 / 3.0);
}

TEST(MakeParameters, AppliesSettingsAndSuggestsNames) {
  const auto p =
      make_parameters<Iepf::Parameters>({{"split_distance", "40 mm"}, {"refine", "false"}});
  EXPECT_DOUBLE_EQ(p.split_distance, 0.04);
  EXPECT_FALSE(p.refine);
  EXPECT_EQ(p.min_points, 6);
  EXPECT_EQ(parameter_settings(p)[0], (ParameterSetting{"split_distance", "0.04"}));
  try {
    (void)make_parameters<Iepf::Parameters>({{"splitdistance", "1"}});
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_STREQ(error.what(), "unknown parameter 'splitdistance'; did you mean 'split_distance'?");
  }
}

TEST(MethodList, DescribesAndMakes) {
  const auto infos = Fitters::descriptions();
  ASSERT_GE(infos.size(), 2U);
  EXPECT_EQ(infos[0].name, "inverse_range");
  ASSERT_EQ(infos[1].parameters.size(), 1U);
  EXPECT_EQ(infos[1].parameters[0].default_value, "propagated");
  EXPECT_TRUE(Fitters::make<Fitter>("utls", {{"covariance", "as_published"}}));
  EXPECT_TRUE(Segmenters::make<Segmenter>("iepf", {}));
  try {
    (void)Fitters::make<Fitter>("wclts", {});
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'wctls'?"));
  }
}

TEST(NearestName, CountsSwapsOnce) {
  EXPECT_EQ(nearest_name("wclts", {"utls", "wtls", "wctls"}), "wctls");
  EXPECT_EQ(nearest_name("min_point", {"min_length", "min_points"}), "min_points");
  EXPECT_EQ(nearest_name("", {"a"}), "");
  EXPECT_EQ(nearest_name("abc", {}), "");
}

TEST(Suggestion, ListsWhenNothingIsNear) {
  EXPECT_EQ(suggestion("iepf2", {"iepf"}), "; did you mean 'iepf'?");
  EXPECT_EQ(suggestion("zzzzzz", {"utls", "wtls"}), "; known are utls, wtls");
  EXPECT_EQ(suggestion("zzzzzz", {}), "");
}

}  // namespace
}  // namespace quoin
