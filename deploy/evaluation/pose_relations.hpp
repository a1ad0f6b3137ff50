// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/evaluation/mapping_quality.hpp"

namespace quoin::deploy {

/// Verified relations as of Kuemmerle et al. 2009, a line "t1 t2 x y z roll pitch yaw" each, plain
/// or gzip compressed; `offset` [s] is taken from both stamps. Throws ScanFileError.
[[nodiscard]] std::vector<PoseRelation> read_pose_relations(const std::filesystem::path& file,
                                                            double offset);

}  // namespace quoin::deploy
