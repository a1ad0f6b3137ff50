// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace quoin::soak {

/// Services of the deployments between which the run goes to and fro, the first one at the start:
/// all have the source, the segmentation, a fitter with a standby and the corners of `steady`; they
/// differ in fitters beside it, in methods, and in what `second` reads.
[[nodiscard]] std::vector<std::string> compositions();

}  // namespace quoin::soak
