// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/points.hpp"

namespace quoin {

void Points::resize(std::size_t count) {
  range.resize(count);
  bearing.resize(count);
  inverse_range.resize(count);
  cosine.resize(count);
  sine.resize(count);
  x.resize(count);
  y.resize(count);
}

}  // namespace quoin
