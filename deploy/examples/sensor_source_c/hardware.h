// SPDX-License-Identifier: Apache-2.0
/* What stands between this example and your hardware: replace hardware.c, keep this header. */
#ifndef HARDWARE_H
#define HARDWARE_H

#include <stdbool.h>
#include <stdint.h>

#define MAX_ACTUATORS 8
#define MAX_SENSORS 16

/* Names and units as the monitor's design has them, in its order. */
struct channel {
  char name[64];
  char unit[32];
  double trim;  /* where the design was made */
  double sigma; /* standard deviation of one sample's noise */
};

struct hardware {
  double altitude_m, mach, delta_isa_k;
  uint32_t actuator_count, sensor_count;
  struct channel actuators[MAX_ACTUATORS];
  struct channel sensors[MAX_SENSORS];
};

/* One sample: what acts from now on, and what was measured at time_ns. */
struct measurement {
  int64_t time_ns; /* of the measurement, nanoseconds since 1970 by your clock; should grow, 0: no clock */
  double altitude_m, mach, delta_isa_k;
  double actuator[MAX_ACTUATORS];
  double sensor[MAX_SENSORS];
  uint32_t sensor_valid; /* bit i: you vouch for sensor i; a channel that failed its own test is 0 */
};

/* Reads the channels from `file`, lines of kind,name,unit,trim,sigma. False after a message on stderr. */
bool open_hardware(struct hardware* hardware, const char* file);

/* Called every sample time; must return well within it. False when nothing can be measured any more. */
bool read_hardware(const struct hardware* hardware, struct measurement* measurement);

#endif
