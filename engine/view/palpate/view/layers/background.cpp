// 16 x 16 squares made of vertex numbers, without a buffer: the gradient is computed at their corners and not at each
// pixel. Each picture.
#include "palpate/view/layers/support_layer.h"

namespace palpate::view {

namespace {

// Neutral grey, so that colours read true, and a little lighter behind the body.
constexpr std::string_view kBackgroundVertex = R"(
uniform float white;
uniform float plain;  // grey of all of it; below 0: the gradient
out vec3 corner_grey;
const int columns = 16;
void main() {
  int quad = gl_VertexID / 6, corner = gl_VertexID % 6;
  ivec2 at = ivec2(quad % columns, quad / columns);
  at += ivec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner >= 4);
  vec2 place = vec2(at) * (2.0 / float(columns)) - 1.0;
  vec3 grey = mix(vec3(0.285, 0.290, 0.300), vec3(0.125, 0.130, 0.142), 0.5 + 0.5 * place.y);
  grey += 0.045 * exp(-1.2 * dot(place, place));
  corner_grey = plain < 0.0 ? mix(grey, vec3(1.0), white) : vec3(plain);
  gl_Position = vec4(place, 1.0, 1.0);
}
)";
constexpr GLsizei kVertices = 6 * 16 * 16;

// A fixed pattern hides the steps of 8 bits.
constexpr std::string_view kBackgroundFragment = R"(
in vec3 corner_grey;
out vec4 colour;
void main() {
  float noise = fract(dot(gl_FragCoord.xy, vec2(0.7548777, 0.5698403)));
  colour = vec4(corner_grey + (noise - 0.5) * (1.0 / 255.0), 1.0);
}
)";

}  // namespace

Background::Background() : program_("background", "", kBackgroundVertex, kBackgroundFragment) {}

void Background::draw(const Look& look) const {
  constexpr float kLight = 0.8f;  // share of the way from the dark gradient to white
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);  // it lies on the far plane
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program_.use();
  const float lightness = look.white_background ? 1.0f : look.light_background ? kLight : 0.0f;
  program_.set("white", lightness);
  program_.set("plain", static_cast<float>(look.plain_background.value_or(-1.0)));
  glBindVertexArray(nothing_.get());
  glDrawArrays(GL_TRIANGLES, 0, kVertices);
  glDepthFunc(GL_LESS);
}

}  // namespace palpate::view
