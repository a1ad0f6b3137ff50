// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Stands for the programs of ROS 2 beside a deployment: Cyclone DDS, as rmw_cyclonedds uses it, with types that ROS 2's
// own tool made of its message definitions, and the names, QoS and user data that rmw gives its endpoints.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../cyclone_endpoint.h"
#include "ros2.h"

static const struct Type {
  const char* name;  // as ROS 2 has it
  const char* dds_name;
  const dds_topic_descriptor_t* descriptor;
} types[] = {
#define TYPE(package, type)                                          \
  {#package "/msg/" #type, #package "::msg::dds_::" #type "_", &package##_msg_##type##_desc}
    TYPE(sensor_msgs, LaserScan),
    TYPE(visualization_msgs, MarkerArray),
    TYPE(geometry_msgs, PoseWithCovarianceStamped),
    TYPE(nav_msgs, Odometry),
    TYPE(nav_msgs, OccupancyGrid),
    TYPE(tf2_msgs, TFMessage),
    TYPE(diagnostic_msgs, DiagnosticArray),
    TYPE(quoin_msgs, Scan),
    TYPE(quoin_msgs, Segments),
    TYPE(quoin_msgs, Lines),
    TYPE(quoin_msgs, Corners),
    TYPE(quoin_msgs, Circles),
    TYPE(quoin_msgs, Odometry),
    TYPE(quoin_msgs, Pose),
    TYPE(quoin_msgs, LineMap),
};

static const char* const usage =
    "usage: %s write DOMAIN TOPIC best_effort|reliable READERS RATE COUNT [FILE]\n"
    "publishes COUNT LaserScans at RATE Hz once READERS are there: of a room, or one a line of FILE:\n"
    "FRAME[@SEC:NSEC] ANGLE_MIN ANGLE_MAX ANGLE_INCREMENT TIME_INCREMENT SCAN_TIME RANGE_MIN RANGE_MAX N RANGE... INTENSITY...\n"
    "       %s odometry DOMAIN TOPIC READERS RATE FILE\n"
    "publishes Odometry, best effort, one a line of FILE: FRAME[@SEC:NSEC] CHILD X Y QX QY QZ QW, the covariance\n"
    "XX XY YY XT YT TT, VX VY WZ and the first element of the covariance of the twist; - is an empty frame\n"
    "       %s read DOMAIN TOPIC PACKAGE/msg/TYPE best_effort|reliable|latched ...\n"
    "prints \"writer TOPIC TYPE USER_DATA\" for each writer that is matched and \"sample TOPIC CDR\" in\n"
    "hexadecimal digits for each message, until it is ended\n";

static const struct Type* type_named(const char* name) {
  for (size_t i = 0; i < sizeof types / sizeof types[0]; ++i) {
    if (strcmp(types[i].name, name) == 0) return &types[i];
  }
  fprintf(stderr, "no type %s\n", name);
  exit(2);
}

/// As rmw creates it: name and type of DDS.
static dds_entity_t create_topic(dds_entity_t participant, const char* name, const struct Type* type) {
  char dds_topic[256];
  snprintf(dds_topic, sizeof dds_topic, "rt%s", name);
  dds_topic_descriptor_t descriptor = *type->descriptor;
  descriptor.m_typename = type->dds_name;
  return made(dds_create_topic(participant, &descriptor, dds_topic, NULL, NULL), name);
}

/// Sensor data of REP-2003 (best effort), the default of ROS 2 (reliable), and that of maps.
static dds_qos_t* ros2_qos(const char* name) {
  dds_qos_t* qos = dds_create_qos();
  const bool best_effort = strcmp(name, "best_effort") == 0;
  const bool latched = strcmp(name, "latched") == 0;
  dds_qset_reliability(qos, best_effort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       DDS_SECS(1));
  dds_qset_durability(qos, latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, latched ? 1 : best_effort ? 5 : 10);
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos, 1, &representation);
  return qos;
}

