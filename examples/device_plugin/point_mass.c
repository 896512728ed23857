/* A device that is only imagined: a mass on a spring, with a little friction, that circles until a force stops it.
 * A plugin for Palpate (docs/howto/plugins.md) in C99; to build it outside of Palpate:
 *
 *   cc -std=c99 -shared -fPIC -I/usr/local/include point_mass.c -o point_mass.so
 *   palpate devices --device plugin:./point_mass.so
 *
 * It is asked by a thread of Palpate's, about 2000 times a second, and may wait; this one has nothing to wait for. */
#include <palpate/device/palpate_device.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double kMassKg = 0.05;
static const double kSpringNPerMm = 0.02; /* about three circles a second */
static const double kFrictionNsPerMm = 0.00002;
static const double kStepS = 0.0005;
static const double kReachMm = 80.0;

struct mass {
  double place_mm[3];
  double speed_mm_s[3];
  double force_n[3];
};

/* A text that always ends, however small the room. */
static void say(char* room, uint32_t bytes, const char* words) {
  if (bytes > 0) snprintf(room, bytes, "%s", words);
}

static palpate_device_handle openMass(const char* which, char* reason, uint32_t room) {
  struct mass* self;
  if (*which != '\0') {
    say(reason, room, "there is only one kind of mass; leave its name out");
    return NULL;
  }
  self = calloc(1, sizeof(*self));
  if (self == NULL) {
    say(reason, room, "no memory");
    return NULL;
  }
  self->place_mm[0] = 30.0; /* pulled out, and pushed sideways: a circle */
  self->speed_mm_s[2] = 600.0;
  return self;
}

static void closeMass(palpate_device_handle device) { free(device); }

static int capabilities(palpate_device_handle device, struct palpate_device_capabilities* able) {
  int axis;
  (void)device;
  able->max_force_n = 2.0;
  able->stiffness_n_per_mm = 1.0;
  able->rate_hz = 1.0 / kStepS;
  for (axis = 0; axis < 3; ++axis) {
    able->reach_min_mm[axis] = -kReachMm;
    able->reach_max_mm[axis] = kReachMm;
  }
  say(able->model, sizeof(able->model), "mass on a spring");
  say(able->version, sizeof(able->version), "1.0");
  return PALPATE_DEVICE_OK;
}

static int writeForce(palpate_device_handle device, const double force_n[3]) {
  struct mass* self = device;
  memcpy(self->force_n, force_n, sizeof(self->force_n));
  return PALPATE_DEVICE_OK;
}

/* One step of the mass under spring, friction and the force of what it touches; then where it is. */
static int readPlace(palpate_device_handle device, struct palpate_device_reading* reading) {
  struct mass* self = device;
  int axis;
  for (axis = 0; axis < 3; ++axis) {
    const double newtons =
        self->force_n[axis] - kSpringNPerMm * self->place_mm[axis] - kFrictionNsPerMm * self->speed_mm_s[axis];
    self->speed_mm_s[axis] += 1000.0 * newtons / kMassKg * kStepS; /* N/kg is m/s2 */
    self->place_mm[axis] += self->speed_mm_s[axis] * kStepS;
    reading->tip_mm[axis] = self->place_mm[axis];
    reading->velocity_mm_s[axis] = self->speed_mm_s[axis];
  }
  return PALPATE_DEVICE_OK; /* the host has zeroed what is not set here: no buttons, no faults, age 0 */
}

/* No probe and no words about trouble: there is always a mass, and it is never in trouble. */
static const struct palpate_device_table kTable = {sizeof(struct palpate_device_table),
                                                   PALPATE_DEVICE_VERSION,
                                                   "point_mass",
                                                   "a mass on a spring that circles until it touches something",
                                                   NULL,
                                                   openMass,
                                                   closeMass,
                                                   capabilities,
                                                   readPlace,
                                                   writeForce,
                                                   NULL};

const struct palpate_device_table* palpate_device_plugin(uint32_t host_version) {
  return host_version >= PALPATE_DEVICE_VERSION ? &kTable : NULL;
}
