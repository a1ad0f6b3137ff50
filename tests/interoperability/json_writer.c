// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "json_writer.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

static void quote(FILE* file, const char* text) {
  fputc('"', file);
  for (; *text != '\0'; ++text) {
    const unsigned char character = (unsigned char)*text;
    if (character == '"' || character == '\\') {
      fprintf(file, "\\%c", character);
    } else if (character < 0x20) {
      fprintf(file, "\\u%04x", character);
    } else {
      fputc(character, file);
    }
  }
  fputc('"', file);
}

static void begin_value(JsonWriter* writer, const char* name) {
  if (writer->has_predecessor) fputc(',', writer->file);
  if (name != NULL) {
    quote(writer->file, name);
    fputc(':', writer->file);
  }
  writer->has_predecessor = true;
}

static void begin_container(JsonWriter* writer, const char* name, char bracket) {
  begin_value(writer, name);
  fputc(bracket, writer->file);
  writer->has_predecessor = false;
}

static void end_container(JsonWriter* writer, char bracket) {
  fputc(bracket, writer->file);
  writer->has_predecessor = true;
}

void json_begin_object(JsonWriter* writer, const char* name) { begin_container(writer, name, '{'); }
void json_end_object(JsonWriter* writer) { end_container(writer, '}'); }
void json_begin_array(JsonWriter* writer, const char* name) { begin_container(writer, name, '['); }
void json_end_array(JsonWriter* writer) { end_container(writer, ']'); }

void json_double(JsonWriter* writer, const char* name, double value) {
  begin_value(writer, name);
  if (isfinite(value)) {
    fprintf(writer->file, "%.*g", DBL_DECIMAL_DIG, value);
  } else {
    fputs("null", writer->file);
  }
}

void json_float(JsonWriter* writer, const char* name, float value) {
  begin_value(writer, name);
  if (!isfinite(value)) {
    fputs("null", writer->file);
    return;
  }
  char text[32];
  for (int digits = 1; digits <= FLT_DECIMAL_DIG; ++digits) {
    snprintf(text, sizeof text, "%.*g", digits, (double)value);
    if (strtof(text, NULL) == value) break;
  }
  fputs(text, writer->file);
}

void json_unsigned(JsonWriter* writer, const char* name, uint64_t value) {
  begin_value(writer, name);
  fprintf(writer->file, "%" PRIu64, value);
}

void json_signed(JsonWriter* writer, const char* name, int64_t value) {
  begin_value(writer, name);
  fprintf(writer->file, "%" PRId64, value);
}

void json_bool(JsonWriter* writer, const char* name, bool value) {
  begin_value(writer, name);
  fputs(value ? "true" : "false", writer->file);
}

void json_string(JsonWriter* writer, const char* name, const char* value) {
  begin_value(writer, name);
  quote(writer->file, value);
}
