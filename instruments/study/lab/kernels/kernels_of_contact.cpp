// Kernels of a finger that slides over the back: the two queries of the tree, and whole ticks of a point and a sphere.
#include <memory>
#include <span>
#include <utility>

#include "lab/kernels/kernel_list.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/contact/finger.h"
#include "palpate/mesh/repair.h"

namespace palpate::bench {

namespace {

/// One second of the slide is enough: 250 mm of skin.
constexpr std::size_t kPointTicks = 1000;
constexpr std::size_t kSphereTicks = 200;
constexpr double kFingertipMm = 8.0;
constexpr double kReachMm = 20.0;  // further than the tip is deep

struct Slide {
  contact::Surface surface;
  std::vector<Vec3> tips;
};

std::shared_ptr<const Slide> slideOver(std::size_t triangles) {
  auto slide = std::make_shared<Slide>();
  const mesh::TriangleMesh mesh = mesh::repair(lab::backMesh(triangles)).mesh;
  contact::SurfaceOptions options;
  options.self_intersecting = false;
  slide->surface = contact::buildSurface(mesh, std::vector<double>(mesh.positions.size(), 0.5), options);
  const device::Trajectory path = device::resampled(lab::backSlide(), 1e-3);
  const auto first = static_cast<std::size_t>(lab::kSlideFromSeconds * 1e3);
  slide->tips.assign(path.tip_mm.begin(), path.tip_mm.begin() + static_cast<std::ptrdiff_t>(first + kPointTicks));
  return slide;
}

std::span<const Vec3> lastTips(const Slide& slide, std::size_t count) { return std::span(slide.tips).last(count); }

/// Ticks of the slide, from the state that the press before it left.
Kernel tickKernel(std::string name, const std::shared_ptr<const Slide>& slide, double radius_mm, std::size_t ticks) {
  contact::FingerSettings settings;
  settings.radius_mm = radius_mm;
  contact::FingerState pressed;
  for (const Vec3& tip : std::span(slide->tips).first(slide->tips.size() - ticks)) {
    (void)contact::step(slide->surface, settings, pressed, tip);
  }
  return {std::move(name), "tick", static_cast<double>(ticks), Burden::arithmetic, [slide, settings, pressed, ticks] {
            contact::FingerState state = pressed;
            double sum = 0.0;
            for (const Vec3& tip : lastTips(*slide, ticks)) {
              sum += contact::step(slide->surface, settings, state, tip).force.z();
            }
            return sum;
          }};
}

}  // namespace

std::vector<Kernel> contactKernels(std::size_t triangles) {
  const auto slide = slideOver(triangles);
  const auto closest = [slide] {
    double sum = 0.0;
    for (const Vec3& tip : lastTips(*slide, kPointTicks)) {
      sum += tree::nearestPoint(slide->surface.geometry->tree, tip, kReachMm).closest.squared_distance;
    }
    return sum;
  };
  const auto crossing = [slide] {
    double sum = 0.0;
    for (const Vec3& tip : lastTips(*slide, kPointTicks)) {
      sum += tree::firstFrontCrossing(slide->surface.geometry->tree, tip + kReachMm * Vec3::UnitZ(), tip).fraction;
    }
    return sum;
  };
  return {{"closest_point", "query", kPointTicks, Burden::arithmetic, closest},
          {"segment_crossing", "query", kPointTicks, Burden::arithmetic, crossing},
          tickKernel("walk_tick", slide, 0.0, kPointTicks),
          tickKernel("sphere_tick", slide, kFingertipMm, kSphereTicks)};
}

}  // namespace palpate::bench
