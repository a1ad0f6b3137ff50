// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/fault.hpp"

#include <functional>

#include <gmock/gmock.h>

namespace quoin::sensor_bridge::rplidar {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const FaultError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Faults, AreReadFromText) {
  EXPECT_THAT(parse_faults(""), IsEmpty());
  EXPECT_THAT(parse_faults("  "), IsEmpty());
  EXPECT_THAT(
      parse_faults("unplug@20s+5s, wrong_checksums=0.3@10s+2s,silence@500ms+1min , garbage"),
      ElementsAre(Fault{FaultKind::unplug, 0.0, 20.0, 5.0},
                  Fault{FaultKind::wrong_checksums, 0.3, 10.0, 2.0},
                  Fault{FaultKind::silence, 0.0, 0.5, 60.0},
                  Fault{FaultKind::garbage, 0.0, 0.0, std::nullopt}));
  EXPECT_THAT(parse_faults("health_error, slow_spin_up, health_error=3@1s, speed=12.5+1e+1s"),
              ElementsAre(Fault{FaultKind::health_error, 1.0, 0.0, std::nullopt},
                          Fault{FaultKind::slow_spin_up, 10.0, 0.0, std::nullopt},
                          Fault{FaultKind::health_error, 3.0, 1.0, std::nullopt},
                          Fault{FaultKind::speed, 12.5, 0.0, 10.0}));
}

TEST(Faults, AreReadAsTyped) {
  EXPECT_EQ(parse_typed_fault("unplug 5s"), (Fault{FaultKind::unplug, 0.0, 0.0, 5.0}));
  EXPECT_EQ(parse_typed_fault(" unplug\t5s\r"), (Fault{FaultKind::unplug, 0.0, 0.0, 5.0}));
  EXPECT_EQ(parse_typed_fault("unplug"), (Fault{FaultKind::unplug, 0.0, 0.0, std::nullopt}));
  EXPECT_EQ(parse_typed_fault("dropped_bytes=0.01 200ms"),
            (Fault{FaultKind::dropped_bytes, 0.01, 0.0, 0.2}));
  EXPECT_EQ(parse_typed_fault("speed=15@1s+2s"), (Fault{FaultKind::speed, 15.0, 1.0, 2.0}));
}

TEST(Faults, OfEachKindSurviveTheirText) {
  for (const std::string& name : fault_names()) {
    const bool has_value = message_of([&] { (void)parse_faults(name + "=1"); }) == "no error";
    const Fault fault = parse_faults(name + (has_value ? "=1" : "") + "@1.25s+3s").at(0);
    EXPECT_EQ(fault.begin, 1.25);
    EXPECT_EQ(fault.duration, 3.0);
    EXPECT_THAT(fault_text(fault), ::testing::StartsWith(name));
    EXPECT_THAT(parse_faults(fault_text(fault)), ElementsAre(fault));
  }
}

TEST(Faults, ThatAreNoneSayWhatIsWrong) {
  const auto message = [](std::string_view text) {
    return message_of([&] { (void)parse_faults(text); });
  };
  EXPECT_THAT(message("unplugg"), HasSubstr("did you mean 'unplug'?"));
  EXPECT_THAT(message("mutiny"), HasSubstr("known are silence, garbage"));
  EXPECT_THAT(message("unplug@5+1s"), HasSubstr("'5' is no time; write it like 5s, 200ms or 2min"));
  EXPECT_THAT(message("unplug@s"), HasSubstr("'s' is no time"));
  EXPECT_THAT(message("unplug@-1s"), HasSubstr("'-1s' is not between 0 s and 1000000 s"));
  EXPECT_THAT(message("unplug@nans"), HasSubstr("is not between"));
  EXPECT_THAT(message("unplug+1e9s"), HasSubstr("is not between"));
  EXPECT_THAT(message("unplug=3"), HasSubstr("takes no value; leave out '=3'"));
  EXPECT_THAT(message("wrong_checksums"),
              HasSubstr("needs a value (share of the frames, 0 to 1): wrong_checksums=..."));
  EXPECT_THAT(message("wrong_checksums=1.5"), HasSubstr("'1.5' is no value of wrong_checksums"));
  EXPECT_THAT(message("wrong_checksums=nan"), HasSubstr("'nan' is no value of wrong_checksums"));
  EXPECT_THAT(message("health_error=1.5"), HasSubstr("no whole number of resets"));
  EXPECT_THAT(message("silence,,garbage"), HasSubstr("nothing between two commas"));
  EXPECT_THAT(message("silence,"), HasSubstr("nothing between two commas"));
  EXPECT_THAT(message_of([] { (void)parse_typed_fault("unplug+1s 5s"); }),
              HasSubstr("two durations"));
  EXPECT_THAT(message_of([] { (void)parse_typed_fault("unplug 5 s"); }), HasSubstr("is no time"));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
