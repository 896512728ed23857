// Kernels of the deformation under one finger that goes to and fro between two places, as from frame to frame: the left
// skin is restored, the reached skin is moved. And the map that gives the ellipse of a place.
#include <array>
#include <bit>
#include <memory>
#include <utility>

#include "lab/kernels/kernel_list.h"
#include "lab/runs/deform_run.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/deform/deformer.h"
#include "palpate/deform/fast_displacement.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/mesh/reorder.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::bench {

namespace {

constexpr int kMapPlaces = 1000;

struct Touched {
  mesh::TriangleMesh mesh;
  deform::Skin skin;
  std::array<deform::Contact, 2> contacts;
};

deform::Contact contactBelow(const Vec3& above, const mesh::TriangleMesh& mesh, const tree::TriangleTree& tree) {
  const tree::NearestPoint place = tree::nearestPoint(tree, above, tree.diagonal);
  return contactAt(mesh, tree.source_triangle[place.triangle], place.closest.point, {.drag_mm = 5.0});
}

std::shared_ptr<const Touched> touchedBack(std::size_t triangles) {
  auto touched = std::make_shared<Touched>();
  touched->mesh = lab::backMesh(triangles);
  mesh::reorderSpatially(touched->mesh);
  touched->skin = deform::buildSkin(touched->mesh);
  const tree::TriangleTree tree = tree::buildTriangleTree(touched->mesh);
  const Vec3 middle = mesh::boundingBox(touched->mesh).center();
  const Vec3 above = middle + Vec3(0.0, 0.0, 0.5 * tree.diagonal);
  touched->contacts = {contactBelow(above, touched->mesh, tree),
                       contactBelow(above + Vec3(4.0, 3.0, 0.0), touched->mesh, tree)};
  return touched;
}

/// A deformer and its surface; both point into `touched`.
struct Applying {
  std::shared_ptr<const Touched> touched;
  deform::Deformer deformer;
  deform::DeformedSurface surface;

  Applying(std::shared_ptr<const Touched> on, const deform::Settings& settings)
      : touched(std::move(on)), deformer(touched->skin, settings), surface(touched->skin) {}
  double run() {
    double moved = 0.0;
    for (const deform::Contact& contact : touched->contacts) {
      moved += static_cast<double>(deformer.apply({&contact, 1}, surface).moved_vertices);
    }
    return moved;
  }
};

Kernel applyKernel(std::string name, const std::shared_ptr<const Touched>& touched, const deform::Settings& settings,
                   Burden burden) {
  auto applying = std::make_shared<Applying>(touched, settings);
  const double moved = applying->run();
  return {std::move(name), "vertex", moved, burden, [applying] { return applying->run(); }};
}

Kernel regionKernel(const std::shared_ptr<const Touched>& touched) {
  auto search = std::make_shared<deform::RegionByBlocks>(touched->skin);
  const auto run = [touched, search] {
    const deform::Contact& contact = touched->contacts[0];
    const auto lanes = deform::lanesOf(deform::frameOf(contact, {}), 0.0, Vec3::Zero());
    double vertices = 0.0;
    for (const deform::BlockPart& part :
         search->find(touched->skin, lanes, touched->skin.triangles[contact.anchor_triangle])) {
      vertices += std::popcount(part.vertices);
    }
    return vertices;
  };
  return {"region_search", "vertex", run(), Burden::arithmetic, run};
}

Kernel mapKernel() {
  auto map = std::make_shared<const maps::EllipseMap>(maps::dissertationKeyPoints());
  return {"ellipse_map", "place", kMapPlaces, Burden::arithmetic, [map] {
            double sum = 0.0;
            for (int i = 0; i < kMapPlaces; ++i) sum += map->at(0.1 * i - 50.0, 0.2 * i - 100.0).half_major_mm;
            return sum;
          }};
}

}  // namespace

std::vector<Kernel> deformationKernels(std::size_t triangles) {
  const auto touched = touchedBack(triangles);
  deform::Settings recomputed, strained;
  recomputed.normals = deform::Normals::recomputed;
  strained.strain = true;
  return {regionKernel(touched), applyKernel("displacement_normals", touched, {}, Burden::memory),
          applyKernel("recomputed_normals", touched, recomputed, Burden::memory),
          applyKernel("strain", touched, strained, Burden::memory), mapKernel()};
}

}  // namespace palpate::bench
