#include "palpate/view/background.h"

namespace palpate::view {

namespace {

constexpr std::string_view kVertex = R"(
out vec2 place;
void main() {  // one triangle that covers the picture
  place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(place, 0.0, 1.0);
}
)";

// Neutral greys, so that colours read true. A trace of fixed noise hides the steps of 8 bits.
constexpr std::string_view kFragment = R"(
in vec2 place;
uniform float white;
out vec4 colour;
void main() {
  float noise = fract(52.98 * fract(dot(gl_FragCoord.xy, vec2(0.0671, 0.00584)))) - 0.5;
  vec3 grey = mix(vec3(0.285, 0.290, 0.300), vec3(0.125, 0.130, 0.142), 0.5 + 0.5 * place.y);
  grey += 0.045 * exp(-1.2 * dot(place, place));
  colour = vec4(mix(grey + noise / 255.0, vec3(1.0), white), 1.0);
}
)";

}  // namespace

Background::Background() : program_("background", "", kVertex, kFragment) {}

void Background::draw(bool white) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program_.use();
  program_.set("white", white ? 1.0f : 0.0f);
  glBindVertexArray(nothing_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace palpate::view
