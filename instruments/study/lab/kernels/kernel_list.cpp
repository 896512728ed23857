// Two kernels of loading, welding and the triangle tree, and all of them in one list.
#include "lab/kernels/kernel_list.h"

#include <iterator>
#include <memory>
#include <utility>

#include "lab/workloads/workload_meshes.h"
#include "palpate/mesh/weld.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::bench {

namespace {

/// Kernels of loading: corners welded to vertices, and the triangle tree.
std::vector<Kernel> buildingKernels(std::size_t triangles) {
  const auto mesh = std::make_shared<const mesh::TriangleMesh>(lab::backMesh(triangles));
  const auto weld = [mesh] {
    mesh::ExactWelder welder(mesh->triangles.size() / 2);
    double sum = 0.0;
    for (const Triangle& triangle : mesh->triangles) {
      for (const Index v : triangle) sum += static_cast<double>(welder.add(mesh->positions[v]));
    }
    return sum;
  };
  const auto build = [mesh] { return static_cast<double>(tree::buildTriangleTree(*mesh).nodes.size()); };
  const auto count = static_cast<double>(mesh->triangles.size());
  return {{"weld", "triangle", count, Burden::arithmetic, weld},
          {"tree_build", "triangle", count, Burden::arithmetic, build}};
}

}  // namespace

std::vector<Kernel> makeKernels(std::size_t triangles) {
  std::vector<Kernel> all;
  for (auto* part : {contactKernels, partitionKernels, deformationKernels, buildingKernels}) {
    std::vector<Kernel> kernels = part(triangles);
    std::move(kernels.begin(), kernels.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace palpate::bench
