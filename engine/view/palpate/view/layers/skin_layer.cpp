// Picks the program for each run of triangles: those near a finger get the one with shadows and blanching, the rest a
// shorter one, because software OpenGL runs both sides of a condition. Transparent skin writes its depth first.
// Data flow: Look, viewpoint, touches -> runs (SkinBuffers) -> program (skin_paint.h) -> framebuffer.
#include "palpate/view/layers/skin_layer.h"

#include <vector>

namespace palpate::view {

namespace {

/// Skin lines fade out below (skin_shader.h): where all of the body is farther away they are not computed at all.
constexpr float kFewestPixelsPerMm = 2.7f;

void drawRuns(std::span<const IndexRun> runs) {
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;
  for (const IndexRun& run : runs) {
    counts.push_back(static_cast<GLsizei>(run.count));
    offsets.push_back(bufferOffset(run.first * sizeof(Index)));
  }
  glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(), static_cast<GLsizei>(runs.size()));
}

/// Depth alone, so that afterwards only the nearest skin of each pixel is blended: exact, whatever the order.
void drawDepth(const SplitRuns& runs) {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  drawRuns(runs.touched);
  drawRuns(runs.plain);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace

void SkinLayer::setWorld(const scene::World& world) {
  picture_.show(world.body->texture);
  buffers_.emplace(world);
  closed_ = world.body->closed;
}

SkinNeeds SkinLayer::shaderNeeds(const Look& look, const Viewpoint& viewpoint) const {
  const bool pores =
      look.detail && look.shading == Shading::skin && viewpoint.pixelsPerMm(buffers_->box()) > kFewestPixelsPerMm;
  const bool picture = look.texture && picture_.isThere();
  return {pores, picture, look.texture && !picture && buffers_->hasColours(), picture && picture_.isMade()};
}

void SkinLayer::drawColours(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch,
                            const SplitRuns& runs) {
  const SkinNeeds needs = shaderNeeds(look, viewpoint);
  if (buffers_->hasField(look)) {
    buffers_->showField(look);
    paint_.useField(look, viewpoint);
    return drawRuns(runs.plain);
  }
  if (needs.picture) picture_.bind();
  if (!runs.touched.empty()) paint_.useTouched(look, viewpoint, needs, touch);
  drawRuns(runs.touched);
  paint_.use(look, viewpoint, needs);
  drawRuns(runs.plain);
}

void SkinLayer::draw(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch) {
  if (!(look.skin_opacity > 0.0)) return;
  const bool transparent = look.skin_opacity < 1.0;
  const bool lit = !buffers_->hasField(look);
  const auto influences = lit ? collectInfluences(touch, viewpoint.lights) : std::vector<Influence>();
  const SplitRuns& runs = buffers_->bind(viewpoint, influences, look.cull);
  glEnable(GL_DEPTH_TEST);
  // A closed skin hides its inside; an open sheet may be looked at from within.
  (closed_ ? glEnable : glDisable)(GL_CULL_FACE);
  if (transparent) {
    paint_.useDepth(viewpoint);
    drawDepth(runs);
  }
  glDepthFunc(transparent ? GL_EQUAL : GL_LESS);
  (transparent ? glEnable : glDisable)(GL_BLEND);
  blendOver();
  drawColours(look, viewpoint, touch, runs);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthFunc(GL_LESS);
}

}  // namespace palpate::view