static void print_writers(dds_entity_t reader, const char* topic) {
  dds_instance_handle_t writers[16];
  const dds_return_t count = dds_get_matched_publications(reader, writers, 16);
  for (int i = 0; i < count && i < 16; ++i) {
    dds_builtintopic_endpoint_t* writer = dds_get_matched_publication_data(reader, writers[i]);
    if (writer == NULL) continue;
    void* data = NULL;
    size_t size = 0;
    if (!dds_qget_userdata(writer->qos, &data, &size)) size = 0;
    printf("writer %s %s %.*s\n", topic, writer->type_name, (int)size, data == NULL ? "" : (char*)data);
    dds_free(data);
    dds_builtintopic_free_endpoint(writer);
  }
  fflush(stdout);
}

static void print_samples(dds_entity_t reader, const char* topic) {
  enum { most = 32 };
  struct ddsi_serdata* samples[most];
  dds_sample_info_t infos[most];
  const dds_return_t count = dds_takecdr(reader, samples, most, infos, DDS_ANY_STATE);
  for (int i = 0; i < count; ++i) {
    const uint32_t size = ddsi_serdata_size(samples[i]);
    unsigned char* bytes = malloc(size);
    ddsi_serdata_to_ser(samples[i], 0, size, bytes);
    if (infos[i].valid_data) {
      printf("sample %s ", topic);
      for (uint32_t k = 0; k < size; ++k) printf("%02x", bytes[k]);
      printf("\n");
    }
    free(bytes);
    ddsi_serdata_unref(samples[i]);
  }
  fflush(stdout);
}

static _Noreturn void read_topics(int argc, char** argv) {
  const dds_entity_t participant = join_domain(argv[2]);
  const dds_entity_t wait_set = made(dds_create_waitset(participant), "a wait set");
  const int count = (argc - 3) / 3;
  dds_entity_t* readers = calloc((size_t)count, sizeof *readers);
  for (int i = 0; i < count; ++i) {
    char** words = argv + 3 + 3 * i;
    dds_qos_t* qos = ros2_qos(words[2]);
    const dds_entity_t topic = create_topic(participant, words[0], type_named(words[1]));
    readers[i] = made(dds_create_reader(participant, topic, qos, NULL), words[0]);
    dds_delete_qos(qos);
    dds_set_status_mask(readers[i], DDS_DATA_AVAILABLE_STATUS | DDS_SUBSCRIPTION_MATCHED_STATUS);
    dds_waitset_attach(wait_set, readers[i], i);
  }
  while (true) {
    dds_waitset_wait(wait_set, NULL, 0, DDS_SECS(1));
    for (int i = 0; i < count; ++i) {
      uint32_t status = 0;
      dds_take_status(readers[i], &status, DDS_DATA_AVAILABLE_STATUS | DDS_SUBSCRIPTION_MATCHED_STATUS);
      if ((status & DDS_SUBSCRIPTION_MATCHED_STATUS) != 0) print_writers(readers[i], argv[3 + 3 * i]);
      print_samples(readers[i], argv[3 + 3 * i]);
    }
  }
}

enum { most_rays = 4096 };

/// Of a room of 4 m by 3 m, counter-clockwise all around.
static void measure_room(sensor_msgs_msg_LaserScan* scan) {
  enum { rays = 720 };
  const double pi = 3.14159265358979323846;
  scan->angle_min = (float)(-pi);
  scan->angle_increment = (float)(2.0 * pi / rays);
  scan->angle_max = (float)(-pi + (rays - 1) * 2.0 * pi / rays);
  scan->time_increment = (float)(0.05 / rays);
  scan->scan_time = 0.05F;
  scan->range_min = 0.1F;
  scan->range_max = 12.0F;
  scan->ranges._length = rays;
  for (int i = 0; i < rays; ++i) {
    const double bearing = -pi + (i + 0.3) * 2.0 * pi / rays;
    const double x = cos(bearing);
    const double y = sin(bearing);
    scan->ranges._buffer[i] = (float)fmin((x >= 0.0 ? 2.5 : -1.5) / x, (y >= 0.0 ? 1.25 : -1.75) / y);
  }
}

