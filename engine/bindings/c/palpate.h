/* Palpate in C: bodies that can be felt, fingers that feel them, skin that follows, recordings read back.
 *
 *   world ─► finger ─ tip ─► palpate_finger_step ─► palpate_touch: force, depth, contact
 *     │                                                   │
 *     └────► skin ─────────────────────────────► palpate_skin_apply ─► positions, normals, strain
 *
 * This file needs nothing but a C89 compiler with <stdint.h>, or C++11. Link with -lpalpate. docs/reference/c-api.md
 * has the rest.
 *
 * Units and axes: millimetre, newton, second, newton per millimetre. The body's frame: x to the body's right seen from
 * behind, y towards the head, z out of the back. Skin faces counter-clockwise seen from outside. Texts are UTF-8 and
 * end in NUL.
 *
 * Structures: every one begins with `size`, its size in bytes as the caller was compiled. The caller sets it, the
 * library reads and writes no more than that many bytes, whatever its own version knows. New members come at the end
 * only. A size of 0, or one that no version of the structure has (no multiple of its alignment), is refused. Members
 * that a library does not know stay unchanged: set a structure to zero before its first use.
 *
 * Handles: a world is counted (_retain, _release) and never changes. A finger and a skin keep their world; a caller may
 * release it first. A recording and its samples are the caller's. Every release function accepts null. Using a
 * released handle is undefined behaviour.
 *
 * Errors: functions that can fail return PALPATE_OK or another code, and fill the caller's palpate_error, which may be
 * null. Null where a pointer is needed, a size of 0, an index out of range: PALPATE_ARGUMENT, and nothing
 * happens. A function that makes a handle sets `*out` to null first. No exception leaves the library, it prints nothing
 * and never ends the program.
 *
 * Threads: a world may be used by any number of threads at once. A finger, a skin and a recording belong to one thread
 * at a time, without locks. Different ones share nothing that is written. A palpate_error belongs to its caller.
 */
