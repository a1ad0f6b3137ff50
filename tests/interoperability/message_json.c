// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "message_json.h"

static void write_floats(JsonWriter* writer, const char* name, const dds_sequence_float* values) {
  json_begin_array(writer, name);
  for (uint32_t i = 0; i < values->_length; ++i) json_float(writer, NULL, values->_buffer[i]);
  json_end_array(writer);
}

static void write_header(JsonWriter* writer, const quoin_msg_Header* header) {
  json_begin_object(writer, "header");
  json_begin_array(writer, "origins");
  for (uint32_t i = 0; i < header->origins._length; ++i) {
    const quoin_msg_Origin* origin = &header->origins._buffer[i];
    json_begin_object(writer, NULL);
    json_string(writer, "source", origin->source);
    json_unsigned(writer, "incarnation", origin->incarnation);
    json_unsigned(writer, "sequence_number", origin->sequence_number);
    json_unsigned(writer, "part", origin->part);
    json_unsigned(writer, "parts", origin->parts);
    json_end_object(writer);
  }
  json_end_array(writer);
  json_signed(writer, "stamp", header->stamp);
  json_string(writer, "frame", header->frame);
  json_begin_array(writer, "trace");
  for (uint32_t i = 0; i < header->trace._length; ++i) {
    const quoin_msg_StageTrace* stage = &header->trace._buffer[i];
    json_begin_object(writer, NULL);
    json_string(writer, "service", stage->service);
    json_string(writer, "input", stage->input);
    json_string(writer, "method", stage->method);
    json_unsigned(writer, "incarnation", stage->incarnation);
    json_unsigned(writer, "index", stage->index);
    json_signed(writer, "received", stage->received);
    json_signed(writer, "published", stage->published);
    json_end_object(writer);
  }
  json_end_array(writer);
  json_end_object(writer);
}

static void write_sensor_model(JsonWriter* writer, const quoin_msg_SensorModel* model) {
  json_begin_object(writer, "sensor_model");
  json_double(writer, "range_stddev", model->range_stddev);
  json_double(writer, "bearing_stddev", model->bearing_stddev);
  json_double(writer, "range_bias_stddev", model->range_bias_stddev);
  json_double(writer, "range_stddev_per_metre", model->range_stddev_per_metre);
  json_double(writer, "flatness_stddev", model->flatness_stddev);
  json_bool(writer, "estimated", model->estimated);
  json_end_object(writer);
}

static void write_point(JsonWriter* writer, const char* name, const quoin_msg_Point* point) {
  json_begin_object(writer, name);
  json_double(writer, "x", point->x);
  json_double(writer, "y", point->y);
  json_end_object(writer);
}

static void write_line(JsonWriter* writer, const quoin_msg_Line* line) {
  json_begin_object(writer, NULL);
  json_double(writer, "alpha", line->alpha);
  json_double(writer, "r", line->r);
  json_double(writer, "covariance_direction", line->covariance_direction);
  json_double(writer, "covariance_direction_offset", line->covariance_direction_offset);
  json_double(writer, "covariance_offset", line->covariance_offset);
  json_double(writer, "covariance_alpha", line->covariance_alpha);
  json_double(writer, "covariance_alpha_r", line->covariance_alpha_r);
  json_double(writer, "covariance_r", line->covariance_r);
  json_bool(writer, "gaussian", line->gaussian);
  write_point(writer, "start", &line->start);
  write_point(writer, "end", &line->end);
  json_unsigned(writer, "points", line->points);
  json_double(writer, "chi_square", line->chi_square);
  json_unsigned(writer, "segment", line->segment);
  json_end_object(writer);
}

static void write_corner(JsonWriter* writer, const quoin_msg_Corner* corner) {
  json_begin_object(writer, NULL);
  json_double(writer, "x", corner->x);
  json_double(writer, "y", corner->y);
  json_double(writer, "covariance_xx", corner->covariance_xx);
  json_double(writer, "covariance_xy", corner->covariance_xy);
  json_double(writer, "covariance_yy", corner->covariance_yy);
  json_double(writer, "ellipse_area", corner->ellipse_area);
  json_double(writer, "ellipse95_major", corner->ellipse95_major);
  json_double(writer, "ellipse95_minor", corner->ellipse95_minor);
  json_double(writer, "ellipse95_direction", corner->ellipse95_direction);
  json_double(writer, "angle", corner->angle);
  json_double(writer, "opening", corner->opening);
  json_double(writer, "gap", corner->gap);
  json_double(writer, "extrapolation", corner->extrapolation);
  json_bool(writer, "seen", corner->seen);
  json_unsigned(writer, "first_line", corner->first_line);
  json_unsigned(writer, "second_line", corner->second_line);
  json_end_object(writer);
}

