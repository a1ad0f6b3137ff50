// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/connection.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/driver/driver_run.hpp"
#include "tests/sensor_bridge/rplidar/driver/scripted_transport.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(BaudRates, BeginWithTheGivenOneAndHoldTheUsualOnes) {
  const Endpoint serial = parse_endpoint("/dev/ttyUSB0");
  EXPECT_THAT(baud_rates_for(serial, 0), ElementsAre(256000, 115200, 460800, 1000000));
  EXPECT_THAT(baud_rates_for(serial, 460800), ElementsAre(460800, 256000, 115200, 1000000));
  EXPECT_THAT(baud_rates_for(serial, 9600), ElementsAre(9600, 256000, 115200, 460800, 1000000));
  EXPECT_THAT(baud_rates_for(parse_endpoint("udp://lidar"), 115200), ElementsAre(0));
}

class FindDevice : public ::testing::Test {
 protected:
  FindDevice() {
    time_outs_.probing = 15ms;
    time_outs_.quiet = 5ms;
    time_outs_.draining = 15ms;
  }

  Connection find() {
    const Opener open = [this](unsigned baud_rate) -> std::unique_ptr<Transport> {
      tried_.push_back(baud_rate);
      if (refusal_.contains(baud_rate)) throw refusal_.at(baud_rate);
      return std::make_unique<ScriptedTransport>(scripts_[baud_rate]);
    };
    const std::vector<unsigned> rates = baud_rates_for(parse_endpoint("/dev/lidar"), 0);
    return find_device(open, "/dev/lidar", rates, uninterrupted(), time_outs_);
  }

  Diagnosis failure() {
    try {
      (void)find();
    } catch (const DeviceError& error) {
      return error.diagnosis();
    }
    return {};
  }

  void answer_at(unsigned baud_rate) {
    scripts_[baud_rate].answer = [](const Request& request) {
      return request.command() == Command::info ? info_answer(s1_info()) : Bytes();
    };
  }

  TimeOuts time_outs_ = short_time_outs();
  std::map<unsigned, Script> scripts_;
  std::map<unsigned, TransportError> refusal_;
  std::vector<unsigned> tried_;
};

TEST_F(FindDevice, TriesTheBaudRatesUntilSomebodyAnswers) {
  answer_at(460800);
  {
    const Connection connection = find();
    EXPECT_EQ(connection.baud_rate, 460800u);
    EXPECT_EQ(connection.info, s1_info());
    EXPECT_FALSE(connection.was_sending);
  }
  EXPECT_THAT(tried_, ElementsAre(256000, 115200, 460800));
  // Nobody is told to stop a motor where nobody is.
  EXPECT_THAT(scripts_[115200].commands, ElementsAre(Command::stop, Command::info, Command::info));
  EXPECT_THAT(scripts_[460800].commands,
              ElementsAre(Command::stop, Command::info, Command::stop, Command::motor_speed));
}

TEST_F(FindDevice, AsksTwice) {
  scripts_[256000].answer = [asked = 0](const Request& request) mutable {
    return request.command() == Command::info && ++asked == 2 ? info_answer(s1_info()) : Bytes();
  };
  EXPECT_EQ(find().baud_rate, 256000u);
}

TEST_F(FindDevice, StopsTheMotorOfADeviceThatWasScanningButDoesNotAnswer) {
  Script& script = scripts_[256000];
  script.answer = [](const Request& request) {
    return request.command() == Command::stop ? Bytes(84, 0x55) : Bytes();
  };
  EXPECT_EQ(failure().finding, Finding::no_answer);
  // Nothing is known of it: it is told by each request that there is.
  EXPECT_EQ(script.commands.at(script.commands.size() - 2), Command::motor_speed);
  EXPECT_EQ(script.commands.back(), Command::motor_pwm);
  EXPECT_EQ(script.motor_held, std::nullopt);
}

TEST_F(FindDevice, TellsTheMostThatItHasLearned) {
  EXPECT_EQ(failure().finding, Finding::no_bytes);
  const auto echo = [](const Request& request) {
    return Bytes(request.bytes().begin(), request.bytes().end());
  };
  scripts_[115200].answer = echo;
  EXPECT_EQ(failure().finding, Finding::echo);
  scripts_[256000].answer = [](const Request&) { return Bytes{'o', 'k'}; };
  const Diagnosis diagnosis = failure();
  EXPECT_EQ(diagnosis.finding, Finding::garbage);
  EXPECT_THAT(diagnosis.text, HasSubstr("(at 256000, 115200, 460800, 1000000 baud)"));
}

TEST_F(FindDevice, GoesOnWhereAnAdapterCannotDoABaudRate) {
  refusal_.emplace(256000, TransportError(TransportError::Kind::unsupported_baud_rate, "no"));
  answer_at(115200);
  EXPECT_EQ(find().baud_rate, 115200u);
}

TEST_F(FindDevice, EndsWhereThePortIsNotThere) {
  refusal_.emplace(256000, TransportError(TransportError::Kind::no_such_port, "no"));
  EXPECT_THROW((void)find(), TransportError);
  EXPECT_THAT(tried_, ElementsAre(256000));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
