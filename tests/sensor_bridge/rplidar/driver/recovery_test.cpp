// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/driver/driver_run.hpp"
#include "tests/sensor_bridge/rplidar/driver/emulator_run.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using quoin::tests::TemporaryFolder;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A driver with short time-outs that measures with an emulated S1 behind a link that stays.
class Recovery : public ::testing::Test {
 protected:
  explicit Recovery(const std::string& connection = "pty") {
    device_ = quick_emulator();
    device_.connection = connection;
    device_.link = connection == "pty" ? (folder_.path() / "lidar").native() : "";
  }

  void plug() {
    emulator_.emplace(device_);
    settings_.endpoint = emulator_->endpoint();
    settings_.time_outs = short_time_outs();
  }

  void start() {
    plug();
    driver_.emplace(settings_);
    ASSERT_TRUE(driver_->wait_for_revolutions(2));
    ASSERT_THAT(driver_->record().problems, IsEmpty());
  }

  /// Ends a test: measuring again, told why, and at rest once stopped.
  void expect_recovered_from(Finding finding) {
    ASSERT_TRUE(driver_->wait_for_problem(finding));
    emulator_->clear_faults();
    ASSERT_TRUE(driver_->wait_for_revolutions(3));
    driver_->stop();
    EXPECT_GE(driver_->record().counts.recoveries_from(finding), 1u);
    EXPECT_EQ(driver_->record().states.back(), DriverState::stopped);
    EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
    EXPECT_EQ(emulator_->status().state, DeviceState::idle);
  }

  TemporaryFolder folder_;
  EmulatorSettings device_;
  DriverSettings settings_;
  std::optional<EmulatorRun> emulator_;
  std::optional<DriverRun> driver_;
};

class RecoveryOver : public Recovery, public ::testing::WithParamInterface<const char*> {
 protected:
  RecoveryOver() : Recovery(GetParam()) {}
};

TEST_P(RecoveryOver, ALapseOfSilence) {
  start();
  emulator_->apply("silence 0.3s");
  expect_recovered_from(Finding::silence);
  EXPECT_EQ(driver_->record().counts.connections, 1u);  // a new scan was enough
}

TEST_P(RecoveryOver, ALongSilence) {
  start();
  emulator_->apply("silence");
  ASSERT_TRUE(driver_->wait_for_problem(Finding::no_bytes));
  expect_recovered_from(Finding::silence);
  EXPECT_EQ(driver_->record().counts.connections, 2u);
}

INSTANTIATE_TEST_SUITE_P(Connection, RecoveryOver, ::testing::Values("pty", "tcp", "udp"),
                         [](const auto& test) { return std::string(test.param); });

TEST_F(Recovery, ADeviceThatIsPluggedInAgain) {
  start();
  emulator_->apply("unplug");
  ASSERT_TRUE(driver_->wait_for_problem(Finding::no_such_port));
  EXPECT_FALSE(std::filesystem::exists(settings_.endpoint.path));
  expect_recovered_from(Finding::unplugged);
  EXPECT_EQ(driver_->record().counts.connections, 2u);
}

TEST_F(Recovery, ADeviceThatIsUnpluggedTwice) {
  start();
  emulator_->apply("unplug 0.1s");
  ASSERT_TRUE(driver_->wait_for_problem(Finding::unplugged));
  ASSERT_TRUE(driver_->wait_for_revolutions(2));
  driver_->clear_problems();
  emulator_->apply("unplug 0.1s");
  expect_recovered_from(Finding::unplugged);
  EXPECT_EQ(driver_->record().counts.recoveries_from(Finding::unplugged), 2u);
}

class RecoveryOverTcp : public Recovery {
 protected:
  RecoveryOverTcp() : Recovery("tcp") {}
};

TEST_F(RecoveryOverTcp, ADeviceThatIsPluggedInAgain) {
  start();
  emulator_->apply("unplug");
  ASSERT_TRUE(driver_->wait_for_problem(Finding::refused));
  expect_recovered_from(Finding::unplugged);
}

class RecoveryOverUdp : public Recovery {
 protected:
  RecoveryOverUdp() : Recovery("udp") {}
};

