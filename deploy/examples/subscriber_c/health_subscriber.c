// SPDX-License-Identifier: Apache-2.0
/* Prints every health estimate of a domain with Cyclone DDS: the same IDL, another vendor. */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>

#include "engine_health.h"

int main(int argc, char **argv) {
  const dds_entity_t participant = dds_create_participant(argc > 1 ? (dds_domainid_t)atoi(argv[1]) : 0, NULL, NULL);
  const dds_entity_t topic = dds_create_topic(participant, &ehm_EngineHealth_desc, "EngineHealth", NULL, NULL);
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 256);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  if (participant < 0 || topic < 0 || reader < 0) {
    fprintf(stderr, "DDS could not be set up: %s\n", dds_strretcode(-(reader < 0 ? reader : participant)));
    return 1;
  }
  const dds_entity_t wait_set = dds_create_waitset(participant);
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(wait_set, reader, reader);
  for (;;) {
    dds_waitset_wait(wait_set, NULL, 0, DDS_SECS(1));
    void *samples[16] = {NULL};
    dds_sample_info_t infos[16];
    const int n = dds_take(reader, samples, infos, 16, 16);
    for (int i = 0; i < n; ++i) {
      const ehm_EngineHealth *health = samples[i];
      if (!infos[i].valid_data) continue;
      printf("engine %u sample %llu:", health->engine_id, (unsigned long long)health->sequence_number);
      // A count is whatever the sender wrote: never leave the array.
      const uint32_t count = health->health_count <= EHM_MAX_HEALTH ? health->health_count : 0;
      for (uint32_t k = 0; k < count; ++k) printf(" %.4f +- %.4f", health->health[k], health->sigma_total[k]);
      printf("\n");
      fflush(stdout);
    }
    if (n > 0) dds_return_loan(reader, samples, n);
  }
}
