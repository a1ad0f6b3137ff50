// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/// Writes JSON on one line. `name` is that of a member of an object, NULL for an element of an
/// array. Numbers come back exactly; those that JSON cannot express become null.
typedef struct JsonWriter {
  FILE* file;
  bool has_predecessor;  // a comma is due before the next value
} JsonWriter;

void json_begin_object(JsonWriter* writer, const char* name);
void json_end_object(JsonWriter* writer);
void json_begin_array(JsonWriter* writer, const char* name);
void json_end_array(JsonWriter* writer);
void json_double(JsonWriter* writer, const char* name, double value);
/// The shortest decimal that is this float.
void json_float(JsonWriter* writer, const char* name, float value);
void json_unsigned(JsonWriter* writer, const char* name, uint64_t value);
void json_signed(JsonWriter* writer, const char* name, int64_t value);
void json_bool(JsonWriter* writer, const char* name, bool value);
void json_string(JsonWriter* writer, const char* name, const char* value);
