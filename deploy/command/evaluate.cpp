// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <sys/ioctl.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "deploy/command/commands.hpp"
#include "deploy/evaluation/evaluation.hpp"
#include "deploy/evaluation/jobs.hpp"
#include "deploy/evaluation/progress_display.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/orchestration/signals.hpp"
#include "sensor_bridge/recordings/line_reader.hpp"
#include "sensor_bridge/simulated/world_file.hpp"

namespace quoin::deploy {

namespace {

struct EvaluateOptions {
  EvaluationOptions evaluation;
  std::string output = "report";
  bool no_timing = false;
  bool json = false;
  bool quiet = false;
};

/// The folder of the report, made before anything is computed so that a mistake shows at once;
/// taken away again, if it is new and empty, when there is no report to put into it.
class OutputFolder {
 public:
  explicit OutputFolder(const std::string& path) : path_(path) {
    std::error_code error;
    made_ = std::filesystem::create_directories(path_, error);
    if (!std::filesystem::is_directory(path_)) {
      throw OptionError("-o: '" + path + "' is not a folder" +
                        (error ? " and cannot be made: " + error.message() : ""));
    }
    if (::access(path_.c_str(), W_OK) != 0) {
      throw OptionError("-o: folder '" + path + "' cannot be written to");
    }
  }
  ~OutputFolder() {
    std::error_code error;
    if (made_) std::filesystem::remove(path_, error);
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool made_ = false;
};

std::size_t error_terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

EvaluationReport evaluate_with_progress(const EvaluationSetup& setup, bool quiet) {
  Signals signals;  // before the threads start
  if (quiet) {
    return evaluate(setup, [&](const EvaluationProgress&) { return signals.take() == 0; });
  }
  ProgressDisplay display(std::cerr, ::isatty(STDERR_FILENO) == 1, error_terminal_width());
  return evaluate(setup, [&](const EvaluationProgress& progress) {
    display.show(progress);
    return signals.take() == 0;
  });
}

int run(EvaluateOptions options) {
  options.evaluation.timing = !options.no_timing;
  options.evaluation.version = QUOIN_VERSION;
  try {
    const EvaluationSetup setup = prepare(options.evaluation);
    for (const ScanFile& file : setup.scan_files) {
      for (const std::string& note : file.notes) std::cerr << file.name << ": " << note << '\n';
    }
    const OutputFolder folder(options.output);
    const EvaluationReport report = evaluate_with_progress(setup, options.quiet);
    write_report(report, folder.path());
    if (options.json) {
      std::cout << report.json;
      return exit_ok;
    }
    if (options.quiet) return exit_ok;
    for (const std::string& line : report.summary) std::cout << line << '\n';
    std::cout << '\n'
              << (folder.path() / "report.html").string() << '\n'
              << (folder.path() / "report.json").string() << '\n';
    return exit_ok;
  } catch (const OptionError& error) {
    std::cerr << error.what() << '\n';
  } catch (const sensor_bridge::WorldError& error) {
    std::cerr << error.what() << '\n';
  } catch (const sensor_bridge::ScanFileError& error) {
    std::cerr << error.what() << '\n';
  } catch (const Interrupted&) {
    std::cerr << "interrupted; no report has been written\n";
    return exit_failure;
  }
  return exit_configuration;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

Command add_evaluate(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "evaluate",
      "Judge segmenters, fitters, maps and poses on simulated worlds and scan files; writes a "
      "report");
  const auto options = std::make_shared<EvaluateOptions>();
  EvaluationOptions& evaluation = options->evaluation;
  evaluation.threads = std::max(1U, std::thread::hardware_concurrency());
  line->add_option("-o,--output", options->output, "Folder for report.json and report.html")
      ->capture_default_str();
  line->add_option("--segmenters", evaluation.segmenters,
                   "Segmenters to judge (quoin methods segmentation lists them); else all, and the "
                   "default one in the loop")
      ->delimiter(',');
  line->add_option("--fitters", evaluation.fitters,
                   "Fitters to judge (quoin methods line_fitting lists them); else all")
      ->delimiter(',');
  line->add_option("--worlds", evaluation.worlds,
                   "Built-in worlds, world files or folders of them; else what each section says")
      ->delimiter(',');
  line->add_option("--scans", evaluation.scans,
                   "Scan files (CARMEN, CSV) or folders of them to extract corners from");
  line->add_option("--relations", evaluation.relations,
                   "Verified relations of poses in these scan files (Kuemmerle et al. 2009)");
  line->add_option("--relations-offset", evaluation.relations_offset,
                   "Stamps of the relations less those of the scans [s]")
      ->capture_default_str();
  SensorModel& noise = evaluation.scan_noise;
  line->add_option("--range-stddev", noise.range_stddev,
                   "Of the sensor that recorded the scan files: noise of each range [m]")
      ->check(more_than_zero())
      ->capture_default_str();
  line->add_option("--range-stddev-per-metre", noise.range_stddev_per_metre,
                   "The same: what that noise grows by with the range [m/m]")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  line->add_option("--bearing-stddev", noise.bearing_stddev,
                   "The same: noise of each bearing [rad]")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  line->add_option("--flatness-stddev", noise.flatness_stddev,
                   "The same: how far walls are off a line [m]")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  line->add_option("--only", evaluation.only, "Sections to compute: " + joined(section_names()))
      ->delimiter(',');
  line->add_option("--trials", evaluation.trials, "Monte Carlo trials of each fitter")
      ->check(more_than_zero())
      ->capture_default_str();
  line->add_option("--scans-per-world", evaluation.scans_per_world,
                   "Simulated scans of each world for segmenters and the loop")
      ->check(more_than_zero())
      ->capture_default_str();
  line->add_option("--laps", evaluation.laps, "Laps of each simulated drive for maps and poses")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  line->add_option("--scenarios", evaluation.scenarios,
                   "Runs of each scenario of localization: corridors, kidnapping and others")
      ->capture_default_str();
  line->add_option("--seed", evaluation.seed, "Seed of all noise; same seed, same numbers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  line->add_option("--threads", evaluation.threads,
                   "Threads that compute; numbers do not depend on it")
      ->check(CLI::Range(1, 1024));
  line->add_flag("--no-timing", options->no_timing,
                 "Leave out figures of time, so that equal runs give equal files");
  line->add_flag("--json", options->json, "Print report.json instead of the summary");
  line->add_flag("--quiet", options->quiet, "No progress and no summary");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
