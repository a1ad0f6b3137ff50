// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What a circle with its covariance costs, over one pass of a plain loop over the same points that
// makes their mean and 2x2 scatter, in one run:
//   taskset -c 1 circle_benchmark [POINTS]
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/circles/circle_fitters.hpp"
#include "core/evaluation/fit_timing.hpp"
#include "core/statistics/order_statistics.hpp"

namespace {

constexpr int rounds = 15;

struct Scatter {
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};

[[gnu::noinline]] Scatter plain_loop(const double* x, const double* y, std::size_t count) {
  Scatter s;
  for (std::size_t i = 0; i < count; ++i) {
    s.mean_x += x[i];
    s.mean_y += y[i];
  }
  s.mean_x /= static_cast<double>(count);
  s.mean_y /= static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = x[i] - s.mean_x;
    const double dy = y[i] - s.mean_y;
    s.xx += dx * dx;
    s.xy += dx * dy;
    s.yy += dy * dy;
  }
  return s;
}

double seconds_of_loop(const std::vector<quoin::Points>& columns) {
  [[maybe_unused]] volatile double sink = 0.0;
  const double seconds = quoin::seconds_per_call([&] {
    for (const quoin::Points& points : columns) {
      const Scatter s = plain_loop(points.x.data(), points.y.data(), points.size());
      sink = s.xx + s.xy + s.yy;
    }
  });
  return seconds / static_cast<double>(columns.size());
}

}  // namespace

int main(int argc, char** argv) {
  const auto points = static_cast<std::size_t>(argc > 1 ? std::atol(argv[1]) : 100);
  if (points < 3) {
    std::fprintf(stderr, "usage: %s [POINTS], at least 3\n", argv[0]);
    return 2;
  }
  const std::vector<quoin::Points> columns = quoin::timing_columns(points);
  std::printf("%zu points      time [ns]  over plain loop  over Eigen's covariance\n", points);
  for (const quoin::MethodInfo& method : quoin::CircleFitters::descriptions()) {
    const auto fitter = quoin::CircleFitters::make<quoin::CircleFitter>(method.name, {});
    std::vector<double> times;
    std::vector<double> over_loop;
    std::vector<double> over_eigen;
    for (int round = 0; round < rounds; ++round) {  // in turn: the machine changes its speed
      const double loop = seconds_of_loop(columns);
      const double time = quoin::seconds_per_fit(fitter, columns);
      times.push_back(1e9 * time);
      over_loop.push_back(time / loop);
      over_eigen.push_back(time / quoin::seconds_per_plain_covariance(columns));
    }
    std::printf("%-18s %6.0f  %15.2f  %23.2f\n", method.name.c_str(),
                quoin::median(std::move(times)), quoin::median(std::move(over_loop)),
                quoin::median(std::move(over_eigen)));
  }
  return 0;
}