static double next_double(void) {
  const char* word = strtok(NULL, " \n");
  return word == NULL ? NAN : strtod(word, NULL);
}

static float next_number(void) { return (float)next_double(); }

/// FRAME or FRAME@SEC:NSEC; without a stamp it is now.
static void read_header(const char* word, char* frame, size_t size, std_msgs_msg_Header* header) {
  const dds_time_t now = dds_time();
  header->stamp.sec = (int32_t)(now / DDS_SECS(1));
  header->stamp.nanosec = (uint32_t)(now % DDS_SECS(1));
  snprintf(frame, size, "%s", word == NULL ? "" : word);
  char* at = strchr(frame, '@');
  if (at != NULL) {
    char* end = NULL;
    header->stamp.sec = (int32_t)strtol(at + 1, &end, 10);
    header->stamp.nanosec = *end == ':' ? (uint32_t)strtoul(end + 1, NULL, 10) : 0;
    *at = '\0';
  }
  if (strcmp(frame, "-") == 0) frame[0] = '\0';
  header->frame_id = frame;
}

/// False at the end of the file.
static bool read_scan(FILE* file, sensor_msgs_msg_LaserScan* scan) {
  static char line[16 * most_rays];
  static char frame[64];
  if (fgets(line, sizeof line, file) == NULL) return false;
  read_header(strtok(line, " \n"), frame, sizeof frame, &scan->header);
  scan->angle_min = next_number();
  scan->angle_max = next_number();
  scan->angle_increment = next_number();
  scan->time_increment = next_number();
  scan->scan_time = next_number();
  scan->range_min = next_number();
  scan->range_max = next_number();
  const float count = next_number();
  scan->ranges._length = count > 0.0F && count <= most_rays ? (uint32_t)count : 0;
  for (uint32_t i = 0; i < scan->ranges._length; ++i) scan->ranges._buffer[i] = next_number();
  scan->intensities._length = 0;
  for (float value = next_number(); !isnan(value) && scan->intensities._length < most_rays; value = next_number()) {
    scan->intensities._buffer[scan->intensities._length++] = value;
  }
  return true;
}

static void wait_for_readers(dds_entity_t writer, uint32_t readers) {
  dds_publication_matched_status_t matched = {0};
  while (dds_get_publication_matched_status(writer, &matched) == DDS_RETCODE_OK && matched.current_count < readers) {
    dds_sleepfor(DDS_MSECS(10));
  }
  dds_sleepfor(DDS_MSECS(200));  // the readers know of the writer
}

static int write_scans(int argc, char** argv) {
  const dds_entity_t participant = join_domain(argv[2]);
  const dds_entity_t topic = create_topic(participant, argv[3], type_named("sensor_msgs/msg/LaserScan"));
  dds_qos_t* qos = ros2_qos(argv[4]);
  const dds_entity_t writer = made(dds_create_writer(participant, topic, qos, NULL), argv[3]);
  dds_delete_qos(qos);
  const uint32_t readers = (uint32_t)positive_number(argv[5], "the number of readers");
  const int32_t rate = positive_number(argv[6], "the rate");
  const int32_t count = positive_number(argv[7], "the count");
  FILE* file = argc > 8 ? fopen(argv[8], "r") : NULL;
  if (argc > 8 && file == NULL) {
    perror(argv[8]);
    return 1;
  }
  static float ranges[most_rays];
  sensor_msgs_msg_LaserScan scan = {.header = {.frame_id = "laser"}};
  scan.ranges._buffer = ranges;
  scan.ranges._maximum = most_rays;
  static float intensities[most_rays];
  scan.intensities._buffer = intensities;
  scan.intensities._maximum = most_rays;
  measure_room(&scan);
  wait_for_readers(writer, readers);
  for (int32_t i = 0; i < count; ++i) {
    if (file != NULL) {
      if (!read_scan(file, &scan)) break;
    } else {
      static char frame[8];
      read_header("laser", frame, sizeof frame, &scan.header);
    }
    const dds_return_t written = dds_write(writer, &scan);
    if (written != DDS_RETCODE_OK) {
      fprintf(stderr, "cannot write: %s\n", dds_strretcode(written));
      return 1;
    }
    printf("written %d\n", i);
    dds_sleepfor(DDS_SECS(1) / rate);
  }
  if (file != NULL) fclose(file);
  dds_wait_for_acks(writer, DDS_SECS(5));
  dds_sleepfor(DDS_MSECS(500));
  return dds_delete(participant) == DDS_RETCODE_OK ? 0 : 1;
}

