// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

namespace quoin::soak {

/// A method of a running service, or several parameters of one.
struct Swap {
  std::string service;  ///< label
  std::string method;
};

/// What a run is made of.
struct Scenario {
  std::string tool;  ///< the program that knows the kinds
  /// Services of the deployments between which the run goes to and fro, the first one at the start.
  std::vector<std::string> compositions;
  std::vector<std::string> listened;  ///< services that give corners and are always there
  std::string visited;                ///< one of them
  std::vector<Swap> swaps;
  /// What may die up to some part of the run lives on from then, so that its memory tells
  /// something.
  std::set<std::string> spared;
  /// Source, segmentation and line fitting that a hostile neighbour speaks for; none: nobody does.
  std::vector<std::string> attacked = {};
};

/// Of the shipped kinds: all compositions have the source, the segmentation, a fitter with a
/// standby and the corners of `steady`; they differ in fitters beside it, in methods, and in what
/// `second` reads. Beside them a LiDAR whose line loses, repeats and damages what it sends.
[[nodiscard]] Scenario shipped_kinds();

/// With the kinds of tests/kinds: joins, outputs at their own rate, state, an observer. The
/// compositions differ in QoS, so that all is replaced, and in what the joins read.
[[nodiscard]] Scenario test_kinds();

/// The services of side_by_side.yaml, in one process, in several, and each in its own.
[[nodiscard]] Scenario composed_stages();

}  // namespace quoin::soak
