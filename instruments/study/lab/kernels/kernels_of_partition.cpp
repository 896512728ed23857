// Kernels of the haptic detecting box: all triangles in it again, and the list that follows the finger.
#include <memory>

#include "lab/kernels/kernel_list.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/hdb/coherent_list.h"
#include "palpate/hdb/haptic_box.h"

namespace palpate::bench {

namespace {

constexpr std::size_t kTicks = 2000;
constexpr std::size_t kTicksPerQuery = 40;
constexpr std::size_t kQueries = kTicks / kTicksPerQuery;  // boxes all over the back

struct BoxScene {
  hdb::Partition built;
  std::vector<Vec3> places;
  double edge_mm = 0.0;
  hdb::TriangleHits hits;
  hdb::CoherentList list;
};

std::shared_ptr<BoxScene> makeBoxScene(std::size_t triangles) {
  auto scene = std::make_shared<BoxScene>();
  scene->built = hdb::buildPartition(lab::backMesh(triangles), {});
  scene->edge_mm = hdb::hdbEdges(scene->built.bounds).x();
  scene->hits.prepareFor(scene->built);
  scene->list.prepareFor(scene->built);
  const device::Trajectory path = device::resampled(lab::backSlide(), 1e-3);
  const auto first = path.tip_mm.begin() + static_cast<std::ptrdiff_t>(lab::kSlideFromSeconds * 1e3);
  scene->places.assign(first, first + kTicks);
  return scene;
}

}  // namespace

std::vector<Kernel> partitionKernels(std::size_t triangles) {
  const auto scene = makeBoxScene(triangles);
  const auto query = [scene] {
    std::size_t found = 0;
    for (std::size_t i = 0; i < kTicks; i += kTicksPerQuery) {
      hdb::findTriangles(scene->built, hdb::hapticBox(scene->places[i], scene->edge_mm), scene->hits);
      hdb::listTriangles(scene->built, scene->hits);
      found += scene->hits.triangles.size();
    }
    return static_cast<double>(found);
  };
  const auto follow = [scene] {
    scene->list.covered.setEmpty();
    std::size_t ranges = 0;
    for (const Vec3& place : scene->places) {
      hdb::follow(scene->list, scene->built, hdb::hapticBox(place, scene->edge_mm));
      ranges += scene->list.hits.ranges.size();
    }
    return static_cast<double>(ranges);
  };
  return {{"hdb_query", "query", kQueries, Burden::arithmetic, query},
          {"coherent_list", "tick", kTicks, Burden::arithmetic, follow}};
}

}  // namespace palpate::bench
