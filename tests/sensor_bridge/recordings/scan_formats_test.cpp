// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Files as people have them: what they hold is found out, or said to be unclear.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/recordings/scan_files.hpp"
#include "tests/sensor_bridge/message_files/bag_bytes.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr double degree = std::numbers::pi / 180.0;

/// Range of the wall x = 3 of a room 6 m wide and 4 m deep, seen from its middle.
double room(double bearing) {
  const double c = std::abs(std::cos(bearing));
  const double s = std::abs(std::sin(bearing));
  return std::min(c > 0.0 ? 3.0 / c : 1e9, s > 0.0 ? 2.0 / s : 1e9);
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6f", value);
  return text.data();
}

class ScanFormats : public ::testing::Test {
 protected:
  tests::TemporaryFolder folder_;
  ReplayParameters parameters_;
  std::vector<std::string> notes_;

  std::vector<RecordedScan> read(const std::filesystem::path& file) {
    ScanFiles files(file, parameters_);
    std::vector<RecordedScan> scans;
    RecordedScan scan;
    while (files.next(scan)) {
      scans.push_back(scan);
      notes_.insert(notes_.end(), scan.notes.begin(), scan.notes.end());
    }
    return scans;
  }
  std::vector<RecordedScan> read_text(const char* name, const std::string& text) {
    return read(folder_.write(name, text));
  }
  std::string error(const char* name, const std::string& text) {
    try {
      (void)read_text(name, text);
    } catch (const ScanFileError& error) {
      return error.what();
    }
    return "";
  }
  /// How far the points of a scan are off the walls of the room [m].
  static double off_the_walls(const RecordedScan& scan) {
    double most = 0.0;
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      most = std::max(most, std::abs(scan.ranges[i] - room(scan.bearings[i])));
    }
    return most;
  }
};

/// A table of `revolutions` of one ray a degree; `row` writes a line of it.
template <class Row>
std::string table(const std::string& names, int revolutions, Row row) {
  std::string text = names;
  for (int i = 0; i < 360 * revolutions; ++i) text += row(i % 360, i / 360) + "\n";
  return text;
}

TEST_F(ScanFormats, CsvAsWeWriteIt) {
  const auto scans = read_text("a.csv", table("bearing,range\n", 1, [](int i, int) {
                                 return number(i * degree) + "," + number(room(i * degree));
                               }));
  ASSERT_THAT(scans, SizeIs(1));
  EXPECT_LT(off_the_walls(scans[0]), 1e-4);
  EXPECT_THAT(notes_, SizeIs(0));
}

TEST_F(ScanFormats, CsvWithUnitsInItsNames) {
  const auto scans = read_text("a.csv", table("angle_deg;distance_mm\n", 1, [](int i, int) {
                                 return number(i - 180) + ";" + number(1e3 * room(i * degree));
                               }));
  ASSERT_THAT(scans, SizeIs(1));
  EXPECT_LT(off_the_walls(scans[0]), 1e-4);
  EXPECT_THAT(notes_, SizeIs(0));
}

TEST_F(ScanFormats, CsvInDegreesAndMillimetresByGuess) {
  const auto scans = read_text("a.csv", table("", 1, [](int i, int) {
                                 return number(i) + "," + number(1e3 * room(i * degree));
                               }));
  ASSERT_THAT(scans, SizeIs(1));
  EXPECT_LT(off_the_walls(scans[0]), 1e-4);
  ASSERT_THAT(notes_, SizeIs(1));
  EXPECT_THAT(notes_[0], HasSubstr("degrees"));
  EXPECT_THAT(notes_[0], HasSubstr("millimetres"));
}

TEST_F(ScanFormats, CsvWithTheRangeFirst) {
  const auto scans = read_text("a.csv", table("", 1, [](int i, int) {
                                 return number(room(i * degree)) + "," + number(i * degree);
                               }));
  ASSERT_THAT(scans, SizeIs(1));
  EXPECT_LT(off_the_walls(scans[0]), 1e-4);
  ASSERT_THAT(notes_, SizeIs(1));
  EXPECT_THAT(notes_[0], HasSubstr("column 2 is taken for the bearing"));
}

