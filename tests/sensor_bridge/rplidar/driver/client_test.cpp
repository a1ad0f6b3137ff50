// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/client.hpp"

#include <chrono>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/driver/driver_run.hpp"
#include "tests/sensor_bridge/rplidar/driver/scripted_transport.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::SizeIs;

ScanMode mode(std::uint16_t id, SampleFormat format) {
  ScanMode mode;
  mode.id = id;
  mode.format = format;
  return mode;
}

class ClientTest : public ::testing::Test {
 protected:
  ClientTest() {
    time_outs_.answer = 30ms;
    time_outs_.quiet = 5ms;
    time_outs_.draining = 20ms;
    client_.emplace(transport_, interruption_, time_outs_, "/dev/lidar");
  }

  void answer_with(const Bytes& bytes) {
    script_.answer = [bytes](const Request&) { return bytes; };
  }

  Script script_;
  ScriptedTransport transport_{script_};
  Interruption interruption_ = uninterrupted();
  TimeOuts time_outs_ = short_time_outs();
  std::optional<Client> client_;
};

TEST_F(ClientTest, ReadsAnAnswerBehindMeasurements) {
  const Bytes samples{0x3E, 0x01, 0xA5, 0x5A, 0x05, 0x02, 0xA5, 0x5A, 0x14};
  answer_with(samples + info_answer(s1_info()));
  EXPECT_EQ(client_->info(30ms), s1_info());
  EXPECT_THAT(script_.commands, ElementsAre(Command::info));
}

TEST_F(ClientTest, PassesAnswersToOtherQuestionsOver) {
  using Key = ConfigurationKey;
  answer_with(health_answer(Health::good) + configuration_answer(Key::mode_count, {2, 0}) +
              configuration_answer(Key::typical_mode, {1, 0}));
  EXPECT_THAT(client_->configuration(Key::typical_mode), ElementsAre(1, 0));
}

TEST_F(ClientTest, DoesNotTakeTheBeginOfAScanForAnAnswer) {
  const auto head = encode(Descriptor{84, true, 0x85});
  answer_with(Bytes(head.begin(), head.end()) + Bytes(84, 0x55) + health_answer(Health::warning));
  EXPECT_EQ(client_->health().status, Health::warning);
}

TEST_F(ClientTest, TellsThatNothingArrives) {
  const Diagnosis diagnosis = thrown_diagnosis([&] { (void)client_->health(); });
  EXPECT_EQ(diagnosis.finding, Finding::no_bytes);
  EXPECT_THAT(to_text(diagnosis), HasSubstr("/dev/lidar: no answer"));
  EXPECT_THAT(to_text(diagnosis), HasSubstr("power"));
}

TEST_F(ClientTest, RecognizesItsOwnWords) {
  script_.answer = [](const Request& request) {
    return Bytes(request.bytes().begin(), request.bytes().end());
  };
  EXPECT_EQ(thrown_diagnosis([&] { (void)client_->info(30ms); }).finding, Finding::echo);
}

TEST_F(ClientTest, TellsWhatItHearsInsteadOfAnAnswer) {
  answer_with({'$', 'G', 'P'});
  const Diagnosis diagnosis = thrown_diagnosis([&] { (void)client_->info(30ms); });
  EXPECT_EQ(diagnosis.finding, Finding::garbage);
  EXPECT_THAT(diagnosis.text, HasSubstr("24 47 50"));
}

TEST_F(ClientTest, GivesUpOnADeviceThatIsNeverQuiet) {
  script_.stream = [] { return Bytes(84, 0x55); };
  EXPECT_FALSE(client_->stop());
  EXPECT_EQ(thrown_diagnosis([&] { (void)client_->info(30ms); }).finding, Finding::garbage);
  EXPECT_EQ(thrown_diagnosis([&] { (void)client_->start_scan({}); }).finding,
            Finding::scan_not_started);
}

