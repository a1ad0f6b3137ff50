// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quoin::deploy {

/// A corner service against the reference, over the scans that both delivered.
struct AgainstReference {
  std::uint64_t scans = 0;
  std::uint64_t reference_corners = 0;
  std::uint64_t own_corners = 0;
  std::uint64_t matched = 0;
  double median_distance = 0.0;  ///< [m] between the estimates of matched corners
  double distance_p95 = 0.0;     ///< [m]

  /// Part of the reference's corners that have a match.
  [[nodiscard]] double share() const {
    return reference_corners == 0
               ? 0.0
               : static_cast<double>(matched) / static_cast<double>(reference_corners);
  }
};

/// What a corner service delivered while it was listened to.
struct ComparedService {
  std::string name;
  std::string methods;  ///< of the newest result's stages, in their order: "iepf/wctls/adjacent"
  std::uint64_t scans = 0;
  std::uint64_t missing = 0;         ///< scans that others delivered and this one did not
  double mean_corners = 0.0;         ///< per scan
  double median_sigma = 0.0;         ///< [m] sqrt((Cxx + Cyy) / 2)
  double median_ellipse_area = 0.0;  ///< [m^2] one-sigma ellipse
  double latency_p50 = 0.0;          ///< [s] from the scan's publication to the corners'
  double latency_p99 = 0.0;          ///< [s]
  AgainstReference against;          ///< of the reference itself: nothing
};

struct ComparisonFigures {
  std::string deployment;     ///< file
  double duration = 0.0;      ///< [s]
  std::uint64_t scans = 0;    ///< that any of the services delivered
  std::size_t reference = 0;  ///< index into services
  std::vector<ComparedService> services;
};

}  // namespace quoin::deploy
