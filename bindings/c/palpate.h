/* Palpate in C: bodies that can be felt, fingers that feel them, skin that follows, sessions read back.
 *
 *   world ─► finger ─ tip ─► palpate_finger_step ─► palpate_touch: force, depth, contact
 *     │                                                   │
 *     └────► skin ─────────────────────────────► palpate_skin_apply ─► positions, normals, strain
 *
 * This file needs nothing but a C89 compiler with <stdint.h>, or C++11. Link with -lpalpate. docs/reference/c-api.md
 * tells the rest.
 *
 * Units and axes: millimetre, newton, second, newton per millimetre. The body's frame: x to the body's right seen from
 * behind, y towards the head, z out of the back. Skin faces counter-clockwise seen from outside. Texts are UTF-8 and
 * end in NUL.
 *
 * Structures: every one begins with `size`, its size in bytes as the caller was compiled. The caller sets it, the
 * library reads and writes no more than that many bytes, whatever its own version knows. New members come at the end
 * only. A size of 0, or one that no version of the structure has (no multiple of its alignment), is refused. What a
 * library does not know is left as it was: set a structure to zero before its first use.
 *
 * Handles: a world is counted (_retain, _release) and never changes. A finger and a skin keep their world; a caller may
 * release it first. A session and what it gave are the caller's. Every function that releases takes null. A handle
 * that was released must not be used again; nothing can find that out.
 *
 * Errors: what can fail returns PALPATE_OK or another code, and explains itself in the caller's palpate_error, which
 * may be null. Null where a pointer is needed, a size of 0, an index out of range: PALPATE_ARGUMENT, and nothing
 * happens. A function that makes a handle sets `*out` to null first. No exception leaves the library, it prints nothing
 * and never ends the program.
 *
 * Threads: a world may be used by any number of threads at once. A finger, a skin and a session belong to one thread at
 * a time; nobody locks for them. Different ones share nothing that is written. A palpate_error belongs to its caller.
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

/* Names as C has them. NOLINTBEGIN(readability-identifier-naming, modernize-use-using) */

/* ---- what functions return ------------------------------------------------------------------------------------- */

#define PALPATE_OK 0
#define PALPATE_ARGUMENT 1 /* null, a size of 0, an index or a number out of range: the caller's mistake */
#define PALPATE_REFUSED 2  /* a file, a text, a mesh or settings that make no sense: the message says what and where */
#define PALPATE_MEMORY 3   /* there is not enough */
#define PALPATE_FAILED 4   /* anything else, in the words of the system */

/* No such triangle, vertex or place. */
#define PALPATE_NONE 0xffffffffu

/* Why something failed; the caller's. Functions that take one write it whether they fail or not. */
typedef struct palpate_error {
  size_t size;
  int32_t code;      /* as returned; PALPATE_OK: nothing failed */
  int32_t line;      /* of the file or text, counted from 1; 0: not known */
  char message[512]; /* one line, `file:line: cause`; cut short between two letters if it is longer */
} palpate_error;

/* Of the loaded library, "0.3.0"; there until the program ends. Any thread. */
PALPATE_API const char* palpate_version(void) PALPATE_NOEXCEPT;

/* ---- worlds: a body with its stiffness, immutable and counted ---------------------------------------------------- */

typedef struct palpate_world palpate_world;

/* Builds the world of a scene file (TOML, docs/reference/scene-files.md), with the files that it names. Takes 0.02 to
 * some seconds. `utf8_path` as the system takes it. Any thread. */
PALPATE_API int32_t palpate_world_load(const char* utf8_path, palpate_world** out,
                                       palpate_error* error) PALPATE_NOEXCEPT;

/* The same from the text of a scene. `name` stands for the file in messages and its folder for relative names; null:
 * "scene". An empty text is the built-in trunk. */
PALPATE_API int32_t palpate_world_parse(const char* utf8_toml, const char* name, palpate_world** out,
                                        palpate_error* error) PALPATE_NOEXCEPT;

/* The built-in torso over its bones. `triangles`: of skin and bones together; 0: 20,389. */
PALPATE_API int32_t palpate_world_torso(size_t triangles, palpate_world** out, palpate_error* error) PALPATE_NOEXCEPT;

/* A body in the caller's memory, which is read during the call only. Set the structure to zero, then its size; exactly
 * one of each pair of pointers. */
