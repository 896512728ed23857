/* How a device that Palpate does not know becomes one that it does: a shared library with one function, in C.
 *
 *   const struct palpate_device_table* palpate_device_plugin(uint32_t host_version);
 *
 * This file needs nothing but a C99 compiler and is all that a plugin needs. docs/howto/plugins.md tells how to write
 * one; examples/device_plugin is a whole one.
 *
 * Units and axes: millimetre, newton, second; x to the right, y up, z towards the person who holds the device.
 *
 * Growing: a structure begins with its size in bytes as its writer knew it, and only ever gets longer. What lies beyond
 * that size is not read. Every number that the host gets is checked: what is not finite is no position, a text ends at
 * its first NUL or at the end of its room.
 *
 * Threads: the calls for one opened device come one after the other, though not all from one thread. One exception: of
 * a device that answers at once, `explain` may be called while another thread is in `read` or `write`. Calls for
 * different devices may overlap. No function may throw or end the program.
 */
#ifndef PALPATE_DEVICE_H
#define PALPATE_DEVICE_H

#include <stdint.h>

#if defined(_WIN32)
#define PALPATE_DEVICE_EXPORT __declspec(dllexport)
#else
#define PALPATE_DEVICE_EXPORT __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Names as C has them. NOLINTBEGIN(readability-identifier-naming) */

/* Raised when something here changes its meaning; functions and members that are added do not raise it. */
#define PALPATE_DEVICE_VERSION 1u

/* What a function returns. */
#define PALPATE_DEVICE_OK 0       /* done */
#define PALPATE_DEVICE_NOT_YET 1  /* `read`: nothing new since the last time; the position grows old by itself */
#define PALPATE_DEVICE_ERROR (-1) /* or any other number below zero: it failed, `explain` says why */

/* Bits of palpate_device_reading.faults: while one is set there is no position and no force. */
#define PALPATE_DEVICE_NO_POSE 1u
#define PALPATE_DEVICE_NOT_CALIBRATED 8u

/* Bits of palpate_device_reading.notes: reported, counted, and the loop goes on. */
#define PALPATE_DEVICE_WARM_MOTORS 1u
#define PALPATE_DEVICE_FORCE_EXCEEDED 2u
#define PALPATE_DEVICE_VELOCITY_EXCEEDED 4u
#define PALPATE_DEVICE_FORCE_LIMITED 8u

/* Bits of palpate_device_capabilities.flags. */
/* `read` and `write` answer from memory within a few microseconds, take no lock, no memory, make no system call: the
 * servo calls them itself, once a tick. Without this flag a thread beside the servo calls them, and they may wait for
 * the hardware. */
#define PALPATE_DEVICE_ANSWERS_AT_ONCE 1u

/* What a device says of itself. 0 and a box of no size: it does not say. */
struct palpate_device_capabilities {
  uint32_t size; /* set by the host; write no further */
  uint32_t flags;
  double max_force_n; /* the host never sends a longer one */
  double continuous_force_n;
  double stiffness_n_per_mm; /* the stiffest wall that it renders well */
  double reach_min_mm[3];
  double reach_max_mm[3];
  double rate_hz;   /* of its own loop */
  char model[64];   /* UTF-8, ends in NUL */
  char version[32]; /* of the driver, likewise */
};

/* What a device found. */
struct palpate_device_reading {
  uint32_t size; /* set by the host; write no further. The rest is zero when `read` is called */
  uint32_t faults;
  uint32_t notes;
  uint32_t buttons; /* bit 0 is the first */
  double tip_mm[3];
  double velocity_mm_s[3];
  double age_s; /* since the tip was there. Above two ticks of the servo (2 ms) it is no position any more */
};

/* A device that is open; the plugin's own. */
typedef void* palpate_device_handle;

/* The table of a plugin: constant, and there until the program ends. Those of its functions that are marked (optional)
 * may be null. `room` counts bytes, its NUL included. */
struct palpate_device_table {
  uint32_t size;     /* sizeof(struct palpate_device_table) */
  uint32_t version;  /* PALPATE_DEVICE_VERSION that it was written for */
  const char* name;  /* one word: "point_mass" */
  const char* about; /* one line for `palpate devices` */

  /* Looks without keeping anything open: OK when a device would open now; else ERROR, with what is wrong and what mends
   * it in words. (optional) */
  int (*probe)(const char* which, char* reason, uint32_t reason_room, char* remedy, uint32_t remedy_room);

  /* Opens a device at rest: `which` is what the user wrote behind the plugin's name, "" for the first. Null and a
   * reason when it cannot. The device that is open already is not opened again. */
  palpate_device_handle (*open)(const char* which, char* reason, uint32_t room);

  /* Zero force, and the device let go. Called once for every handle, last. */
  void (*close)(palpate_device_handle device);

  /* Asked once, after `open`. */
  int (*capabilities)(palpate_device_handle device, struct palpate_device_capabilities* able);

  /* Where the device is now. */
  int (*read)(palpate_device_handle device, struct palpate_device_reading* reading);

  /* The force for the hand, N. Called before `read` by the thread beside the servo, after it by the servo itself. A
   * device that answers at once must drop a force that is not renewed within two ticks: nobody else can. */
  int (*write)(palpate_device_handle device, const double force_n[3]);

  /* What is wrong now, in words; "" for nothing. (optional) */
  void (*explain)(palpate_device_handle device, char* text, uint32_t room);
};

/* The one function that a plugin exports. `host_version` is the PALPATE_DEVICE_VERSION of the host; null when the
 * plugin needs a newer one. */
PALPATE_DEVICE_EXPORT const struct palpate_device_table* palpate_device_plugin(uint32_t host_version);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
