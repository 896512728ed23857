// The functions that the page's worker calls: a body is opened, touched, shown and exported. Plain C names over
// LiveBody.
//
// The functions are those of engine/web/page/engine.js, which has their documentation.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "engine/body_json.h"
#include "engine/exports.h"
#include "engine/live_body.h"
#include "engine/opened_body.h"
#include "palpate/base/colour_map.h"
#include "palpate/contact/pressure_field.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::web {

namespace {

std::unique_ptr<LiveBody> body;
scene::ReadyBody ready;  // read, not yet opened
std::vector<float> ready_rest;
FramePacker frame;
std::vector<float> bone_positions;
std::vector<std::uint32_t> bone_triangles;

/// All bones as one mesh: they are drawn together.
void gatherBones(const std::vector<body::Bone>& bones) {
  bone_positions.clear();
  bone_triangles.clear();
  for (const body::Bone& bone : bones) {
    const auto first = static_cast<std::uint32_t>(bone_positions.size() / 3);
    for (const Vec3& p : bone.mesh.positions) {
      for (const double axis : p) bone_positions.push_back(static_cast<float>(axis));
    }
    for (const Triangle& t : bone.mesh.triangles) {
      for (const Index corner : t) bone_triangles.push_back(first + corner);
    }
  }
}

/// In the layout of a frame (frame_packer.h), so that it can be shown while it is built.
std::vector<float> packRestFrame(const mesh::TriangleMesh& skin) {
  std::vector<float> rest;
  rest.reserve(kFloatsOfVertex * skin.positions.size());
  const std::vector<Vec3> normals = mesh::vertexNormals(skin);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    for (const double axis : skin.positions[v]) rest.push_back(static_cast<float>(axis));
    for (const double axis : normals[v]) rest.push_back(static_cast<float>(axis));
    rest.push_back(0.0f);
  }
  return rest;
}

void adoptWorld(std::shared_ptr<const scene::World> world) {
  body.reset();  // there may not be room for both
  body = std::make_unique<LiveBody>(std::move(world));
  gatherBones(body->world().body->anatomy.bones);
}

}  // namespace

const char* keptText(std::string text) {
  static std::string kept;
  kept = std::move(text);
  return kept.c_str();
}

// ---- memory and bodies

PALPATE_EXPORT void* palpate_take(std::size_t bytes) { return std::malloc(bytes); }
PALPATE_EXPORT void palpate_give(void* memory) { std::free(memory); }

/// Reads the trunk's file; palpate_open_ready makes it the body. Between them it can be looked at.
PALPATE_EXPORT const char* palpate_read_ready(const char* bytes, std::size_t length) {
  return catchError([&] {
    ready = scene::decodeBody({bytes, length}, "trunk");
    ready_rest = packRestFrame(ready.parts.skin);
  });
}
PALPATE_EXPORT std::size_t palpate_ready_vertices() { return ready.parts.skin.positions.size(); }
PALPATE_EXPORT const float* palpate_ready_rest() { return ready_rest.data(); }
PALPATE_EXPORT std::size_t palpate_ready_triangles() { return ready.parts.skin.triangles.size(); }
PALPATE_EXPORT const Index* palpate_ready_corners() { return ready.parts.skin.triangles.data()->data(); }
PALPATE_EXPORT const char* palpate_ready_landmarks() { return keptText(landmarksJson(ready.parts.anatomy.landmarks)); }
PALPATE_EXPORT const char* palpate_open_ready() {
  return catchError([] {
    ready_rest = {};
    adoptWorld(openReady(std::exchange(ready, {})));
  });
}

PALPATE_EXPORT const char* palpate_open_mesh(const char* bytes, std::size_t length, const char* name,
                                             std::size_t name_length, double unit_mm) {
  return catchError([&] { adoptWorld(openMesh({bytes, length}, {name, name_length}, unit_mm)); });
}

/// `numbers`: x, y, radius and change in per cent of each dysfunction.
PALPATE_EXPORT const char* palpate_set_dysfunctions(const double* numbers, std::size_t count) {
  return catchError([&] {
    std::vector<maps::Dysfunction> dysfunctions(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double* n = numbers + 4 * i;
      dysfunctions[i] = {.x_mm = n[0], .y_mm = n[1], .radius_mm = n[2], .change_percent = n[3]};
    }
    body->setDysfunctions(std::move(dysfunctions));
  });
}

/// Not 0: the preset's three, which only the trunk has room for; 0: none.
PALPATE_EXPORT const char* palpate_set_lumps(int on) {
  return catchError([&] { body->setLumps(on != 0 ? presetLumps() : std::vector<scene::LumpSettings>()); });
}

