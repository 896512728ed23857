// The place of the skin that each pixel sees: the chart of the back as a projected mesh, painted triangle by triangle.
// Private to the folder: nothing outside it sees OpenCV.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/measure/synthesis/synthetic_body.h"
#include "palpate/measure/synthesis/synthetic_camera.h"
#include "palpate/measure/synthesis/synthetic_case.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::measure {

/// Skin seen by the pixels of a band of rows.
struct SeenSkin {
  cv::Mat place;  ///< CV_32FC2: chart, mm
  cv::Mat light;  ///< CV_32FC2: share of the oblique light, sheen
  cv::Mat depth;  ///< CV_32F: mm; infinite off the skin
};

class SyntheticMesh {
 public:
  /// `pressed`: what drags it; null: nothing.
  SyntheticMesh(const SyntheticCase& made, const SyntheticBody& body, const SyntheticCamera& camera,
                const TrueField* pressed, const BodyMotion& motion);

  /// Rows `first` to `first + seen.depth.rows` of the picture, which are overwritten.
  void paint(int first, SeenSkin& seen) const;

 private:
  struct Node {
    Vec2f pixel;
    float depth = 0.0f;
    Vec2f place;
    Vec2f light;
  };
  std::size_t indexOf(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  void paintTriangle(const Node& a, const Node& b, const Node& c, int first, SeenSkin& seen) const;

  int columns_ = 0;
  int rows_ = 0;
  std::vector<Node> nodes_;
};

}  // namespace palpate::measure
