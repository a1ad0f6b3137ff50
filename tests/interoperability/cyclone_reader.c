// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads topics of Quoin with Cyclone DDS and prints each message as a line of JSON:
//   {"topic": "robot1/wctls/lines", "message": {...}}
// and on the standard error output how many writers each topic has: "robot1/wctls/lines: 1
// writers".
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cyclone_endpoint.h"
#include "message_json.h"

enum { max_topics = 64 };

// One per kind of topic, for messages of any type.
static void print_scan(JsonWriter* writer, const void* message) {
  write_scan(writer, "message", message);
}
static void print_segments(JsonWriter* writer, const void* message) {
  write_segments(writer, "message", message);
}
static void print_lines(JsonWriter* writer, const void* message) {
  write_lines(writer, "message", message);
}
static void print_corners(JsonWriter* writer, const void* message) {
  write_corners(writer, "message", message);
}
static void print_circles(JsonWriter* writer, const void* message) {
  write_circles(writer, "message", message);
}
static void print_odometry(JsonWriter* writer, const void* message) {
  write_odometry(writer, "message", message);
}
static void print_pose(JsonWriter* writer, const void* message) {
  write_pose(writer, "message", message);
}
static void print_line_map(JsonWriter* writer, const void* message) {
  write_line_map(writer, "message", message);
}
static void print_status(JsonWriter* writer, const void* message) {
  write_status(writer, "message", message);
}

typedef struct MessageKind {
  const char* ending;  // of the topic's name
  const dds_topic_descriptor_t* type;
  QosPreset qos;
  void (*print)(JsonWriter* writer, const void* message);
} MessageKind;

static const MessageKind kinds[] = {
    {"/scan", &quoin_msg_Scan_desc, QOS_SENSOR, print_scan},
    {"/segments", &quoin_msg_Segments_desc, QOS_FEATURE, print_segments},
    {"/lines", &quoin_msg_Lines_desc, QOS_FEATURE, print_lines},
    {"/corners", &quoin_msg_Corners_desc, QOS_FEATURE, print_corners},
    {"/circles", &quoin_msg_Circles_desc, QOS_FEATURE, print_circles},
    {"/odometry", &quoin_msg_Odometry_desc, QOS_FEATURE, print_odometry},
    {"/pose", &quoin_msg_Pose_desc, QOS_FEATURE, print_pose},
    {"/line_map", &quoin_msg_LineMap_desc, QOS_STATE, print_line_map},
    {"/status", &quoin_msg_ServiceStatus_desc, QOS_STATE, print_status},
};

typedef struct Subscription {
  const char* topic;
  const MessageKind* kind;
  dds_entity_t reader;
  int32_t received;
} Subscription;

static const MessageKind* kind_of(const char* topic) {
  const char* ending = strrchr(topic, '/');
  for (size_t i = 0; ending != NULL && i < sizeof kinds / sizeof kinds[0]; ++i) {
    if (strcmp(ending, kinds[i].ending) == 0) return &kinds[i];
  }
  fprintf(stderr, "'%s' ends in none of", topic);
  for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; ++i) {
    fprintf(stderr, " %s", kinds[i].ending);
  }
  fprintf(stderr, "\n");
  exit(2);
}

/// Tells when writers come and go: what a writer published before that is not for this reader.
static void tell_writers(dds_entity_t reader, const dds_subscription_matched_status_t status,
                         void* topic) {
  (void)reader;
  fprintf(stderr, "%s: %u writers\n", (const char*)topic, status.current_count);
}

static Subscription subscribe(dds_entity_t participant, dds_entity_t wait_set, const char* topic) {
  Subscription subscription = {topic, kind_of(topic), 0, 0};
  dds_qos_t* qos = quoin_qos(subscription.kind->qos);
  // The terminal may be slow; no message is to be overwritten before it is printed.
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  const dds_entity_t dds_topic =
      made(dds_create_topic(participant, subscription.kind->type, topic, NULL, NULL), topic);
  dds_listener_t* listener = dds_create_listener((void*)topic);
  dds_lset_subscription_matched(listener, tell_writers);
  subscription.reader = made(dds_create_reader(participant, dds_topic, qos, listener), topic);
  dds_delete_listener(listener);
  dds_delete_qos(qos);
  const dds_entity_t unread =
      made(dds_create_readcondition(subscription.reader, DDS_ANY_STATE), "a read condition");
  dds_waitset_attach(wait_set, unread, 0);
  return subscription;
}

/// Prints what has come, at most `count` messages in all.
static void take(Subscription* subscription, int32_t count) {
  void* sample = NULL;  // lent by the reader
  dds_sample_info_t info;
  while (dds_take(subscription->reader, &sample, &info, 1, 1) == 1) {
    // Other samples tell of instances that ended.
    if (info.valid_data && subscription->received < count) {
      JsonWriter writer = {stdout, false};
      json_begin_object(&writer, NULL);
      json_string(&writer, "topic", subscription->topic);
      subscription->kind->print(&writer, sample);
      json_end_object(&writer);
      fputc('\n', stdout);
      ++subscription->received;
    }
    dds_return_loan(subscription->reader, &sample, 1);
    sample = NULL;
  }
  fflush(stdout);
}

int main(int argc, char** argv) {
  if (argc < 4 || argc - 3 > max_topics) {
    fprintf(stderr,
            "usage: %s DOMAIN COUNT TOPIC...\nprints COUNT messages of each TOPIC as JSON, one a "
            "line; the end of its name (/scan, /lines, ...) tells the type\n",
            argv[0]);
    return 2;
  }
  const int32_t count = positive_number(argv[2], "the count");
  const dds_entity_t participant = join_domain(argv[1]);
  const dds_entity_t wait_set = made(dds_create_waitset(participant), "a wait set");
  Subscription subscriptions[max_topics];
  const int topics = argc - 3;
  for (int i = 0; i < topics; ++i) {
    subscriptions[i] = subscribe(participant, wait_set, argv[3 + i]);
  }
  int complete = 0;
  while (complete < topics) {
    dds_waitset_wait(wait_set, NULL, 0, DDS_INFINITY);
    complete = 0;
    for (int i = 0; i < topics; ++i) {
      take(&subscriptions[i], count);
      if (subscriptions[i].received >= count) ++complete;
    }
  }
  return dds_delete(participant) == DDS_RETCODE_OK ? 0 : 1;
}
