// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/parameters/method_list.hpp"
#include "core/segmentation/expectation_maximization.hpp"
#include "core/segmentation/hierarchical.hpp"
#include "core/segmentation/hough.hpp"
#include "core/segmentation/iepf.hpp"
#include "core/segmentation/line_regression.hpp"
#include "core/segmentation/line_tracking.hpp"
#include "core/segmentation/ransac.hpp"
#include "core/segmentation/split_and_merge.hpp"
#include "core/segmentation/successive_edge_following.hpp"

namespace quoin {

/// All segmenters, the default first.
using Segmenters = MethodList<Iepf, SplitAndMerge, SuccessiveEdgeFollowing, LineTracking,
                              LineRegression, Ransac, Hough, ExpectationMaximization, Hierarchical>;

}  // namespace quoin
