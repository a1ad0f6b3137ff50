// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

/// Presets of Quoin, as far as another DDS must know them: reliability, durability
/// and data representation have to fit the other side, the depth of the history is each side's own.
typedef enum QosPreset {
  QOS_SENSOR,   // scans
  QOS_FEATURE,  // segments, lines, corners, circles, odometry, pose
  QOS_STATE     // keyed topics, line_map and status: a late reader gets the latest of every key
} QosPreset;

/// To be deleted with dds_delete_qos().
dds_qos_t* quoin_qos(QosPreset preset);

/// Joins the domain that `text` names; how is up to CYCLONEDDS_URI. Ends the program with a text
/// when that is not possible.
dds_entity_t join_domain(const char* text);

/// The entity, or the end of the program with a text that names `what`.
dds_entity_t made(dds_entity_t entity, const char* what);

/// A positive number that fits an int32_t, or the end of the program with a text.
int32_t positive_number(const char* text, const char* what);
