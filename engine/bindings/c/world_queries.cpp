// Queries on a world: its skin, its places, where its vertices came from.
#include <algorithm>

#include "answers.h"
#include "palpate/body/places.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/engine/skin_place.h"
#include "palpate/scene/lumps_of_body.h"
#include "structs.h"
#include "world_handle.h"

namespace palpate::c_api {

namespace {

// Vectors of threes are handed out as plain numbers.
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::uint32_t));
static_assert(kNoIndex == PALPATE_NONE);

void putVector(const Vec3& vector, double (&target)[3]) noexcept {
  for (int axis = 0; axis < 3; ++axis) target[axis] = vector[axis];
}

palpate_world_facts makeWorldFacts(const scene::World& world) {
  palpate_world_facts facts = {};
  facts.vertices = world.body->skin.positions.size();
  facts.triangles = world.body->skin.triangles.size();
  facts.landmarks = world.body->anatomy.landmarks.size();
  facts.notes = world.notes.size();
  facts.fingers = world.scene.fingers.size();
  const Box3 box = mesh::boundingBox(world.body->skin);
  putVector(box.min(), facts.low_mm);
  putVector(box.max(), facts.high_mm);
  facts.closed = world.body->closed ? 1 : 0;
  facts.breathes = world.breath ? 1 : 0;
  facts.ticks_per_s = world.scene.ticks_per_s;
  facts.hash = engine::hashOf(world);
  putText(world.body->name, facts.body_name);
  facts.lumps = world.lumps.size();
  return facts;
}

palpate_lump toCLump(const scene::PlacedLump& placed) noexcept {
  palpate_lump lump = {};
  putVector(placed.lump.foot, lump.foot_mm);
  putVector(placed.lump.axis, lump.axis);
  putVector(placed.lump.across, lump.across);
  putVector(placed.lump.up, lump.up);
  putVector(placed.settings.halfAxes(), lump.half_axes_mm);
  lump.depth_mm = placed.settings.depth_mm;
  lump.young_kpa = placed.young_kpa;
  lump.layer_kpa = placed.layer_kpa;
  lump.tissue_mm = placed.thickness_mm;
  lump.mobility_mm_per_n = placed.settings.mobility_mm_per_n;
  lump.mobility_limit_mm = placed.settings.mobility_limit_mm;
  std::copy(placed.share.begin(), placed.share.end(), lump.share);
  putText(placed.name, lump.name);
  return lump;
}

palpate_place toPlace(const SkinPlace& at, std::string_view name) noexcept {
  palpate_place place = {};
  putVector(at.point, place.point_mm);
  putVector(at.normal, place.normal);
  place.triangle = at.triangle;
  putText(name, place.name);
  return place;
}

const std::vector<Index>* findIndexMap(const engine::WorldFromArrays& built, int32_t map) noexcept {
  switch (map) {
    case PALPATE_MAP_SOURCE_VERTEX:
      return &built.source_vertex;
    case PALPATE_MAP_SOURCE_TRIANGLE:
      return &built.source_triangle;
    case PALPATE_MAP_BUILT_VERTEX:
      return &built.built_vertex;
    case PALPATE_MAP_BUILT_TRIANGLE:
      return &built.built_triangle;
    default:
      return nullptr;
  }
}

}  // namespace

}  // namespace palpate::c_api

using namespace palpate;
using c_api::answered;
using c_api::require;

int32_t palpate_world_get_facts(const palpate_world* world, palpate_world_facts* facts) noexcept {
  return answered(nullptr, [&] {
    require(world != nullptr && c_api::isUsable(facts), "");
    c_api::toCaller(c_api::makeWorldFacts(world->world()), facts);
  });
}

const double* palpate_world_positions(const palpate_world* world) noexcept {
  return world == nullptr ? nullptr : world->world().body->skin.positions.front().data();
}

const uint32_t* palpate_world_triangles(const palpate_world* world) noexcept {
  return world == nullptr ? nullptr : world->world().body->skin.triangles.front().data();
}

const double* palpate_world_stiffness(const palpate_world* world) noexcept {
  return world == nullptr ? nullptr : world->world().surface.stiffness_n_per_mm->data();
}

const uint32_t* palpate_world_map(const palpate_world* world, int32_t map, size_t* count) noexcept {
  const std::vector<Index>* found = world == nullptr ? nullptr : c_api::findIndexMap(world->built, map);
  const bool is_there = found != nullptr && !found->empty();
  if (count != nullptr) *count = is_there ? found->size() : 0;
  return is_there ? found->data() : nullptr;
}

int32_t palpate_world_place(const palpate_world* world, const char* utf8_words, palpate_place* place,
                            palpate_error* error) noexcept {
  return answered(error, [&] {
    require(world != nullptr && utf8_words != nullptr, "the world or the words are null");
    require(c_api::isUsable(place), "place is null, or its size is not set");
    const std::string name = body::placeNamed(world->world().body->anatomy.landmarks, utf8_words).name;
    c_api::toCaller(c_api::toPlace(engine::skinPlace(world->world(), utf8_words), name), place);
  });
}

int32_t palpate_world_landmark(const palpate_world* world, size_t index, palpate_place* place) noexcept {
  return answered(nullptr, [&] {
    require(world != nullptr && c_api::isUsable(place) && index < world->world().body->anatomy.landmarks.size(), "");
    const body::SkinLandmark& landmark = world->world().body->anatomy.landmarks[index];
    const SkinPlace at = {landmark.position, landmark.normal, kNoIndex};
    c_api::toCaller(c_api::toPlace(at, body::spokenName(landmark.name)), place);
  });
}

int32_t palpate_world_lump(const palpate_world* world, size_t index, palpate_lump* lump) noexcept {
  if (world == nullptr || !c_api::isUsable(lump) || index >= world->world().lumps.size()) return PALPATE_ARGUMENT;
  c_api::toCaller(c_api::toCLump(*world->world().lumps[index]), lump);
  return PALPATE_OK;
}

const char* palpate_world_note(const palpate_world* world, size_t index) noexcept {
  if (world == nullptr || index >= world->world().notes.size()) return nullptr;
  return world->world().notes[index].c_str();
}