TEST_F(ScanFormats, CsvOfQualityAngleDistance) {
  const auto scans = read_text("a.csv", table("", 1, [](int i, int) {
                                 return "15\t" + number(i) + "\t" + number(1e3 * room(i * degree));
                               }));
  ASSERT_THAT(scans, SizeIs(1));
  EXPECT_LT(off_the_walls(scans[0]), 1e-4);
  EXPECT_EQ(scans[0].qualities.at(5), 15.0F);
}

TEST_F(ScanFormats, CsvOfPoints) {
  const auto scans = read_text("a.csv", table("x,y\n", 1, [](int i, int) {
                                 const double range = room(i * degree);
                                 return number(range * std::cos(i * degree)) + "," +
                                        number(range * std::sin(i * degree));
                               }));
  ASSERT_THAT(scans, SizeIs(1));
  ASSERT_THAT(scans[0].ranges, SizeIs(360));
  EXPECT_LT(off_the_walls(scans[0]), 1e-4);
}

TEST_F(ScanFormats, CsvOfColumnsThatTheUserNames) {
  parameters_.columns = "time_ms;range_cm;angle_deg";
  const auto scans = read_text("a.csv", table("", 1, [](int i, int) {
                                 return "2500 " + number(100 * room(i * degree)) + " " + number(i);
                               }));
  ASSERT_THAT(scans, SizeIs(1));
  EXPECT_LT(off_the_walls(scans[0]), 1e-4);
  EXPECT_EQ(scans[0].stamp, 2.5);
}

TEST_F(ScanFormats, CsvOfSeveralRevolutions) {
  const auto row = [](int i, int) { return number(i * degree) + "," + number(room(i * degree)); };
  EXPECT_THAT(read_text("a.csv", table("", 3, row)), SizeIs(3));
  // Clockwise, from 180 deg on, and numbered.
  const auto clockwise = [](int i, int) {
    const int angle = (540 - i) % 360;
    return number(angle) + "," + number(1e3 * room(angle * degree));
  };
  const auto scans = read_text("b.csv", table("angle_deg,mm_range\n", 3, clockwise));
  ASSERT_THAT(scans, SizeIs(3));
  for (const RecordedScan& scan : scans) EXPECT_THAT(scan.ranges, SizeIs(360));
  const auto numbered = [](int i, int revolution) {
    return std::to_string(revolution) + "," + number(i) + "," + number(room(i * degree));
  };
  EXPECT_THAT(read_text("c.csv", table("scan,angle_deg,range_m\n", 4, numbered)), SizeIs(4));
}

TEST_F(ScanFormats, CsvOfSectors) {
  std::string text = "angle_deg,range_m\n";
  for (int i = 0; i < 3 * 271; ++i) text += number(i % 271 - 135) + ",1.5\n";
  const auto scans = read_text("a.csv", text);
  ASSERT_THAT(scans, SizeIs(3));
  for (const RecordedScan& scan : scans) EXPECT_THAT(scan.ranges, SizeIs(271));
}

TEST_F(ScanFormats, CsvWithBothEndsOfACircleIsOneRevolution) {
  std::string text;
  for (int i = 0; i <= 360; ++i) text += number(i * degree) + ",2.0\n";
  const auto scans = read_text("a.csv", text);
  ASSERT_THAT(scans, SizeIs(1));
  EXPECT_THAT(scans[0].ranges, SizeIs(361));
}

TEST_F(ScanFormats, CsvThatIsUnclearIsRefused) {
  EXPECT_THAT(error("a.csv", table("", 1,
                                   [](int i, int) {
                                     return number(3.0 * std::cos(i * degree)) + "," +
                                            number(3.0 * std::sin(i * degree));
                                   })),
              HasSubstr("'columns'"));
  EXPECT_THAT(error("b.csv", "voltage,current\n1,2\n"), HasSubstr("b.csv:1:1: "));
  EXPECT_THAT(error("c.csv", "0,1\n0.1,x\n"), HasSubstr("c.csv:2:5: 'x'"));
  EXPECT_THAT(error("d.csv", "0,1\n0.1,1,2\n"), HasSubstr("d.csv:2:1: "));
}