typedef struct palpate_arrays {
  size_t size;
  const double* positions_mm;       /* x, y, z of each vertex; finite */
  const float* positions_mm_f32;    /* or these */
  size_t vertices;                  /* how many */
  const int32_t* corners;           /* three vertices of each triangle, counted from 0 */
  const int64_t* corners_i64;       /* or these */
  size_t triangles;                 /* how many */
  const double* stiffness_n_per_mm; /* of each vertex, finite and >= 0; null: as the scene says */
  const char* scene_toml;           /* friction, force law, deformation; its [body] is not looked at; null: defaults */
} palpate_arrays;

/* Seams are welded, faults mended, and vertices put in spatial order: palpate_world_map tells who became whom. */
PALPATE_API int32_t palpate_world_from_arrays(const palpate_arrays* arrays, palpate_world** out,
                                              palpate_error* error) PALPATE_NOEXCEPT;

/* The same body, vertices and triangles in the same order, under another scene: other law, stiffness, friction,
 * deformation. The scene's [body] is not looked at. `name` as for palpate_world_parse. */
PALPATE_API int32_t palpate_world_rebuilt(const palpate_world* world, const char* utf8_toml, const char* name,
                                          palpate_world** out, palpate_error* error) PALPATE_NOEXCEPT;

/* One more user, one less; the last one's release frees it. Null is fine. Any thread. */
PALPATE_API void palpate_world_retain(palpate_world* world) PALPATE_NOEXCEPT;
PALPATE_API void palpate_world_release(palpate_world* world) PALPATE_NOEXCEPT;

typedef struct palpate_world_facts {
  size_t size;
  uint64_t vertices;  /* of the skin */
  uint64_t triangles; /* of the skin */
  uint64_t landmarks; /* for palpate_world_landmark */
  uint64_t notes;     /* for palpate_world_note */
  uint64_t fingers;   /* that the scene describes; may be 0 */
  double low_mm[3];   /* box around the skin */
  double high_mm[3];
  int32_t closed;      /* 1: the skin has no border */
  int32_t breathes;    /* 1: the skin moves by itself, and ticks are its clock */
  double ticks_per_s;  /* of the scene */
  uint64_t hash;       /* worlds with the same hash give the same forces */
  char body_name[128]; /* "torso", or the file's name */
  uint64_t lumps;      /* for palpate_world_lump */
} palpate_world_facts;

/* Some milliseconds: the hash reads the whole skin. */
PALPATE_API int32_t palpate_world_get_facts(const palpate_world* world, palpate_world_facts* facts) PALPATE_NOEXCEPT;

/* The skin at rest. Null for a null world; else there until the world's last release. */
PALPATE_API const double* palpate_world_positions(const palpate_world* world) PALPATE_NOEXCEPT;   /* x, y, z; mm */
PALPATE_API const uint32_t* palpate_world_triangles(const palpate_world* world) PALPATE_NOEXCEPT; /* three vertices */
PALPATE_API const double* palpate_world_stiffness(const palpate_world* world) PALPATE_NOEXCEPT;   /* N/mm, a vertex */

/* Of a world from arrays: who became whom. Values are indices, or PALPATE_NONE. */
#define PALPATE_MAP_SOURCE_VERTEX 0   /* a vertex of the world each: the given one it is */
#define PALPATE_MAP_SOURCE_TRIANGLE 1 /* a triangle of the world each: the given one, none for what mending made */
#define PALPATE_MAP_BUILT_VERTEX 2    /* a given vertex each: the world's */
#define PALPATE_MAP_BUILT_TRIANGLE 3  /* a given triangle each: the world's */
/* Null and a count of 0 for another world and for another `map`. `count` may be null. */
PALPATE_API const uint32_t* palpate_world_map(const palpate_world* world, int32_t map, size_t* count) PALPATE_NOEXCEPT;

/* A named place of the skin at rest. */
typedef struct palpate_place {
  size_t size;
  double point_mm[3];
  double normal[3];  /* unit, out of the body */
  uint32_t triangle; /* of the world's skin, or PALPATE_NONE */
  uint32_t reserved;
  char name[128]; /* as an examiner says it: "T6 right 30 mm" */
} palpate_place;

