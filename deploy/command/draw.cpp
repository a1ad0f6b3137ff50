// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/text/printable.hpp"
#include "deploy/command/commands.hpp"
#include "deploy/evaluation/drawing/drawing.hpp"
#include "deploy/evaluation/drawing/png.hpp"
#include "deploy/export/output_file.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/observation/display.hpp"
#include "deploy/observation/scan_join.hpp"
#include "deploy/orchestration/exclusive.hpp"
#include "deploy/orchestration/host.hpp"
#include "deploy/orchestration/launch.hpp"
#include "deploy/orchestration/signals.hpp"
#include "deploy/orchestration/supervisor.hpp"
#include "deploy/recordings/scan_picture.hpp"
#include "sensor_bridge/message_files/scan_file_error.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

struct DrawOptions {
  std::string file;
  std::string service;
  std::string output;
  std::optional<std::uint64_t> scan;
  std::optional<double> at;  // [s]
  std::string topic;
  bool run = false;
  double wait = 10.0;  // [s] without any message
  DrawingOptions drawing;
};

/// Starts the deployment for as long as it is needed; does nothing when it runs already.
class Companion {
 public:
  Companion(const DrawOptions& options, const Deployment& deployment, const CornerChain& chain)
      : display_(Display::Mode::quiet) {
    if (!options.run) return;
    exclusive_.emplace(deployment);
    const auto observers = [&](const ServiceConfig& service) {
      return chain.shows(service) ? 1 : 0;
    };
    Supervisor::Callbacks callbacks;
    callbacks.output = [this](const std::string& name, const std::string& line) {
      display_.log(name, line);
    };
    callbacks.event = [this](const std::string& name, const std::string& text) {
      display_.log("quoin", name + ": " + text);
    };
    // A configuration error ends everything, whenever it shows.
    callbacks.was_active = [](const std::string&) { return false; };
    supervisor_.emplace(process_plans(deployment, host_to_run(deployment, ""), observers),
                        std::move(callbacks));
    supervisor_->start();
  }

  /// Whether there is somebody to wait for.
  bool alive() {
    if (!supervisor_) return true;
    supervisor_->poll(milliseconds(0));
    return !supervisor_->ended();
  }

  /// The exit code of the deployment.
  int stop(Signals& signals) {
    if (!supervisor_) return exit_ok;
    supervisor_->request_stop();
    while (!supervisor_->ended()) {
      if (supervisor_->poll(milliseconds(100), signals.descriptor()) && signals.take() > 0) {
        supervisor_->kill_all();
      }
    }
    return supervisor_->exit_code();
  }

 private:
  Display display_;
  std::optional<Exclusive> exclusive_;
  std::optional<Supervisor> supervisor_;
};

/// Nothing when the scan passed by, nothing came for too long, or a signal came; says why.
std::optional<Drawing> wait_for_drawing(const DrawOptions& options, ScanJoin& join,
                                        Companion& companion, Signals& signals) {
  const auto timeout =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.wait));
  auto deadline = Clock::now() + timeout;
  std::optional<std::uint64_t> newest;
  bool alive = true;
  while (signals.take() == 0) {
    if (auto drawing = join.poll(milliseconds(100))) return drawing;
    if (join.newest() != newest) {
      newest = join.newest();
      deadline = Clock::now() + timeout;
    }
    // Parts of one scan arrive a little apart; 64 scans later it is not coming any more.
    if (options.scan && newest && *newest > *options.scan + 64) {
      std::cerr << "scan " << *options.scan << " has passed, the newest is " << *newest
                << "; ask for a later one or leave --scan out\n";
      return std::nullopt;
    }
    if (!alive) {
      std::cerr << "the deployment ended before the scan was complete\n";
      return std::nullopt;
    }
    if (Clock::now() >= deadline) {
      std::cerr << "no complete scan arrived within " << options.wait
                << " s; is the deployment running? (--run starts it)\n";
      return std::nullopt;
    }
    alive = companion.alive();  // what came before the end is still polled once
  }
  return std::nullopt;
}

int write_picture(const DrawOptions& options, const Drawing& drawing) {
  const std::string svg = draw_svg(drawing, options.drawing);
  const bool png = std::filesystem::path(options.output).extension() == ".png";
  write_whole(options.output, png ? png_of(svg) : svg);
  std::cout << options.output << ": " << drawing.title << "; " << drawing.points.size()
            << " points, " << drawing.lines.size() << " lines, " << drawing.corners.size()
            << " corners";
  if (!drawing.circles.empty()) std::cout << ", " << drawing.circles.size() << " circles";
  std::cout << '\n';
  return exit_ok;
}

int draw_recording(const DrawOptions& options) {
  if (options.run) throw std::out_of_range("--run starts a deployment, and this is a recording");
  try {
    return write_picture(options,
                         picture_of_recording(options.file, {.topic = options.topic,
                                                             .service = options.service,
                                                             .scan = options.scan.value_or(0),
                                                             .at = options.at}));
  } catch (const sensor_bridge::ScanFileError& error) {
    std::cerr << printable(error.what()) << '\n';
    return exit_input;
  }
}

int run(const DrawOptions& options) {
  const std::string extension = std::filesystem::path(options.file).extension();
  if (extension != ".yaml" && extension != ".yml") return draw_recording(options);
  if (options.service.empty()) {
    throw std::out_of_range("--service is missing: the corner service whose result is drawn");
  }
  if (options.at || !options.topic.empty()) {
    throw std::out_of_range("--at and --topic are for recordings");
  }
  const Deployment deployment = load_deployment(options.file);
  const CornerChain chain = corner_chain(deployment, options.service);
  Signals signals;  // before DDS starts its threads
  ScanJoin join(deployment, chain, options.scan);
  Companion companion(options, deployment, chain);
  const std::optional<Drawing> drawing = wait_for_drawing(options, join, companion, signals);
  const int exit_code = companion.stop(signals);
  if (!drawing) return exit_code != exit_ok ? exit_code : exit_failure;

  return write_picture(options, *drawing);
}

}  // namespace

Command add_draw(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "draw", "Draw one scan with its lines, corners, circles and 95 % ellipses as SVG or PNG");
  const auto options = std::make_shared<DrawOptions>();
  line->add_option("file", options->file,
                   "Deployment file (YAML), or a recording (MCAP, bag, CARMEN, CSV, ...)")
      ->required();
  line->add_option(
      "--service", options->service,
      "Corner service whose result is drawn; of a recording the only one, if left out");
  line->add_option("-o,--output", options->output, "File to write: .png is PNG, anything else SVG")
      ->required();
  line->add_option("--scan", options->scan,
                   "Number of the scan, from 0; else the first that is complete");
  line->add_option("--at", options->at,
                   "Of a recording: the scan so long after the first [s], in place of its number")
      ->excludes("--scan");
  line->add_option("--topic", options->topic, "Of a recording with several: the topic of scans");
  line->add_flag("--run", options->run, "Start the deployment for the picture and stop it again");
  line->add_option("--wait", options->wait, "Give up when nothing arrives for this time [s]")
      ->transform(a_time())
      ->capture_default_str();
  line->add_option("--ellipse-scale", options->drawing.ellipse_scale,
                   "Draw ellipses enlarged this many times; 0 chooses what can be seen")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  line->add_option("--width", options->drawing.width, "Width of the picture [pixel]")
      ->check(CLI::Range(300.0, 10000.0))
      ->capture_default_str();
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