void write_scan(JsonWriter* writer, const char* name, const quoin_msg_Scan* scan) {
  json_begin_object(writer, name);
  write_header(writer, &scan->header);
  write_sensor_model(writer, &scan->sensor_model);
  json_float(writer, "range_min", scan->range_min);
  json_float(writer, "range_max", scan->range_max);
  json_float(writer, "duration", scan->duration);
  write_floats(writer, "bearings", &scan->bearings);
  write_floats(writer, "ranges", &scan->ranges);
  write_floats(writer, "qualities", &scan->qualities);
  write_floats(writer, "time_offsets", &scan->time_offsets);
  json_end_object(writer);
}

static void write_ranges(JsonWriter* writer, const char* name, const quoin_msg_IndexRange* ranges,
                         uint32_t count) {
  json_begin_array(writer, name);
  for (uint32_t i = 0; i < count; ++i) {
    json_begin_object(writer, NULL);
    json_unsigned(writer, "begin", ranges[i].begin);
    json_unsigned(writer, "end", ranges[i].end);
    json_end_object(writer);
  }
  json_end_array(writer);
}

void write_segments(JsonWriter* writer, const char* name, const quoin_msg_Segments* segments) {
  json_begin_object(writer, name);
  write_header(writer, &segments->header);
  write_sensor_model(writer, &segments->sensor_model);
  json_unsigned(writer, "scan_points", segments->scan_points);
  write_floats(writer, "bearings", &segments->bearings);
  write_floats(writer, "ranges", &segments->ranges);
  write_ranges(writer, "segments", segments->segments._buffer, segments->segments._length);
  write_ranges(writer, "arcs", segments->arcs._buffer, segments->arcs._length);
  json_unsigned(writer, "set_aside", segments->set_aside);
  json_unsigned(writer, "no_return", segments->no_return);
  json_end_object(writer);
}

void write_lines(JsonWriter* writer, const char* name, const quoin_msg_Lines* lines) {
  json_begin_object(writer, name);
  write_header(writer, &lines->header);
  write_sensor_model(writer, &lines->sensor_model);
  json_string(writer, "covariance_mode", lines->covariance_mode);
  json_begin_array(writer, "lines");
  for (uint32_t i = 0; i < lines->lines._length; ++i) write_line(writer, &lines->lines._buffer[i]);
  json_end_array(writer);
  json_begin_array(writer, "failures");
  for (uint32_t i = 0; i < lines->failures._length; ++i) {
    json_begin_object(writer, NULL);
    json_unsigned(writer, "segment", lines->failures._buffer[i].segment);
    json_string(writer, "reason", lines->failures._buffer[i].reason);
    json_end_object(writer);
  }
  json_end_array(writer);
  json_end_object(writer);
}

void write_corners(JsonWriter* writer, const char* name, const quoin_msg_Corners* corners) {
  json_begin_object(writer, name);
  write_header(writer, &corners->header);
  json_string(writer, "covariance_mode", corners->covariance_mode);
  json_begin_array(writer, "corners");
  for (uint32_t i = 0; i < corners->corners._length; ++i) {
    write_corner(writer, &corners->corners._buffer[i]);
  }
  json_end_array(writer);
  json_begin_array(writer, "without");
  for (uint32_t i = 0; i < corners->without._length; ++i) {
    json_begin_object(writer, NULL);
    json_unsigned(writer, "first_line", corners->without._buffer[i].first_line);
    json_unsigned(writer, "second_line", corners->without._buffer[i].second_line);
    json_string(writer, "reason", corners->without._buffer[i].reason);
    json_end_object(writer);
  }
  json_end_array(writer);
  json_end_object(writer);
}

static void write_circle(JsonWriter* writer, const quoin_msg_Circle* circle) {
  json_begin_object(writer, NULL);
  json_double(writer, "x", circle->x);
  json_double(writer, "y", circle->y);
  json_double(writer, "radius", circle->radius);
  json_double(writer, "covariance_xx", circle->covariance_xx);
  json_double(writer, "covariance_xy", circle->covariance_xy);
  json_double(writer, "covariance_yy", circle->covariance_yy);
  json_double(writer, "covariance_x_radius", circle->covariance_x_radius);
  json_double(writer, "covariance_y_radius", circle->covariance_y_radius);
  json_double(writer, "covariance_radius", circle->covariance_radius);
  json_double(writer, "arc_start", circle->arc_start);
  json_double(writer, "arc_end", circle->arc_end);
  json_bool(writer, "concave", circle->concave);
  json_unsigned(writer, "points", circle->points);
  json_double(writer, "chi_square", circle->chi_square);
  json_double(writer, "nonlinearity", circle->nonlinearity);
  json_unsigned(writer, "arc", circle->arc);
  json_end_object(writer);
}

