// SPDX-License-Identifier: Apache-2.0
/* Takes the place of engine_sim: publishes EngineSensors every 15 ms with Cyclone DDS, from read_hardware().
 *
 *   sensor_source_c [-d DOMAIN] [-p PARTITION] [-e ENGINE_ID] [-i SOURCE_ID] [-s SECONDS] CHANNELS.csv
 *
 * Exit: 0 done, 1 failed while running, 2 wrong command line or file. */
#include <dds/dds.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "engine_health.h"
#include "hardware.h"

enum { schema = 1, role_source = 1 }; /* idl/wire_values.h */
static const int64_t sample_time_ns = 15000000;

static volatile sig_atomic_t stopped = 0;
static void stop(int number) {
  (void)number;
  stopped = 1;
}

struct options {
  unsigned domain, engine_id, source_id;
  double seconds; /* 0: until stopped */
  const char *partition, *channels;
};

static bool read_options(int argc, char** argv, struct options* options) {
  *options = (struct options){.engine_id = 1, .source_id = 1};
  for (int option; (option = getopt(argc, argv, "d:p:e:i:s:")) != -1;) {
    if (option == 'd')
      options->domain = (unsigned)atoi(optarg);
    else if (option == 'p')
      options->partition = optarg;
    else if (option == 'e')
      options->engine_id = (unsigned)atoi(optarg);
    else if (option == 'i')
      options->source_id = (unsigned)atoi(optarg);
    else if (option == 's')
      options->seconds = atof(optarg);
    else
      return false;
  }
  if (optind + 1 != argc || options->engine_id == 0 || options->source_id == 0) return false;
  options->channels = argv[optind];
  return true;
}

/* What the monitor's readers match: reliable, keep last; deadline and liveliness are offered, so that a reader may ask
 * for them. */
static dds_qos_t* stream_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 256);
  dds_qset_deadline(qos, DDS_MSECS(100));
  dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(1));
  return qos;
}

/* The last value of each key stays for who joins late. */
static dds_qos_t* state_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 16);
  return qos;
}

static dds_entity_t create_writer(dds_entity_t participant, dds_entity_t publisher, const dds_topic_descriptor_t* type,
                                  const char* name, dds_qos_t* qos) {
  const dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  const dds_entity_t writer = topic < 0 ? topic : dds_create_writer(publisher, topic, qos, NULL);
  dds_delete_qos(qos);
  if (writer < 0) fprintf(stderr, "no writer on %s: %s\n", name, dds_strretcode(-writer));
  return writer;
}

static void describe_channels(ehm_ChannelDescription* to, const struct channel* from, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    snprintf(to[i].name, sizeof to[i].name, "%s", from[i].name);
    snprintf(to[i].unit, sizeof to[i].unit, "%s", from[i].unit);
    to[i].trim = from[i].trim;
    to[i].sigma = from[i].sigma;
  }
}

/* Optional, but with it `monitor --listen` compares names and units. */
static int describe(dds_entity_t writer, const struct options* options, const struct hardware* hardware) {
  static ehm_EngineDescription d;
  d.engine_id = options->engine_id;
  d.source_id = options->source_id;
  d.role = role_source;
  d.schema = schema;
  snprintf(d.engine_type, sizeof d.engine_type, "hardware");
  d.sample_time_s = 1e-9 * (double)sample_time_ns;
  d.actuator_count = hardware->actuator_count;
  d.sensor_count = hardware->sensor_count;
  describe_channels(d.actuators, hardware->actuators, hardware->actuator_count);
  describe_channels(d.sensors, hardware->sensors, hardware->sensor_count);
  return dds_write(writer, &d);
}

static int publish(dds_entity_t writer, const struct options* options, const struct hardware* hardware,
                   const struct measurement* measured, uint64_t sequence) {
  ehm_EngineSensors s;
  memset(&s, 0, sizeof s); /* entries behind the counts are 0 */
  s.engine_id = options->engine_id;
  s.schema = schema;
  s.sequence_number = sequence;
  s.source_time_ns = measured->time_ns;
  s.altitude_m = measured->altitude_m;
  s.mach = measured->mach;
  s.delta_isa_k = measured->delta_isa_k;
  s.source_id = options->source_id;
  s.sensor_valid = measured->sensor_valid;
  s.sensor_count = hardware->sensor_count;
  s.actuator_count = hardware->actuator_count;
  memcpy(s.actuator, measured->actuator, sizeof s.actuator);
  memcpy(s.sensor, measured->sensor, sizeof s.sensor);
  return dds_write(writer, &s);
}

/* Every period on the monotonic clock, so that a late sample does not shift those after it. */
static int run(dds_entity_t writer, const struct options* options, const struct hardware* hardware) {
  struct timespec next;
  clock_gettime(CLOCK_MONOTONIC, &next);
  struct measurement measured;
  for (uint64_t sequence = 0; !stopped; ++sequence) {
    if (options->seconds > 0.0 && (double)sequence * (double)sample_time_ns >= 1e9 * options->seconds) break;
    if (!read_hardware(hardware, &measured)) return 1;
    const int written = publish(writer, options, hardware, &measured, sequence);
    if (written < 0)
      fprintf(stderr, "sample %llu not taken: %s\n", (unsigned long long)sequence, dds_strretcode(-written));
    next.tv_nsec += sample_time_ns;
    if (next.tv_nsec >= 1000000000) {
      next.tv_nsec -= 1000000000;
      ++next.tv_sec;
    }
    while (!stopped && clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL) == EINTR) {
    }
  }
  return dds_wait_for_acks(writer, DDS_SECS(1)) == DDS_RETCODE_OK ? 0 : 1;
}

int main(int argc, char** argv) {
  struct options options;
  struct hardware hardware;
  if (!read_options(argc, argv, &options)) {
    fprintf(
        stderr,
        "usage: sensor_source_c [-d DOMAIN] [-p PARTITION] [-e ENGINE_ID] [-i SOURCE_ID] [-s SECONDS] CHANNELS.csv\n");
    return 2;
  }
  if (!open_hardware(&hardware, options.channels)) return 2;
  struct sigaction action = {.sa_handler = stop}; /* no SA_RESTART: a signal ends the sleep */
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);

  const dds_entity_t participant = dds_create_participant(options.domain, NULL, NULL);
  if (participant < 0) {
    fprintf(stderr, "no participant on domain %u: %s\n", options.domain, dds_strretcode(-participant));
    return 1;
  }
  dds_qos_t* in_partition = dds_create_qos();
  if (options.partition) dds_qset_partition1(in_partition, options.partition);
  const dds_entity_t publisher = dds_create_publisher(participant, in_partition, NULL);
  dds_delete_qos(in_partition);
  const dds_entity_t sensors =
      create_writer(participant, publisher, &ehm_EngineSensors_desc, "EngineSensors", stream_qos());
  const dds_entity_t descriptions =
      create_writer(participant, publisher, &ehm_EngineDescription_desc, "EngineDescription", state_qos());
  int result = 1;
  if (sensors >= 0 && descriptions >= 0 && describe(descriptions, &options, &hardware) >= 0)
    result = run(sensors, &options, &hardware);
  dds_delete(participant);
  return result;
}
