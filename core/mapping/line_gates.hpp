// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace quoin {

inline constexpr double line_gate = 13.815510557964274;  ///< chi square of 2, 99.9 %
inline constexpr double widest_offset = 0.30;     ///< [m] standard deviation of an innovation
inline constexpr double widest_direction = 0.10;  ///< [rad] the same

}  // namespace quoin
