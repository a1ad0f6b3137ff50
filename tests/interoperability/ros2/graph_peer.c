// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Stands for `ros2 node list` and `ros2 node info`: what participants announce about their nodes, and what DDS itself
// discovers of them, by Cyclone DDS.
#include <dds/dds.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../cyclone_endpoint.h"
#include "graph.h"

static const char* const usage =
    "usage: %s DOMAIN humble|iron\n"
    "prints until it is ended what it discovers, GUIDs in hexadecimal digits:\n"
    "participant GUID USER_DATA              (as far as the first zero)\n"
    "reader|writer GUID TOPIC USER_DATA      of topics of ROS 2\n"
    "gone GUID                               an endpoint that has ended\n"
    "graph GUID COUNT                        a participant's nodes, of which follow COUNT:\n"
    "node GUID NAMESPACE/NAME reads GUID ... writes GUID ...\n";

enum { most = 64 };

static void print_bytes(const uint8_t* bytes, size_t size) {
  for (size_t i = 0; i < size; ++i) printf("%02x", bytes[i]);
}

static void print_user_data(const dds_qos_t* qos) {
  void* data = NULL;
  size_t size = 0;
  if (dds_qget_userdata(qos, &data, &size) && data != NULL) printf(" %.*s", (int)size, (char*)data);
  dds_free(data);
}

static void print_participants(dds_entity_t reader) {
  void* samples[most] = {NULL};
  dds_sample_info_t infos[most];
  const int32_t count = dds_take(reader, samples, infos, most, most);
  for (int32_t i = 0; i < count; ++i) {
    const dds_builtintopic_participant_t* participant = samples[i];
    if (!infos[i].valid_data) continue;
    printf("participant ");
    print_bytes(participant->key.v, sizeof participant->key.v);
    print_user_data(participant->qos);
    printf("\n");
  }
  if (count > 0) dds_return_loan(reader, samples, count);
}

static void print_endpoints(dds_entity_t reader, const char* kind) {
  void* samples[most] = {NULL};
  dds_sample_info_t infos[most];
  const int32_t count = dds_take(reader, samples, infos, most, most);
  for (int32_t i = 0; i < count; ++i) {
    const dds_builtintopic_endpoint_t* endpoint = samples[i];
    const bool gone = infos[i].instance_state != DDS_IST_ALIVE;
    if (!gone && (!infos[i].valid_data || (strncmp(endpoint->topic_name, "rt/", 3) != 0 &&
                                           strcmp(endpoint->topic_name, "ros_discovery_info") != 0))) {
      continue;
    }
    printf("%s ", gone ? "gone" : kind);
    print_bytes(endpoint->key.v, sizeof endpoint->key.v);
    if (!gone) {
      printf(" %s", endpoint->topic_name);
      print_user_data(endpoint->qos);
    }
    printf("\n");
  }
  if (count > 0) dds_return_loan(reader, samples, count);
}

// The two types have the same fields, of Gids of other lengths.
#define PRINT_GRAPHS(Info, NodeInfo)                                                               \
  static void print_##Info(dds_entity_t reader) {                                                  \
    void* samples[most] = {NULL};                                                                  \
    dds_sample_info_t infos[most];                                                                 \
    const int32_t count = dds_take(reader, samples, infos, most, most);                            \
    for (int32_t i = 0; i < count; ++i) {                                                          \
      const rmw_dds_common_msg_##Info* info = samples[i];                                          \
      if (!infos[i].valid_data) continue;                                                          \
      printf("graph ");                                                                            \
      print_bytes(info->gid.data, sizeof info->gid.data);                                          \
      printf(" %u\n", info->node_entities_info_seq._length);                                       \
      for (uint32_t n = 0; n < info->node_entities_info_seq._length; ++n) {                        \
        const rmw_dds_common_msg_##NodeInfo* node = &info->node_entities_info_seq._buffer[n];      \
        printf("node ");                                                                           \
        print_bytes(info->gid.data, sizeof info->gid.data);                                        \
        printf(" %s/%s reads", node->node_namespace, node->node_name);                             \
        for (uint32_t k = 0; k < node->reader_gid_seq._length; ++k) {                              \
          printf(" ");                                                                             \
          print_bytes(node->reader_gid_seq._buffer[k].data, sizeof info->gid.data);                \
        }                                                                                          \
        printf(" writes");                                                                         \
        for (uint32_t k = 0; k < node->writer_gid_seq._length; ++k) {                              \
          printf(" ");                                                                             \
          print_bytes(node->writer_gid_seq._buffer[k].data, sizeof info->gid.data);                \
        }                                                                                          \
        printf("\n");                                                                              \
      }                                                                                            \
    }                                                                                              \
    if (count > 0) dds_return_loan(reader, samples, count);                                        \
  }
PRINT_GRAPHS(ParticipantEntitiesInfo, NodeEntitiesInfo)
PRINT_GRAPHS(HumbleParticipantEntitiesInfo, HumbleNodeEntitiesInfo)

int main(int argc, char** argv) {
  const bool humble = argc == 3 && strcmp(argv[2], "humble") == 0;
  if (argc != 3 || (!humble && strcmp(argv[2], "iron") != 0)) {
    fprintf(stderr, usage, argv[0]);
    return 2;
  }
  const dds_entity_t participant = join_domain(argv[1]);
  dds_topic_descriptor_t descriptor = humble ? rmw_dds_common_msg_HumbleParticipantEntitiesInfo_desc
                                             : rmw_dds_common_msg_ParticipantEntitiesInfo_desc;
  descriptor.m_typename = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
  const dds_entity_t topic =
      made(dds_create_topic(participant, &descriptor, "ros_discovery_info", NULL, NULL), "the topic");
  // As rmw reads it.
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos, 1, &representation);
  const dds_entity_t graphs = made(dds_create_reader(participant, topic, qos, NULL), "a reader");
  dds_delete_qos(qos);
  const dds_entity_t participants =
      made(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, NULL, NULL), "participants");
  const dds_entity_t writers =
      made(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, NULL, NULL), "publications");
  const dds_entity_t readers =
      made(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, NULL, NULL), "subscriptions");
  while (true) {
    print_participants(participants);
    print_endpoints(writers, "writer");
    print_endpoints(readers, "reader");
    if (humble) {
      print_HumbleParticipantEntitiesInfo(graphs);
    } else {
      print_ParticipantEntitiesInfo(graphs);
    }
    fflush(stdout);
    dds_sleepfor(DDS_MSECS(50));
  }
}
