// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/soak/composition.hpp"

namespace quoin::soak {

std::vector<std::string> compositions() {
  const std::string common =
      "  - {name: front, kind: simulated, parameters: {rate_hz: 20}}\n"
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

}  // namespace quoin::soak
