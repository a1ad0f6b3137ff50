// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "core/mapping/localizer.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// A map by `line_merge` (LineMap), whose lines keep the heading: it is corrected by the weighted
/// mean of the angles between the lines of the scan and the stored lines that they match. The
/// position is that of the odometry, driven with the corrected heading.
class AngularOffsets {
 public:
  static constexpr const char* name = "angular_offsets";
  static constexpr const char* description =
      "odometry whose heading the directions of mapped lines correct";
  static constexpr const char* source = "Opromolla et al. 2017, section 2.1, eq. 12-14";
  static constexpr const char* choose =
      "To compare with the paper, or where odometry is good and only its heading drifts: the "
      "position is not corrected, so that its error grows with the way. landmarks corrects both.";
  static constexpr const char* state = "line_map/1";

  struct Parameters {
    double largest_angle = 0.2617993877991494;  // [rad] 15 deg
    double largest_distance = 1.0;              // [m]

    static constexpr auto fields() {
      return std::make_tuple(
          field(&Parameters::largest_angle, "largest_angle", "rad", 0.001, 1.57,
                "lines whose directions differ by more are different walls"),
          field(&Parameters::largest_distance, "largest_distance", "m", 0.01, 100.0,
                "so are those whose distances from the origin and whose centroids differ by more, "
                "summed"));
    }
  };

  AngularOffsets() : AngularOffsets(Parameters{}) {}
  explicit AngularOffsets(const Parameters& parameters);

  void operator()(const LocalizationInput& input, Localization& result);

  [[nodiscard]] const LineMap& map() const { return map_; }

  void use_map(std::span<const MapLine> map, const std::optional<PoseEstimate>& pose);
  void reset();
  [[nodiscard]] static std::vector<Pose2> keyframes() { return {}; }
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.map_, self.pose_, self.velocity_, self.stamp_, self.is_given_, self.has_pose_);
  }

 private:
  LineMap map_;
  PoseEstimate pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // [m/s, rad/s] in the frame of the sensor
  std::optional<double> stamp_;                         // [s] of the previous scan
  bool is_given_ = false;                               // the map, which stays as it is
  bool has_pose_ = true;
  std::vector<std::optional<LineMatch>> matches_;  // of the lines of the scan
};

}  // namespace quoin