/* "T6", "left PSIS", "T6 right 30 mm": upper and lower case and the order of words do not matter. Refuses a place that
 * the body has not, naming what is near in spelling. */
PALPATE_API int32_t palpate_world_place(const palpate_world* world, const char* utf8_words, palpate_place* place,
                                        palpate_error* error) PALPATE_NOEXCEPT;
/* Landmark number `index` of the body, from 0; its triangle is PALPATE_NONE. */
PALPATE_API int32_t palpate_world_landmark(const palpate_world* world, size_t index,
                                           palpate_place* place) PALPATE_NOEXCEPT;
/* What the user should know of the body: repairs, a doubtful unit. Null past the last; there until the last release. */
PALPATE_API const char* palpate_world_note(const palpate_world* world, size_t index) PALPATE_NOEXCEPT;

/* A lump under the skin, as the scene's [[lump]] has it in this body (docs/explanation/lumps.md). */
typedef struct palpate_lump {
  size_t size;
  double foot_mm[3];        /* on the skin at rest, over its middle */
  double axis[3];           /* unit, out of the skin there */
  double across[3];         /* unit; across, up and axis are right-handed */
  double up[3];             /* unit, towards the head */
  double half_axes_mm[3];   /* across, across, into the body */
  double depth_mm;          /* of its top under the skin, along the axis */
  double young_kpa;         /* in its middle */
  double layer_kpa;         /* of the layer at its centre */
  double tissue_mm;         /* thickness over the bone there */
  double mobility_mm_per_n; /* how far it moves under 1 N sideways; 0: it is fixed */
  double mobility_limit_mm; /* it moves no farther */
  double share[3];          /* what it adds to the force of a fingertip right over it that presses 3, 5, 8 mm */
  char name[64];            /* "lump1" where the scene gives none */
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
  double max_depth_mm;        /* the deepest depth that is felt; above 0 to 100,000 */
  double tick_s;              /* between two steps; 1e-6 to 1 */
  double catch_up_mm_per_s;   /* bounds how fast the contact may run after the tip; 0 to 1e6 */
  int32_t force_shading;      /* not 0: round off facets; a point finger only */
  int32_t reserved;           /* 0 */
  double relaxation_share;    /* of the force that a held press loses, first term; all together at most 0.9 */
  double relaxation_time_s;   /* above 0 */
  double relaxation_share_2;  /* second term */
  double relaxation_time_2_s; /* above 0 */
} palpate_finger_settings;

/* Defaults, and `size` in it. `size` is sizeof(palpate_finger_settings) of the caller; nothing for null or 0. */
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
#define PALPATE_UNSETTLED 64u       /* a ball goes on looking in the next tick */
#define PALPATE_SHADING_FAILED 128u /* force shading fell back to the facets */

/* What a finger felt in one tick. In free space places are the tip's and normal, force and depth zero. */
typedef struct palpate_touch {
  size_t size;
  double force_n[3];   /* on the tip */
  double depth_mm;     /* of the tip below the skin at rest */
  int32_t touch;       /* PALPATE_FREE, _STICK, _SLIP */
  uint32_t status;     /* bits */
  double normal[3];    /* unit, out of the skin; zero when free */
  double tip_mm[3];    /* where the device is */
  double proxy_mm[3];  /* the place of the skin that it presses */
  double anchor_mm[3]; /* the place of the skin that friction holds */
  double hold_mm[3];   /* where friction holds the tip, a point in space */
  uint32_t triangle;   /* of the world's skin under the proxy, or PALPATE_NONE */
  uint32_t anchor_triangle;
  double tissue_mm;        /* thickness over the bone under the proxy; 0 where it is not known */
  double rest_mm;          /* how deep the pressed skin would stay by itself (relaxation); 0 when free */
  double dent_mm[3];       /* a dent that the finger left and that comes back: where */
  double dent_rest_mm;     /* how deep it still is; 0: there is none */
  uint32_t dent_triangle;  /* of the world's skin, or PALPATE_NONE */
  uint32_t reserved;       /* 0 */
  uint64_t tick;           /* counts this finger's steps from 0 */
  double lump_force_n[3];  /* of force_n, what the lumps under the skin add */
  double lump_share;       /* their normal force over that of the press without them; 0 where that is 0 */
  double lump_moved_mm[2]; /* how far the lump below is from its place, across and up */
  uint32_t lump;           /* of those that move and are felt the nearest, for palpate_world_lump; or PALPATE_NONE */
  uint32_t reserved_2;     /* 0 */
} palpate_touch;

