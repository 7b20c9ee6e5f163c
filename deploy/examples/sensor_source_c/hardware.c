// SPDX-License-Identifier: Apache-2.0
/* Hardware that is not there: every channel stands at its trim, with the noise of its sensor. */
#include "hardware.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static bool add_channel(struct hardware* hardware, const char* kind, const struct channel* channel) {
  if (strcmp(kind, "actuator") == 0 && hardware->actuator_count < MAX_ACTUATORS)
    hardware->actuators[hardware->actuator_count++] = *channel;
  else if (strcmp(kind, "sensor") == 0 && hardware->sensor_count < MAX_SENSORS)
    hardware->sensors[hardware->sensor_count++] = *channel;
  else if (strcmp(kind, "flight") == 0 && strcmp(channel->name, "altitude_m") == 0)
    hardware->altitude_m = channel->trim;
  else if (strcmp(kind, "flight") == 0 && strcmp(channel->name, "mach") == 0)
    hardware->mach = channel->trim;
  else if (strcmp(kind, "flight") == 0 && strcmp(channel->name, "delta_isa_k") == 0)
    hardware->delta_isa_k = channel->trim;
  else
    return false;
  return true;
}

/* Splits at the next comma; an empty field is a field too, which strtok would pass over. */
static const char* next_field(char** rest) {
  char* field = *rest ? *rest : "";
  if (*rest) {
    *rest = strchr(field, ',');
    if (*rest) *(*rest)++ = '\0';
  }
  return field;
}

bool open_hardware(struct hardware* hardware, const char* file) {
  memset(hardware, 0, sizeof *hardware);
  FILE* stream = fopen(file, "r");
  if (!stream) {
    perror(file);
    return false;
  }
  char line[256];
  bool good = true;
  for (int number = 1; good && fgets(line, sizeof line, stream); ++number) {
    line[strcspn(line, "\r\n")] = '\0';
    if (number == 1 || line[0] == '\0') continue; /* the heading */
    struct channel channel;
    char* rest = line;
    const char* kind = next_field(&rest);
    snprintf(channel.name, sizeof channel.name, "%s", next_field(&rest));
    snprintf(channel.unit, sizeof channel.unit, "%s", next_field(&rest));
    channel.trim = atof(next_field(&rest));
    channel.sigma = atof(next_field(&rest));
    good = add_channel(hardware, kind, &channel);
    if (!good)
      fprintf(stderr, "%s:%d: '%s,%s' is no flight, actuator or sensor channel, or one too many\n", file, number, kind,
              channel.name);
  }
  fclose(stream);
  if (good && hardware->sensor_count == 0) fprintf(stderr, "%s: no sensor\n", file);
  return good && hardware->sensor_count > 0;
}

/* Standard normal, by Box and Muller. */
static double noise(void) {
  const double u = (rand() + 1.0) / (RAND_MAX + 2.0), v = rand() / (RAND_MAX + 1.0);
  return sqrt(-2.0 * log(u)) * cos(6.283185307179586 * v);
}

bool read_hardware(const struct hardware* hardware, struct measurement* measurement) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  memset(measurement, 0, sizeof *measurement);
  measurement->time_ns = now.tv_sec * INT64_C(1000000000) + now.tv_nsec;
  measurement->altitude_m = hardware->altitude_m;
  measurement->mach = hardware->mach;
  measurement->delta_isa_k = hardware->delta_isa_k;
  for (uint32_t i = 0; i < hardware->actuator_count; ++i) measurement->actuator[i] = hardware->actuators[i].trim;
  for (uint32_t i = 0; i < hardware->sensor_count; ++i)
    measurement->sensor[i] = hardware->sensors[i].trim + hardware->sensors[i].sigma * noise();
  measurement->sensor_valid = (1u << hardware->sensor_count) - 1u;
  return true;
}
