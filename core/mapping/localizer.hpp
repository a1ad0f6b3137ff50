// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/corners/corner_finder.hpp"
#include "core/geometry/line.hpp"
#include "core/mapping/line_map.hpp"
#include "core/mapping/motion.hpp"
#include "core/mapping/state_archive.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// What is known of a pose.
enum class LocalizationStatus {
  tracking,   ///< the pose is known within its covariance
  ambiguous,  ///< one direction is not determined, or several poses explain the scan
  lost,       ///< the scan does not fit the map where the robot should be
};

template <>
struct EnumNames<LocalizationStatus> {
  static constexpr std::array<std::pair<LocalizationStatus, std::string_view>, 3> names{
      {{LocalizationStatus::tracking, "tracking"},
       {LocalizationStatus::ambiguous, "ambiguous"},
       {LocalizationStatus::lost, "lost"}}};
};

/// The features of one scan, in the frame of the sensor.
struct LocalizationInput {
  double stamp = 0.0;                  ///< [s] of the scan; stamps ascend
  std::span<const LineSegment> lines;  ///< [m]
  std::span<const Corner> corners;     ///< of these lines; may be empty
  /// Motion of the sensor since the previous scan, in its frame then; without it the velocity is
  /// taken to be constant.
  std::optional<PoseEstimate> motion;
  bool wants_map = false;  ///< fill Localization::map
  /// [m] all points of the scan, in order of bearing, or none. What is on no line helps as well to
  /// find the pose; without them it is found by the lines alone.
  std::span<const Eigen::Vector2d> points = {};
};

/// Where the sensor is, in the frame of the map, whose origin is the first pose.
struct Localization {
  PoseEstimate pose;
  LocalizationStatus status = LocalizationStatus::tracking;
  /// [rad] in the frame of the map: the direction in which the walls say nothing of the position.
  std::optional<double> weak_direction;
  std::size_t matched = 0;  ///< lines of the scan that are in the map
  /// The keyframe that the pose hangs on, and the pose in its frame: as the map is smoothed,
  /// Localizer::keyframes() says where it is by what is known later. Nothing where a method has no
  /// keyframes.
  std::optional<std::size_t> keyframe;
  Pose2 in_keyframe;
  std::vector<MapLine> map;  ///< empty unless it was wanted
};

/// A method that localizes one scan after the other, and maps what is new: any class that has the
/// functions below. Errors of `restore` are std::invalid_argument, and leave it as it was.
class Localizer {
 public:
  Localizer() = default;
  template <class Method>
  Localizer(Method method)  // NOLINT(google-explicit-constructor): as a std::function
      : method_(std::make_unique<Wrapped<Method>>(std::move(method))) {}

  explicit operator bool() const { return method_ != nullptr; }

  /// The result is overwritten and keeps its memory. A stamp that does not ascend is an error of
  /// the caller.
  void operator()(const LocalizationInput& input, Localization& result) {
    method_->localize(input, result);
  }

  /// Forgets all and localizes in these walls, which stay as they are: nothing is mapped. A line
  /// without observations is a plan's, seen from either side; one without a covariance gets that of
  /// the method's parameter. Without a pose the status is `lost` until the scans show where it is.
  void use_map(std::span<const MapLine> map, const std::optional<PoseEstimate>& pose) {
    method_->use_map(map, pose);
  }
  /// Forgets all: the next scan is the origin of a new map.
  void reset() { method_->reset(); }

  /// All that it knows, in the form that its `state` names; a method of the same form and
  /// parameters goes on as this one would.
  [[nodiscard]] std::vector<std::uint8_t> save() const { return method_->save(); }
  void restore(std::span<const std::uint8_t> bytes) { method_->restore(bytes); }

  /// Poses of all keyframes in the map by what is known now.
  [[nodiscard]] std::vector<Pose2> keyframes() const { return method_->keyframes(); }

 private:
  struct Interface {
    Interface() = default;
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    virtual ~Interface() = default;
    virtual void localize(const LocalizationInput& input, Localization& result) = 0;
    virtual void use_map(std::span<const MapLine> map, const std::optional<PoseEstimate>& pose) = 0;
    virtual void reset() = 0;
    [[nodiscard]] virtual std::vector<std::uint8_t> save() const = 0;
    virtual void restore(std::span<const std::uint8_t> bytes) = 0;
    [[nodiscard]] virtual std::vector<Pose2> keyframes() const = 0;
  };
  template <class Method>
  struct Wrapped final : Interface {
    explicit Wrapped(Method wrapped) : method(std::move(wrapped)) {}
    void localize(const LocalizationInput& input, Localization& result) override {
      method(input, result);
    }
    void use_map(std::span<const MapLine> map, const std::optional<PoseEstimate>& pose) override {
      method.use_map(map, pose);
    }
    void reset() override { method.reset(); }
    [[nodiscard]] std::vector<std::uint8_t> save() const override { return save_state(method); }
    void restore(std::span<const std::uint8_t> bytes) override { restore_state(bytes, method); }
    [[nodiscard]] std::vector<Pose2> keyframes() const override { return method.keyframes(); }
    Method method;
  };
  std::unique_ptr<Interface> method_;
};

}  // namespace quoin