#ifndef PALPATE_H
#define PALPATE_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define PALPATE_API
#else
#define PALPATE_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
#define PALPATE_NOEXCEPT noexcept
extern "C" {
#else
#define PALPATE_NOEXCEPT
#endif

/* Names in C's style. NOLINTBEGIN(readability-identifier-naming, modernize-use-using) */

/* ---- what functions return ------------------------------------------------------------------------------------- */

#define PALPATE_OK 0
#define PALPATE_ARGUMENT 1 /* null, a size of 0, an index or a number out of range: the caller's mistake */
#define PALPATE_REFUSED 2  /* a file, a text, a mesh or settings that make no sense: the message says what and where */
#define PALPATE_MEMORY 3   /* out of memory */
#define PALPATE_FAILED 4   /* anything else, with the system's message */

/* No such triangle, vertex or place. */
#define PALPATE_NONE 0xffffffffu

/* The reason of a failure; the caller's. Functions that take one always write it. */
typedef struct palpate_error {
  size_t size;
  int32_t code;      /* as returned; PALPATE_OK: nothing failed */
  int32_t line;      /* of the file or text, counted from 1; 0: unknown */
  char message[512]; /* one line, `file:line: cause`; cut short between two letters if it is longer */
} palpate_error;

/* Version of the loaded library, "0.3.0"; valid until the program ends. Any thread. */
PALPATE_API const char* palpate_version(void) PALPATE_NOEXCEPT;

/* ---- worlds: a body with its stiffness, immutable and counted ---------------------------------------------------- */

typedef struct palpate_world palpate_world;

/* Builds the world of a scene file (TOML, docs/reference/scene-files.md), with the files that it names. Takes 0.02 to
 * some seconds. Any thread. */
PALPATE_API int32_t palpate_world_load(const char* utf8_path, palpate_world** out,
                                       palpate_error* error) PALPATE_NOEXCEPT;

/* The same from the text of a scene. `name` replaces the file in messages, and its folder resolves relative names;
 * null: "scene". An empty text is the built-in trunk. */
PALPATE_API int32_t palpate_world_parse(const char* utf8_toml, const char* name, palpate_world** out,
                                        palpate_error* error) PALPATE_NOEXCEPT;

/* The built-in torso over its bones. `triangles`: skin and bones together; 0: 20,389. */
PALPATE_API int32_t palpate_world_torso(size_t triangles, palpate_world** out, palpate_error* error) PALPATE_NOEXCEPT;

/* A body in the caller's memory, which is read during the call only. Set the structure to zero, then its size; exactly
 * one of each pair of pointers. */
typedef struct palpate_arrays {
  size_t size;
  const double* positions_mm;       /* x, y, z of each vertex; finite */
  const float* positions_mm_f32;    /* or these */
  size_t vertices;                  /* number */
  const int32_t* corners;           /* three vertices of each triangle, counted from 0 */
  const int64_t* corners_i64;       /* or these */
  size_t triangles;                 /* number */
  const double* stiffness_n_per_mm; /* per vertex, finite and >= 0; null: the scene's */
  const char* scene_toml;           /* friction, force law, deformation; its [body] is ignored; null: defaults */
} palpate_arrays;

/* Seams are welded, faults mended, and vertices put in spatial order: palpate_world_map has the correspondence. */
PALPATE_API int32_t palpate_world_from_arrays(const palpate_arrays* arrays, palpate_world** out,
                                              palpate_error* error) PALPATE_NOEXCEPT;

/* The same body, vertices and triangles in the same order, under another scene: other law, stiffness, friction,
 * deformation. The scene's [body] is ignored. `name` as for palpate_world_parse. */
PALPATE_API int32_t palpate_world_rebuilt(const palpate_world* world, const char* utf8_toml, const char* name,
                                          palpate_world** out, palpate_error* error) PALPATE_NOEXCEPT;

/* Adds and drops a reference; the last release frees the world. Null is allowed. Any thread. */
PALPATE_API void palpate_world_retain(palpate_world* world) PALPATE_NOEXCEPT;
PALPATE_API void palpate_world_release(palpate_world* world) PALPATE_NOEXCEPT;

typedef struct palpate_world_facts {
  size_t size;
  uint64_t vertices;  /* of the skin */
  uint64_t triangles; /* of the skin */
  uint64_t landmarks; /* for palpate_world_landmark */
  uint64_t notes;     /* for palpate_world_note */
  uint64_t fingers;   /* in the scene; may be 0 */
  double low_mm[3];   /* box around the skin */
  double high_mm[3];
  int32_t closed;      /* 1: the skin has no border */
  int32_t breathes;    /* 1: the skin moves by itself, and ticks are its clock */
  double ticks_per_s;  /* the scene's */
  uint64_t hash;       /* worlds with the same hash give the same forces */
  char body_name[128]; /* "torso", or the file's name */
  uint64_t lumps;      /* for palpate_world_lump */
} palpate_world_facts;

/* Some milliseconds: the hash reads the whole skin. */
PALPATE_API int32_t palpate_world_get_facts(const palpate_world* world, palpate_world_facts* facts) PALPATE_NOEXCEPT;

/* The skin at rest. Null for a null world; else valid until the world's last release. */
PALPATE_API const double* palpate_world_positions(const palpate_world* world) PALPATE_NOEXCEPT;   /* x, y, z; mm */
PALPATE_API const uint32_t* palpate_world_triangles(const palpate_world* world) PALPATE_NOEXCEPT; /* three vertices */
PALPATE_API const double* palpate_world_stiffness(const palpate_world* world) PALPATE_NOEXCEPT;   /* N/mm per vertex */

/* The correspondence of a world from arrays to them. Values are indices, or PALPATE_NONE. */
#define PALPATE_MAP_SOURCE_VERTEX 0   /* per vertex of the world: the given one */
#define PALPATE_MAP_SOURCE_TRIANGLE 1 /* per triangle of the world: the given one; none if mending made it */
#define PALPATE_MAP_BUILT_VERTEX 2    /* per given vertex: the world's */
#define PALPATE_MAP_BUILT_TRIANGLE 3  /* per given triangle: the world's */
/* Null and a count of 0 for another world and for another `map`. `count` may be null. */
PALPATE_API const uint32_t* palpate_world_map(const palpate_world* world, int32_t map, size_t* count) PALPATE_NOEXCEPT;

/* A named place of the skin at rest. */
typedef struct palpate_place {
  size_t size;
  double point_mm[3];
  double normal[3];  /* unit, out of the body */
  uint32_t triangle; /* of the world's skin, or PALPATE_NONE */
  uint32_t reserved;
  char name[128]; /* in an examiner's terms: "T6 right 30 mm" */
} palpate_place;

/* "T6", "left PSIS", "T6 right 30 mm": upper and lower case and the order of words do not matter. Refuses a place that
 * the body lacks, with names of similar spelling. */
PALPATE_API int32_t palpate_world_place(const palpate_world* world, const char* utf8_words, palpate_place* place,
                                        palpate_error* error) PALPATE_NOEXCEPT;
/* Landmark number `index` of the body, from 0; its triangle is PALPATE_NONE. */
PALPATE_API int32_t palpate_world_landmark(const palpate_world* world, size_t index,
                                           palpate_place* place) PALPATE_NOEXCEPT;
/* Notes on the body for the user: repairs, a doubtful unit. Null past the last; valid until the last release. */
PALPATE_API const char* palpate_world_note(const palpate_world* world, size_t index) PALPATE_NOEXCEPT;

/* A lump under the skin: the scene's [[lump]] in this body (docs/explanation/lumps.md). */
typedef struct palpate_lump {
  size_t size;
  double foot_mm[3];        /* on the skin at rest, over its middle */
  double axis[3];           /* unit, out of the skin there */
  double across[3];         /* unit; across, up and axis are right-handed */
  double up[3];             /* unit, towards the head */
  double half_axes_mm[3];   /* across, across, into the body */
  double depth_mm;          /* depth of its top under the skin, along the axis */
  double young_kpa;         /* in its middle */
  double layer_kpa;         /* the layer's at its centre */
  double tissue_mm;         /* thickness over the bone there */
  double mobility_mm_per_n; /* motion under 1 N sideways; 0: it is fixed */
  double mobility_limit_mm; /* its largest motion */
  double share[3];          /* added force on a fingertip right over it that presses 3, 5, 8 mm, as a share */
  char name[64];            /* "lump1" without a name in the scene */
} palpate_lump;
/* Lump number `index` of the world, from 0, in the order of the scene. PALPATE_ARGUMENT beyond the last. Any thread. */
PALPATE_API int32_t palpate_world_lump(const palpate_world* world, size_t index, palpate_lump* lump) PALPATE_NOEXCEPT;

/* ---- fingers ----------------------------------------------------------------------------------------------------- */

typedef struct palpate_finger_settings {
  size_t size;
  double radius_mm;           /* 0 is a point, 8 a fingertip; 0 to 1,000 */
  double stiffness_ratio;     /* tangential over normal stiffness; 0 to 100 */
  double mu_static;           /* 0 to 5 */
  double mu_dynamic;          /* 0 to mu_static */
  double max_depth_mm;        /* largest depth that adds force; above 0 to 100,000 */
  double tick_s;              /* between two steps; 1e-6 to 1 */
  double catch_up_mm_per_s;   /* largest speed of the contact after the tip; 0 to 1e6 */
  int32_t force_shading;      /* not 0: round off facets; a point finger only */
  int32_t reserved;           /* 0 */
  double relaxation_share;    /* share of the force that a held press loses, first term; together at most 0.9 */
  double relaxation_time_s;   /* above 0 */
  double relaxation_share_2;  /* second term */
  double relaxation_time_2_s; /* above 0 */
} palpate_finger_settings;

/* Sets the defaults and `size`, the caller's sizeof(palpate_finger_settings); does nothing for null or 0. */
PALPATE_API void palpate_finger_settings_init(palpate_finger_settings* settings, size_t size) PALPATE_NOEXCEPT;
/* Settings of the scene's finger `index`; beyond its last one those of a point with the scene's friction. Only `size`
 * is read. */
PALPATE_API int32_t palpate_world_finger_settings(const palpate_world* world, size_t index,
                                                  palpate_finger_settings* settings) PALPATE_NOEXCEPT;

/* palpate_touch.touch */
#define PALPATE_FREE 0
#define PALPATE_STICK 1
#define PALPATE_SLIP 2

/* Bits of palpate_touch.status */
#define PALPATE_TIP_LOST 1u         /* tip not finite or absurdly far: no force */
#define PALPATE_CATCHING_UP 2u      /* the contact used up its path in this tick, or the force its step */
#define PALPATE_TOO_DEEP 4u         /* deeper than max_depth_mm: the force no longer grows */
#define PALPATE_LETTING_GO 8u       /* the contact has ended, its force fades */
#define PALPATE_AT_BORDER 16u       /* the force fades because the sheet ends here */
#define PALPATE_STARTED_INSIDE 32u  /* a ball that overlaps the skin is being pushed out */
#define PALPATE_UNSETTLED 64u       /* a ball continues its search in the next tick */
#define PALPATE_SHADING_FAILED 128u /* force shading fell back to the facets */

/* A finger's output in one tick. In free space places are the tip's and normal, force and depth zero. */
typedef struct palpate_touch {
  size_t size;
  double force_n[3];   /* on the tip */
  double depth_mm;     /* depth of the tip below the skin at rest */
  int32_t touch;       /* PALPATE_FREE, _STICK, _SLIP */
  uint32_t status;     /* bits */
  double normal[3];    /* unit, out of the skin; zero when free */
  double tip_mm[3];    /* place of the device */
  double proxy_mm[3];  /* the pressed place of the skin */
  double anchor_mm[3]; /* the place of the skin held by friction */
  double hold_mm[3];   /* where friction holds the tip, a point in space */
  uint32_t triangle;   /* of the world's skin under the proxy, or PALPATE_NONE */
  uint32_t anchor_triangle;
  double tissue_mm;        /* thickness over the bone under the proxy, as felt: more over a narrow one; 0: unknown */
  double rest_mm;          /* remaining depth of the pressed skin without the finger (relaxation); 0 when free */
  double dent_mm[3];       /* place of a dent that the finger left and that recovers */
  double dent_rest_mm;     /* its present depth; 0: no dent */
  uint32_t dent_triangle;  /* of the world's skin, or PALPATE_NONE */
  uint32_t reserved;       /* 0 */
  uint64_t tick;           /* counts this finger's steps from 0 */
  double lump_force_n[3];  /* the part of force_n that lumps under the skin add */
  double lump_share;       /* their normal force over that of the press without them; 0 where that is 0 */
  double lump_moved_mm[2]; /* shift of the lump below from its place, across and up */
  uint32_t lump;           /* nearest mobile one that is felt, for palpate_world_lump; or PALPATE_NONE */
  uint32_t reserved_2;     /* 0 */
} palpate_touch;

typedef struct palpate_finger palpate_finger;

/* `settings`: null for those of the scene's first finger. Refuses settings out of range. Retains the world. */
PALPATE_API int32_t palpate_finger_create(palpate_world* world, const palpate_finger_settings* settings,
                                          palpate_finger** out, palpate_error* error) PALPATE_NOEXCEPT;
/* One tick: the tip is at `tip_mm` now. 0.1 to some us. No allocation, no lock. A tip that is not finite gets
 * PALPATE_OK, no force and the status PALPATE_TIP_LOST. */
PALPATE_API int32_t palpate_finger_step(palpate_finger* finger, const double tip_mm[3],
                                        palpate_touch* touch) PALPATE_NOEXCEPT;
/* `count` ticks, one after the other: `tips_mm` has x, y, z of each. `touches` has `count` structures that begin
 * `stride` bytes apart, and each gets `stride` as its size: pass sizeof(palpate_touch). No allocation, no lock. */
PALPATE_API int32_t palpate_finger_rollout(palpate_finger* finger, const double* tips_mm, size_t count,
                                           palpate_touch* touches, size_t stride) PALPATE_NOEXCEPT;
/* The pressure on the fingertip in its last step, kPa: `taxels` rows of as many (2 to 16) of a square pad with sides of
 * `pad_mm` (1 to 100), in the plane of the contact. The first row is nearest to the head, the first taxel of a row
 * lowest along u = v x normal, with v towards the head. `kpa` has room for taxels * taxels, `shear_kpa` for twice as
 * many, or is null: shear on the finger along u and v, taxel by taxel. Zeros when free. The pressures add up to the
 * normal force; a point counts as a fingertip of 8 mm. Layered tissue only: PALPATE_REFUSED for another. 0.2
 * us for 4 x 4, 2 for 16 x 16; the first call of a finger in a world with neither lumps nor a pad takes
 * milliseconds and allocates. */
PALPATE_API int32_t palpate_finger_pressure(palpate_finger* finger, size_t taxels, double pad_mm, float* kpa,
                                            float* shear_kpa) PALPATE_NOEXCEPT;
/* Lifts the finger: its next tip may be anywhere, without contact in between. Ticks continue. */
PALPATE_API int32_t palpate_finger_lift(palpate_finger* finger) PALPATE_NOEXCEPT;
PALPATE_API void palpate_finger_release(palpate_finger* finger) PALPATE_NOEXCEPT;

/* ---- skin -------------------------------------------------------------------------------------------------------- */

typedef struct palpate_skin palpate_skin;

/* The skin at rest, with room for the touches of `fingers` fingers (1 to 4,096). `strain` not 0: strain is computed
 * too. Retains the world. */
PALPATE_API int32_t palpate_skin_create(palpate_world* world, size_t fingers, int32_t strain, palpate_skin** out,
                                        palpate_error* error) PALPATE_NOEXCEPT;
/* Deforms the skin by these touches, independent of its state before; none: to rest. They are of this world, and begin
 * `stride` bytes apart; each has its size. Too many touches, numbers that are not finite and invalid triangles are
 * refused, and the skin stays. Once a picture; 0.2 ms a finger. No allocation, no lock. */
PALPATE_API int32_t palpate_skin_apply(palpate_skin* skin, const palpate_touch* touches, size_t count,
                                       size_t stride) PALPATE_NOEXCEPT;
PALPATE_API size_t palpate_skin_vertices(const palpate_skin* skin) PALPATE_NOEXCEPT;
/* One value per vertex of the world's skin, in order; `axis` 0, 1, 2 = x, y, z. Null for a null skin and for another
 * axis. The pointer is valid until release, its contents until the next apply. Without the breath, which lifts the
 * body by palpate_skin_lift_mm. Positions count from palpate_skin_origin_mm. */
PALPATE_API const float* palpate_skin_positions(const palpate_skin* skin, int32_t axis) PALPATE_NOEXCEPT;
PALPATE_API const float* palpate_skin_normals(const palpate_skin* skin, int32_t axis) PALPATE_NOEXCEPT;
PALPATE_API const float* palpate_skin_displacements(const palpate_skin* skin, int32_t axis) PALPATE_NOEXCEPT;
/* Strain around the vertex, above 0 is tension; zeros without `strain`. */
PALPATE_API const float* palpate_skin_strain(const palpate_skin* skin) PALPATE_NOEXCEPT;
/* Changes of the last apply, as `count` pairs: first vertex, end. Upload these. Valid until the next apply. */
PALPATE_API const uint32_t* palpate_skin_changed(const palpate_skin* skin, size_t* count) PALPATE_NOEXCEPT;
PALPATE_API double palpate_skin_lift_mm(const palpate_skin* skin) PALPATE_NOEXCEPT;
/* Origin x, y, z of the positions: zeros, except for a body farther than 10 m from the origin of its frame (a scan in
 * map coordinates), where floats would be millimetres apart. Valid until release; null for a null skin. */
PALPATE_API const double* palpate_skin_origin_mm(const palpate_skin* skin) PALPATE_NOEXCEPT;
PALPATE_API void palpate_skin_release(palpate_skin* skin) PALPATE_NOEXCEPT;

/* ---- sessions: recordings of runs, read back (docs/reference/recordings.md) ----------------------------------------
 */

typedef struct palpate_session palpate_session;

/* Also opens one that is being written, or whose writer was killed. */
PALPATE_API int32_t palpate_session_open(const char* utf8_path, palpate_session** out,
                                         palpate_error* error) PALPATE_NOEXCEPT;

typedef struct palpate_session_facts {
  size_t size;
  double ticks_per_s;
  double seconds; /* from the first tick to the last */
  uint64_t samples;
  uint64_t first_tick;
  uint64_t last_tick;
  uint64_t fingers;
  uint64_t first_world; /* not 0 where the beginning was dropped */
  uint64_t worlds;
  uint64_t events;
  uint64_t dropped;     /* samples lost when it was written */
  char started_utc[32]; /* 2026-11-21T18:45:00Z */
  char ended_utc[32];   /* "": unfinished */
  char ended_by[64];
  char software[64]; /* that wrote it */
  char notes[512];
} palpate_session_facts;
PALPATE_API int32_t palpate_session_get_facts(const palpate_session* session,
                                              palpate_session_facts* facts) PALPATE_NOEXCEPT;

typedef struct palpate_session_finger {
  size_t size;
  char name[64];
  char device[64];
} palpate_session_finger;
/* Finger number `index`, from 0. */
PALPATE_API int32_t palpate_session_get_finger(const palpate_session* session, size_t index,
                                               palpate_session_finger* finger) PALPATE_NOEXCEPT;

/* Further data of a sample besides the touch. */
typedef struct palpate_sample {
  size_t size;
  uint64_t tick;
  uint32_t finger;
  uint32_t world;           /* number of its world */
  double device_force_n[3]; /* force on the hand */
  uint32_t safety;          /* bits (docs/explanation/safety.md); 0: the force went through unchanged */
  uint32_t buttons;         /* the device's, bit 0 the first */
} palpate_sample;

/* Reads samples of the ticks `from` to `to`, both included, in the order of their ticks and fingers, into two arrays:
 * sample i goes to samples[i] and touches[i], either of which may be null. Strides and sizes as in
 * palpate_finger_rollout; tissue_mm is not recorded and 0, `tick` is the recording's. `room` is the capacity, at least
 * the number of fingers; only whole ticks are written. `*count` gets the number of samples; 0: none left. Continue with
 * the tick after the last. */
PALPATE_API int32_t palpate_session_read(palpate_session* session, uint64_t from, uint64_t to, palpate_sample* samples,
                                         size_t sample_stride, palpate_touch* touches, size_t touch_stride, size_t room,
                                         size_t* count, palpate_error* error) PALPATE_NOEXCEPT;

typedef struct palpate_replay {
  size_t size;
  uint64_t ticks;     /* samples replayed and compared */
  uint64_t different; /* those that differ in any bit */
  uint64_t unproven;  /* samples not compared: time before them is missing from the recording */
  uint64_t first_different_tick;
  int32_t identical; /* 1: samples were compared, none differed, and the worlds are the recorded ones */
  int32_t reserved;
  char difference[256]; /* describes the first one; "" for none */
  char notes[512];      /* a world that is not the recorded one, and so on; "" for none */
} palpate_replay;
/* Replays the whole recording and compares every bit. `folder`: present place of the files that its scene names; null:
 * their recorded place. Takes as long as building its worlds and computing its ticks. */
PALPATE_API int32_t palpate_session_replay(palpate_session* session, const char* folder, palpate_replay* replay,
                                           palpate_error* error) PALPATE_NOEXCEPT;
/* World number `number` of the recording, built again; `folder` as above. */
PALPATE_API int32_t palpate_session_world(palpate_session* session, uint64_t number, const char* folder,
                                          palpate_world** out, palpate_error* error) PALPATE_NOEXCEPT;
PALPATE_API void palpate_session_close(palpate_session* session) PALPATE_NOEXCEPT;

/* NOLINTEND(readability-identifier-naming, modernize-use-using) */

#ifdef __cplusplus
}
#endif

#endif
