// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What scans of the largest size that a message may have take in each segmenter, over shapes that
// no room has.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

#include "core/segmentation/segmenters.hpp"
#include "tests/core/hostile_scans.hpp"

int main() {
  using namespace quoin;
  constexpr std::size_t points = 100'000;
  constexpr SensorModel sensor{0.01, 0.0, 0.0};
  std::printf("%-26s", "[s] for 100000 points");
  for (const std::string_view shape : hostile_shapes)
    std::printf(" %18s", std::string(shape).c_str());
  std::printf(" %8s\n", "worst");
  for (const MethodInfo& method : Segmenters::descriptions()) {
    const Segmenter segment = Segmenters::make<Segmenter>(method.name, {});
    Segmentation found;
    double worst = 0.0;
    std::printf("%-26s", method.name.c_str());
    for (const std::string_view shape : hostile_shapes) {
      const Points scan = hostile_scan(shape, points);
      const auto begin = std::chrono::steady_clock::now();
      segment(scan, sensor, found);
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
      worst = std::max(worst, time.count());
      std::printf(" %18.3f", time.count());
    }
    std::printf(" %8.3f\n", worst);
  }
}
