// Engine and literal deformation move fingers over the same places, the literal one every fourth of them, on the mesh
// as it was made. The shortest time of each place counts, since other load only ever adds. Both results are hashed, so
// that a change shows.
#include "lab/runs/deform_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "lab/counters/thread_counts.h"
#include "lab/literal/deformation.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/base/hash.h"
#include "palpate/base/stopwatch.h"
#include "palpate/deform/deformer.h"
#include "palpate/deform/fast_displacement.h"
#include "palpate/mesh/reorder.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::bench {

namespace {

/// Between neighbouring fingers: regions of the default size overlap, the fingers do not touch.
constexpr double kFingersApartMm = 40.0;
/// The literal deformation takes a thousand times as long as a frame may: every fourth place must do.
constexpr int kLiteralStride = 4;
/// Number of applies whose time is kept for the percentiles.
constexpr std::size_t kMaxSamples = 100000;

Index triangleAt(const mesh::TriangleMesh& mesh, const Vec2& place) {
  Index best = 0;
  double nearest = 1e300;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const double distance = (centreOf(mesh, mesh.triangles[t]).head<2>() - place).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      best = t;
    }
  }
  return best;
}

using Contacts = std::vector<deform::Contact>;

void setLayers(const DeformRun& run, deform::Contact& contact) {
  constexpr double kThicknessMm = 40.0;
  constexpr double kFatMm = 8.0;
  static const tissue::LayeredTissue layers(tissue::libraryNodes(kFatMm));
  const tissue::DragCurve drag = layers.dragAt(kThicknessMm);
  contact.layered = deform::LayeredShape{layers.pressAt(kThicknessMm, run.depth_mm), drag.share};
  contact.normal_region = maps::liftedOntoSurface({contact.layered->press.radius_mm, 1.0}, contact.normal);
  if (run.drag_mm > 0.0) {
    contact.tangential_region = {drag.along_mm * contact.drag_mm.normalized(), drag.across_mm / drag.along_mm};
  }
}

