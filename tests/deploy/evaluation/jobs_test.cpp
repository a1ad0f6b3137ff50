// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/jobs.hpp"

#include <atomic>
#include <set>
#include <thread>

#include <gtest/gtest.h>

namespace quoin::deploy {
namespace {

bool always(const JobProgress&) { return true; }

TEST(Jobs, AllAreRunOnceByAnyNumberOfThreads) {
  for (const std::size_t threads : {1U, 3U, 50U}) {
    std::vector<std::atomic<int>> runs(20);
    std::vector<Job> jobs;
    for (auto& run : runs) {
      jobs.push_back({"job", [&run](const std::stop_token&) { ++run; }});
    }
    std::vector<bool> done;
    run_jobs(jobs, threads, [&](const JobProgress& progress) {
      done = progress.done;
      return true;
    });
    for (const auto& run : runs) EXPECT_EQ(run, 1);
    EXPECT_EQ(done, std::vector<bool>(20, true));
  }
  EXPECT_NO_THROW(run_jobs({}, 2, always));
}

TEST(Jobs, AnExceptionEndsAllAndIsThrown) {
  std::atomic<int> after = 0;
  std::vector<Job> jobs{
      {"fails", [](const std::stop_token&) { throw std::runtime_error("no room"); }}};
  jobs.push_back({"waits", [&](const std::stop_token& stop) {
                    while (!stop.stop_requested()) std::this_thread::yield();
                  }});
  for (int i = 0; i < 10; ++i) jobs.push_back({"later", [&](const auto&) { ++after; }});
  EXPECT_THROW(run_jobs(jobs, 1, always), std::runtime_error);
  EXPECT_EQ(after, 0);
  EXPECT_THROW(run_jobs(jobs, 2, always), std::runtime_error);
}

TEST(Jobs, EndWhenTheyAreNotToProceed) {
  std::atomic<int> later = 0;
  std::vector<Job> jobs{
      {"endless",
       [](const std::stop_token& stop) {
         const Fitter fitter =
             stoppable([](const PointsView&, const SensorModel&) { return FitResult{}; }, stop);
         while (true) (void)fitter({}, {});
       }},
      {"later", [&](const auto&) { ++later; }}};
  EXPECT_THROW(run_jobs(jobs, 1, [](const JobProgress&) { return false; }), Interrupted);
  EXPECT_EQ(later, 0);
}

TEST(Jobs, MethodsStopWhenTheyAreTold) {
  std::stop_source stop;
  const Segmenter segmenter = stoppable(
      [](const PointsView&, const SensorModel&, Segmentation& found) {
        found.segments = {{0, 7}};
      },
      stop.get_token());
  Segmentation found;
  segmenter({}, {}, found);
  EXPECT_EQ(found.segments.size(), 1U);
  stop.request_stop();
  EXPECT_THROW(segmenter({}, {}, found), Interrupted);
}

TEST(DerivedSeed, DiffersBySeedAndIdentity) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (const char* identity : {"a", "b", "ab", "ba", ""}) {
      seeds.insert(derived_seed(seed, identity));
    }
  }
  EXPECT_EQ(seeds.size(), 250U);
  EXPECT_EQ(derived_seed(7, "loop"), derived_seed(7, "loop"));
}

}  // namespace
}  // namespace quoin::deploy
