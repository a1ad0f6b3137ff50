// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/calibration/noise_estimate.hpp"
#include "core/sensor/scan.hpp"

namespace quoin::deploy {

/// Scans that are kept for a calibration. When they are more than the memory allows, every second
/// one is forgotten, so that those that are kept are spread over all.
class CollectedScans {
 public:
  explicit CollectedScans(std::size_t most_rays = 20'000'000) : most_rays_(most_rays) {}

  void add(const ScanView& scan);

  [[nodiscard]] std::size_t added() const { return added_; }
  [[nodiscard]] std::size_t size() const { return scans_.size(); }
  [[nodiscard]] ScanView scan(std::size_t index) const;

 private:
  struct Scan {
    std::vector<float> bearings, ranges;
    float range_min = 0.0F, range_max = 0.0F;
  };

  std::size_t most_rays_;
  std::size_t rays_ = 0;
  std::size_t added_ = 0;
  std::size_t stride_ = 1;
  std::vector<Scan> scans_;
};

/// The error common to all ranges, from walls in front of the sensor at a known distance.
struct RangeBias {
  Interval bias;          ///< [m] measured less true distance
  std::size_t scans = 0;  ///< that show such a wall
};

struct Calibration {
  NoiseEstimate noise;
  std::optional<double> distance;  ///< [m] as it was given
  std::optional<RangeBias> bias;   ///< where a wall is near that distance
};

/// Estimates the noise from the scans: walls by the default segmenter under the last estimate, the
/// estimate from these walls, three times. `distance` [m] is the true one from the sensor,
/// perpendicular to a wall that the scans show. `proceed` is called scan by scan with the done part
/// of the work (0..1); when it returns false, nothing is returned.
[[nodiscard]] std::optional<Calibration> calibrate(const CollectedScans& scans,
                                                   std::optional<double> distance,
                                                   const std::function<bool(double done)>& proceed);

}  // namespace quoin::deploy