void write_circles(JsonWriter* writer, const char* name, const quoin_msg_Circles* circles) {
  json_begin_object(writer, name);
  write_header(writer, &circles->header);
  write_sensor_model(writer, &circles->sensor_model);
  json_begin_array(writer, "circles");
  for (uint32_t i = 0; i < circles->circles._length; ++i) {
    write_circle(writer, &circles->circles._buffer[i]);
  }
  json_end_array(writer);
  json_begin_array(writer, "failures");
  for (uint32_t i = 0; i < circles->failures._length; ++i) {
    json_begin_object(writer, NULL);
    json_unsigned(writer, "arc", circles->failures._buffer[i].arc);
    json_string(writer, "reason", circles->failures._buffer[i].reason);
    json_end_object(writer);
  }
  json_end_array(writer);
  json_end_object(writer);
}

static void write_pose_estimate(JsonWriter* writer, const quoin_msg_PoseEstimate* estimate) {
  json_begin_object(writer, "pose");
  json_double(writer, "x", estimate->x);
  json_double(writer, "y", estimate->y);
  json_double(writer, "theta", estimate->theta);
  json_double(writer, "covariance_xx", estimate->covariance_xx);
  json_double(writer, "covariance_xy", estimate->covariance_xy);
  json_double(writer, "covariance_yy", estimate->covariance_yy);
  json_double(writer, "covariance_x_theta", estimate->covariance_x_theta);
  json_double(writer, "covariance_y_theta", estimate->covariance_y_theta);
  json_double(writer, "covariance_theta", estimate->covariance_theta);
  json_end_object(writer);
}

void write_odometry(JsonWriter* writer, const char* name, const quoin_msg_Odometry* odometry) {
  json_begin_object(writer, name);
  write_header(writer, &odometry->header);
  json_string(writer, "child_frame", odometry->child_frame);
  write_pose_estimate(writer, &odometry->pose);
  json_bool(writer, "velocity_known", odometry->velocity_known);
  json_double(writer, "velocity_x", odometry->velocity_x);
  json_double(writer, "velocity_y", odometry->velocity_y);
  json_double(writer, "velocity_theta", odometry->velocity_theta);
  json_end_object(writer);
}

void write_pose(JsonWriter* writer, const char* name, const quoin_msg_Pose* pose) {
  static const char* const names[] = {"POSE_TRACKING", "POSE_AMBIGUOUS", "POSE_LOST"};
  json_begin_object(writer, name);
  write_header(writer, &pose->header);
  json_string(writer, "child_frame", pose->child_frame);
  write_pose_estimate(writer, &pose->pose);
  json_string(writer, "status", (unsigned)pose->status < 3 ? names[pose->status] : "unknown");
  json_double(writer, "weak_direction", pose->weak_direction);
  json_bool(writer, "odometry", pose->odometry);
  json_unsigned(writer, "lines", pose->lines);
  json_unsigned(writer, "matched", pose->matched);
  json_end_object(writer);
}

void write_line_map(JsonWriter* writer, const char* name, const quoin_msg_LineMap* map) {
  json_begin_object(writer, name);
  write_header(writer, &map->header);
  json_unsigned(writer, "part", map->part);
  json_unsigned(writer, "parts", map->parts);
  json_unsigned(writer, "begun", map->begun);
  json_unsigned(writer, "version", map->version);
  json_begin_array(writer, "lines");
  for (uint32_t i = 0; i < map->lines._length; ++i) {
    const quoin_msg_MapLine* line = &map->lines._buffer[i];
    json_begin_object(writer, NULL);
    json_unsigned(writer, "id", line->id);
    write_point(writer, "start", &line->start);
    write_point(writer, "end", &line->end);
    json_double(writer, "covariance_direction", line->covariance_direction);
    json_double(writer, "covariance_direction_offset", line->covariance_direction_offset);
    json_double(writer, "covariance_offset", line->covariance_offset);
    json_unsigned(writer, "observations", line->observations);
    json_end_object(writer);
  }
  json_end_array(writer);
  json_end_object(writer);
}

void write_status(JsonWriter* writer, const char* name, const quoin_msg_ServiceStatus* status) {
  json_begin_object(writer, name);
  json_string(writer, "service", status->service);
  json_string(writer, "kind", status->kind);
  json_string(writer, "method", status->method);
  json_string(writer, "host", status->host);
  json_string(writer, "version", status->version);
  json_string(writer, "dds", status->dds);
  json_unsigned(writer, "pid", status->pid);
  json_unsigned(writer, "state", status->state);
  json_unsigned(writer, "received", status->received);
  json_unsigned(writer, "published", status->published);
  json_unsigned(writer, "lost", status->lost);
  json_unsigned(writer, "upstream_lost", status->upstream_lost);
  json_end_object(writer);
}
