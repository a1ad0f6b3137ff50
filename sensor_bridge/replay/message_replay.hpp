// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "sensor_bridge/recordings/parameters.hpp"
#include "services/runtime/process/source.hpp"

namespace quoin::sensor_bridge {

/// Whether something else than scans is to be published. Throws ParameterError for a type of
/// `messages` that is not replayed.
[[nodiscard]] bool replays_messages(const ReplayParameters& parameters);

/// Opens the recordings of ours and returns the body that publishes their messages of the types
/// asked for, in the order and at the pace of their recording. They are as they were recorded, with
/// the replay as their source: origins and trace begin with it. Stamps are those of the recording
/// too (`stamps: recorded`), or those of the publication; messages with the same stamp in the
/// recording get the same. Throws ParameterError or ScanFileError; the body throws
/// runtime::SourceError where a file turns bad, once all messages before are published.
[[nodiscard]] std::function<void(runtime::Source&)> open_message_replay(
    const ReplayParameters& parameters, const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge
