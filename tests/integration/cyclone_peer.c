// SPDX-License-Identifier: Apache-2.0
// An independent DDS implementation (Cyclone DDS, types by idlc from the same IDL) as a peer of the services.
//
//   cyclone_peer listen DOMAIN SECONDS          counts what it hears on every topic, prints "TOPIC COUNT" lines
//   cyclone_peer feed DOMAIN COUNT ACTUATOR SENSOR...   publishes COUNT EngineSensors around the given trim, every 15 ms,
//                                               once a reader has matched; waits until all are acknowledged
//   cyclone_peer feed-xcdr2 ...                 the same in data representation XCDR2, which no reader of ours takes
//
// Built once more for each IDL that is not quite ours (odd_idl in CMakeLists.txt).
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef EHM_ODD_TYPES
#include EHM_ODD_TYPES
#else
#include "engine_health.h"
#endif

#define TOPICS 11

static dds_qos_t *reliable(bool durable, int depth) {
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, durable ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  return qos;
}

static int listen_all(dds_entity_t participant, double seconds) {
  const struct {
    const char *name;
    const dds_topic_descriptor_t *type;
    bool durable;
  } topics[TOPICS] = {
      {"EngineSensors", &ehm_EngineSensors_desc, false},       {"EngineHealth", &ehm_EngineHealth_desc, false},
      {"EngineAuxiliary", &ehm_EngineAuxiliary_desc, false},   {"EngineResiduals", &ehm_EngineResiduals_desc, false},
      {"EngineTruth", &ehm_EngineTruth_desc, false},           {"EngineDescription", &ehm_EngineDescription_desc, true},
      {"MonitorStatus", &ehm_MonitorStatus_desc, true},        {"HealthEvent", &ehm_HealthEvent_desc, true},
      {"SimCommand", &ehm_SimCommand_desc, false},             {"MonitorCommand", &ehm_MonitorCommand_desc, false},
      {"FlightSummary", &ehm_FlightSummary_desc, true},
  };
  dds_entity_t readers[TOPICS];
  int counts[TOPICS] = {0};
  double first_health = 0.0, first_thrust = 0.0;
  for (int i = 0; i < TOPICS; ++i) {
    dds_qos_t *qos = reliable(topics[i].durable, 256);
    readers[i] = dds_create_reader(participant, dds_create_topic(participant, topics[i].type, topics[i].name, NULL, NULL), qos, NULL);
    dds_delete_qos(qos);
    if (readers[i] < 0) {
      fprintf(stderr, "no reader on %s: %s\n", topics[i].name, dds_strretcode(-readers[i]));
      return 1;
    }
  }
  const dds_time_t end = dds_time() + (dds_duration_t)(seconds * 1e9);
  while (dds_time() < end) {
    for (int i = 0; i < TOPICS; ++i) {
      void *samples[64] = {NULL};
      dds_sample_info_t infos[64];
      const int n = dds_take(readers[i], samples, infos, 64, 64);
      for (int k = 0; k < n; ++k) {
        if (!infos[k].valid_data) continue;
        ++counts[i];
        if (i == 1) first_health = ((const ehm_EngineHealth *)samples[k])->sigma_total[0];
        if (i == 2) first_thrust = ((const ehm_EngineAuxiliary *)samples[k])->auxiliary[2];
      }
      if (n > 0) dds_return_loan(readers[i], samples, n);
    }
    dds_sleepfor(DDS_MSECS(5));
  }
  for (int i = 0; i < TOPICS; ++i) printf("%s %d\n", topics[i].name, counts[i]);
  printf("sigma_total[0] %.9g\nthrust %.9g\n", first_health, first_thrust);
  return 0;
}

static int feed(dds_entity_t participant, bool xcdr2, int count, double actuator, char **sensor, int sensors) {
  dds_qos_t *qos = reliable(false, 256);
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR2;
  if (xcdr2) dds_qset_data_representation(qos, 1, &representation);
  const dds_entity_t writer = dds_create_writer(participant, dds_create_topic(participant, &ehm_EngineSensors_desc, "EngineSensors", NULL, NULL), qos, NULL);
  dds_delete_qos(qos);
  dds_publication_matched_status_t matched = {0};
  for (int tries = 0; matched.current_count == 0 && tries < 1500; ++tries) {
    dds_get_publication_matched_status(writer, &matched);
    dds_sleepfor(DDS_MSECS(10));
  }
  if (matched.current_count == 0) {
    fprintf(stderr, "no reader of EngineSensors has matched in 15 s\n");
    return 1;
  }
  for (int k = 0; k < count; ++k) {
    ehm_EngineSensors s;
    memset(&s, 0, sizeof s);
    s.engine_id = 7;
    s.schema = 1;
    s.sequence_number = (uint64_t)k;
    s.source_time_ns = dds_time();
    s.altitude_m = 10668.0;
    s.mach = 0.8;
    s.source_id = 3;
    s.sensor_valid = (1u << sensors) - 1u;
    s.sensor_count = (uint32_t)sensors;
    s.actuator_count = 5; /* fuel flow; vanes on schedule, bleed valves shut, nothing taken off */
    s.actuator[0] = actuator;
    for (int i = 0; i < sensors; ++i) s.sensor[i] = atof(sensor[i]) * (1.0 + 1e-5 * (k % 7));
    if (dds_write(writer, &s) < 0) return 1;
    dds_sleepfor(DDS_MSECS(15));
  }
  return dds_wait_for_acks(writer, DDS_SECS(5)) == 0 ? 0 : 1;
}

int main(int argc, char **argv) {
  if (argc < 4) return 2;
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[2]), NULL, NULL);
  if (participant < 0) {
    fprintf(stderr, "no participant: %s\n", dds_strretcode(-participant));
    return 1;
  }
  const int result = strcmp(argv[1], "listen") == 0
                         ? listen_all(participant, atof(argv[3]))
                         : feed(participant, strcmp(argv[1], "feed-xcdr2") == 0, atoi(argv[3]), atof(argv[4]), argv + 5, argc - 5);
  dds_delete(participant);
  return result;
}