Vec3 highestPlace(const mesh::TriangleMesh& mesh) {
  return *std::max_element(mesh.positions.begin(), mesh.positions.end(),
                           [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
}

/// The same on any body: each place is the nearest of the skin to one of the plane x, y through `at`.
std::vector<Contacts> contactsOnBody(const mesh::TriangleMesh& mesh, const DeformRun& run) {
  const tree::TriangleTree tree = tree::buildTriangleTree(mesh);
  const Vec3 at = run.at.value_or(highestPlace(mesh));
  std::vector<Contacts> places;
  for (const Vec2& place : placesAround(at.head<2>())) {
    Contacts& contacts = places.emplace_back();
    for (int finger = 0; finger < run.fingers; ++finger) {
      const double beside = kFingersApartMm * (finger - 0.5 * (run.fingers - 1));
      const auto nearest = tree::nearestPoint(tree, Vec3(place.x() + beside, place.y(), at.z()),
                                              std::numeric_limits<double>::infinity());
      deform::Contact contact = contactAt(mesh, tree.source_triangle[nearest.triangle], nearest.closest.point, run);
      const Vec3 along = Vec3::UnitX() - contact.normal.x() * contact.normal;
      contact.drag_mm = run.drag_mm * along.normalized();
      contacts.push_back(contact);
    }
  }
  return places;
}

/// For each place of a round its fingers.
std::vector<Contacts> wanderingContacts(const mesh::TriangleMesh& mesh, const DeformRun& run) {
  if (run.body) return contactsOnBody(mesh, run);
  std::vector<Contacts> places;
  for (const Vec2& place : placesAround({0.5 * lab::kBackWidthMm, 0.5 * lab::kBackLengthMm})) {
    Contacts& contacts = places.emplace_back();
    for (int finger = 0; finger < run.fingers; ++finger) {
      const double beside = kFingersApartMm * (finger - 0.5 * (run.fingers - 1));
      const Index triangle = triangleAt(mesh, place + Vec2(beside, 0.0));
      contacts.push_back(contactAt(mesh, triangle, centreOf(mesh, mesh.triangles[triangle]), run));
    }
  }
  return places;
}

literal::Touch toTouch(const deform::Contact& contact) {
  const maps::SurfaceEllipse& ellipse = contact.normal_region;
  return {.anchor = contact.anchor,
          .anchor_triangle = static_cast<int>(contact.anchor_triangle),
          .normal = contact.normal,
          .depth_mm = contact.depth_mm,
          .drag_mm = contact.drag_mm,
          .half_major_mm = ellipse.half_major,
          .aspect = ellipse.aspect};
}

/// The times of a step at each place: the shortest, in ns, and all of them as far as there is room, in us.
struct Timings {
  std::array<double, kPlaces> best_ns;  // on the stack: allocations are being counted
  std::vector<double> all_us;
  explicit Timings(std::size_t room) {
    best_ns.fill(1e300);
    all_us.reserve(room);
  }
  void note(std::size_t place, double ns) {
    best_ns[place] = std::min(best_ns[place], ns);
    if (all_us.size() < all_us.capacity()) all_us.push_back(1e-3 * ns);
  }
  /// Time of one round.
  double bestRoundNs(std::size_t places) const {
    return std::accumulate(best_ns.begin(), best_ns.begin() + static_cast<std::ptrdiff_t>(places), 0.0);
  }
};

/// Calls `step(place)` for each of at most kPlaces places, round after round for `seconds`, at least once.
template <class Step>
void repeat(std::size_t places, double seconds, Timings& timings, const Step& step) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  do {
    for (std::size_t i = 0; i < places; ++i) {
      const auto start = Clock::now();
      step(i);
      timings.note(i, nanosecondsSince(start));
    }
  } while (Clock::now() < end);
}

ApplyFigures summariseTimings(Timings timings, std::size_t places, double moved) {
  ApplyFigures figures;
  const double round_ns = timings.bestRoundNs(places);
  figures.vertices = moved / static_cast<double>(places);
  figures.ns_per_vertex = round_ns / moved;
  figures.us_per_frame = 1e-3 * round_ns / static_cast<double>(places);
  figures.apply_us = lab::computePercentiles(std::move(timings.all_us));
  return figures;
}

std::uint64_t hashOf(const deform::DeformedSurface& surface) {
  Hash hash;
  for (Index v = 0; v < surface.vertices(); ++v) {
    hash.add(Vec3(surface.positionAt(v).cast<double>()));
    hash.add(Vec3(surface.normalAt(v).cast<double>()));
  }
  return hash.value();
}

std::uint64_t hashOf(const literal::Mesh& mesh) {
  Hash hash;
  for (const literal::Vertex& vertex : mesh.vertices) {
    hash.add(vertex.position);
    hash.add(vertex.normal);
  }
  return hash.value();
}

deform::FormSettings formsOf(const DeformRun& run) {
  deform::FormSettings forms;
  forms.common.strain = run.strain || run.principal;
  if (run.recompute) forms.common.normals = deform::Normals::recomputed;
  if (run.incremental) forms.common.normals = deform::Normals::incremental;
  if (run.principal) forms.strain_kind = deform::StrainKind::principal;
  return forms;
}

double copyFloor(std::size_t vertices, double seconds) {
  deform::FloatStreams streams(6, vertices, 0);
  Timings timings(0);
  repeat(1, seconds, timings, [&](std::size_t) {
    for (std::size_t stream = 0; stream < 6; ++stream) {
      float* values = streams[stream];
      for (std::size_t v = 0; v < vertices; ++v) values[v] += 1.0f;
    }
  });
  return timings.best_ns[0] / static_cast<double>(vertices);
}

void timeEngine(const deform::Skin& skin, const std::vector<Contacts>& places, const DeformRun& run,
                DeformFigures& figures) {
  deform::Deformer deformer(skin, formsOf(run), run.general ? deform::Way::general : deform::Way::chosen);
  deform::DeformedSurface surface(skin);
  double moved = 0.0;
  for (const Contacts& contacts : places) moved += deformer.apply(contacts, surface).moved_vertices;
  Timings timings(kMaxSamples);
  const auto before = lab::allocationsOfThisThread();
  repeat(kPlaces, run.seconds, timings, [&](std::size_t place) { deformer.apply(places[place], surface); });
  if (before) figures.allocations = *lab::allocationsOfThisThread() - *before;
  figures.ours = summariseTimings(std::move(timings), kPlaces, moved);
  deformer.apply(places[0], surface);
  figures.ours.hash = hashOf(surface);
}

double searchNs(const deform::Skin& skin, const std::vector<Contacts>& places, const DeformRun& run) {
  deform::RegionByBlocks search(skin);
  const deform::TissueSettings tissue = formsOf(run).common.tissue;
  Timings timings(0);
  repeat(kPlaces, run.seconds / 2, timings, [&](std::size_t place) {
    for (const deform::Contact& contact : places[place]) {
      const auto lanes = deform::lanesOf(deform::frameOf(contact, tissue), 0.0, Vec3::Zero());
      search.find(skin, lanes, skin.triangles[contact.anchor_triangle]);
    }
  });
  return timings.bestRoundNs(kPlaces);
}

/// On the mesh as it was made: linked lists gain nothing from the order that the engine sorts it into.
ApplyFigures timeLiteral(const DeformRun& run) {
  const mesh::TriangleMesh mesh = run.body ? *run.body : lab::backMesh(run.triangles);
  const auto places = wanderingContacts(mesh, run);
  literal::Deformation deformation(mesh);
  std::vector<std::vector<literal::Touch>> touches;
  for (std::size_t i = 0; i < places.size(); i += kLiteralStride) {
    std::transform(places[i].begin(), places[i].end(), std::back_inserter(touches.emplace_back()), toTouch);
  }
  double moved = 0.0;
  for (const auto& fingers : touches) {
    deformation.apply(fingers);
    moved += deformation.movedNodes();
  }
  Timings timings(kMaxSamples);
  repeat(touches.size(), run.seconds, timings, [&](std::size_t place) { deformation.apply(touches[place]); });
  ApplyFigures figures = summariseTimings(std::move(timings), touches.size(), moved);
  deformation.apply(touches[0]);
  figures.hash = hashOf(deformation.mesh());
  return figures;
}

}  // namespace

