// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/kinds.hpp"

#include <stdexcept>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "sensor_bridge/replay/parameters.hpp"
#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"
#include "sensor_bridge/rplidar/service/parameters.hpp"
#include "sensor_bridge/simulated/parameters.hpp"

namespace quoin {

std::string_view message_name(MessageType type) {
  switch (type) {
    case MessageType::none:
      return "none";
    case MessageType::scan:
      return "scan";
    case MessageType::segments:
      return "segments";
    case MessageType::lines:
      return "lines";
    case MessageType::corners:
      return "corners";
  }
  return "unknown";
}

const std::vector<KindInfo>& kinds() {
  using sensor_bridge::ReplayParameters;
  using sensor_bridge::SimulatedParameters;
  using sensor_bridge::rplidar::EmulatorSettings;
  using sensor_bridge::rplidar::RplidarParameters;
  static const std::vector<KindInfo> all{
      {"simulated",
       "scans of a simulated sensor in a world, built in or of a file",
       "quoin-simulated",
       MessageType::none,
       MessageType::scan,
       "sensor",
       {},
       describe_parameters<SimulatedParameters>()},
      {"replay",
       "scans of a recorded file",
       "quoin-replay",
       MessageType::none,
       MessageType::scan,
       "sensor",
       {},
       describe_parameters<ReplayParameters>()},
      {"rplidar",
       "scans of an RPLIDAR on a serial port, TCP or UDP",
       "quoin-rplidar",
       MessageType::none,
       MessageType::scan,
       "sensor",
       {},
       describe_parameters<RplidarParameters>()},
      {"rplidar_emulator",
       "an RPLIDAR S1 without hardware, for a service of kind rplidar or any other client",
       "quoin-rplidar-emulator-service",
       MessageType::none,
       MessageType::none,
       "sensor",
       {},
       describe_parameters<EmulatorSettings>()},
      {"segmentation",
       "splits each scan into runs of points on one straight wall",
       "quoin-segmentation",
       MessageType::scan,
       MessageType::segments,
       "feature",
       Segmenters::descriptions(),
       {}},
      {"line_fitting",
       "fits a line with its covariance to each segment",
       "quoin-line-fitting",
       MessageType::segments,
       MessageType::lines,
       "feature",
       Fitters::descriptions(),
       {}},
      {"corner_estimation",
       "intersects neighbouring lines to corners with their covariances",
       "quoin-corner-estimation",
       MessageType::lines,
       MessageType::corners,
       "feature",
       CornerFinders::descriptions(),
       {}},
  };
  return all;
}

const KindInfo* find_kind(std::string_view name) {
  for (const KindInfo& kind : kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

const std::vector<ParameterInfo>& parameters_of(const KindInfo& kind, std::string_view method) {
  if (kind.methods.empty()) return kind.parameters;
  for (const MethodInfo& info : kind.methods) {
    if (info.name == method) return info.parameters;
  }
  throw std::out_of_range("no method '" + std::string(method) + "' of " + kind.name);
}

}  // namespace quoin
