// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What a scan costs from bearings and ranges to corners with covariances, against one plain pass of
// x = r cos(b), y = r sin(b) over the same scan. Run both on one processor and divide the times:
//   taskset -c 1 extraction_benchmark --benchmark_enable_random_interleaving=true
//                --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/corners/adjacent.hpp"
#include "core/fitting/algebraic.hpp"
#include "core/segmentation/iepf.hpp"
#include "core/sensor/scan.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/world.hpp"

namespace {

using quoin::SimulatedScan;

/// Different scans in turn, so that branch prediction does not learn a single one by heart.
const std::vector<SimulatedScan>& scans() {
  static const std::vector<SimulatedScan> all = [] {
    constexpr std::size_t count = 64;
    quoin::SimulatedScanner scanner(quoin::built_in_world("domestic_room").value(), {}, 20260422);
    std::vector<SimulatedScan> made(count);
    for (std::size_t i = 0; i < count; ++i) {
      scanner.scan(0.05 * static_cast<double>(i), 0.0, made[i]);
    }
    return made;
  }();
  return all;
}

class Rotation {
 public:
  const SimulatedScan& next() {
    const SimulatedScan& scan = scans()[index_];
    index_ = index_ + 1 < scans().size() ? index_ + 1 : 0;
    return scan;
  }

 private:
  std::size_t index_ = 0;
};

void plain_conversion(benchmark::State& state) {
  Rotation rotation;
  std::vector<double> x(scans().front().ranges.size());
  std::vector<double> y(x.size());
  for (auto _ : state) {
    const SimulatedScan& scan = rotation.next();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double range = static_cast<double>(scan.ranges[i]);
      const double bearing = static_cast<double>(scan.bearings[i]);
      x[i] = range * std::cos(bearing);
      y[i] = range * std::sin(bearing);
    }
    benchmark::DoNotOptimize(x.data());
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
}

/// How far the pipeline is run; the difference of two is the cost of a step.
enum Until { conversion, segmentation, lines, corners };

void extraction(benchmark::State& state, Until until) {
  Rotation rotation;
  const quoin::SensorModel sensor;
  quoin::Points points;
  quoin::Iepf iepf;
  const quoin::Wctls fitter;
  quoin::Adjacent finder;
  quoin::Segmentation in_scan;
  std::vector<quoin::LineSegment> fitted;
  quoin::FoundCorners found;
  double corner_count = 0.0;
  for (auto _ : state) {
    const SimulatedScan& scan = rotation.next();
    quoin::convert({scan.bearings, scan.ranges, 0.1F, 40.0F}, points);
    benchmark::DoNotOptimize(points.x.data());
    if (until >= segmentation) {
      iepf(points, sensor, in_scan);
      quoin::set_aside(points, in_scan);
    }
    if (until >= lines) {
      fitted.clear();
      for (const quoin::Segment& segment : in_scan.segments) {
        const quoin::PointsView view = points.view().subview(segment.begin, segment.end);
        const quoin::FitResult fit = fitter(view, sensor);
        if (fit.ok()) fitted.push_back(quoin::line_segment(fit.estimate, fit.normal, view));
      }
    }
    if (until >= corners) finder(fitted, sensor.range_bias_stddev, found);
    benchmark::DoNotOptimize(in_scan.segments.data());
    benchmark::DoNotOptimize(fitted.data());
    benchmark::DoNotOptimize(found.corners.data());
    benchmark::ClobberMemory();
    corner_count += static_cast<double>(found.corners.size());
  }
  if (until == corners) {
    state.counters["corners"] =
        benchmark::Counter(corner_count, benchmark::Counter::kAvgIterations);
  }
}

BENCHMARK(plain_conversion);
BENCHMARK_CAPTURE(extraction, to_points, conversion);
BENCHMARK_CAPTURE(extraction, to_segments, segmentation);
BENCHMARK_CAPTURE(extraction, to_lines, lines);
BENCHMARK_CAPTURE(extraction, to_corners, corners);

}  // namespace

BENCHMARK_MAIN();