deform::Contact contactAt(const mesh::TriangleMesh& mesh, Index triangle, const Vec3& place, const DeformRun& run) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  deform::Contact contact;
  contact.anchor = place;
  contact.anchor_triangle = triangle;
  contact.normal = mesh::areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]).normalized();
  contact.depth_mm = run.depth_mm;
  contact.drag_mm = {run.drag_mm, 0.0, 0.0};
  contact.normal_region = maps::liftedOntoSurface({run.half_major_mm, run.aspect}, contact.normal);
  contact.tangential_region = contact.normal_region;
  if (run.layered) setLayers(run, contact);
  return contact;
}

std::array<Vec2, kPlaces> placesAround(const Vec2& middle) {
  constexpr double kWanderMm = 10.0;
  std::array<Vec2, kPlaces> places;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPlaces;
    places[i] = middle + kWanderMm * Vec2(std::cos(angle), std::sin(angle));
  }
  return places;
}

DeformFigures measureDeform(const DeformRun& run) {
  mesh::TriangleMesh mesh = run.body ? *run.body : lab::backMesh(run.triangles);
  mesh::reorderSpatially(mesh);
  const auto places = wanderingContacts(mesh, run);
  const deform::Skin skin = deform::buildSkin(mesh);
  DeformFigures figures;
  figures.triangles = mesh.triangles.size();
  timeEngine(skin, places, run, figures);
  const double moved = figures.ours.vertices;
  figures.region_ns_per_vertex = searchNs(skin, places, run) / (kPlaces * moved);
  figures.copy_floor_ns_per_vertex = copyFloor(static_cast<std::size_t>(moved) + 1, run.seconds / 4);
  figures.ratio_to_copy_floor = figures.ours.ns_per_vertex / figures.copy_floor_ns_per_vertex;
  if (!run.literal) return figures;
  figures.literal = timeLiteral(run);
  figures.speedup_over_literal = figures.literal->ns_per_vertex / figures.ours.ns_per_vertex;
  return figures;
}

}  // namespace palpate::bench
