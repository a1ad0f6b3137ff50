// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <string>

namespace quoin::topics {

// One line for people: number and stamp of the scan, time since the scan was published, content.
[[nodiscard]] std::string to_text(const msg::Scan& message);
[[nodiscard]] std::string to_text(const msg::Segments& message);
[[nodiscard]] std::string to_text(const msg::Lines& message);
[[nodiscard]] std::string to_text(const msg::Corners& message);

}  // namespace quoin::topics
