// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/evaluation/mapping_quality.hpp"
#include "core/fitting/fit.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"
#include "core/simulation/world.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::deploy {

/// An option that cannot be used: which, what is wrong, what to do.
class OptionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the user asks for; empty lists mean what each section shows by default.
struct EvaluationOptions {
  std::vector<std::string> segmenters;
  std::vector<std::string> fitters;
  std::vector<std::string> worlds;  ///< names of built-in worlds, world files or folders of them
  std::vector<std::string> scans;   ///< paths of scan files or folders of them
  std::string relations;            ///< verified relations of poses of `scans`, a file; or ""
  double relations_offset = 0.0;    ///< [s] their stamps less those of the scans
  SensorModel scan_noise;           ///< of the sensor that recorded `scans`
  std::vector<std::string> only;    ///< names of sections
  std::size_t trials = 2000;
  std::size_t scans_per_world = 200;
  double laps = 1.0;          ///< of simulated drives, there and back
  std::size_t scenarios = 1;  ///< runs of each scenario of localization
  std::uint64_t seed = 1;
  std::size_t threads = 1;
  bool timing = true;   ///< figures that differ from run to run
  std::string version;  ///< of the program, for the report
};

struct ScanFile {
  std::string name;
  std::vector<sensor_bridge::RecordedScan> scans;
  std::set<std::string> notes;  ///< what was guessed of them, for people
};

/// The options with everything in them looked up and read.
struct EvaluationSetup {
  EvaluationOptions options;
  std::vector<std::string> fitters;          ///< the chosen ones, or all
  std::vector<std::string> segmenters;       ///< the chosen ones, or all
  std::vector<std::string> loop_segmenters;  ///< the chosen ones, or the default
  std::vector<World> worlds;                 ///< the given ones, or none
  std::vector<ScanFile> scan_files;
  std::vector<PoseRelation> relations;
};

/// Throws OptionError, WorldError or ScanFileError.
[[nodiscard]] EvaluationSetup prepare(const EvaluationOptions& options);

/// The given worlds, or the built-in ones of these names.
[[nodiscard]] std::vector<World> worlds_or(const EvaluationSetup& setup,
                                           const std::vector<std::string>& names);

/// The covariance modes that a fitter offers; "" for one without a choice.
[[nodiscard]] std::vector<std::string> covariance_modes(std::string_view fitter);
[[nodiscard]] Fitter make_fitter(std::string_view name, const std::string& covariance);
[[nodiscard]] Segmenter make_segmenter(std::string_view name);

}  // namespace quoin::deploy
