// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Circles.h"
#include "Corners.h"
#include "LineMap.h"
#include "Lines.h"
#include "Odometry.h"
#include "Pose.h"
#include "Scan.h"
#include "Segments.h"
#include "Status.h"
#include "json_writer.h"

// Messages with all their fields under the names of the IDL.
void write_scan(JsonWriter* writer, const char* name, const quoin_msg_Scan* scan);
void write_segments(JsonWriter* writer, const char* name, const quoin_msg_Segments* segments);
void write_lines(JsonWriter* writer, const char* name, const quoin_msg_Lines* lines);
void write_corners(JsonWriter* writer, const char* name, const quoin_msg_Corners* corners);
void write_circles(JsonWriter* writer, const char* name, const quoin_msg_Circles* circles);
void write_odometry(JsonWriter* writer, const char* name, const quoin_msg_Odometry* odometry);
void write_pose(JsonWriter* writer, const char* name, const quoin_msg_Pose* pose);
void write_line_map(JsonWriter* writer, const char* name, const quoin_msg_LineMap* map);
/// What identifies the service, its state and its counts.
void write_status(JsonWriter* writer, const char* name, const quoin_msg_ServiceStatus* status);
