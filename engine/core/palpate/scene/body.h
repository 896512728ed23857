// The body of a world: everything that only another body changes. Built once, immutable, shared by every world of it,
// so that a moved slider or another dysfunction costs neither a copy nor a tree.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/body/torso.h"
#include "palpate/body/trunk/trunk.h"
#include "palpate/contact/surface.h"
#include "palpate/deform/skin.h"
#include "palpate/tissue/layered_tissue.h"

namespace palpate::scene {

/// Describes what lies under the skin of a built-in body; empty for a mesh.
struct Anatomy : body::BonesUnderSkin {
  std::vector<float> bone_radius_mm;     ///< a skin vertex each (beneath/bone_width.h); empty: all bone is wide
  std::optional<body::Support> support;  ///< what the body lies or sits on
};

struct SkinTexture;
struct SkinChannels;

/// Neighbours in memory are neighbours in space: the boxes, in the map plane, of so many vertices or triangles that
/// follow each other. What changes in one place finds the few blocks that it reaches.
struct PlaneBlocks {
  static constexpr std::size_t kSize = 256;
  std::vector<Eigen::AlignedBox2d> boxes;
};

/// Parts of which a body is built: the first half of building a world.
struct BodyParts {
  std::string name;         ///< for reports: "torso" or the file's name
  mesh::TriangleMesh skin;  ///< fit for contact, spatially ordered; triangle numbers everywhere are its own
  bool closed = false;      ///< the skin has no border
  bool self_intersecting = false;
  Anatomy anatomy;
  std::vector<std::string> notes;                          ///< what the user should know: repairs, a doubtful unit
  std::shared_ptr<const SkinTexture> texture;              ///< a picture on the skin (skin_texture.h), or null
  std::shared_ptr<const SkinChannels> channels = nullptr;  ///< of the body's file (skin_channels.h), or null
  /// The body's own stiffness, one per skin vertex, before dysfunctions; empty: the scene's applies.
  std::vector<double> given_stiffness_n_per_mm = {};
  /// Layered tissue in place of the library's and the scene's table; or null.
  std::shared_ptr<const tissue::LayeredTissue> given_layers = nullptr;
};

struct Body : BodyParts {
  std::shared_ptr<const contact::SurfaceGeometry> geometry;
  std::shared_ptr<const contact::SkinPlanes> planes;  ///< of the geometry; null for more than contact::kMaxPlanes
  deform::Skin deformable;                   ///< as the settings that it was built for want it (World::deformable)
  std::optional<double> thickness_limit_mm;  ///< up to which its parts were measured; nothing: they were not
  Eigen::AlignedBox3d box;
  PlaneBlocks vertex_blocks, triangle_blocks;
  /// A skin vertex each, 1: it looks to the front, where the map plane, seen from behind, says nothing. Empty where the
  /// body has no known front.
  std::vector<std::uint8_t> front;
};

/// How thick the body is under each vertex of its skin, mm, up to the limit: infinite beyond it.
std::vector<float> thicknessOf(const Body& body, double limit_mm);

/// `thickness_limit_mm`: up to which the parts of the deformable skin are measured (tree/triangle_tree.h), or nothing.
/// Throws Error for a mesh that cannot be felt.
std::shared_ptr<const Body> builtBody(BodyParts parts, std::optional<double> thickness_limit_mm,
                                      const Progress& progress);

}  // namespace palpate::scene
