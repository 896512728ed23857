#include "palpate/view/renderer.h"

#include "palpate/view/gl_objects.h"

namespace palpate::view {

struct Renderer::Parts {
  std::shared_ptr<const scene::World> world;
};

Renderer::Renderer(std::shared_ptr<const scene::World> world) : parts_(std::make_unique<Parts>()) {
  parts_->world = std::move(world);
}
Renderer::~Renderer() = default;

Index Renderer::update(const deform::DeformedSurface&) { return 0; }
void Renderer::updateAll(const deform::DeformedSurface&) {}

void Renderer::draw(const Frame&, const Look&, const Frustum&, int, int) {
  glClearColor(0.25f, 0.25f, 0.27f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace palpate::view
