// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace quoin {

/// The step [m] that ranges [m] are whole multiples of, from 0.1 mm up; 0 when there is none, or
/// when they are too few to show it.
[[nodiscard]] double quantization_step(std::span<const float> ranges);

}  // namespace quoin
