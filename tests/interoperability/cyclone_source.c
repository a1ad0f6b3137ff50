// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Publishes scans of a rectangular room with Cyclone DDS: in place of a source of Quoin, or as a
// program that knows only the type of its messages.
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "Scan.h"
#include "cyclone_endpoint.h"

enum { rays = 720 };

static const double pi = 3.14159265358979323846;

// Walls of the room, as seen from the sensor [m].
static const double wall_front = 2.5;
static const double wall_left = 1.25;
static const double wall_back = -1.5;
static const double wall_right = -1.75;

/// Range [m] of the wall in direction `bearing` [rad].
static double range_of_room(double bearing) {
  const double x = cos(bearing);
  const double y = sin(bearing);
  return fmin((x >= 0.0 ? wall_front : wall_back) / x, (y >= 0.0 ? wall_left : wall_right) / y);
}

static int64_t now(void) { return dds_time(); }  // [ns since the Unix epoch]

static void fill_rays(float* bearings, float* ranges) {
  for (int i = 0; i < rays; ++i) {
    // Half a step off the axes, so that no ray runs along a wall's normal to infinity.
    const double bearing = 2.0 * pi * (i + 0.5) / rays - pi;
    bearings[i] = (float)bearing;
    ranges[i] = (float)range_of_room(bearing);
  }
  // What REP-117 says of rays without a range.
  ranges[10] = INFINITY;
  ranges[11] = -INFINITY;
  ranges[12] = NAN;
}

/// Waits until `count` readers are there; what is written before that is lost.
static void wait_for_readers(dds_entity_t writer, uint32_t count) {
  const dds_entity_t wait_set = made(dds_create_waitset(dds_get_participant(writer)), "a wait set");
  dds_set_status_mask(writer, DDS_PUBLICATION_MATCHED_STATUS);
  dds_waitset_attach(wait_set, writer, 0);
  dds_publication_matched_status_t matched;
  while (dds_get_publication_matched_status(writer, &matched) == DDS_RETCODE_OK &&
         matched.current_count < count) {
    dds_waitset_wait(wait_set, NULL, 0, DDS_INFINITY);
  }
  dds_delete(wait_set);
}

/// What to publish, and how.
typedef struct Task {
  char topic[256];
  char* service;  // that the header names; NULL: the header is left to the readers
  int32_t count;
  int32_t readers;
  int32_t rate;  // [Hz]
  bool best_effort;
} Task;

static const char* const usage =
    "usage: %s DOMAIN NAMESPACE SERVICE COUNT READERS\npublishes COUNT scans at 20 Hz as "
    "NAMESPACE/SERVICE/scan once READERS are there\n"
    "       %s DOMAIN TOPIC COUNT READERS RATE sensor|best_effort [SERVICE]\nas a topic of any "
    "name; "
    "without SERVICE origin and trace of the headers are left empty\n";

static void set_topic(Task* task, const char* name_space, const char* rest, const char* last) {
  const int length = snprintf(task->topic, sizeof task->topic, "%s%s%s", name_space, rest, last);
  if (length >= 0 && (size_t)length < sizeof task->topic) return;
  fprintf(stderr, "the name of the topic is too long\n");
  exit(2);
}

static Task task_of(int argc, char** argv) {
  Task task = {.rate = 20};
  if (argc == 6) {
    task.service = argv[3];
    task.count = positive_number(argv[4], "the count");
    task.readers = positive_number(argv[5], "the number of readers");
    char rest[128];
    if (snprintf(rest, sizeof rest, "/%s", argv[3]) >= (int)sizeof rest) rest[0] = '\0';
    set_topic(&task, argv[2], rest, "/scan");
  } else if (argc == 7 || argc == 8) {
    set_topic(&task, argv[2], "", "");
    task.count = positive_number(argv[3], "the count");
    task.readers = positive_number(argv[4], "the number of readers");
    task.rate = positive_number(argv[5], "the rate");
    task.best_effort = strcmp(argv[6], "best_effort") == 0;
    if (argc == 8) task.service = argv[7];
  } else {
    fprintf(stderr, usage, argv[0], argv[0]);
    exit(2);
  }
  return task;
}

int main(int argc, char** argv) {
  const Task task = task_of(argc, argv);
  const dds_entity_t participant = join_domain(argv[1]);
  const dds_entity_t topic =
      made(dds_create_topic(participant, &quoin_msg_Scan_desc, task.topic, NULL, NULL), task.topic);
  dds_qos_t* qos = quoin_qos(QOS_SENSOR);
  if (task.best_effort) dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  const dds_entity_t writer = made(dds_create_writer(participant, topic, qos, NULL), task.topic);
  dds_delete_qos(qos);

  float bearings[rays];
  float ranges[rays];
  fill_rays(bearings, ranges);
  // The source's entry in the trace. Its incarnation tells a restarted source from the one before.
  quoin_msg_StageTrace trace = {
      .service = task.service, .input = "", .method = "", .incarnation = (uint64_t)now()};
  quoin_msg_Origin origin = {.source = task.service, .incarnation = trace.incarnation, .parts = 1};
  quoin_msg_Scan scan = {
      .header = {.origins = {._maximum = 1, ._length = 1, ._buffer = &origin},
                 .frame = "laser",
                 .trace = {._maximum = 1, ._length = 1, ._buffer = &trace}},
      .sensor_model = {.range_stddev = 0.010, .bearing_stddev = 0.0, .range_bias_stddev = 0.0},
      .range_min = 0.1F,
      .range_max = 40.0F,
      .duration = 0.05F,
      .bearings = {._maximum = rays, ._length = rays, ._buffer = bearings},
      .ranges = {._maximum = rays, ._length = rays, ._buffer = ranges},
  };
  if (task.service == NULL) {
    scan.header.origins._length = 0;
    scan.header.trace._length = 0;
  }
  wait_for_readers(writer, (uint32_t)task.readers);
  for (int32_t i = 0; i < task.count; ++i) {
    scan.header.stamp = now();
    dds_sleepfor(DDS_SECS(1) / task.rate);  // the revolution
    origin.sequence_number = (uint64_t)i;
    trace.index = (uint64_t)i;
    trace.received = trace.published = now();
    const dds_return_t written = dds_write(writer, &scan);
    if (written != DDS_RETCODE_OK) {
      fprintf(stderr, "cannot write to %s: %s\n", task.topic, dds_strretcode(written));
      return 1;
    }
  }
  // What has been written must reach the readers before the writer goes.
  if (dds_wait_for_acks(writer, DDS_SECS(5)) != DDS_RETCODE_OK) {
    fprintf(stderr, "not all readers have acknowledged the last scans\n");
    return 1;
  }
  return dds_delete(participant) == DDS_RETCODE_OK ? 0 : 1;
}
