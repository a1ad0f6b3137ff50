// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <foxglove/foxglove.pb.h>
#include <idl/Scan.h>
#include <idl/Segments.h>

namespace quoin::topics {

/// The scan as evenly spaced rays. False when they are not: a bearing that is off by more than a
/// tenth of the spacing would be shown in a wrong place. Its points are shown all the same.
bool show_rays(const msg::Scan& scan, foxglove::LaserScan& out);

/// All rays with a finite range: x, y, z [m] and, where the scan has it, the quality.
bool show_points(const msg::Scan& scan, foxglove::PointCloud& out);

/// The points with the number of their segment; -1 of none, and -2 - n of arc n.
bool show_segments(const msg::Segments& message, foxglove::PointCloud& out);

}  // namespace quoin::topics