TEST_F(RecoveryOverUdp, ADeviceThatIsPluggedInAgain) {
  start();
  emulator_->apply("unplug");
  ASSERT_TRUE(driver_->wait_for_problem(Finding::refused));
  expect_recovered_from(Finding::silence);
}

TEST_F(Recovery, DamagedFrames) {
  start();
  emulator_->apply("wrong_checksums=0.8");
  expect_recovered_from(Finding::damaged_frames);
  EXPECT_GE(driver_->record().counts.checksum_errors, 1u);
}

TEST_F(Recovery, AFewDamagedFramesAreNoReason) {
  start();
  emulator_->apply("wrong_checksums=0.1");
  ASSERT_TRUE(driver_->wait_for(
      [](const DriverRecord& record) { return record.counts.lost_samples >= 80; }));
  emulator_->clear_faults();
  driver_->stop();
  EXPECT_EQ(driver_->record().counts.connections, 1u);
  EXPECT_GE(driver_->record().counts.checksum_errors, 1u);
}

TEST_F(Recovery, Garbage) {
  start();
  emulator_->apply("garbage");
  ASSERT_TRUE(driver_->wait_for([](const DriverRecord& record) {
    return record.has_problem(Finding::no_frames) || record.has_problem(Finding::damaged_frames);
  }));
  emulator_->clear_faults();
  ASSERT_TRUE(driver_->wait_for_revolutions(3));
  driver_->stop();
  EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
}

TEST_F(Recovery, DroppedBytesAreLostSamples) {
  start();
  emulator_->apply("dropped_bytes=0.002");
  ASSERT_TRUE(driver_->wait_for(
      [](const DriverRecord& record) { return record.counts.lost_samples >= 80; }));
  emulator_->clear_faults();
  ASSERT_TRUE(driver_->wait_for_revolutions(2));
  driver_->stop();
  EXPECT_EQ(driver_->record().counts.connections, 1u);
  EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
}

TEST_F(Recovery, ASlowSpinUpIsWaitedFor) {
  device_.faults = "slow_spin_up=0.6";
  start();
  EXPECT_EQ(driver_->record().counts.connections, 1u);
  driver_->stop();
  emulator_->clear_faults();
  EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
}

TEST_F(Recovery, AMotorThatTurnsTooSlowlyIsToldOf) {
  start();
  emulator_->apply("speed=8");
  ASSERT_TRUE(driver_->wait_for_problem(Finding::wrong_rotation));
  EXPECT_THAT(driver_->record().problems.back().text,
              HasSubstr("turns at 480 rev/min, not at 600"));
  driver_->stop();
  EXPECT_EQ(driver_->record().counts.connections, 1u);
}

TEST_F(Recovery, AProtectionStopThatAResetEnds) {
  device_.faults = "health_error=2";
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_revolutions(1));
  expect_recovered_from(Finding::protection_stop);
  EXPECT_EQ(driver_->record().counts.resets, 2u);
  EXPECT_EQ(driver_->record().facts->health.status, Health::good);
}

TEST_F(Recovery, AProtectionStopWhileItMeasures) {
  start();
  emulator_->apply("health_error=1");
  ASSERT_TRUE(driver_->wait_for_problem(Finding::protection_stop));
  ASSERT_TRUE(driver_->wait_for_revolutions(3));
  driver_->stop();
  EXPECT_EQ(driver_->record().counts.resets, 1u);
  EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
}

TEST_F(Recovery, IsNotTriedByResetForever) {
  device_.faults = "health_error=1000";
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for([](const DriverRecord& record) {
    return record.counts.resets == 3 && record.states.back() == DriverState::waiting;
  }));
  const auto before = driver_->record().states.size();
  ASSERT_TRUE(driver_->wait_for(
      [&](const DriverRecord& record) { return record.states.size() > before + 4; }));
  EXPECT_EQ(driver_->record().counts.resets, 3u);
  driver_->stop();
  EXPECT_EQ(driver_->record().problems.size(), 1u);  // told once
  EXPECT_THAT(to_text(driver_->record().problems[0]), HasSubstr("turn freely"));
}

TEST_F(Recovery, TheOtherBaudRateIsFound) {
  device_.baud_rate = 460800;
  start();
  EXPECT_EQ(driver_->record().facts->baud_rate, 460800u);
  driver_->stop();
  EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
}