typedef struct palpate_finger palpate_finger;

/* `settings`: null for those of the scene's first finger. Refuses what is out of range. The world is kept. */
PALPATE_API int32_t palpate_finger_create(palpate_world* world, const palpate_finger_settings* settings,
                                          palpate_finger** out, palpate_error* error) PALPATE_NOEXCEPT;
/* One tick: the tip is at `tip_mm` now. 0.1 to some us. No allocation, no lock. A tip that is not finite is answered by
 * PALPATE_OK, no force and the status PALPATE_TIP_LOST. */
PALPATE_API int32_t palpate_finger_step(palpate_finger* finger, const double tip_mm[3],
                                        palpate_touch* touch) PALPATE_NOEXCEPT;
/* `count` ticks, one after the other: `tips_mm` has x, y, z of each. `touches` holds `count` structures that begin
 * `stride` bytes apart, and each gets `stride` as its size: give sizeof(palpate_touch). No allocation, no lock. */
PALPATE_API int32_t palpate_finger_rollout(palpate_finger* finger, const double* tips_mm, size_t count,
                                           palpate_touch* touches, size_t stride) PALPATE_NOEXCEPT;
/* The pressure on the fingertip in its last step, kPa: `taxels` rows of as many (2 to 16) of a square pad with sides of
 * `pad_mm` (1 to 100), in the plane of the contact. The first row is nearest to the head, the first taxel of a row
 * lowest along u = v x normal, with v towards the head. `kpa` has room for taxels * taxels, `shear_kpa` for twice as
 * many, or is null: shear on the finger along u and v, taxel by taxel. Zeros when free. The pressures add up to the
 * normal force; a point counts as a fingertip of 8 mm. Bodies of layered tissue only: PALPATE_REFUSED for another. 0.2
 * us for 4 x 4, 2 for 16 x 16; the first call of a finger in a world that has neither lumps nor a pad takes
 * milliseconds and allocates, others do not. */
PALPATE_API int32_t palpate_finger_pressure(palpate_finger* finger, size_t taxels, double pad_mm, float* kpa,
                                            float* shear_kpa) PALPATE_NOEXCEPT;
/* Lifts the finger: its next tip may be anywhere, and nothing between here and there is touched. Ticks go on. */
PALPATE_API int32_t palpate_finger_lift(palpate_finger* finger) PALPATE_NOEXCEPT;
PALPATE_API void palpate_finger_release(palpate_finger* finger) PALPATE_NOEXCEPT;

/* ---- skin -------------------------------------------------------------------------------------------------------- */

typedef struct palpate_skin palpate_skin;

/* The skin at rest, with room for the touches of so many fingers (1 to 4,096). `strain` not 0: strain is written too.
 * The world is kept. */
PALPATE_API int32_t palpate_skin_create(palpate_world* world, size_t fingers, int32_t strain, palpate_skin** out,
                                        palpate_error* error) PALPATE_NOEXCEPT;
/* Brings the skin to what these touches make of it, whatever it was before; none: to rest. They are of this world, and
 * begin `stride` bytes apart; each has its size. More than there is room for, a number that is not finite and a
 * triangle that there is none of are refused, and the skin stays. Once a picture; 0.2 ms a finger. No allocation, no
 * lock. */
PALPATE_API int32_t palpate_skin_apply(palpate_skin* skin, const palpate_touch* touches, size_t count,
                                       size_t stride) PALPATE_NOEXCEPT;
PALPATE_API size_t palpate_skin_vertices(const palpate_skin* skin) PALPATE_NOEXCEPT;
/* One value a vertex of the world's skin, in its order; `axis` 0, 1, 2 = x, y, z. Null for a null skin and for another
 * axis. The place stays until release, what is in it until the next apply. On a body that breathes as if it held its
 * breath: palpate_skin_lift_mm tells how far the breath has lifted it. Positions count from palpate_skin_origin_mm. */