TEST_F(ScanFormats, AnEmptyRevolutionIsAScan) {
  folder_.write("f/a.csv", "0,1\n1,1\n");
  folder_.write("f/b.csv", "bearing,range\n");
  folder_.write("f/c.csv", "0,1\n1,1\n");
  const auto scans = read(folder_.path() / "f");
  ASSERT_THAT(scans, SizeIs(3));
  EXPECT_THAT(scans[1].ranges, SizeIs(0));
  EXPECT_THAT(read_text("a.log", "FLASER 0 0 0 0 0 0 0 1 host 1\n"), SizeIs(1));
}

TEST_F(ScanFormats, AForeignFileInAFolderIsPassedOver) {
  folder_.write("f/a.csv", "0,1\n1,1\n");
  folder_.write("f/rosout.log", "hello\nworld\n");
  folder_.write("f/z.csv", "0,1\n1,1\n");
  EXPECT_THAT(read(folder_.path() / "f"), SizeIs(2));
  ASSERT_THAT(notes_, SizeIs(1));
  EXPECT_THAT(notes_[0], HasSubstr("rosout.log"));
}

/// FLASER with ranges of the room at `first` + i `step` [rad].
std::string flaser(int count, double first, double step) {
  std::string line = "FLASER " + std::to_string(count);
  for (int i = 0; i < count; ++i) line += " " + number(room(first + i * step));
  return line + " 0 0 0 0 0 0 1.5 host 1.5\n";
}

TEST_F(ScanFormats, AnEvenNumberOfRaysHasBothEnds) {
  const double step = 255.234 * degree / 725;
  parameters_.field_of_view = 255.234 * degree;
  const auto scans = read_text("a.log", flaser(726, -127.617 * degree, step));
  EXPECT_LT(off_the_walls(scans[0]), 1e-3);
  // As the SICK LMS does not.
  parameters_.field_of_view = 0.0;
  notes_.clear();
  EXPECT_LT(off_the_walls(read_text("b.log", flaser(360, -90 * degree, 0.5 * degree))[0]), 1e-3);
  EXPECT_THAT(notes_, SizeIs(0));
}

TEST_F(ScanFormats, TheFirstRayAndTheStepCanBeDeclared) {
  parameters_.start_angle = -135 * degree;
  parameters_.angle_step = 0.3516 * degree;
  EXPECT_LT(off_the_walls(read_text("a.log", flaser(726, -135 * degree, 0.3516 * degree))[0]),
            1e-3);
}

TEST_F(ScanFormats, AFieldOfViewThatNoSensorHasIsNoted) {
  (void)read_text("a.log", flaser(1081, -135 * degree, 0.25 * degree));
  ASSERT_THAT(notes_, SizeIs(1));
  EXPECT_THAT(notes_[0], HasSubstr("field_of_view"));
}

TEST_F(ScanFormats, RobotLaserLinesSayWhereTheirRaysPoint) {
  std::string line = "ROBOTLASER1 0 -1.570796 3.141593 0.008727 81.9 0.01 0 361";
  for (int i = 0; i < 361; ++i) line += " " + number(room((i * 0.5 - 90) * degree));
  line += " 0 1 2 0.5 3 4 0.25 0 0 0 0 0 7.5 host 7.6\n";
  for (const char* name : {"a.log", "a.clf", "noname"}) {
    const auto scans = read_text(name, flaser(361, -90 * degree, 0.5 * degree) + line + line);
    ASSERT_THAT(scans, SizeIs(3)) << name;
    EXPECT_LT(off_the_walls(scans[1]), 1e-3);
    EXPECT_EQ(scans[1].stamp, 7.5);
    EXPECT_EQ(scans[1].pose->y, 2.0);
    ASSERT_THAT(scans[1].odometry, SizeIs(1));
    EXPECT_EQ(scans[1].odometry[0].pose.x, 3.0);
  }
}