TEST_F(ClientTest, TellsThatAnAnswerIsOfAWrongLength) {
  Bytes bytes = info_answer(s1_info());
  bytes[2] = 23;
  answer_with(bytes);
  const Diagnosis diagnosis = thrown_diagnosis([&] { (void)client_->info(30ms); });
  EXPECT_EQ(diagnosis.finding, Finding::wrong_length);
  EXPECT_THAT(diagnosis.text, HasSubstr("23 bytes"));

  bytes = info_answer(s1_info());
  bytes.pop_back();
  answer_with(bytes);
  EXPECT_EQ(thrown_diagnosis([&] { (void)client_->info(30ms); }).finding, Finding::wrong_length);
}

TEST_F(ClientTest, TakesAnUnknownHealthForAWarning) {
  answer_with(answer(AnswerType::health, Bytes{4, 7, 0}));
  EXPECT_EQ(client_->health(), (DeviceHealth{Health::warning, 7, 4}));
}

TEST_F(ClientTest, NamesTheQuestionThatGotNoAnswer) {
  EXPECT_THAT(thrown_diagnosis([&] { (void)client_->health(); }).text,
              HasSubstr("no answer to health, not a byte arrives"));
  answer_with(health_answer(Health::good));
  (void)client_->health();
  answer_with({});
  const Diagnosis diagnosis = thrown_diagnosis([&] { (void)client_->sample_times(); });
  EXPECT_EQ(diagnosis.finding, Finding::no_answer);
  EXPECT_THAT(diagnosis.text, HasSubstr("no answer to sample_rate in time, though"));
}

TEST_F(ClientTest, AsksForTheBoardThatDrivesTheMotor) {
  answer_with(answer(AnswerType::accessory_board, Bytes{1, 0, 0, 0}));
  EXPECT_TRUE(client_->has_motor_pwm());
  EXPECT_THAT(script_.requests.back().bytes(), ElementsAre(0xA5, 0xFF, 0x04, 0, 0, 0, 0, 0x5E));
  client_->set_motor_pwm(660);
  EXPECT_THAT(script_.requests.back().bytes(), ElementsAre(0xA5, 0xF0, 0x02, 0x94, 0x02, 0xC1));
}

TEST_F(ClientTest, StopsAndReadsOnUntilTheDeviceIsQuiet) {
  int chunks = 3;
  script_.stream = [&chunks] { return chunks-- > 0 ? Bytes(84, 0x55) : Bytes(); };
  EXPECT_TRUE(client_->stop());
  EXPECT_EQ(client_->received_bytes(), 3u * 84);
  EXPECT_THAT(script_.commands, ElementsAre(Command::stop));
}

TEST_F(ClientTest, StartsScansByTheirFormat) {
  const auto begin = [](SampleFormat format, std::uint32_t length) {
    const auto head = encode(Descriptor{length, true, static_cast<std::uint8_t>(format)});
    return Bytes(head.begin(), head.end());
  };
  answer_with(begin(SampleFormat::standard, 5) + Bytes{1, 2});
  EXPECT_EQ(client_->start_scan(mode(0, SampleFormat::standard)), (Descriptor{5, true, 0x81}));
  // What came along is the begin of the measurements.
  EXPECT_THAT(client_->read(std::chrono::steady_clock::now()), ElementsAre(1, 2));

  answer_with(begin(SampleFormat::dense, 84));
  EXPECT_EQ(client_->start_scan(mode(1, SampleFormat::dense)), (Descriptor{84, true, 0x85}));
  EXPECT_THAT(script_.commands, ElementsAre(Command::scan, Command::express_scan));
  EXPECT_EQ(script_.requests[1].payload()[0], 1);
}

TEST_F(ClientTest, IsInterruptedWhileItWaits) {
  int questions = 0;
  interruption_ = [&questions](Deadline) { return ++questions < 3; };
  EXPECT_THROW((void)client_->info(10s), Stopped);
}

TEST_F(ClientTest, DoesNotTurnAClosedTransportIntoSilence) {
  script_.failure = TransportError(TransportError::Kind::closed, "/dev/lidar: gone");
  EXPECT_THROW((void)client_->info(10s), TransportError);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
