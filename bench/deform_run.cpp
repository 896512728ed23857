#include "bench/deform_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "bench/allocation_count.h"
#include "bench/workload_meshes.h"
#include "palpate/deform/form_deformer.h"
#include "palpate/mesh/reorder.h"

namespace palpate::bench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPlaces = 16;
/// The finger's places lie on a circle of this radius around the middle of the back: a few millimetres apart, as
/// between two frames of a moving hand.
constexpr double kWanderMm = 10.0;
constexpr double kMiddleX = 175.0;
constexpr double kMiddleY = 200.0;

Index triangleAt(const mesh::TriangleMesh& mesh, double x, double y) {
  Index best = 0;
  double nearest = 1e300;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 centre = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    const double distance = (centre.head<2>() - Vec2(x, y)).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      best = t;
    }
  }
  return best;
}

deform::Contact contactAt(const mesh::TriangleMesh& mesh, Index triangle, const DeformRun& run) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  deform::Contact contact;
  contact.anchor = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
  contact.anchor_triangle = triangle;
  contact.normal = mesh::areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]).normalized();
  contact.depth_mm = run.depth_mm;
  contact.drag_mm = {run.drag_mm, 0.0, 0.0};
  contact.normal_region = maps::liftedOntoSurface({run.half_major_mm, run.aspect}, contact.normal);
  contact.tangential_region = contact.normal_region;
  return contact;
}

std::vector<deform::Contact> wanderingContacts(const mesh::TriangleMesh& mesh, const DeformRun& run) {
  std::vector<deform::Contact> contacts;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPlaces;
    const double x = kMiddleX + kWanderMm * std::cos(angle);
    const double y = kMiddleY + kWanderMm * std::sin(angle);
    contacts.push_back(contactAt(mesh, triangleAt(mesh, x, y), run));
  }
  return contacts;
}

/// Calls `step(place)` for each of at most kPlaces places, round after round for `seconds`; the sum of each place's
/// shortest time in ns.
template <class Step>
double bestOf(std::size_t places, double seconds, const Step& step) {
  std::array<double, kPlaces> best;  // on the stack: allocations are being counted
  best.fill(1e300);
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  do {
    for (std::size_t i = 0; i < places; ++i) {
      const auto start = Clock::now();
      step(i);
      best[i] = std::min(best[i], std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    }
  } while (Clock::now() < end);
  return std::accumulate(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(places), 0.0);
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
  const double best = bestOf(1, seconds, [&](std::size_t) {
    for (std::size_t stream = 0; stream < 6; ++stream) {
      float* values = streams[stream];
      for (std::size_t v = 0; v < vertices; ++v) values[v] += 1.0f;
    }
  });
  return best / static_cast<double>(vertices);
}

}  // namespace

DeformFigures measureDeform(const DeformRun& run) {
  mesh::TriangleMesh mesh = backMesh(run.triangles);
  mesh::reorderSpatially(mesh);
  const auto contacts = wanderingContacts(mesh, run);
  const deform::Skin skin = deform::buildSkin(mesh);
  const deform::FormSettings forms = formsOf(run);
  std::optional<deform::Deformer> fast;
  std::optional<deform::FormDeformer> general;
  if (run.general || deform::needsForms(forms)) {
    general.emplace(skin, forms);
  } else {
    fast.emplace(skin, forms.common);
  }
  deform::DeformedSurface surface(skin);

  const auto apply = [&](const deform::Contact& contact) {
    return fast ? fast->apply({&contact, 1}, surface) : general->apply({&contact, 1}, surface);
  };
  double moved = 0.0;
  for (const deform::Contact& contact : contacts) moved += apply(contact).moved_vertices;
  const auto allocations_before = allocationsOfThisThread();
  const double applied = bestOf(kPlaces, run.seconds, [&](std::size_t place) { apply(contacts[place]); });
  DeformFigures figures;
  if (allocations_before) figures.allocations = *allocationsOfThisThread() - *allocations_before;

  deform::RegionSearch search(skin);
  const double searched = bestOf(kPlaces, run.seconds / 2, [&](std::size_t place) {
    const auto lanes = deform::lanesOf(deform::frameOf(contacts[place], forms.common.tissue), 0.0, Vec3::Zero());
    search.find(skin, lanes, skin.triangles[contacts[place].anchor_triangle]);
  });
  figures.triangles = mesh.triangles.size();
  figures.vertices = moved / kPlaces;
  figures.ns_per_vertex = applied / moved;
  figures.region_ns_per_vertex = searched / moved;
  figures.copy_floor_ns_per_vertex = copyFloor(static_cast<std::size_t>(figures.vertices) + 1, run.seconds / 4);
  figures.ratio_to_copy_floor = figures.ns_per_vertex / figures.copy_floor_ns_per_vertex;
  return figures;
}

}  // namespace palpate::bench