TEST_F(Recovery, AWrongBaudRateIsToldOf) {
  device_.baud_rate = 115200;
  settings_.baud_rate = 256000;
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(
      driver_->wait_for([](const DriverRecord& record) { return !record.problems.empty(); }));
  EXPECT_EQ(driver_->record().problems[0].finding, Finding::other_baud_rate);
  EXPECT_THAT(driver_->record().problems[0].text,
              HasSubstr("answers at 115200 baud, not at the 256000 that are set"));
  driver_->stop();
  EXPECT_EQ(driver_->record().counts.connections, 0u);
}

TEST_F(Recovery, ASamplePeriodThatIsNotDeclaredIsMeasured) {
  device_.faults = "zero_sample_time";
  settings_.scan_frequency = 15.0;
  start();
  driver_->stop();
  EXPECT_NEAR(driver_->record().mode->sample_period, 108e-6, 3e-6);
  EXPECT_NEAR(static_cast<double>(driver_->record().last_revolution.angle_q16.size()), 617, 3);
}

TEST_F(Recovery, ASpeedThatNoDeviceHasIsNotPublished) {
  device_.faults = "speed=25";
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_problem(Finding::impossible_rotation));
  EXPECT_THAT(driver_->record().problems.back().text, HasSubstr("Hz, which no RPLIDAR does"));
  EXPECT_EQ(driver_->record().counts.revolutions, 0u);
  emulator_->clear_faults();
  ASSERT_TRUE(driver_->wait_for_revolutions(2));
}

TEST_F(Recovery, MeasurementsOfTwoDevicesAreNotPublished) {
  device_.faults = "second_device";
  device_.baud_rate = 1000000;
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for([](const DriverRecord& record) {
    return record.has_problem(Finding::mixed_frames) ||
           record.has_problem(Finding::impossible_rotation);
  }));
  EXPECT_EQ(driver_->record().counts.revolutions, 0u);
}

TEST_F(Recovery, TheFormatThatArrivesIsReadWhateverWasAnnounced) {
  device_.faults = "wrong_format";
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_problem(Finding::other_format));
  ASSERT_TRUE(driver_->wait_for_revolutions(3));
  driver_->stop();
  EXPECT_EQ(driver_->record().mode->format, SampleFormat::dense);
  EXPECT_NEAR(static_cast<double>(driver_->record().last_revolution.angle_q16.size()), 926, 2);
}

TEST_F(Recovery, LongerAnswersThanKnownAreRead) {
  device_.faults = "long_answers";
  start();
  EXPECT_EQ(model_text(driver_->record().facts->info), "S1M1");
}

/// Over TCP there is no baud rate to be found.
TEST_F(RecoveryOverTcp, ADeviceThatAnswersAfterSixTenthsOfASecondIsWaitedFor) {
  device_.faults = "slow_answers=0.6+2s";
  plug();
  settings_.time_outs = {};  // as they are where nobody sets them
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_revolutions(2));
  EXPECT_THAT(driver_->record().problems, IsEmpty());
  EXPECT_EQ(model_text(driver_->record().facts->info), "S1M1");
}

TEST_F(Recovery, AHealthWarningIsToldOfOnce) {
  device_.faults = "health_warning=16";
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_revolutions(2));
  ASSERT_EQ(driver_->record().problems.size(), 1u);
  EXPECT_THAT(driver_->record().problems[0].text, HasSubstr("status 1, error code 16"));
}

TEST_F(Recovery, AnswersOfAWrongLengthAreToldOf) {
  device_.faults = "wrong_length+0.7s";
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_problem(Finding::wrong_length));
  ASSERT_TRUE(driver_->wait_for_revolutions(1));
}

TEST_F(Recovery, ALineThatIsTooSlowIsToldOf) {
  device_.baud_rate = 115200;
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_problem(Finding::line_too_slow));
  ASSERT_TRUE(driver_->wait_for(
      [](const DriverRecord& record) { return record.counts.lost_samples > 2000; }));
  driver_->stop();
  EXPECT_FALSE(driver_->record().has_problem(Finding::wrong_rotation));
}

