/* Where every member of every structure lies, on machines with eight-byte pointers: a member that moves does not
 * compile here. New members come at the end, and their line at the end of their structure. */
#include "palpate.h"

#define AT(structure, member, place) \
  _Static_assert(offsetof(structure, member) == (place), #structure "." #member " has moved")
#define SIZE(structure, bytes) _Static_assert(sizeof(structure) == (bytes), #structure " has another size")

#if UINTPTR_MAX == 0xffffffffffffffffu

AT(palpate_error, size, 0);
AT(palpate_error, code, 8);
AT(palpate_error, line, 12);
AT(palpate_error, message, 16);
SIZE(palpate_error, 528);

AT(palpate_arrays, size, 0);
AT(palpate_arrays, positions_mm, 8);
AT(palpate_arrays, positions_mm_f32, 16);
AT(palpate_arrays, vertices, 24);
AT(palpate_arrays, corners, 32);
AT(palpate_arrays, corners_i64, 40);
AT(palpate_arrays, triangles, 48);
AT(palpate_arrays, stiffness_n_per_mm, 56);
AT(palpate_arrays, scene_toml, 64);
SIZE(palpate_arrays, 72);

AT(palpate_world_facts, size, 0);
AT(palpate_world_facts, vertices, 8);
AT(palpate_world_facts, triangles, 16);
AT(palpate_world_facts, landmarks, 24);
AT(palpate_world_facts, notes, 32);
AT(palpate_world_facts, fingers, 40);
AT(palpate_world_facts, low_mm, 48);
AT(palpate_world_facts, high_mm, 72);
AT(palpate_world_facts, closed, 96);
AT(palpate_world_facts, breathes, 100);
AT(palpate_world_facts, ticks_per_s, 104);
AT(palpate_world_facts, hash, 112);
AT(palpate_world_facts, body_name, 120);
AT(palpate_world_facts, lumps, 248);
SIZE(palpate_world_facts, 256);

AT(palpate_place, size, 0);
AT(palpate_place, point_mm, 8);
AT(palpate_place, normal, 32);
AT(palpate_place, triangle, 56);
AT(palpate_place, reserved, 60);
AT(palpate_place, name, 64);
SIZE(palpate_place, 192);

AT(palpate_lump, size, 0);
AT(palpate_lump, foot_mm, 8);
AT(palpate_lump, axis, 32);
AT(palpate_lump, across, 56);
AT(palpate_lump, up, 80);
AT(palpate_lump, half_axes_mm, 104);
AT(palpate_lump, depth_mm, 128);
AT(palpate_lump, young_kpa, 136);
AT(palpate_lump, layer_kpa, 144);
AT(palpate_lump, tissue_mm, 152);
AT(palpate_lump, mobility_mm_per_n, 160);
AT(palpate_lump, mobility_limit_mm, 168);
AT(palpate_lump, share, 176);
AT(palpate_lump, name, 200);
SIZE(palpate_lump, 264);

AT(palpate_finger_settings, size, 0);
AT(palpate_finger_settings, radius_mm, 8);
AT(palpate_finger_settings, stiffness_ratio, 16);
AT(palpate_finger_settings, mu_static, 24);
AT(palpate_finger_settings, mu_dynamic, 32);
AT(palpate_finger_settings, max_depth_mm, 40);
AT(palpate_finger_settings, tick_s, 48);
AT(palpate_finger_settings, catch_up_mm_per_s, 56);
AT(palpate_finger_settings, force_shading, 64);
AT(palpate_finger_settings, reserved, 68);
AT(palpate_finger_settings, relaxation_share, 72);
AT(palpate_finger_settings, relaxation_time_s, 80);
AT(palpate_finger_settings, relaxation_share_2, 88);
AT(palpate_finger_settings, relaxation_time_2_s, 96);
SIZE(palpate_finger_settings, 104);

AT(palpate_touch, size, 0);
AT(palpate_touch, force_n, 8);
AT(palpate_touch, depth_mm, 32);
AT(palpate_touch, touch, 40);
AT(palpate_touch, status, 44);
AT(palpate_touch, normal, 48);
AT(palpate_touch, tip_mm, 72);
AT(palpate_touch, proxy_mm, 96);
AT(palpate_touch, anchor_mm, 120);
AT(palpate_touch, hold_mm, 144);
AT(palpate_touch, triangle, 168);
AT(palpate_touch, anchor_triangle, 172);
AT(palpate_touch, tissue_mm, 176);
AT(palpate_touch, rest_mm, 184);
AT(palpate_touch, dent_mm, 192);
AT(palpate_touch, dent_rest_mm, 216);
AT(palpate_touch, dent_triangle, 224);
AT(palpate_touch, reserved, 228);
AT(palpate_touch, tick, 232);
AT(palpate_touch, lump_force_n, 240);
AT(palpate_touch, lump_share, 264);
AT(palpate_touch, lump_moved_mm, 272);
AT(palpate_touch, lump, 288);
AT(palpate_touch, reserved_2, 292);
SIZE(palpate_touch, 296);

AT(palpate_session_facts, size, 0);
AT(palpate_session_facts, ticks_per_s, 8);
AT(palpate_session_facts, seconds, 16);
AT(palpate_session_facts, samples, 24);
AT(palpate_session_facts, first_tick, 32);
AT(palpate_session_facts, last_tick, 40);
AT(palpate_session_facts, fingers, 48);
AT(palpate_session_facts, first_world, 56);
AT(palpate_session_facts, worlds, 64);
AT(palpate_session_facts, events, 72);
AT(palpate_session_facts, dropped, 80);
AT(palpate_session_facts, started_utc, 88);
AT(palpate_session_facts, ended_utc, 120);
AT(palpate_session_facts, ended_by, 152);
AT(palpate_session_facts, software, 216);
AT(palpate_session_facts, notes, 280);
SIZE(palpate_session_facts, 792);

AT(palpate_session_finger, size, 0);
AT(palpate_session_finger, name, 8);
AT(palpate_session_finger, device, 72);
SIZE(palpate_session_finger, 136);

AT(palpate_sample, size, 0);
AT(palpate_sample, tick, 8);
AT(palpate_sample, finger, 16);
AT(palpate_sample, world, 20);
AT(palpate_sample, device_force_n, 24);
AT(palpate_sample, safety, 48);
AT(palpate_sample, buttons, 52);
SIZE(palpate_sample, 56);

AT(palpate_replay, size, 0);
AT(palpate_replay, ticks, 8);
AT(palpate_replay, different, 16);
AT(palpate_replay, unproven, 24);
AT(palpate_replay, first_different_tick, 32);
AT(palpate_replay, identical, 40);
AT(palpate_replay, reserved, 44);
AT(palpate_replay, difference, 48);
AT(palpate_replay, notes, 304);
SIZE(palpate_replay, 816);

#endif

int main(void) { return palpate_version() == NULL; }
