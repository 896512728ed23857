// The body: trunk, torso or back is made, a mesh file is read, mended and judged; both are ordered along a
// space-filling curve, so that triangles near each other lie near each other in memory. Whatever belongs to a vertex or
// a triangle follows.
#include "palpate/scene/body_parts.h"

#include <fmt/format.h>

#include <array>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/body/fitting/body_fit.h"
#include "palpate/body/fitting/fitted_body.h"
#include "palpate/body/fitting/made_scan.h"
#include "palpate/mesh/intersections.h"
#include "palpate/mesh/reorder.h"
#include "palpate/mesh/repair.h"
#include "palpate/mesh/validate.h"
#include "palpate/mesh/weld.h"
#include "palpate/scene/beneath/bone_width.h"
#include "palpate/scene/ready_body.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/scene/skin_texture.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

/// Takes over a generated body, with its skin in an order that keeps neighbours close in memory.
BodyParts makeBodyParts(std::string name, mesh::TriangleMesh& skin, body::BonesUnderSkin& under) {
  BodyParts parts;
  parts.name = std::move(name);
  parts.skin = std::move(skin);
  const auto order = mesh::reorderSpatially(parts.skin);
  Anatomy& anatomy = parts.anatomy;
  static_cast<body::BonesUnderSkin&>(anatomy) = std::move(under);
  anatomy.depth_mm = mesh::picked(anatomy.depth_mm, order.source_vertex);
  anatomy.nearest_bone = mesh::picked(anatomy.nearest_bone, order.source_vertex);
  anatomy.bone_radius_mm = boneRadii(parts.skin, anatomy.depth_mm, anatomy.bones);
  return parts;
}

BodyParts makeTrunkParts(const BodySettings& settings) {
  body::TrunkSettings wanted{.bone_triangles = settings.bone_triangles, .shape = settings.shape};
  if (settings.triangles != 0) wanted.triangles = settings.triangles;
  body::Trunk trunk = body::makeTrunk(wanted);
  BodyParts parts =
      makeBodyParts(fmt::format("built-in trunk, {} triangles with bones", wanted.triangles), trunk.skin, trunk);
  parts.closed = true;
  parts.anatomy.support = trunk.support;
  return parts;
}

BodyParts makeBuiltInParts(const BodySettings& settings, const Progress& progress) {
  report(progress, fmt::format("building the {}", wordFor(settings.kind)), 0.0);
  if (settings.kind == BodyKind::trunk) return makeTrunkParts(settings);
  const body::SkinSettings shape{settings.shape.stature_mm, settings.shape.relief, settings.shape.asymmetry};
  if (settings.kind == BodyKind::torso) {
    body::TorsoSettings wanted{.bone_triangles = settings.bone_triangles, .shape = shape};
    if (settings.triangles != 0) wanted.triangles = settings.triangles;
    body::Torso torso = body::makeTorso(wanted);
    return makeBodyParts(fmt::format("built-in torso, {} triangles with bones", wanted.triangles), torso.skin.mesh,
                         torso);
  }
  const std::size_t triangles = settings.triangles != 0 ? settings.triangles : body::kDissertationBackTriangles;
  body::Torso back = body::makeBackOverBones({triangles, shape});
  return makeBodyParts(fmt::format("built-in back, {} triangles over {} bones", triangles, back.bones.size()),
                       back.skin.mesh, back);
}

/// As an earlier run has left it in the store, or made now and left there.
BodyParts builtInParts(const BodySettings& settings, const Progress& progress) {
  if (std::optional<BodyParts> kept = keptBody(settings)) {
    report(progress, "reusing a body made before", 0.0);
    return std::move(*kept);
  }
  BodyParts parts = makeBuiltInParts(settings, progress);
  storeBody(settings, parts);
  return parts;
}

void scale(mesh::TriangleMesh& mesh, double factor) {
  if (factor == 1.0) return;
  for (Vec3& position : mesh.positions) position *= factor;
}

void noteDoubtfulUnit(const mesh::TriangleMesh& skin, std::vector<std::string>& notes) {
  const Eigen::AlignedBox3d box = mesh::boundingBox(skin);
  if (!mesh::hasDoubtfulSize(box)) return;
  const double length = box.diagonal().norm();
  notes.push_back(fmt::format("the body is {:.3g} mm from corner to corner; check unit and scale", length));
}

