// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/soak/composition.hpp"

#include "core/fitting/fitters.hpp"

namespace quoin::soak {

namespace {

std::vector<std::string> shipped_compositions() {
  const std::string common =
      "  - {name: front, kind: simulated, parameters: {rate_hz: 20}}\n"
      // A sensor that is never quite well, as long as the device itself is left alone.
      "  - {name: device, kind: rplidar_emulator, parameters: {link: lidar.tty, spin_up_time: 0.2 "
      "s,\n"
      "     faults: \"lost_frames=0.01, repeated_frames=0.01, swapped_frames=0.01, \n"
      "     dropped_bytes=0.0001, flipped_bits=0.00001\"}}\n"
      "  - {name: lidar, kind: rplidar, parameters: {serial_port: ./lidar.tty}}\n"
      "  - {name: lidar_walls, kind: segmentation, input: lidar, method: iepf}\n"
      "  - {name: steady, kind: line_fitting, input: walls, method: wctls, strength: 10}\n"
      "  - {name: steady, kind: line_fitting, input: walls, method: wctls, strength: 5}\n"
      "  - {name: steady_corners, kind: corner_estimation, input: steady}\n"
      "  - {name: second_corners, kind: corner_estimation, input: second}\n";
  return {
      common +
          "  - {name: walls, kind: segmentation, input: front, method: iepf}\n"
          "  - {name: second, kind: line_fitting, input: walls, method: inverse_range}\n",
      // Other parameters, another method, one fitter more.
      common +
          "  - {name: walls, kind: segmentation, input: front, method: iepf,\n"
          "     parameters: {split_distance: 60 mm}}\n"
          "  - {name: second, kind: line_fitting, input: walls, method: utls}\n"
          "  - {name: third, kind: line_fitting, input: walls, method: pca}\n",
      // Another segmentation beside the first, from which `second` reads now.
      common +
          "  - {name: walls, kind: segmentation, input: front, method: iepf}\n"
          "  - {name: other_walls, kind: segmentation, input: front, method: split_and_merge}\n"
          "  - {name: second, kind: line_fitting, input: other_walls, method: inverse_range}\n",
  };
}

}  // namespace

Scenario shipped_kinds() {
  Scenario scenario{.tool = "quoin",
                    .compositions = shipped_compositions(),
                    .listened = {"steady_corners", "second_corners"},
                    .visited = "second_corners",
                    .swaps = {},
                    .spared = {"front", "walls", "steady@10", "steady_corners"},
                    .attacked = {"front", "walls", "second"}};
  for (const MethodInfo& method : Fitters::descriptions()) {
    for (const char* service : {"second", "steady@10"}) {
      scenario.swaps.push_back({service, method.name});
    }
  }
  return scenario;
}

Scenario test_kinds() {
  const std::string common =
      "  - {name: front, kind: simulated, parameters: {rate_hz: 20, points: 360}}\n"
      "  - {name: odo, kind: test_odometer, parameters: {rate_hz: 15}}\n"
      "  - {name: far_map, kind: test_own_rate, input: newest, parameters: {every: 7}}\n"
      "  - {name: sink, kind: test_sink, input: map}\n"
      "  - {name: tape, kind: test_observer, inputs: all}\n";
  const auto rest = [](const std::string& qos, const std::string& partner) {
    return "  - {name: walls, kind: segmentation," + qos + " input: front}\n" +
           "  - {name: lines, kind: line_fitting," + qos + " input: walls}\n" +
           "  - {name: corners, kind: corner_estimation," + qos + " input: lines}\n" +
           "  - {name: pose, kind: test_join," + qos + " inputs: {lines: lines, scan: " + partner +
           "}}\n" + "  - {name: moved, kind: test_join," + qos +
           " inputs: {lines: odo, scan: front}}\n" + "  - {name: newest, kind: test_latest," + qos +
           " inputs: {scan: odo, corners: corners}}\n" + "  - {name: map, kind: test_own_rate," +
           qos + " input: corners, parameters: {every: 5}}\n";
  };
  return {.tool = "quoin_test_tool",
          .compositions = {common + rest("", "odo"), common + rest(" qos: lossless,", "odo"),
                           common + rest("", "front")},
          .listened = {"far_map", "newest"},
          .visited = "newest",
          .swaps = {{"map", "count"},
                    {"map", "recount"},
                    {"map", "count_otherwise"},
                    {"far_map", "recount"},
                    {"lines", "utls"},
                    {"lines", "wctls"}},
          .spared = {"front", "odo", "walls", "lines", "corners", "newest"}};
}

Scenario composed_stages() {
  std::string services =
      "  - {name: front, kind: simulated, parameters: {rate_hz: 20}}\n"
      "  - {name: walls, kind: segmentation, input: front, method: iepf}\n";
  std::vector<Swap> swaps;
  for (const std::string fitter : {"utls", "wtls", "wctls"}) {
    services += "  - {name: " + fitter + ", kind: line_fitting, input: walls, method: " + fitter +
                "}\n  - {name: " + fitter + "_corners, kind: corner_estimation, input: " + fitter +
                "}\n";
    for (const MethodInfo& method : Fitters::descriptions()) swaps.push_back({fitter, method.name});
  }
  return {
      .tool = "quoin",
      .compositions = {services + "processes:\n  stages: [walls, utls, wtls, wctls, utls_corners, "
                                  "wtls_corners, wctls_corners]\n",
                       services,
                       services +
                           "processes:\n  first: [front, walls, utls, utls_corners]\n  second: "
                           "[wtls, wctls, wtls_corners, wctls_corners]\n"},
      .listened = {"utls_corners", "wctls_corners"},
      .visited = "wctls_corners",
      .swaps = swaps,
      .spared = {"front", "walls", "utls", "wtls", "wctls", "utls_corners", "wtls_corners",
                 "wctls_corners"}};
}

}  // namespace quoin::soak
