// Modes that keep the eyes apart copy rectangles; those that mix them draw one triangle over the screen that reads
// both. Eyes are swapped outside the shader. Each picture.
// Based on: Dubois (2001), Rec. 709, see stereo_composer.h.
#include "palpate/view/layers/stereo_composer.h"

namespace palpate::view {

namespace {

/// One triangle that covers the screen.
constexpr std::string_view kVertexSource = R"glsl(
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)glsl";

constexpr std::string_view kFragmentSource = R"glsl(
uniform sampler2D left_eye;
uniform sampler2D right_eye;
uniform int mode;         // 0 grey, 1 Dubois, 2 half, 3 interlaced
uniform int height;
uniform int row_height;
uniform int monitor_row;
out vec4 colour;

vec3 linear(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045))); }
vec3 encoded(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}
float luma(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// Rows of the published matrices are columns here: what each channel of an eye adds to red, green and blue.
const mat3 kDuboisLeft = mat3(0.437, -0.062, -0.048, 0.449, -0.062, -0.050, 0.164, -0.024, -0.017);
const mat3 kDuboisRight = mat3(-0.011, 0.377, -0.026, -0.032, 0.761, -0.093, -0.007, 0.009, 1.234);

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy);
  vec3 l = texelFetch(left_eye, place, 0).rgb;
  vec3 r = texelFetch(right_eye, place, 0).rgb;
  if (mode == 3) {
    int row = (height - 1 - place.y) / row_height + monitor_row;
    colour = vec4((row & 1) == 0 ? l : r, 1.0);
    return;
  }
  l = linear(l);
  r = linear(r);
  vec3 mixed = vec3(luma(l), vec2(luma(r)));
  if (mode == 1) mixed = kDuboisLeft * l + kDuboisRight * r;
  if (mode == 2) mixed = vec3(luma(l), r.gb);
  colour = vec4(encoded(mixed), 1.0);
}
)glsl";

int mixerMode(StereoMode mode) {
  switch (mode) {
    case StereoMode::anaglyph_dubois:
      return 1;
    case StereoMode::anaglyph_half:
      return 2;
    case StereoMode::interlaced:
      return 3;
    default:
      return 0;
  }
}

bool isMixed(StereoMode mode) {
  return mode == StereoMode::anaglyph_grey || mode == StereoMode::anaglyph_dubois ||
         mode == StereoMode::anaglyph_half || mode == StereoMode::interlaced;
}

void copyTo(const Target& eye, GLuint framebuffer, const Corner& corner) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, eye.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glBlitFramebuffer(0, 0, eye.width(), eye.height(), corner.x, corner.y, corner.x + eye.width(),
                    corner.y + eye.height(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace

StereoComposer::StereoComposer() : mixer_("stereo", "", kVertexSource, kFragmentSource) {}

const Target& StereoComposer::eye(Eye eye, const EyePicture& picture) {
  std::unique_ptr<Target>& target = eye == Eye::left ? left_ : right_;
  if (!target || target->width() != picture.width || target->height() != picture.height) {
    target = std::make_unique<Target>(picture.width, picture.height);
  }
  return *target;
}

void StereoComposer::compose(const StereoSettings& settings, GLuint framebuffer, int width, int height,
                             int row_height) const {
  if (isMixed(settings.mode)) {
    mix(settings, framebuffer, width, height, row_height);
  } else {
    copy(settings, framebuffer, width, height);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
}

void StereoComposer::copy(const StereoSettings& settings, GLuint framebuffer, int width, int height) const {
  const bool two_buffers = settings.mode == StereoMode::quad_buffer;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glDisable(GL_SCISSOR_TEST);
  // An odd row or column between the eyes stays black.
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  for (const Eye eye : {Eye::left, Eye::right}) {
    if (two_buffers) glDrawBuffer((eye == Eye::left) != settings.swap_eyes ? GL_BACK_LEFT : GL_BACK_RIGHT);
    copyTo(eye == Eye::left ? *left_ : *right_, framebuffer, pictureCorner(eye, settings, width, height));
  }
  if (two_buffers) glDrawBuffer(GL_BACK);
}

void StereoComposer::mix(const StereoSettings& settings, GLuint framebuffer, int width, int height,
                         int row_height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  mixer_.use();
  mixer_.set("left_eye", 0);
  mixer_.set("right_eye", 1);
  mixer_.set("mode", mixerMode(settings.mode));
  mixer_.set("height", height);
  mixer_.set("row_height", row_height);
  mixer_.set("monitor_row", settings.monitor_row);
  const bool swapped = settings.swap_eyes;
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, (swapped ? left_ : right_)->texture());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, (swapped ? right_ : left_)->texture());
  glBindVertexArray(nothing_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

}  // namespace palpate::view
