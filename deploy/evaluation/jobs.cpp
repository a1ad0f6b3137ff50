// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/jobs.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace quoin::deploy {

namespace {

constexpr std::chrono::milliseconds progress_period{100};

/// What the threads share.
struct Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t next = 0;      // job to begin
  std::size_t finished = 0;  // threads that found nothing to begin
  JobProgress progress;
  std::exception_ptr failure;
};

void work(const std::vector<Job>& jobs, Shared& shared, std::stop_source& stop) {
  std::unique_lock lock(shared.mutex);
  while (shared.next < jobs.size() && !stop.stop_requested()) {
    const std::size_t index = shared.next++;
    shared.progress.name = jobs[index].name;
    lock.unlock();
    std::exception_ptr failure;
    try {
      jobs[index].run(stop.get_token());
    } catch (...) {
      failure = std::current_exception();
      stop.request_stop();
    }
    lock.lock();
    if (failure && !shared.failure) shared.failure = failure;
    shared.progress.done[index] = failure == nullptr;
  }
  ++shared.finished;
  shared.changed.notify_all();
}

}  // namespace

void run_jobs(const std::vector<Job>& jobs, std::size_t threads,
              const std::function<bool(const JobProgress&)>& proceed) {
  Shared shared;
  shared.progress.done.resize(jobs.size(), false);
  std::stop_source stop;
  bool interrupted = false;
  {
    const std::size_t count =
        std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(1, jobs.size()));
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < count; ++i) {
      workers.emplace_back([&] { work(jobs, shared, stop); });
    }
    std::unique_lock lock(shared.mutex);
    for (bool last = false; !last;) {
      last =
          shared.changed.wait_for(lock, progress_period, [&] { return shared.finished == count; });
      const JobProgress progress = shared.progress;
      lock.unlock();
      if (!interrupted && !proceed(progress)) {
        interrupted = true;
        stop.request_stop();
      }
      lock.lock();
    }
  }
  if (interrupted) throw Interrupted();
  if (shared.failure) std::rethrow_exception(shared.failure);
}

std::uint64_t derived_seed(std::uint64_t seed, std::string_view identity) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char character : identity) {
    hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3U;
  }
  // The finalizer of splitmix64: seeds that differ in one bit must not give similar streams.
  std::uint64_t mixed = hash + 0x9e3779b97f4a7c15U * (seed + 1);
  mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9U;
  mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebU;
  return mixed ^ (mixed >> 31U);
}

Fitter stoppable(Fitter fitter, std::stop_token stop) {
  return [fitter = std::move(fitter), stop = std::move(stop)](const PointsView& points,
                                                              const SensorModel& sensor) {
    if (stop.stop_requested()) throw Interrupted();
    return fitter(points, sensor);
  };
}

Segmenter stoppable(Segmenter segmenter, std::stop_token stop) {
  return [segmenter = std::move(segmenter), stop = std::move(stop)](
             const PointsView& points, const SensorModel& sensor, Segmentation& found) mutable {
    if (stop.stop_requested()) throw Interrupted();
    segmenter(points, sensor, found);
  };
}

}  // namespace quoin::deploy