void requireFit(const mesh::TriangleMesh& mesh, const Progress& progress) {
  const mesh::ValidationReport found = mesh::validate(mesh, {}, progress);
  if (found.sound()) return;
  std::string traits;
  for (const std::string& trait : mesh::describe(found)) traits += (traits.empty() ? "" : "; ") + trait;
  throw Error("is not fit for contact and repair is off: " + traits);
}

/// The bones of a scan that a fit knows of; of its skin as it is felt.
Anatomy fittedAnatomy(const std::filesystem::path& file, const mesh::TriangleMesh& skin, const Progress& progress) {
  report(progress, "building the fitted bones", 0.0);
  const body::BodyFit fit = body::fitFromJson(readFile(file, body::kLongestFitFile), file.string());
  try {
    Anatomy anatomy{body::fittedBody(body::TemplateBody(), fit, skin), {}, {}};
    anatomy.bone_radius_mm = boneRadii(skin, anatomy.depth_mm, anatomy.bones);
    return anatomy;
  } catch (const Error& error) {
    throw Error::inFile(file.string(), error.what());
  }
}

BodyParts makeMeshParts(const BodySettings& settings, const Progress& progress) {
  mesh::MeshWithChannels loaded;
  if (isMadeScan(settings)) {
    report(progress, "making the scan", 0.0);
    loaded.mesh = body::makeScan();
  } else {
    loaded = mesh::loadWithChannels(settings.file, loadOptionsOf(settings), progress);
  }
  mesh::TriangleMesh& mesh = loaded.mesh;
  scale(mesh, settings.scale);
  BodyParts parts;
  try {
    if (!settings.repair) requireFit(mesh, progress);
    std::vector<Index> source_vertex;
    parts = mendedBody(std::move(mesh), settings.file.filename().string(), progress, source_vertex);
    parts.channels = skinChannels(loaded.channels, std::move(source_vertex));
    parts.notes.insert(parts.notes.begin(), loaded.notes.begin(), loaded.notes.end());
  } catch (const Error& error) {
    throw Error::inFile(settings.file.string(), error.what());
  }
  parts.texture = loadSkinTexture(settings, parts.skin, {}, progress);
  if (!settings.fit.empty()) parts.anatomy = fittedAnatomy(settings.fit, parts.skin, progress);
  return parts;
}

}  // namespace

BodyParts mendedBody(mesh::TriangleMesh mesh, std::string name, const Progress& progress,
                     std::vector<Index>& source_vertex) {
  mesh::RepairOptions options;
  options.find_self_intersections = false;  // looked for in spatial order, where it is faster
  mesh::RepairResult repaired = mesh::repair(std::move(mesh), options, progress);
  BodyParts parts;
  parts.name = std::move(name);
  parts.skin = std::move(repaired.mesh);
  parts.closed = repaired.closed;
  for (const mesh::RepairAction& action : repaired.actions) {
    parts.notes.push_back(fmt::format("repaired: {} ({})", action.what, action.count));
  }
  parts.notes.insert(parts.notes.end(), repaired.warnings.begin(), repaired.warnings.end());
  report(progress, "ordering the triangles", 0.0);
  source_vertex = mesh::picked(repaired.source_vertex, mesh::reorderSpatially(parts.skin).source_vertex);
  parts.self_intersecting = mesh::isSelfIntersecting(mesh::findIntersections(parts.skin, progress));
  if (parts.self_intersecting)
    parts.notes.emplace_back("the surface intersects itself; at those places a point finger acts as a tiny sphere");
  noteDoubtfulUnit(parts.skin, parts.notes);
  return parts;
}

bool isMadeScan(const BodySettings& settings) {
  return settings.kind == BodyKind::mesh && settings.file.filename() == "made:scan";
}

double millimetresOf(Unit unit) {
  constexpr std::array kMillimetres = {0.0, 1.0, 10.0, 100.0, 1000.0, 25.4};  // in the order of Unit
  static_assert(kMillimetres.size() == static_cast<std::size_t>(Unit::inch) + 1);
  return kMillimetres[static_cast<std::size_t>(unit)];
}

mesh::LoadOptions loadOptionsOf(const BodySettings& settings) {
  return {.unit_mm = millimetresOf(settings.unit), .group = settings.group, .keep_wrong_indices = settings.repair};
}

BodyParts makeBody(const BodySettings& settings, const Progress& progress) {
  if (settings.kind == BodyKind::mesh) return makeMeshParts(settings, progress);
  BodyParts parts = builtInParts(settings, progress);
  parts.texture = loadSkinTexture(settings, parts.skin, parts.anatomy.landmarks, progress);
  return parts;
}

}  // namespace palpate::scene
