// The default body: the longer skin, down to the sacrum, over its bones; every skin vertex knows the bone below it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/body/back.h"
#include "palpate/body/bones.h"

namespace palpate::body {

struct TorsoSettings {
  std::size_t triangles = 20389;    ///< skin and bones together, exact; at least kFewestTorsoTriangles
  std::size_t bone_triangles = 0;   ///< share for bones, even; 0 gives the bones the larger of 44 % and their least
  SkinSettings shape{1750, {}, 1};  ///< a natural back
};
/// Maximum of the grid from which the bones are drawn.
inline constexpr std::size_t kMaxBoneTriangles = 60000;
inline constexpr std::size_t kFewestTorsoTriangles = kFewestTriangles + kFewestBoneTriangles;
/// Skin only: the model of section 2.1.
inline constexpr std::size_t kDissertationBackTriangles = 2962;

/// A point that an examiner looks for, on the skin above the bone.
struct SkinLandmark {
  std::string name;    ///< one of boneLandmarks: "spinous_T6", "scapula_left_inferior_angle" ...
  std::string bone;    ///< name of the bone
  Vec3 position;       ///< on the smooth skin, mm
  Vec3 normal;         ///< normal of the skin there, out of the body
  Vec3 bone_position;  ///< the point of the bone itself, mm
};

/// Bones under the skin of a body, and how deep they lie.
struct BonesUnderSkin {
  std::vector<Bone> bones;          ///< closed meshes in their place
  std::vector<double> depth_mm;     ///< a skin vertex each: distance to the nearest bone
  std::vector<Index> nearest_bone;  ///< a skin vertex each: index into `bones`
  std::vector<SkinLandmark> landmarks;

  /// Fills in depth_mm and nearest_bone.
  void measureDepths(std::span<const Vec3> skin);
};

struct Torso : BonesUnderSkin {  ///< 43 bones
  Skin skin;
};

/// Builds the torso; one to two seconds on one core, nearly all of it for the bones. Throws Error on a wrong setting.
Torso makeTorso(const TorsoSettings& settings = {});

/// The dissertation's back: the patch of makeBack in `settings.triangles` triangles, 2962 being those of its section
/// 2.1, and besides them the bones under it, T1 to L3, ribs and scapulae (41), of the body's own share.
/// As long as makeTorso. Throws Error on a wrong setting.
Torso makeBackOverBones(const BackSettings& settings = {.triangles = kDissertationBackTriangles, .shape = {}});

/// Null when there is none.
inline const SkinLandmark* findLandmark(std::span<const SkinLandmark> landmarks, std::string_view name) {
  const auto found = std::ranges::find(landmarks, name, &SkinLandmark::name);
  return found == landmarks.end() ? nullptr : &*found;
}
/// The landmark of that name. Throws Error when there is none.
const SkinLandmark& landmark(const Torso& torso, std::string_view name);

}  // namespace palpate::body
