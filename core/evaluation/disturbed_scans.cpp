// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/disturbed_scans.hpp"

#include <cmath>

#include "core/extraction/extraction.hpp"

namespace quoin {
namespace {

constexpr double nearest_stray = 0.2;                       // [m]
constexpr std::uint64_t of_strays = 0x9e3779b97f4a7c15ULL;  // sets their random numbers apart

ScannerSettings settings_of(const DisturbedScans& disturbed) {
  ScannerSettings settings;
  settings.points = disturbed.rays;
  settings.noise = disturbed.noise;
  settings.dropout = disturbed.dropout;
  return settings;
}

}  // namespace

DisturbedScanner::DisturbedScanner(const World& world, const DisturbedScans& disturbed,
                                   std::uint64_t seed)
    : scanner_(world, settings_of(disturbed), seed),
      strays_(disturbed.strays),
      random_(seed ^ of_strays) {}

const SimulatedScan& DisturbedScanner::scan() {
  scanner_.scan(0.0, 0.0, scan_);
  for (std::size_t i = 0; i < scan_.ranges.size(); ++i) {
    float& range = scan_.ranges[i];
    if (!(random_.uniform() < strays_) || !std::isfinite(range)) continue;
    range = static_cast<float>(random_.uniform(nearest_stray, static_cast<double>(range)));
    scan_.walls[i] = Hit::no_wall;
  }
  return scan_;
}

ScanView DisturbedScanner::view() const { return quoin::view(scan_, scanner_.settings()); }

}  // namespace quoin
