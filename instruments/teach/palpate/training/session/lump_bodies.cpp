#include "palpate/training/session/lump_bodies.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/lumps/lump_observer.h"
#include "palpate/scene/healthy_tissue.h"
#include "palpate/scene/lumps_of_body.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::training {

namespace {

/// Grid of places where a lump may be, mm: finer than anyone names them.
constexpr double kGridMm = 4.0;
/// Margin around the outermost sites.
constexpr double kBesideSitesMm = 8.0;
/// C of a lump is that of a press with this, N: firm, and no more than desktop devices hold.
constexpr double kCuePressN = 3.0;

tissue::LumpShape shapeOf(const lumps::LumpTask& task, std::size_t size, std::size_t depth) {
  const double radius = 0.5 * task.diameters_mm[size];
  tissue::LumpShape shape{.half_axes_mm = {radius, radius, radius}, .depth_mm = task.depths_mm[depth]};
  shape.stiffness_ratio = task.ratios.back();
  return shape;
}

/// Whether any lump of the task may lie in tissue of this thickness.
bool hasRoom(const lumps::LumpTask& task, const scene::LumpGround& ground, double thickness_mm) {
  const tissue::LayerStack stack = ground.stackAt(thickness_mm);
  for (std::size_t size = 0; size < lumps::kGrades; ++size) {
    for (std::size_t depth = 0; depth < lumps::kGrades; ++depth) {
      const tissue::LumpShape shape = shapeOf(task, size, depth);
      const tissue::TopRange tops = tissue::topRange(shape, stack);
      if (shape.depth_mm < tops.from_mm || shape.depth_mm > tops.to_mm) return false;
    }
  }
  return true;
}

struct SkinOver {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  double tissue_mm = 0.0;
};

std::optional<SkinOver> skinOver(const scene::World& world, const Vec2& place) {
  const tree::TriangleTree& tree = world.surface.geometry->tree;
  const double far = 2.0 * tree.diagonal + tree.center.norm();
  const tree::Crossing hit = tree::firstFrontCrossing(tree, {place.x(), place.y(), far}, {place.x(), place.y(), -far});
  if (hit.triangle == kNoIndex) return std::nullopt;
  const auto& corners = tree.records[hit.triangle].corners;
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  return SkinOver{hit.point, normal.normalized(),
                  scene::thicknessOverBone(*world.healthy, tree.records[hit.triangle], hit.point)};
}

std::vector<Vec2> placesWithRoom(const scene::World& world, const lumps::LumpTask& task, const SiteSet& sites) {
  const scene::LumpGround ground(world.scene, *world.healthy, world.tissue.model == scene::TissueModel::layered,
                                 "sittings with lumps");
  Eigen::AlignedBox2d box;
  for (const Site& site : sites.sites) box.extend(site.place_mm);
  std::map<double, bool> known;  // many places are as thick as each other
  std::vector<Vec2> places;
  for (double y = box.min().y() - kBesideSitesMm; y <= box.max().y() + kBesideSitesMm; y += kGridMm) {
    for (double x = box.min().x() - kBesideSitesMm; x <= box.max().x() + kBesideSitesMm; x += kGridMm) {
      const auto skin = skinOver(world, {x, y});
      if (!skin) continue;
      const double thickness = skin->tissue_mm > 0.0 ? skin->tissue_mm : ground.thickest();
      const auto found = known.find(thickness);
      const bool room = found != known.end() ? found->second : hasRoom(task, ground, thickness);
      known.insert_or_assign(thickness, room);
      if (room) places.emplace_back(x, y);
    }
  }
  return places;
}

scene::Scene withoutLumps(const scene::Scene& base, const Protocol& protocol) {
  if (!protocol.lump) {
    throw Error(fmt::format("protocol {}: a lump session needs a table [lump]", protocol.id));
  }
  return lumpScene(base, *protocol.lump, {});
}

}  // namespace

scene::Scene lumpScene(const scene::Scene& base, const lumps::LumpTask& task,
                       std::span<const lumps::HiddenLump> hidden) {
  scene::Scene scene = base;
  scene.dysfunctions.clear();
  scene.lumps.clear();
  for (const lumps::HiddenLump& one : hidden) {
    scene::LumpSettings lump;
    lump.x_mm = one.place_mm.x();
    lump.y_mm = one.place_mm.y();
    lump.diameter_mm = task.diameters_mm[static_cast<std::size_t>(one.size)];
    lump.depth_mm = task.depths_mm[static_cast<std::size_t>(one.depth)];
    lump.stiffness_ratio = task.ratios[static_cast<std::size_t>(one.hardness)];
    if (one.mobile) lump.mobility_mm_per_n = task.mobility_mm_per_n;
    scene.lumps.push_back(lump);
  }
  return scene;
}

LumpBodies::LumpBodies(const std::shared_ptr<const scene::World>& body, const Protocol& protocol, const SiteSet& sites)
    : plain_(scene::rebuilt(*body, withoutLumps(body->scene, protocol))),
      ground_(scene::pressureGround(*plain_)),
      task_(*protocol.lump),
      places_(placesWithRoom(*plain_, task_, sites)) {
  if (places_.empty()) {
    throw Error(
        fmt::format("protocol {}: lumps of {:g} mm with tops {:g} mm deep do not fit between the skin and bones here",
                    protocol.id, task_.diameters_mm.back(), task_.depths_mm.back()));
  }
}

std::shared_ptr<const scene::World> LumpBodies::with(std::span<const lumps::HiddenLump> hidden) const {
  return hidden.empty() ? plain_ : scene::rebuilt(*plain_, lumpScene(plain_->scene, task_, hidden));
}

double LumpBodies::computeClarity(const lumps::HiddenLump& lump) const {
  // The lump alone: a whole world of it takes ten times as long.
  const scene::Scene scene = lumpScene(plain_->scene, task_, std::span(&lump, 1));
  std::vector<std::string> notes;
  contact::Surface surface = plain_->surface;
  surface.lumps = scene::feltLumps(scene::placedLumps({scene, *plain_->body, *plain_->healthy, surface}, notes));
  const scene::Finger finger = scene.fingers.empty() ? scene::Finger{} : scene.fingers.front();
  const lumps::ComparedSkin skin(std::move(surface), ground_, scene::contactSettings(scene, finger));
  const SkinOver over = *skinOver(*plain_, lump.place_mm);
  const lumps::ComparedSkin::Press press = skin.press(over.point, over.normal, kCuePressN);
  const lumps::LumpObserver observer;
  return lumps::computeClarity(skin.cue(press, observer.taxels), observer);
}

}  // namespace palpate::training
