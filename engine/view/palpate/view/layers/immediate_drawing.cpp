// The same corners go to the picture or to the feedback buffer, whichever mode is set. Feedback returns a token, a
// number of corners and their places for each polygon; clipping adds corners, so there is room for more than three.
// Based on: Segal and Akeley, see immediate_drawing.h.
#include "palpate/view/layers/immediate_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/view/offscreen.h"

namespace palpate::view {

namespace {

// Feedback returns a triangle as a token, its number of corners and three coordinates for each; the rest is room for
// corners that clipping adds.
constexpr std::size_t kValuesPerTriangle = 16;

// Parallel projection along z: x and y of the box fill the picture, nothing is cut off.
void lookAt(const Eigen::AlignedBox3d& model, int width, int height) {
  const Vec3 middle = model.center();
  const Vec3 half = 0.5 * model.sizes();
  const double pixel = std::max(half.x() / width, half.y() / height);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(-pixel * width, pixel * width, -pixel * height, pixel * height, -2.0 * half.norm(), 2.0 * half.norm());
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glTranslated(-middle.x(), -middle.y(), -middle.z());
}

void drawTriangles(const ImmediateDrawing::Draw& draw) {
  glBegin(GL_TRIANGLES);
  draw();
  glEnd();
}

std::size_t polygonsIn(const std::vector<float>& values, int count) {
  std::size_t polygons = 0;
  for (int at = 0; at + 1 < count;) {
    if (values[static_cast<std::size_t>(at)] != static_cast<float>(GL_POLYGON_TOKEN)) break;
    at += 2 + 3 * static_cast<int>(values[static_cast<std::size_t>(at) + 1]);
    ++polygons;
  }
  return polygons;
}

}  // namespace

struct ImmediateDrawing::Impl {
  OffscreenContext context{Profile::compatibility};
  Target target;
  std::string renderer = rendererName();
  std::vector<float> feedback;

  Impl(int width, int height) : target(width, height) {}
};

ImmediateDrawing::ImmediateDrawing(const Eigen::AlignedBox3d& model, int width, int height)
    : impl_(std::make_unique<Impl>(width, height)) {
  impl_->target.bind();
  lookAt(model, width, height);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_LIGHT0);
  glEnable(GL_COLOR_MATERIAL);
  glShadeModel(GL_SMOOTH);
}

ImmediateDrawing::~ImmediateDrawing() = default;

void ImmediateDrawing::corner(const Vec3& normal, const Vec3& position) {
  glNormal3dv(normal.data());
  glVertex3dv(position.data());
}

std::size_t ImmediateDrawing::capture(std::size_t triangles, const Draw& draw) {
  impl_->feedback.resize(kValuesPerTriangle * (triangles + 1));
  glDisable(GL_LIGHTING);
  glFeedbackBuffer(static_cast<GLsizei>(impl_->feedback.size()), GL_3D, impl_->feedback.data());
  glRenderMode(GL_FEEDBACK);
  drawTriangles(draw);
  const int count = glRenderMode(GL_RENDER);
  if (count < 0) throw Error("immediate drawing: more triangles were drawn than announced");
  return polygonsIn(impl_->feedback, count);
}

void ImmediateDrawing::paint(const Draw& draw) {
  glEnable(GL_LIGHTING);
  glClearColor(1.0f, 1.0f, 1.0f, 1.0f);
  glClear(static_cast<GLbitfield>(GL_COLOR_BUFFER_BIT) | static_cast<GLbitfield>(GL_DEPTH_BUFFER_BIT));
  glColor3d(0.89, 0.74, 0.65);
  drawTriangles(draw);
  glFinish();
}

Image ImmediateDrawing::read() const { return impl_->target.read(); }

const std::string& ImmediateDrawing::renderer() const { return impl_->renderer; }

}  // namespace palpate::view
