// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/options.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "core/fitting/fitters.hpp"
#include "core/parameters/parameter.hpp"
#include "core/segmentation/segmenters.hpp"
#include "deploy/evaluation/pose_relations.hpp"
#include "deploy/evaluation/sections.hpp"
#include "sensor_bridge/recordings/scan_files.hpp"
#include "sensor_bridge/simulated/world_file.hpp"

namespace quoin::deploy {

namespace {

std::vector<std::string> names_of(const std::vector<MethodInfo>& methods) {
  std::vector<std::string> names;
  for (const MethodInfo& method : methods) names.push_back(method.name);
  return names;
}

/// Throws OptionError for the first name that is not known or comes twice.
void check_names(const std::string& option, const std::string& what,
                 const std::vector<std::string>& names, const std::vector<std::string>& known) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(known.begin(), known.end(), *name) == known.end()) {
      throw OptionError(option + ": unknown " + what + " '" + *name + "'" +
                        suggestion(*name, known));
    }
    if (std::find(names.begin(), name, *name) != name) {
      throw OptionError(option + ": '" + *name + "' is named twice");
    }
  }
}

std::vector<ScanFile> read_scan_files(const std::vector<std::string>& paths) {
  const sensor_bridge::ReplayParameters defaults;
  std::vector<ScanFile> files;
  for (const std::string& path : paths) {
    for (const std::filesystem::path& file : sensor_bridge::list_scan_files(path)) {
      ScanFile result{file.string(), {}, {}};
      sensor_bridge::ScanFiles reader(file, defaults);
      sensor_bridge::RecordedScan scan;
      while (reader.next(scan)) {
        result.notes.insert(scan.notes.begin(), scan.notes.end());
        result.scans.push_back(scan);
      }
      files.push_back(std::move(result));
    }
  }
  return files;
}

/// The world files of a folder in the order of their names; anything else as it is.
std::vector<std::string> worlds_in(const std::string& world) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(world, ignored)) return {world};
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(world, ignored)) {
    const std::string ending = entry.path().extension();
    if (ending == ".yaml" || ending == ".yml") files.push_back(entry.path().string());
  }
  if (files.empty()) {
    throw OptionError("--worlds: there is no world file (.yaml) in folder '" + world + "'");
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

EvaluationSetup prepare(const EvaluationOptions& options) {
  EvaluationSetup setup;
  setup.options = options;
  const std::vector<std::string> all_fitters = names_of(Fitters::descriptions());
  const std::vector<std::string> all_segmenters = names_of(Segmenters::descriptions());
  check_names("--fitters", "fitter", options.fitters, all_fitters);
  check_names("--segmenters", "segmenter", options.segmenters, all_segmenters);
  check_names("--only", "section", options.only, section_names());
  if (options.scans.empty() && std::find(options.only.begin(), options.only.end(),
                                         scan_files_section) != options.only.end()) {
    throw OptionError("--only: '" + std::string(scan_files_section) +
                      "' needs scan files; name them with --scans");
  }
  if (options.trials == 0 || options.scans_per_world == 0) {
    throw OptionError("--trials and --scans-per-world must be more than 0");
  }
  setup.fitters = options.fitters.empty() ? all_fitters : options.fitters;
  setup.segmenters = options.segmenters.empty() ? all_segmenters : options.segmenters;
  setup.loop_segmenters =
      options.segmenters.empty() ? std::vector{all_segmenters.front()} : options.segmenters;
  for (const std::string& world : options.worlds) {
    for (const std::string& one : worlds_in(world)) {
      setup.worlds.push_back(sensor_bridge::load_world(one, "."));
    }
  }
  setup.scan_files = read_scan_files(options.scans);
  if (!options.relations.empty()) {
    if (options.scans.empty()) {
      throw OptionError("--relations: they are of poses of scan files; name these with --scans");
    }
    setup.relations = read_pose_relations(options.relations, options.relations_offset);
  }
  return setup;
}

std::vector<World> worlds_or(const EvaluationSetup& setup, const std::vector<std::string>& names) {
  if (!setup.worlds.empty()) return setup.worlds;
  std::vector<World> worlds;
  for (const std::string& name : names) {
    if (auto world = built_in_world(name)) worlds.push_back(std::move(*world));
  }
  return worlds;
}

std::vector<std::string> covariance_modes(std::string_view fitter) {
  for (const MethodInfo& method : Fitters::descriptions()) {
    if (method.name != fitter) continue;
    for (const ParameterInfo& parameter : method.parameters) {
      if (parameter.name == "covariance") return parameter.choices;
    }
  }
  return {""};
}

Fitter make_fitter(std::string_view name, const std::string& covariance) {
  return Fitters::make<Fitter>(name, covariance.empty()
                                         ? ParameterSettings{}
                                         : ParameterSettings{{"covariance", covariance}});
}

Segmenter make_segmenter(std::string_view name) { return Segmenters::make<Segmenter>(name, {}); }

}  // namespace quoin::deploy