TEST_F(Recovery, TheMotorRestsWhileNobodyWantsTheRevolutions) {
  device_.model = "A2";
  settings_.idle_stop = std::chrono::milliseconds(50);
  start();
  driver_->set_wanted(false);
  ASSERT_TRUE(driver_->wait_for(
      [](const DriverRecord& record) { return record.states.back() == DriverState::standby; }));
  EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
  driver_->set_wanted(true);
  ASSERT_TRUE(driver_->wait_for_revolutions(3));
  driver_->stop();
  EXPECT_EQ(driver_->record().counts.connections, 1u);
  EXPECT_THAT(driver_->record().problems, IsEmpty());
}

TEST_F(Recovery, ADeviceThatIsUnpluggedWhileItRestsIsFoundAgain) {
  settings_.idle_stop = std::chrono::milliseconds(50);
  start();
  driver_->set_wanted(false);
  ASSERT_TRUE(driver_->wait_for(
      [](const DriverRecord& record) { return record.states.back() == DriverState::standby; }));
  emulator_->apply("unplug 0.1s");
  ASSERT_TRUE(driver_->wait_for_problem(Finding::unplugged));
  driver_->set_wanted(true);
  ASSERT_TRUE(driver_->wait_for_revolutions(2));
}

class EachModel : public Recovery, public ::testing::WithParamInterface<const char*> {};

// An A2 or A3 sends nothing before its motor is told to turn.
TEST_P(EachModel, TurnsMeasuresAndRests) {
  device_.model = GetParam();
  start();
  EXPECT_THAT(model_text(driver_->record().facts->info), HasSubstr(GetParam()));
  driver_->stop();
  EXPECT_EQ(driver_->record().counts.lost_samples, 0u);
  EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Model, EachModel,
                         ::testing::Values("A1", "A2", "A3", "C1", "S1", "S2", "S3"),
                         [](const auto& test) { return std::string(test.param); });

TEST_F(Recovery, AWishThatAC1CannotFulfilIsAWarning) {
  device_.model = "C1";
  settings_.scan_frequency = 12.0;
  plug();
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_revolutions(1));
  EXPECT_THAT(driver_->record().problems.at(0).text, HasSubstr("the speed of C1M1 cannot be set"));
}

/// What the driver ended with by itself.
Diagnosis end_of(DriverRun& driver) {
  EXPECT_FALSE(driver.wait_for_revolutions(1));
  try {
    if (driver.error()) std::rethrow_exception(driver.error());
  } catch (const SettingsError& error) {
    return error.diagnosis();
  }
  return {};
}

TEST_F(Recovery, AnUnknownFormatEndsTheRun) {
  device_.faults = "unknown_format";
  plug();
  driver_.emplace(settings_);
  EXPECT_THAT(to_text(end_of(*driver_)),
              HasSubstr("no scan mode that is typical and can be read; choose one of: none"));
}

TEST_F(Recovery, AnUnknownScanModeEndsTheRun) {
  settings_.scan_mode = "denseboots";
  plug();
  driver_.emplace(settings_);
  const Diagnosis diagnosis = end_of(*driver_);
  EXPECT_EQ(diagnosis.finding, Finding::unknown_scan_mode);
  EXPECT_THAT(to_text(diagnosis),
              HasSubstr("S1M1 has no scan mode 'denseboots'; choose one of: Standard, DenseBoost"));
  EXPECT_EQ(emulator_->speed_at_rest(), 0.0);
}

TEST_F(Recovery, ASpeedOutOfRangeEndsTheRun) {
  settings_.scan_frequency = 20.0;
  plug();
  driver_.emplace(settings_);
  EXPECT_THAT(to_text(end_of(*driver_)),
              HasSubstr("20 Hz: out of the device's range; choose within 8..15"));
}

TEST_F(Recovery, StopsWhileNothingIsThere) {
  settings_.endpoint = parse_endpoint((folder_.path() / "lidar").native());
  driver_.emplace(settings_);
  ASSERT_TRUE(driver_->wait_for_problem(Finding::no_such_port));
  driver_->stop();
  EXPECT_THAT(driver_->record().states, Contains(DriverState::stopped));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