// ---- what the body looks like

PALPATE_EXPORT const char* palpate_about() { return keptText(bodyJson(body->world())); }
PALPATE_EXPORT std::size_t palpate_vertices() { return body->world().deformable->vertices; }
PALPATE_EXPORT std::size_t palpate_triangles() { return body->world().deformable->triangles.size(); }
PALPATE_EXPORT const Index* palpate_triangle_corners() { return body->world().deformable->triangles.data()->data(); }
PALPATE_EXPORT const double* palpate_stiffness() { return body->world().surface.stiffness_n_per_mm->data(); }
PALPATE_EXPORT std::size_t palpate_bone_vertices() { return bone_positions.size() / 3; }
PALPATE_EXPORT const float* palpate_bone_positions() { return bone_positions.data(); }
PALPATE_EXPORT std::size_t palpate_bone_corners() { return bone_triangles.size(); }
PALPATE_EXPORT const std::uint32_t* palpate_bone_triangles() { return bone_triangles.data(); }

/// 256 colours, four bytes each; `map` as ColourMap.
PALPATE_EXPORT const std::uint8_t* palpate_colours(unsigned map) {
  static std::array<std::uint8_t, 1024> bytes;
  for (std::size_t i = 0; i < 256; ++i) {
    const ColourBytes colour = bytesOf(colourOf(static_cast<ColourMap>(map), static_cast<double>(i) / 255.0));
    std::copy(colour.begin(), colour.end(), bytes.begin() + static_cast<std::ptrdiff_t>(4 * i));
    bytes[4 * i + 3] = 255;
  }
  return bytes.data();
}

// ---- touching

/// `numbers`: place, normal, depth in mm. Not pressed: it hovers. `present` 0: it is nowhere.
PALPATE_EXPORT void palpate_aim(std::size_t finger, int present, int pressed, const double* numbers) {
  device::FingerTarget target;
  target.present = present != 0;
  target.pressed = pressed != 0;
  target.place = Vec3(numbers[0], numbers[1], numbers[2]);
  target.normal = Vec3(numbers[3], numbers[4], numbers[5]);
  target.depth_mm = numbers[6];
  body->aim(finger, target);
}

PALPATE_EXPORT void palpate_run(std::size_t ticks) { body->run(ticks); }

/// The finger's last tick: tip, proxy, normal, force (three each), depth, touch (0 free, 1 stick, 2 slip), status.
PALPATE_EXPORT const double* palpate_felt(std::size_t finger) {
  static std::array<double, 15> numbers;
  const contact::FingerOutput& felt = body->felt(finger);
  double* out = numbers.data();
  for (const Vec3* v : {&felt.tip, &felt.proxy, &felt.normal, &felt.force}) out = std::copy(v->begin(), v->end(), out);
  *out++ = felt.depth_mm;
  *out++ = static_cast<double>(felt.touch);
  *out = static_cast<double>(felt.status);
  return numbers.data();
}

/// kPa of the finger's last tick, `taxels` rows of as many, the first nearest to the head; null where the body has no
/// lumps, and so no pads.
PALPATE_EXPORT const double* palpate_pad(std::size_t finger, std::size_t taxels) {
  static std::array<double, contact::kMaxTaxels * contact::kMaxTaxels> kpa;
  if (taxels < contact::kMinTaxels || taxels > contact::kMaxTaxels) return nullptr;
  return body->pad(finger, std::span(kpa).first(taxels * taxels)) ? kpa.data() : nullptr;
}

// ---- pictures and files

/// Packs the changes since the last call (or all); returns the number of ranges.
PALPATE_EXPORT std::size_t palpate_frame(int all) {
  body->packFrame(frame, all != 0);
  return frame.ranges().size() / 2;
}
PALPATE_EXPORT const std::uint32_t* palpate_frame_ranges() { return frame.ranges().data(); }
PALPATE_EXPORT const float* palpate_frame_values() { return frame.values().data(); }
PALPATE_EXPORT std::size_t palpate_frame_floats() { return frame.values().size(); }

PALPATE_EXPORT std::size_t palpate_recorded() { return body->recording().size(); }
PALPATE_EXPORT void palpate_record_anew() { body->restartRecording(); }
PALPATE_EXPORT const char* palpate_forces_csv() { return keptText(body->recording().asForcesCsv()); }
PALPATE_EXPORT const char* palpate_scene_toml() { return keptText(sceneText(body->world().scene)); }

}  // namespace palpate::web
