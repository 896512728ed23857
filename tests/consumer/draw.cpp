// What another simulator does with palpate::view: a picture of a skin, without a window. Says so and ends well on a
// machine that cannot draw.
#include <palpate/base/error.h>
#include <palpate/body/back.h>
#include <palpate/mesh/files/save.h>
#include <palpate/scene/scene_file.h>
#include <palpate/scene/world.h>
#include <palpate/view/picture.h>
#include <palpate/view/scene_view.h>

#include <cstdio>
#include <set>

using namespace palpate;

int main() try {
  mesh::save("back.obj", body::makeBack({.triangles = 2000, .shape = {}}));
  const auto world =
      scene::build(scene::parse("[body]\nkind = \"mesh\"\nfile = \"back.obj\"\n"
                                "[[finger]]\nname = \"index\"\nscript = [{ do = \"press\" }]\n",
                                "consumer.toml"));
  const deform::DeformedSurface rest(world->deformable);
  try {
    const view::OffscreenContext can_draw;
  } catch (const Error& error) {
    std::printf("nothing drawn: %s\n", error.what());
    return 0;
  }
  const view::PictureSettings settings = view::pictureSettings(*world, 16.0 / 9.0);
  const view::Image image = view::picture(world, rest, {}, settings, {320, 180, 1});
  view::writePng("back.png", image);
  const std::size_t colours = std::set<view::Pixel>(image.pixels.begin(), image.pixels.end()).size();
  std::printf("drew %d x %d pixels in %zu colours\n", image.width, image.height, colours);
  return colours > 100 ? 0 : 1;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
