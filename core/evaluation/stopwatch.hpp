// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace quoin {

/// Time [s] that one call takes: the best of several runs of at least `run_time` [s] each, because
/// whatever else the machine does makes a run only longer.
[[nodiscard]] double seconds_per_call(const std::function<void()>& function,
                                      double run_time = 0.002);

}  // namespace quoin