static int write_odometry(char** argv) {
  const dds_entity_t participant = join_domain(argv[2]);
  const dds_entity_t topic = create_topic(participant, argv[3], type_named("nav_msgs/msg/Odometry"));
  dds_qos_t* qos = ros2_qos("best_effort");
  const dds_entity_t writer = made(dds_create_writer(participant, topic, qos, NULL), argv[3]);
  dds_delete_qos(qos);
  FILE* file = fopen(argv[6], "r");
  if (file == NULL) {
    perror(argv[6]);
    return 1;
  }
  wait_for_readers(writer, (uint32_t)positive_number(argv[4], "the number of readers"));
  const int32_t rate = positive_number(argv[5], "the rate");
  char line[1024];
  while (fgets(line, sizeof line, file) != NULL) {
    char frame[64];
    nav_msgs_msg_Odometry odometry = {0};
    read_header(strtok(line, " \n"), frame, sizeof frame, &odometry.header);
    char* child = strtok(NULL, " \n");
    odometry.child_frame_id = child != NULL && strcmp(child, "-") != 0 ? child : "";
    odometry.pose.pose.position.x = next_double();
    odometry.pose.pose.position.y = next_double();
    odometry.pose.pose.orientation.x = next_double();
    odometry.pose.pose.orientation.y = next_double();
    odometry.pose.pose.orientation.z = next_double();
    odometry.pose.pose.orientation.w = next_double();
    enum { x = 0, y = 1, yaw = 5 };
    static const int places[6][2] = {{x, x}, {x, y}, {y, y}, {x, yaw}, {y, yaw}, {yaw, yaw}};
    for (int i = 0; i < 6; ++i) {
      const double value = next_double();
      odometry.pose.covariance[6 * places[i][0] + places[i][1]] = value;
      odometry.pose.covariance[6 * places[i][1] + places[i][0]] = value;
    }
    odometry.twist.twist.linear.x = next_double();
    odometry.twist.twist.linear.y = next_double();
    odometry.twist.twist.angular.z = next_double();
    odometry.twist.covariance[0] = next_double();
    const dds_return_t written = dds_write(writer, &odometry);
    if (written != DDS_RETCODE_OK) {
      fprintf(stderr, "cannot write: %s\n", dds_strretcode(written));
      return 1;
    }
    dds_sleepfor(DDS_SECS(1) / rate);
  }
  fclose(file);
  dds_sleepfor(DDS_MSECS(500));
  return dds_delete(participant) == DDS_RETCODE_OK ? 0 : 1;
}

int main(int argc, char** argv) {
  if (argc >= 8 && strcmp(argv[1], "write") == 0) return write_scans(argc, argv);
  if (argc >= 6 && argc % 3 == 0 && strcmp(argv[1], "read") == 0) read_topics(argc, argv);
  if (argc == 7 && strcmp(argv[1], "odometry") == 0) return write_odometry(argv);
  fprintf(stderr, usage, argv[0], argv[0], argv[0]);
  return 2;
}
