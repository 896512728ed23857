#include "palpate/measure/synthesis/synthetic_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::measure {

namespace {

/// Between straight pieces of this length and bent skin lie less than 0.02 mm.
constexpr double kStepMm = 2.0;

float cross(const Vec2f& a, const Vec2f& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

SyntheticMesh::SyntheticMesh(const SyntheticCase& made, const SyntheticBody& body, const SyntheticCamera& camera,
                             const TrueField* pressed, const BodyMotion& motion)
    : columns_(static_cast<int>(2.0 * kHalfWidthMm / kStepMm) + 1),
      rows_(static_cast<int>(2.0 * kHalfLengthMm / kStepMm) + 1) {
  const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  std::vector<Vec3> places(count);
  nodes_.resize(count);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto i = indexOf(column, row);
      const Vec2 skin(-kHalfWidthMm + kStepMm * column, -kHalfLengthMm + kStepMm * row);
      places[i] = movedBody(pressed != nullptr ? body.pressedAt(skin, *pressed) : body.placeAt(skin), motion);
      nodes_[i].place = skin.cast<float>();
      nodes_[i].pixel = camera.project(places[i]).cast<float>();
      nodes_[i].depth = static_cast<float>(camera.depthOf(places[i]));
    }
  }
  const Vec3 light = made.look.light.normalized();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto at = [&](int c, int r) -> const Vec3& {
        return places[indexOf(std::clamp(c, 0, columns_ - 1), std::clamp(r, 0, rows_ - 1))];
      };
      const Vec3 normal =
          (at(column + 1, row) - at(column - 1, row)).cross(at(column, row + 1) - at(column, row - 1)).normalized();
      const Vec3 half = (light + (camera.eye() - at(column, row)).normalized()).normalized();
      nodes_[indexOf(column, row)].light = {static_cast<float>(std::max(0.0, normal.dot(light))),
                                            static_cast<float>(std::pow(std::max(0.0, normal.dot(half)), 20.0))};
    }
  }
}

void SyntheticMesh::paintTriangle(const Node& a, const Node& b, const Node& c, int first, SeenSkin& seen) const {
  const Vec2f low = a.pixel.cwiseMin(b.pixel).cwiseMin(c.pixel);
  const Vec2f high = a.pixel.cwiseMax(b.pixel).cwiseMax(c.pixel);
  const int top = std::max(static_cast<int>(std::ceil(low.y())), first);
  const int bottom = std::min(static_cast<int>(std::floor(high.y())), first + seen.depth.rows - 1);
  if (top > bottom) return;
  const int left = std::max(static_cast<int>(std::ceil(low.x())), 0);
  const int right = std::min(static_cast<int>(std::floor(high.x())), seen.depth.cols - 1);
  const float area = cross(b.pixel - a.pixel, c.pixel - a.pixel);
  if (area == 0.0f) return;
  for (int y = top; y <= bottom; ++y) {
    auto* depth = seen.depth.ptr<float>(y - first);
    auto* place = seen.place.ptr<cv::Vec2f>(y - first);
    auto* light = seen.light.ptr<cv::Vec2f>(y - first);
    for (int x = left; x <= right; ++x) {
      const Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const float of_b = cross(pixel - a.pixel, c.pixel - a.pixel) / area;
      const float of_c = cross(b.pixel - a.pixel, pixel - a.pixel) / area;
      const float of_a = 1.0f - of_b - of_c;
      constexpr float kSeam = -1e-4f;  // no pixel falls between two triangles
      if (of_a < kSeam || of_b < kSeam || of_c < kSeam) continue;
      const float distance = of_a * a.depth + of_b * b.depth + of_c * c.depth;
      if (distance >= depth[x]) continue;
      depth[x] = distance;
      const Vec2f chart = of_a * a.place + of_b * b.place + of_c * c.place;
      const Vec2f lit = of_a * a.light + of_b * b.light + of_c * c.light;
      place[x] = {chart.x(), chart.y()};
      light[x] = {lit.x(), lit.y()};
    }
  }
}

void SyntheticMesh::paint(int first, SeenSkin& seen) const {
  seen.depth.setTo(std::numeric_limits<float>::infinity());
  seen.place.setTo(cv::Scalar(0.0, 0.0));
  seen.light.setTo(cv::Scalar(0.0, 0.0));
  for (int row = 0; row + 1 < rows_; ++row) {
    for (int column = 0; column + 1 < columns_; ++column) {
      const Node* below = &nodes_[indexOf(column, row)];
      const Node* above = below + columns_;
      paintTriangle(below[0], below[1], above[1], first, seen);
      paintTriangle(below[0], above[1], above[0], first, seen);
    }
  }
}

}  // namespace palpate::measure
