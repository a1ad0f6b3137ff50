// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "cyclone_endpoint.h"

#include <stdio.h>
#include <stdlib.h>

dds_qos_t* quoin_qos(QosPreset preset) {
  dds_qos_t* qos = dds_create_qos();
  const int32_t depth = preset == QOS_SENSOR ? 5 : preset == QOS_FEATURE ? 32 : 1;
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(
      qos, preset == QOS_STATE ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos, 1, &representation);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  return qos;
}

dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "cannot create %s: %s\n", what, dds_strretcode(entity));
    exit(1);
  }
  return entity;
}

static int32_t number(const char* text, const char* what, long smallest, long largest) {
  char* end = NULL;
  const long value = strtol(text, &end, 10);
  if (end == text || *end != '\0' || value < smallest || value > largest) {
    fprintf(stderr, "%s must be a number from %ld to %ld, not '%s'\n", what, smallest, largest,
            text);
    exit(2);
  }
  return (int32_t)value;
}

int32_t positive_number(const char* text, const char* what) {
  return number(text, what, 1, INT32_MAX);
}

dds_entity_t join_domain(const char* text) {
  const int32_t domain = number(text, "the domain", 0, 230);
  return made(dds_create_participant((dds_domainid_t)domain, NULL, NULL), "a participant");
}