TEST_F(ScanFormats, JsonOfTriples) {
  const auto triples = [](int revolutions) {
    std::string text = "[";
    for (int i = 0; i < 360 * revolutions; ++i) {
      text += (i == 0 ? "[15, " : ", [15, ") + number(i % 360) + ", " +
              number(1e3 * room(i * degree)) + "]";
    }
    return text + "]";
  };
  const auto scans = read_text("a.json", triples(2));
  ASSERT_THAT(scans, SizeIs(2));
  EXPECT_LT(off_the_walls(scans[1]), 1e-4);
  EXPECT_THAT(read_text("b.json", "[" + triples(1) + ",\n" + triples(1) + "]\n"), SizeIs(2));
  EXPECT_THAT(read_text("c.txt", triples(1) + "\n" + triples(1) + "\n"), SizeIs(2));
  EXPECT_THAT(error("d.json", "[[1, 2, 3], [1, 2"), HasSubstr("cut off"));
}

TEST_F(ScanFormats, GeometryIsDeclaredForAnyFormat) {
  parameters_.clockwise = true;
  parameters_.angle_offset = 0.5;
  parameters_.leave_out_from = -0.6;
  parameters_.leave_out_to = -0.4;
  const auto scans = read_text("a.csv", "0,1\n0.5,1\n1.0,1\n1.5,1\n");
  EXPECT_FLOAT_EQ(scans[0].bearings[1], 0.0F);
  EXPECT_FLOAT_EQ(scans[0].bearings[3], -1.0F);
  EXPECT_TRUE(std::isnan(scans[0].ranges[2]));  // at -0.5
  EXPECT_FALSE(std::isnan(scans[0].ranges[1]));
  parameters_.inverted = true;  // twice mirrored
  EXPECT_FLOAT_EQ(read_text("b.csv", "0,1\n0.5,1\n")[0].bearings[1], 1.0F);
}

TEST_F(ScanFormats, ABagHasOdometryBesideItsScans) {
  const std::string turned = tests::ros1_odometry(3);
  const std::string records = tests::bag_connection(0, "/scan", "sensor_msgs/LaserScan") +
                              tests::bag_connection(1, "/odom", "nav_msgs/Odometry") +
                              tests::bag_message(1, 1, turned) + tests::bag_message(1, 2, turned) +
                              tests::bag_message(0, 3, tests::ros1_laser_scan(3, {1.0F})) +
                              tests::bag_message(0, 4, tests::ros1_laser_scan(4, {1.0F}));
  const auto file = folder_.write("a.bag", tests::bag(records, "none", records));
  parameters_.odometry = true;
  const auto scans = read(file);
  ASSERT_THAT(scans, SizeIs(2));
  ASSERT_THAT(scans[0].odometry, SizeIs(2));
  EXPECT_THAT(scans[1].odometry, SizeIs(0));
  const RecordedOdometry& odometry = scans[0].odometry[1];
  EXPECT_EQ(odometry.epoch_stamp, 3'000'000'000);
  EXPECT_EQ(odometry.frame, "odom");
  EXPECT_EQ(odometry.child_frame, "base");
  EXPECT_EQ(odometry.pose.y, 2.0);
  EXPECT_NEAR(odometry.pose.theta, 2.0 * std::atan(0.5), 1e-12);
  EXPECT_EQ(odometry.covariance.diagonal(), Eigen::Vector3d(4.0, 9.0, 0.25));
  EXPECT_EQ(odometry.velocity, Eigen::Vector3d(0.75, 0.0, 0.125));

  const std::string cut = records + tests::bag_message(1, 5, turned.substr(0, 200));
  const auto damaged = folder_.write("b.bag", tests::bag(cut, "none", cut));
  EXPECT_THROW(read(damaged), ScanFileError);
  parameters_.odometry = false;
  EXPECT_THAT(read(damaged)[0].odometry, SizeIs(0)) << "nobody asked for it";
}

TEST_F(ScanFormats, WhatCannotBeReadIsCalledByItsName) {
  EXPECT_THAT(error("a.rawlog", "xx"), HasSubstr("MRPT"));
  EXPECT_THAT(error("a.pcd", "# .PCD v0.7"), HasSubstr("PCL"));
  EXPECT_THAT(error("a.bag", "no bag"), HasSubstr("does not begin as"));
  EXPECT_THAT(error("a.bag", "#ROSBAG V1.2\n"), HasSubstr("before 2.0"));
  EXPECT_THAT(error("a.xyz", "hello\n"), HasSubstr("CARMEN logs, CSV"));
}

}  // namespace
}  // namespace quoin::sensor_bridge
