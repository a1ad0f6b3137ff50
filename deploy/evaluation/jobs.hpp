// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/fitting/fit.hpp"
#include "core/segmentation/segment.hpp"

namespace quoin::deploy {

/// Somebody asked for the end of the evaluation.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// A piece of work that depends on no other. It writes to a place of its own.
struct Job {
  std::string name;  ///< what is being computed, for the progress
  /// Throws Interrupted soon after a stop has been requested.
  std::function<void(const std::stop_token&)> run;
};

struct JobProgress {
  std::vector<bool> done;  ///< for each job
  std::string name;        ///< of the job last begun
};

/// Runs all jobs on `threads` threads. `proceed` is called on the calling thread several times a
/// second with which jobs are done and the name of the last one begun; when it returns false the
/// jobs are stopped and Interrupted is thrown. The first exception of a job ends all and is thrown.
void run_jobs(const std::vector<Job>& jobs, std::size_t threads,
              const std::function<bool(const JobProgress&)>& proceed);

/// A seed for the experiment called `identity`, so that its numbers depend neither on the other
/// experiments nor on the order in which they run. Experiments that are to see the same noise (one
/// per method) have the same identity.
[[nodiscard]] std::uint64_t derived_seed(std::uint64_t seed, std::string_view identity);

/// The same method, throwing Interrupted when a stop has been requested.
[[nodiscard]] Fitter stoppable(Fitter fitter, std::stop_token stop);
[[nodiscard]] Segmenter stoppable(Segmenter segmenter, std::stop_token stop);

}  // namespace quoin::deploy
