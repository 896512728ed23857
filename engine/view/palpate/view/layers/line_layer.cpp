// Lines are cut at the near plane, projected and widened in pixels, with a pixel more for the soft edge; two passes
// with opposite depth tests draw the hidden and the visible parts. Each picture.
#include "palpate/view/layers/line_layer.h"

#include <cstddef>

namespace palpate::view {

namespace {

constexpr std::string_view kPointVertex = R"(
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 paint;
uniform float nearer;
out vec4 corner_paint;
void main() {
  corner_paint = paint;
  gl_Position = clip_from_body * vec4(mix(place, eye, nearer), 1.0);
}
)";

constexpr std::string_view kEdgeVertex = R"(
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in float z;
layout(location = 13) in float breath_share;
uniform float nearer;
uniform vec4 edge_paint;
out vec4 corner_paint;
void main() {
  corner_paint = edge_paint;
  gl_Position = clip_from_body * vec4(mix(vec3(x, y, z + lift_mm * breath_share), eye, nearer), 1.0);
}
)";

constexpr std::string_view kLineGeometry = R"(
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
in vec4 corner_paint[];
uniform vec2 pixels;
uniform float width;
out vec4 paint;
noperspective out float across;  // pixels from the middle of the line
noperspective out float along;   // pixels from its start
void emit(vec4 at, vec2 aside, float side, float distance, vec4 its_paint) {
  paint = its_paint;
  across = side;
  along = distance;
  gl_Position = at + vec4(aside * side * 2.0 / pixels * at.w, 0.0, 0.0);
  EmitVertex();
}
void main() {
  vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
  // The part before the near plane: what lies behind the eye has no place on the screen.
  float da = a.z + a.w, db = b.z + b.w;
  if (da <= 0.0 && db <= 0.0) return;
  if (da <= 0.0) a = mix(a, b, da / (da - db) + 1e-4);
  if (db <= 0.0) b = mix(b, a, db / (db - da) + 1e-4);
  vec2 pa = a.xy / a.w * 0.5 * pixels, pb = b.xy / b.w * 0.5 * pixels;
  float length_px = max(distance(pa, pb), 1e-3);
  vec2 direction = (pb - pa) / length_px;
  vec2 aside = vec2(-direction.y, direction.x);
  float half_px = 0.5 * width + 1.0;  // a pixel more for the soft edge
  emit(a, aside, half_px, 0.0, corner_paint[0]);
  emit(a, aside, -half_px, 0.0, corner_paint[0]);
  emit(b, aside, half_px, length_px, corner_paint[1]);
  emit(b, aside, -half_px, length_px, corner_paint[1]);
  EndPrimitive();
}
)";

constexpr std::string_view kLineFragment = R"(
in vec4 paint;
noperspective in float across;
noperspective in float along;
uniform float width;
uniform float dash_px;  // 0: a whole line
uniform float strength;
out vec4 colour;
void main() {
  if (dash_px > 0.0 && mod(along, 2.0 * dash_px) > dash_px) discard;
  float covered = saturate(0.5 * width + 0.5 - abs(across)) * min(1.0, width);
  colour = vec4(paint.rgb, paint.a * covered * strength);
}
)";

constexpr std::string_view kPatchFragment = R"(
in vec4 corner_paint;
out vec4 colour;
void main() { colour = corner_paint; }
)";

/// Hidden lines: this much of their opacity is left, in dashes of this many pixels.
constexpr float kHiddenShare = 0.25f;
constexpr float kDashPx = 4.0f;

Eigen::Vector4f toUnitRange(Paint paint) { return Eigen::Vector4f(paint[0], paint[1], paint[2], paint[3]) / 255.0f; }

}  // namespace

LineLayer::LineLayer()
    : lines_("lines", kSharedShader, kPointVertex, kLineFragment, kLineGeometry),
      edges_("edges", kSharedShader, kEdgeVertex, kLineFragment, kLineGeometry),
      patches_("patches", kSharedShader, kPointVertex, kPatchFragment) {
  glBindVertexArray(vertex_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, points_.get());
  attributeAt(0, 3, GL_FLOAT, sizeof(UploadedPoint));
  attributeAt(1, 4, GL_UNSIGNED_BYTE, sizeof(UploadedPoint), offsetof(UploadedPoint, paint));
  glBindVertexArray(0);
}

void LineLayer::upload(std::span<const PaintedPoint> points, const Viewpoint& viewpoint) {
  uploaded_.clear();
  for (const PaintedPoint& point : points) uploaded_.push_back({viewpoint.drawn(point.place), point.paint});
  glBindVertexArray(vertex_array_.get());
  fillBuffer<UploadedPoint>(GL_ARRAY_BUFFER, points_.get(), uploaded_, GL_STREAM_DRAW);
}

void LineLayer::begin(const Program& program, const Viewpoint& viewpoint) {
  program.use();
  setViewpoint(program, viewpoint);
  program.set("pixels", viewpoint.pixels);
  program.set("nearer", kNearerShare);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  blendOver();
}

void LineLayer::end() {
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void LineLayer::draw(const Lines& lines, const Viewpoint& viewpoint, double pixels_per_point) {
  if (lines.points.empty()) return;
  upload(lines.points, viewpoint);
  begin(lines_, viewpoint);
  const auto scale = static_cast<float>(pixels_per_point);
  lines_.set("width", static_cast<float>(lines.width_px) * scale);
  const auto pass = [&](GLenum depth, float dash_px, float strength) {
    glDepthFunc(depth);
    lines_.set("dash_px", dash_px);
    lines_.set("strength", strength);
    glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(lines.points.size()));
  };
  pass(GL_GREATER, kDashPx * scale, kHiddenShare);
  pass(GL_LEQUAL, 0.0f, 1.0f);
  end();
}

void LineLayer::draw(const Patches& patches, const Viewpoint& viewpoint, PatchDepth depth) {
  if (patches.points.empty()) return;
  upload(patches.points, viewpoint);
  begin(patches_, viewpoint);
  glDepthFunc(depth == PatchDepth::seen_through ? GL_ALWAYS : GL_LEQUAL);
  if (depth == PatchDepth::solid) glDepthMask(GL_TRUE);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(patches.points.size()));
  end();
}

void LineLayer::beginEdges(const Viewpoint& viewpoint, double width_px, Paint paint) {
  begin(edges_, viewpoint);
  glDepthFunc(GL_LEQUAL);
  edges_.set("width", static_cast<float>(width_px));
  edges_.set("dash_px", 0.0f);
  edges_.set("strength", 1.0f);
  edges_.set("edge_paint", toUnitRange(paint));
}

}  // namespace palpate::view