PALPATE_API const float* palpate_skin_positions(const palpate_skin* skin, int32_t axis) PALPATE_NOEXCEPT;
PALPATE_API const float* palpate_skin_normals(const palpate_skin* skin, int32_t axis) PALPATE_NOEXCEPT;
PALPATE_API const float* palpate_skin_displacements(const palpate_skin* skin, int32_t axis) PALPATE_NOEXCEPT;
/* Strain around the vertex, above 0 is tension; zeros unless it was asked for. */
PALPATE_API const float* palpate_skin_strain(const palpate_skin* skin) PALPATE_NOEXCEPT;
/* What the last apply wrote, as `count` pairs: first vertex, end. Upload these. There until the next apply. */
PALPATE_API const uint32_t* palpate_skin_changed(const palpate_skin* skin, size_t* count) PALPATE_NOEXCEPT;
PALPATE_API double palpate_skin_lift_mm(const palpate_skin* skin) PALPATE_NOEXCEPT;
/* x, y, z that the positions count from: zeros, but for a body farther than 10 m from the origin of its frame (a scan in
 * map coordinates), where floats would be millimetres apart. There until release; null for a null skin. */
PALPATE_API const double* palpate_skin_origin_mm(const palpate_skin* skin) PALPATE_NOEXCEPT;
PALPATE_API void palpate_skin_release(palpate_skin* skin) PALPATE_NOEXCEPT;

/* ---- sessions: recorded runs, read back (docs/reference/recordings.md) ----------------------------------------------
 */

typedef struct palpate_session palpate_session;

/* Also one that is being written, or whose writer was killed. */
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
  uint64_t first_world; /* not 0 where the beginning was forgotten */
  uint64_t worlds;
  uint64_t events;
  uint64_t dropped;     /* samples that found no room when it was written */
  char started_utc[32]; /* 2026-11-21T18:45:00Z */
  char ended_utc[32];   /* "": it has no end */
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

/* What was recorded beside the touch. */
typedef struct palpate_sample {
  size_t size;
  uint64_t tick;
  uint32_t finger;
  uint32_t world;           /* number of the world in which it was felt */
  double device_force_n[3]; /* what went to the hand */
  uint32_t safety;          /* bits (docs/explanation/safety.md); 0: the force went through unchanged */
  uint32_t buttons;         /* of the device, bit 0 the first */
} palpate_sample;

/* Reads samples of the ticks `from` to `to`, both included, in the order of their ticks and fingers, into two arrays:
 * sample i goes to samples[i] and touches[i], either of which may be null. Each is written as palpate_finger_rollout
 * does; tissue_mm is not recorded and 0, `tick` is the session's. `room` is how many fit, at least as many as there are
 * fingers; whole ticks only are written. `*count` gets how many were; 0: there is none left. Go on with the tick after
 * the last. */
PALPATE_API int32_t palpate_session_read(palpate_session* session, uint64_t from, uint64_t to, palpate_sample* samples,
                                         size_t sample_stride, palpate_touch* touches, size_t touch_stride, size_t room,
                                         size_t* count, palpate_error* error) PALPATE_NOEXCEPT;

typedef struct palpate_replay {
  size_t size;
  uint64_t ticks;     /* samples that were felt again and compared */
  uint64_t different; /* of them, in any bit */
  uint64_t unproven;  /* samples that were not compared: time before them is missing from the session */
  uint64_t first_different_tick;
  int32_t identical; /* 1: something was compared, nothing differed, and the worlds are the recorded ones */
  int32_t reserved;
  char difference[256]; /* the first one in words; "" for none */
  char notes[512];      /* a world that is not the recorded one, and so on; "" for none */
} palpate_replay;
/* Feels the whole session again and compares every bit. `folder`: where the files that its scene names lie now; null:
 * where they lay. Takes as long as building its worlds and feeling its ticks. */
PALPATE_API int32_t palpate_session_replay(palpate_session* session, const char* folder, palpate_replay* replay,
                                           palpate_error* error) PALPATE_NOEXCEPT;
/* World number `number` of the session, built again; `folder` as above. */
PALPATE_API int32_t palpate_session_world(palpate_session* session, uint64_t number, const char* folder,
                                          palpate_world** out, palpate_error* error) PALPATE_NOEXCEPT;
PALPATE_API void palpate_session_close(palpate_session* session) PALPATE_NOEXCEPT;

/* NOLINTEND(readability-identifier-naming, modernize-use-using) */

#ifdef __cplusplus
}
#endif

#endif
