// What another simulator does with palpate::view: pictures of a skin at rest and under a finger, without a window. Ends
// with 77 and says why on a machine that has no OpenGL to draw with.
#include <palpate/base/error.h>
#include <palpate/body/back.h>
#include <palpate/engine/simulator.h>
#include <palpate/mesh/files/save.h>
#include <palpate/scene/scene_file.h>
#include <palpate/view/picture.h>
#include <palpate/view/scene_view.h>

#include <cstdio>
#include <optional>
#include <set>

using namespace palpate;

/// Why nothing can be drawn here; empty where it can.
std::optional<Error> noContext() {
  try {
    const view::OffscreenContext context;
    return std::nullopt;
  } catch (const Error& error) {
    return error;
  }
}

int main() try {
  mesh::save("back.obj", body::makeBack({.triangles = 8163, .shape = {}}));
  const auto world =
      scene::build(scene::parse("[body]\nkind = \"mesh\"\nfile = \"back.obj\"\n"
                                "[[finger]]\nname = \"index\"\nscript = [{ do = \"press\" }]\n",
                                "consumer.toml"));
  engine::Simulator simulator(world);
  double depth_mm = 0.0;
  for (double z = 130.0; depth_mm < 8.0 && z > 0.0; z -= 0.025) depth_mm = simulator.feel(0, {60.0, 0.0, z}).depth_mm;

  if (const auto reason = noContext()) {
    std::printf("nothing drawn: %s\n", reason->what());
    return 77;
  }
  const view::PictureSettings settings = view::pictureSettings(*world, 16.0 / 9.0);
  const auto drawn = [&](const deform::DeformedSurface& skin) {
    return view::picture(world, skin, {}, settings, {320, 180, 1});
  };
  const view::Image rest = drawn(deform::DeformedSurface(*world->deformable));
  const view::Image pressed = drawn(simulator.skin());
  view::writePng("back.png", pressed);
  const std::size_t colours = std::set<view::Pixel>(pressed.pixels.begin(), pressed.pixels.end()).size();
  std::size_t changed = 0;
  for (std::size_t i = 0; i < rest.pixels.size(); ++i) changed += pressed.pixels[i] != rest.pixels[i] ? 1 : 0;
  std::printf("drew %d x %d pixels in %zu colours, %zu of them changed by a press of %.1f mm\n", pressed.width,
              pressed.height, colours, changed, depth_mm);
  return colours > 100 && changed > 50 ? 0 : 1;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
