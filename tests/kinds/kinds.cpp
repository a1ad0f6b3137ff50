// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/kinds/kinds.hpp"

#include "sensor_bridge/replay/kind.hpp"
#include "sensor_bridge/rplidar/emulator_service/kind.hpp"
#include "sensor_bridge/rplidar/service/kind.hpp"
#include "sensor_bridge/simulated/kind.hpp"
#include "services/circle_fitting/kind.hpp"
#include "services/corner_estimation/kind.hpp"
#include "services/line_fitting/kind.hpp"
#include "services/segmentation/kind.hpp"
#include "tests/kinds/faulty/kind.hpp"
#include "tests/kinds/join/kind.hpp"
#include "tests/kinds/latest/kind.hpp"
#include "tests/kinds/observer/kind.hpp"
#include "tests/kinds/odometer/kind.hpp"
#include "tests/kinds/own_rate/kind.hpp"
#include "tests/kinds/sink/kind.hpp"

namespace quoin::deploy {

// Some of the shipped kinds, and those that the tests bring.
const KindList& kinds() {
  static const KindList all{{&sensor_bridge::simulated_kind(), &sensor_bridge::replay_kind(),
                             &sensor_bridge::rplidar::rplidar_kind(),
                             &sensor_bridge::rplidar::rplidar_emulator_kind(),
                             &tests::odometer_kind(), &segmentation_kind(), &line_fitting_kind(),
                             &corner_estimation_kind(), &circle_fitting_kind(), &tests::join_kind(),
                             &tests::latest_kind(), &tests::own_rate_kind(), &tests::sink_kind(),
                             &tests::observer_kind(), &tests::faulty_kind(), &external_kind()}};
  return all;
}

const char* process_program() { return "quoin-test-process"; }

}  // namespace quoin::deploy
