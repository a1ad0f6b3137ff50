// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/kinds/kinds.hpp"

#include "sensor_bridge/replay/kind.hpp"
#include "sensor_bridge/ros2_odometry/kind.hpp"
#include "sensor_bridge/ros2_scan/kind.hpp"
#include "sensor_bridge/rplidar/emulator_service/kind.hpp"
#include "sensor_bridge/rplidar/service/kind.hpp"
#include "sensor_bridge/simulated/kind.hpp"
#include "services/circle_fitting/kind.hpp"
#include "services/corner_estimation/kind.hpp"
#include "services/deskewing/kind.hpp"
#include "services/line_fitting/kind.hpp"
#include "services/localization/kind.hpp"
#include "services/mapping/kind.hpp"
#include "services/recorder/kind.hpp"
#include "services/ros2_output/kind.hpp"
#include "services/segmentation/kind.hpp"
#include "services/viewer/kind.hpp"

namespace quoin::deploy {

// A new kind is one line here.
const KindList& kinds() {
  static const KindList all{
      {&sensor_bridge::simulated_kind(), &sensor_bridge::replay_kind(),
       &sensor_bridge::rplidar::rplidar_kind(), &sensor_bridge::rplidar::rplidar_emulator_kind(),
       &sensor_bridge::ros2_scan_kind(), &sensor_bridge::ros2_odometry_kind(), &deskewing_kind(),
       &segmentation_kind(), &line_fitting_kind(), &corner_estimation_kind(),
       &circle_fitting_kind(), &mapping_kind(), &localization_kind(), &viewer_kind(),
       &recorder_kind(), &ros2_output_kind(), &external_kind()}};
  return all;
}

const char* process_program() { return "quoin-process"; }

}  // namespace quoin::deploy
