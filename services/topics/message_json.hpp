// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>

#include <nlohmann/json_fwd.hpp>

namespace quoin::topics {

// Messages with all their fields under the names of the IDL. Numbers that JSON cannot express
// (ranges that are infinite or not a number) become null.
[[nodiscard]] nlohmann::ordered_json to_json(const msg::Scan& message);
[[nodiscard]] nlohmann::ordered_json to_json(const msg::Segments& message);
[[nodiscard]] nlohmann::ordered_json to_json(const msg::Lines& message);
[[nodiscard]] nlohmann::ordered_json to_json(const msg::Corners& message);

}  // namespace quoin::topics
