// The bones under the built-in back: T1 to L5, 24 ribs and two scapulae as closed meshes, and the points one palpates.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

inline constexpr std::size_t kBoneCount = 43;

enum class BoneKind : unsigned char { vertebra, rib, scapula, sacrum, hip, sternum, cartilage, clavicle, humerus };

/// One closed, manifold, outward mesh in the body frame.
struct Bone {
  std::string name;  ///< "T1".."T12", "L1".."L5", "rib_1_right".."rib_12_left", "scapula_right", "scapula_left"
  BoneKind kind = BoneKind::vertebra;
  mesh::TriangleMesh mesh;
};

/// A change of shape of the whole body, from and to millimetres of a man of 1750 mm; must stay invertible.
using Warp = std::function<Vec3(const Vec3&)>;

struct BonesSettings {
  double stature_mm = 1750.0;     ///< everything scales linearly with it
  std::size_t triangles = 60000;  ///< all bones together, exact; even; at least kFewestBoneTriangles
  double cell_mm = 0.0;           ///< grid of the mesher before the reduction, for 1750; 0: fits the triangles
  Warp warp{};                    ///< applied before the scaling, e.g. the skin's asymmetry; empty: none
};

/// Fewest triangles of all bones together that still read as bones.
inline constexpr std::size_t kFewestBoneTriangles = 4000;

/// The 43 bones, always in the same order: T1..T12, L1..L5, ribs 1..12 right, ribs 1..12 left, scapula right, left.
/// Right and left are exact mirror images, vertebrae are exactly symmetric, until the warp. Throws Error on wrong
/// settings. About a second on one core.
std::vector<Bone> makeBones(const BonesSettings& settings = {});

/// Shares a total out over the 43 bones in order: even counts whose sum is the total, mirror images equal,
/// larger and more finely shaped bones more.
std::vector<std::size_t> shareTriangles(std::size_t total);

/// A point that an examiner finds by touch.
struct Landmark {
  std::string name;  ///< "spinous_T6", "rib_7_right_angle", "scapula_left_inferior_angle" ...
  std::string bone;  ///< the Bone that it is on
  Vec3 position;     ///< on or within a millimetre of the bone's surface, mm
};

/// Spinous tips T1..L5, rib angles, and per scapula superior angle, spine root, inferior angle and acromial angle.
/// Uses stature and warp of the settings.
std::vector<Landmark> boneLandmarks(const BonesSettings& settings = {});

// The depth of bone under each point of the skin, and the bone.

/// One entry per point. Depth is the distance to the nearest point of any bone (mm), in any direction: a pressing
/// finger feels the nearest hard thing, and unlike a depth along the normal it has no jumps. It is never negative: a
/// point inside a bone has its distance to the surface as well.
struct BoneDepth {
  std::vector<double> depth_mm;
  std::vector<Index> bone;  ///< index into the given bones
};

/// Depths of the points below, or next to, the bones. Throws Error without bones. Fastest when neighbouring
/// points follow each other, as vertices of a spatially ordered mesh do.
BoneDepth depthToBones(std::span<const Vec3> points, std::span<const Bone> bones);

}  // namespace palpate::body
