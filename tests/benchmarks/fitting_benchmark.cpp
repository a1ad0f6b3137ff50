// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What a line with its covariance costs, against the plain covariance of the same points with
// Eigen: the mean, then the products about it. Run on one processor and divide the times:
//   taskset -c 1 fitting_benchmark --benchmark_enable_random_interleaving=true
//                --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
#include <cstddef>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/evaluation/fit_timing.hpp"
#include "core/evaluation/papers/cwlf_paper.hpp"
#include "core/fitting/fitters.hpp"

namespace {

/// The walls in turn.
class Walls {
 public:
  explicit Walls(std::size_t points) : walls_(quoin::timing_walls(points)) {}

  const quoin::Points& next() {
    index_ = index_ + 1 < walls_.size() ? index_ + 1 : 0;
    return walls_[index_];
  }

 private:
  std::vector<quoin::Points> walls_;
  std::size_t index_ = 0;
};

std::size_t points_of(const benchmark::State& state) {
  return static_cast<std::size_t>(state.range(0));
}

void eigen_covariance(benchmark::State& state) {
  Walls walls(points_of(state));
  for (auto _ : state) benchmark::DoNotOptimize(quoin::plain_covariance(walls.next()));
}

void fit(benchmark::State& state, const std::string& name) {
  Walls walls(points_of(state));
  const quoin::SensorModel sensor;
  const auto fitter = quoin::Fitters::make<quoin::Fitter>(name, {});
  for (auto _ : state) benchmark::DoNotOptimize(fitter(walls.next(), sensor));
}

// The steps of the two methods that the CWLF paper compares.

void cwlf_line_alone(benchmark::State& state) {
  Walls walls(points_of(state));
  for (auto _ : state) benchmark::DoNotOptimize(quoin::cwlf_line(walls.next(), {}));
}

void cwlf_covariance_alone(benchmark::State& state, quoin::CovarianceMode mode) {
  Walls walls(points_of(state));
  const quoin::Points& wall = walls.next();
  const quoin::AxisRegression line = quoin::cwlf_line(wall, {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(quoin::cwlf_covariance(wall, {}, line, mode));
  }
}

void arras_siegwart_line_alone(benchmark::State& state) {
  Walls walls(points_of(state));
  for (auto _ : state) benchmark::DoNotOptimize(quoin::arras_siegwart_line(walls.next()));
}

void arras_siegwart_covariance_alone(benchmark::State& state) {
  Walls walls(points_of(state));
  const quoin::Points& wall = walls.next();
  const quoin::OrthogonalLine line = quoin::arras_siegwart_line(wall);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        quoin::arras_siegwart_covariance(wall, {}, line, quoin::CovarianceMode::propagated));
  }
}

void arras_siegwart_literal_line(benchmark::State& state) {
  Walls walls(points_of(state));
  for (auto _ : state) benchmark::DoNotOptimize(quoin::arras_siegwart_literal(walls.next(), {}));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int size : {100, 1000, 10000, 100000}) benchmark->Arg(size);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("eigen_covariance", eigen_covariance)->Apply(sizes);
  for (const quoin::MethodInfo& method : quoin::Fitters::descriptions()) {
    benchmark::RegisterBenchmark(("fit/" + method.name).c_str(), fit, method.name)->Apply(sizes);
  }
  benchmark::RegisterBenchmark("step/cwlf_line", cwlf_line_alone)->Arg(100);
  benchmark::RegisterBenchmark("step/cwlf_covariance", cwlf_covariance_alone,
                               quoin::CovarianceMode::propagated)
      ->Arg(100);
  benchmark::RegisterBenchmark("step/cwlf_covariance_as_published", cwlf_covariance_alone,
                               quoin::CovarianceMode::as_published)
      ->Arg(100);
  benchmark::RegisterBenchmark("step/arras_siegwart_line", arras_siegwart_line_alone)->Arg(100);
  benchmark::RegisterBenchmark("step/arras_siegwart_covariance", arras_siegwart_covariance_alone)
      ->Arg(100);
  benchmark::RegisterBenchmark("step/arras_siegwart_literal_line", arras_siegwart_literal_line)
      ->Arg(100)
      ->Arg(1000);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
