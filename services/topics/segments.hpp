// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Scan.h>
#include <idl/Segments.h>
#include <vector>

#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin::topics {

[[nodiscard]] SensorModel sensor_model(const msg::SensorModel& message);
[[nodiscard]] msg::SensorModel sensor_model_message(const SensorModel& model);

/// Everything but the header. The foreign points have been set aside.
void fill_segments(const msg::Scan& scan, const Points& points, const Segmentation& found,
                   msg::Segments& out);

/// True when every range of the message lies inside its points; any program may have sent it.
[[nodiscard]] bool valid(const msg::Segments& message);

}  // namespace quoin::topics
