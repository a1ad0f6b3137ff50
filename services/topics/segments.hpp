// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Scan.h>
#include <idl/Segments.h>
#include <vector>

#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin::topics {

/// With the noise that ranges have at least.
[[nodiscard]] SensorModel sensor_model(const msg::SensorModel& message);
[[nodiscard]] msg::SensorModel sensor_model_message(const SensorModel& model);

/// True when every range of the message lies inside its points. What Reader takes is
/// (MessageCheck); bytes of a raw reader or a recording may be anything.
[[nodiscard]] bool valid(const msg::Segments& message);

/// Everything but the header. The foreign points have been set aside.
void fill_segments(const msg::Scan& scan, const Points& points, const Segmentation& found,
                   msg::Segments& out);

}  // namespace quoin::topics
