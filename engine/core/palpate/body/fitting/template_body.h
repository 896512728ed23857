// The trunk in a form that can be fitted to a scan: its skin in few triangles and its landmarks, of any build in a
// millisecond.
//
// trunk.h -> here -> alignment.h. A trunk of another build is made again from its bones in a second or two; a fit needs
// hundreds. Here each place of the fitted skin stores how fat and muscle move it, so that a build is one pass.
#pragma once

#include <vector>

#include "palpate/body/trunk/even_mesh.h"
#include "palpate/body/trunk/trunk.h"
#include "palpate/body/trunk/trunk_field.h"

namespace palpate::body {

/// Places a body of our frame in the frame of a scan: x = scale * rotation * y + translation.
struct BodyPlacement {
  TrunkShape shape;  ///< its stature is the scale; posture and relief are not looked at
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();  ///< mm, in the scan's frame

  double scale() const;
  /// `body`: of this shape in the millimetres of a man of 1750 mm.
  Vec3 toScan(const Vec3& body) const { return scale() * (rotation * body) + translation; }
  Vec3 toBody(const Vec3& scan) const { return rotation.transpose() * (scan - translation) / scale(); }
};

class TemplateBody {
 public:
  /// Makes the trunk once; one to two seconds, nearly all for the bones.
  TemplateBody();

  /// Places of a build, in millimetres of a man of 1750 mm: its stature is left out.
  struct Shaped {
    std::vector<Vec3> skin;       ///< vertices of triangles()
    std::vector<Vec3> landmarks;  ///< on the skin, as in landmarks()
  };
  Shaped shaped(const TrunkShape& shape) const;

  /// Bones and landmarks of a build, as makeTrunk has them, its stature left out and without relief.
  std::vector<Bone> bonesOf(const TrunkShape& shape) const;
  std::vector<SkinLandmark> landmarksOf(const TrunkShape& shape) const;

  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Landmarks of the average build.
  const std::vector<SkinLandmark>& landmarks() const { return landmarks_; }
  /// Whether a triangle belongs to a stump: neck, arm or thigh continues there in a scan of a whole person.
  const std::vector<bool>& isStump() const { return is_stump_; }

 private:
  struct Place {
    Vec3 fitted, normal, outward;  // outward: the way in which fat grows
    double fat, muscle;            // mm out a unit of body mass index, of muscle
    double depth_mm;               // to the bone
  };
  Place placeOf(const Vec3& fitted, const Vec3& normal, double depth_mm) const;
  std::vector<Place> placesOf(const std::vector<SkinPoint>& points) const;
  static Vec3 shapedPlace(const Place& place, const TrunkShape& shape, const BodyWarp& warp);

  TrunkField field_;
  std::vector<Place> skin_, on_landmarks_;
  std::vector<Bone> bones_;
  std::vector<Triangle> triangles_;
  std::vector<SkinLandmark> landmarks_;
  std::vector<bool> is_stump_;
};

}  // namespace palpate::body
