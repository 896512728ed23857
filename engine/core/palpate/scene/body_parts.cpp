// The body: trunk, torso or back is made, a mesh file is read, mended and judged; both are ordered along a
// space-filling curve, so that triangles near each other lie near each other in memory. Whatever belongs to a vertex or
// a triangle follows.
#include "palpate/scene/body_parts.h"

#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/body/fitting/body_fit.h"
#include "palpate/body/fitting/fitted_body.h"
#include "palpate/body/fitting/made_scan.h"
#include "palpate/mesh/intersections.h"
#include "palpate/mesh/reorder.h"
#include "palpate/mesh/repair.h"
#include "palpate/mesh/validate.h"
#include "palpate/scene/beneath/tissue_beneath.h"
#include "palpate/scene/ready_body.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/scene/skin_texture.h"

namespace palpate::scene {

namespace {

template <class T>
std::vector<T> permuted(const std::vector<T>& values, const std::vector<Index>& source) {
  std::vector<T> result(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) result[i] = values[source[i]];
  return result;
}

/// Anatomy of a torso or a trunk, with vertices in the order of `source`.
template <class Body>
Anatomy makeAnatomy(Body body, const std::vector<Index>& source) {
  return {.bones = std::move(body.bones),
          .depth_mm = permuted(body.depth_mm, source),
          .nearest_bone = permuted(body.nearest_bone, source),
          .bone_radius_mm = {},
          .landmarks = std::move(body.landmarks),
          .support = std::nullopt};
}

/// Takes over a generated body, with its skin in an order that keeps neighbours close in memory.
template <class Made>
BodyParts makeBodyParts(std::string name, mesh::TriangleMesh& skin, Made& made) {
  BodyParts parts;
  parts.name = std::move(name);
  parts.skin = std::move(skin);
  const auto order = mesh::reorderSpatially(parts.skin);
  parts.anatomy = makeAnatomy(std::move(made), order.source_vertex);
  parts.anatomy.bone_radius_mm = boneRadii(parts.skin, parts.anatomy.depth_mm, parts.anatomy.bones);
  return parts;
}

BodyParts makeTorsoParts(const BodySettings& body, const Progress& progress) {
  report(progress, "building the torso", 0.0);
  body::TorsoSettings settings;
  if (body.triangles != 0) settings.triangles = body.triangles;
  settings.bone_triangles = body.bone_triangles;
  settings.shape = {body.shape.stature_mm, body.shape.relief, body.shape.asymmetry};
  body::Torso torso = body::makeTorso(settings);
  return makeBodyParts(fmt::format("built-in torso, {} triangles with bones", settings.triangles), torso.skin.mesh,
                       torso);
}

BodyParts makeBackParts(const BodySettings& body, const Progress& progress) {
  report(progress, "building the back", 0.0);
  body::BackSettings settings;
  settings.triangles = body.triangles != 0 ? body.triangles : body::kDissertationBackTriangles;
  settings.shape = {body.shape.stature_mm, body.shape.relief, body.shape.asymmetry};
  body::Torso back = body::makeBackOverBones(settings);
  return makeBodyParts(fmt::format("built-in back, {} triangles over {} bones", settings.triangles, back.bones.size()),
                       back.skin.mesh, back);
}

BodyParts makeTrunkParts(const BodySettings& body, const Progress& progress) {
  report(progress, "building the trunk", 0.0);
  body::TrunkSettings settings;
  if (body.triangles != 0) settings.triangles = body.triangles;
  settings.bone_triangles = body.bone_triangles;
  settings.shape = body.shape;
  body::Trunk trunk = body::makeTrunk(settings);
  const std::optional<body::Support> support = trunk.support;
  BodyParts parts =
      makeBodyParts(fmt::format("built-in trunk, {} triangles with bones", settings.triangles), trunk.skin, trunk);
  parts.closed = true;
  parts.anatomy.support = support;
  return parts;
}

BodyParts makeBuiltInParts(const BodySettings& settings, const Progress& progress) {
  if (settings.kind == BodyKind::torso) return makeTorsoParts(settings, progress);
  if (settings.kind == BodyKind::back) return makeBackParts(settings, progress);
  return makeTrunkParts(settings, progress);
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
    body::FittedBody fitted = body::fittedBody(body::TemplateBody(), fit, skin);
    std::vector<float> bone_radius_mm = boneRadii(skin, fitted.depth_mm, fitted.bones);
    return {.bones = std::move(fitted.bones),
            .depth_mm = std::move(fitted.depth_mm),
            .nearest_bone = std::move(fitted.nearest_bone),
            .bone_radius_mm = std::move(bone_radius_mm),
            .landmarks = std::move(fitted.landmarks),
            .support = std::nullopt};
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
  source_vertex = permuted(repaired.source_vertex, mesh::reorderSpatially(parts.skin).source_vertex);
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
  switch (unit) {
    case Unit::from_file:
      break;
    case Unit::millimetre:
      return 1.0;
    case Unit::centimetre:
      return 10.0;
    case Unit::decimetre:
      return 100.0;
    case Unit::metre:
      return 1000.0;
    case Unit::inch:
      return 25.4;
  }
  return 0.0;
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
