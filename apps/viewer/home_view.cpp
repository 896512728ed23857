#include "apps/viewer/home_view.h"

#include <algorithm>
#include <cmath>

#include "apps/viewer/panels.h"

namespace palpate::viewer {

view::Camera homeView(const scene::World& world, const Session& session, view::StandardView side,
                      const Vec2& size_points) {
  const auto width = static_cast<float>(size_points.x());
  const auto height = static_cast<float>(size_points.y());
  const FreeArea free = freeArea(session, width, height);
  const double free_width = std::max(50.0f, free.right - free.left);
  const double free_height = std::max(50.0f, free.below - free.top);
  view::Camera camera = view::fitted(mesh::boundingBox(world.skin), free_width / free_height, side);
  // Fitted for the free part alone; the window shows more, so the same size there needs a camera further away.
  camera.distance_mm *= height / free_height;
  const double mm_per_pixel = 2.0 * camera.distance_mm * std::tan(0.5 * camera.height_rad) / height;
  const double right = 0.5 * (free.left + free.right - width);
  const double below = 0.5 * (free.top + free.below - height);
  camera.centre += mm_per_pixel * (below * camera.up() - right * camera.right());
  return camera;
}

}  // namespace palpate::viewer
