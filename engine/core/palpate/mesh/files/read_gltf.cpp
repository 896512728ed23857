// glTF and GLB: all triangles of the file's default scene, as displayed: moved by their nodes or by the joints of their
// skin, morphed by their weights, in all their instances, in one mesh. Materials, animations, cameras and lights are
// passed over; points, lines and what the scene does not show are left out and reported.
//
// Not read through assimp: version 5.2.5 overflows the stack on deeply nested JSON and on long chains of nodes, and its
// errors name no place. Checking a file so well that neither can happen is nearly all of the work of reading it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/mesh/files/detail/gltf_data.h"
#include "palpate/mesh/files/detail/gltf_pose.h"
#include "palpate/mesh/files/detail/json.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/files/detail/text_reader.h"

namespace palpate::mesh {

namespace {

enum Mode : int { kPoints = 0, kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

constexpr std::size_t kMaxTextureSets = 64;
/// Each has four joints per vertex. Programs write two at most.
constexpr std::size_t kMaxJointSets = 16;

/// Extensions that change nothing about the surface, or that are read here. One that a file requires and that is not
/// among them may be anything: another place, another packing.
constexpr auto kKnownExtensions = std::to_array<std::string_view>(
    {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_xmp", "KHR_xmp_json_ld",
     "KHR_animation_pointer", "EXT_lights_image_based", "EXT_lights_ies", "MSFT_lod", "EXT_mesh_features",
     "EXT_structural_metadata", "EXT_mesh_manifold", "FB_ngon_encoding", "CESIUM_primitive_outline"});
/// Families of extensions that only colour the surface.
constexpr auto kKnownFamilies =
    std::to_array<std::string_view>({"KHR_materials_", "EXT_materials_", "ADOBE_materials_", "NV_materials_",
                                     "KHR_texture_", "EXT_texture_", "MSFT_texture_", "MSFT_packing_"});
constexpr std::string_view kDraco = "KHR_draco_mesh_compression";
constexpr auto kCompressions =
    std::to_array<std::string_view>({kDraco, "EXT_meshopt_compression", "KHR_meshopt_compression"});

template <class Names>
bool isAmong(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool isKnown(std::string_view extension) {
  const auto begins = [&](std::string_view family) { return extension.starts_with(family); };
  return isAmong(kKnownExtensions, extension) || std::any_of(kKnownFamilies.begin(), kKnownFamilies.end(), begins);
}

/// Call it first: a file of another version or with an unknown extension cannot be interpreted.
void checkNeeds(JsonValue root) {
  const JsonValue asset = root["asset"];
  for (const char* name : {"version", "minVersion"}) {
    const JsonValue version = asset[name];
    const bool is_needed = version && (std::string_view(name) == "minVersion" || !asset["minVersion"]);
    if (!is_needed) continue;
    const std::string words = version.text();
    if (words != "2" && !words.starts_with("2."))
      version.fail(fmt::format("glTF {} cannot be read, glTF 2 can", shown(words)));
  }
  for (const JsonValue extension : root["extensionsRequired"].items()) {
    const std::string name = extension.text();
    if (isAmong(kCompressions, name)) extension.fail(fmt::format("geometry compressed with {} cannot be read", name));
    if (!isKnown(name))
      extension.fail(fmt::format("the file requires the extension {}, which is not supported", shown(name)));
  }
}

/// The transform of the picture's coordinates (KHR_texture_transform).
Eigen::Affine2f textureTransform(JsonValue base_colour) {
  const JsonValue transform = base_colour["extensions"]["KHR_texture_transform"];
  const JsonValue turn = transform["rotation"];
  // v points down: a counter-clockwise turn in this notation is the extension's matrix.
  const double angle = turn ? turn.number() : 0.0;
  const double sine = elementary::sin(angle);
  const double cosine = elementary::cos(angle);
  const Eigen::Matrix2f rotation = (Eigen::Matrix2d() << cosine, -sine, sine, cosine).finished().cast<float>();
  return Eigen::Translation2f(vectorOr<2>(transform["offset"], Vec2::Zero()).cast<float>()) * rotation *
         Eigen::Scaling(Eigen::Vector2f(vectorOr<2>(transform["scale"], Vec2::Ones()).cast<float>()));
}

class GltfReader {
 public:
  GltfReader(const MeshFile& file, const GltfParts& parts, const JsonDocument& document, TexturePlaces* places)
      : file_(file),
        places_(places),
        root_(document.root()),
        accessors_(file, root_, parts.binary),
        pose_(root_),
        meshes_(root_["meshes"].items()),
        primitives_(meshes_.size()) {
    if (places_ != nullptr) base_colours_ = baseColours(root_);
  }

  TriangleMesh read() {
    if (pose_.nodes() == 0) {
      for (std::size_t m = 0; m < meshes_.size(); ++m) addMesh(m, {}, {Eigen::Affine3d::Identity()});
    } else {
      pose_.showScene([this](JsonValue node, const Eigen::Affine3d& transform) { showNode(node, transform); });
      reportHiddenMeshes();
    }
    return std::move(mesh_);
  }

 private:
  void showNode(JsonValue node, const Eigen::Affine3d& transform) {
    const JsonValue mesh = node["mesh"];
    if (!mesh) return;
    const JsonValue instances = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    addMesh(mesh.index(meshes_.size(), "mesh"), node,
            instances && !node["skin"] ? readInstances(instances, transform) : std::vector{transform});
  }

  /// EXT_mesh_gpu_instancing: the node's mesh once for each of these.
  std::vector<Eigen::Affine3d> readInstances(JsonValue attributes, const Eigen::Affine3d& transform) {
    const auto moves = readVectors<Vec3>(attributes["TRANSLATION"]);
    const auto turns = readVectors<Eigen::Vector4d>(attributes["ROTATION"]);
    const auto scales = readVectors<Vec3>(attributes["SCALE"]);
    const std::size_t count = std::max({moves.size(), turns.size(), scales.size()});
    for (const std::size_t size : {moves.size(), turns.size(), scales.size()}) {
      if (size != 0 && size != count) attributes.fail("attributes of instances need one count");
    }
    spend(count, attributes);
    std::vector<Eigen::Affine3d> instances;
    for (std::size_t i = 0; i < count; ++i) {
      instances.push_back(transform * composed(moves.empty() ? Vec3(Vec3::Zero()) : moves[i],
                                               turns.empty() ? Eigen::Vector4d(0, 0, 0, 1) : turns[i],
                                               scales.empty() ? Vec3(Vec3::Ones()) : scales[i]));
    }
    return instances;
  }

  template <class Vector>
  std::vector<Vector> readVectors(JsonValue accessor) {
    return accessor ? accessors_.vectors<Vector>(accessor) : std::vector<Vector>();
  }

  void reportHiddenMeshes() const {
    std::vector<bool> is_named(meshes_.size(), false);
    for (std::size_t n = 0; n < pose_.nodes(); ++n) {
      const JsonValue mesh = pose_.node(n)["mesh"];
      if (!mesh) continue;
      is_named[mesh.index(meshes_.size(), "mesh")] = true;
      if (!pose_.isShown(n)) file_.passed_over.leaveOut("nodes with a mesh that the scene does not show");
    }
    const auto unnamed = std::count(is_named.begin(), is_named.end(), false);
    if (unnamed > 0) file_.passed_over.leaveOut("meshes that no node shows", static_cast<std::size_t>(unnamed));
  }

  /// A primitive as stored in the file, before any transform.
  struct Primitive {
    JsonValue where;
    int mode = kTriangles;
    std::vector<Vec3> positions;
    std::vector<Index> indices;
    std::vector<JsonValue> morph_targets;
    std::vector<std::pair<JsonValue, JsonValue>> joint_sets;  // JOINTS_n and WEIGHTS_n
    TexturePlaces places;                                     // used on request only
  };

  void addMesh(std::size_t mesh, JsonValue node, const std::vector<Eigen::Affine3d>& instances) {
    if (!primitives_[mesh]) primitives_[mesh] = readPrimitives(meshes_[mesh]);
    const std::vector<double> weights = readWeights(node["weights"] ? node["weights"] : meshes_[mesh]["weights"]);
    for (const Primitive& primitive : *primitives_[mesh]) {
      const std::vector<Vec3> morphed = morphedBy(weights, primitive);
      if (const JsonValue skin = node["skin"]) {
        // The node of a skinned mesh has no effect: its joints place it (section 3.7.3.3).
        addSkinned(primitive, morphed, pose_.jointMotions(skin, accessors_));
        continue;
      }
      for (const Eigen::Affine3d& transform : instances) addMoved(primitive, morphed, transform);
    }
    report(file_.progress, "reading", 0.5);
  }

  std::vector<double> readWeights(JsonValue list) {
    std::vector<double> weights;
    for (const JsonValue weight : list.items()) weights.push_back(weight.number());
    spend(weights.size(), list);
    return weights;
  }

  std::vector<Primitive> readPrimitives(JsonValue mesh) {
    std::vector<Primitive> primitives;
    for (const JsonValue json : mesh["primitives"].items()) {
      const auto mode = static_cast<int>(json["mode"].indexOr(kTriangles, kTriangleFan + 1, "mode"));
      const JsonValue attributes = json["attributes"];
      const JsonValue attribute = attributes["POSITION"];
      if (mode < kTriangles)
        file_.passed_over.leaveOut(mode == kPoints ? "primitives of points" : "primitives of lines");
      if (mode >= kTriangles && !attribute)
        file_.passed_over.leaveOut("primitives without POSITION");  // section 3.7.2.1
      if (mode < kTriangles || !attribute) continue;
      if (json["extensions"][kDraco] && accessors_.isWithoutView(attribute)) {
        json.fail(fmt::format("geometry compressed with {} cannot be read", kDraco));
      }
      Primitive primitive{json, mode, accessors_.vectors<Vec3>(attribute), {}, {}, {}, {}};
      primitive.indices = readIndices(json, primitive.positions.size());
      checkTriangles(primitive);
      for (const JsonValue target : json["targets"].items()) primitive.morph_targets.push_back(target["POSITION"]);
      for (std::size_t set = 0; set < kMaxJointSets; ++set) {
        const JsonValue joints = attributes[fmt::format("JOINTS_{}", set)];
        const JsonValue weights = attributes[fmt::format("WEIGHTS_{}", set)];
        if (joints && weights) primitive.joint_sets.emplace_back(joints, weights);
      }
      if (places_ != nullptr) primitive.places = placesOf(json, primitive.positions.size());
      spend(countItems(primitive), json);
      primitives.push_back(std::move(primitive));
    }
    return primitives;
  }

  static void checkTriangles(const Primitive& primitive) {
    const std::size_t corners = primitive.indices.size();
    if (primitive.mode == kTriangles && corners % 3 != 0) {
      primitive.where.fail(fmt::format("{} corners are no whole number of triangles", corners));
    }
    if (corners == 1 || corners == 2) primitive.where.fail("a strip or fan of triangles needs at least 3 corners");
  }

  std::vector<Vec3> morphedBy(const std::vector<double>& weights, const Primitive& primitive) {
    std::vector<Vec3> positions = primitive.positions;
    for (std::size_t t = 0; t < std::min(weights.size(), primitive.morph_targets.size()); ++t) {
      const JsonValue target = primitive.morph_targets[t];
      if (weights[t] == 0.0 || !target) continue;
      const std::vector<Vec3> moves = accessors_.vectors<Vec3>(target);
      spend(moves.size(), target);
      if (moves.size() != positions.size()) target.fail("a morph target needs one move for each vertex");
      for (std::size_t v = 0; v < moves.size(); ++v) positions[v] += weights[t] * moves[v];
    }
    return positions;
  }

  /// Texture places of the base colour; empty without such an attribute. glTF counts v downwards.
  TexturePlaces placesOf(JsonValue primitive, std::size_t vertices) {
    const JsonValue base_colour = findBaseColour(base_colours_, primitive);
    const JsonValue moved_set = base_colour["extensions"]["KHR_texture_transform"]["texCoord"];
    const std::size_t set = (moved_set ? moved_set : base_colour["texCoord"]).indexOr(0, kMaxTextureSets, "texCoord");
    TexturePlaces places = readVectors<Vec2f>(primitive["attributes"][fmt::format("TEXCOORD_{}", set)]);
    const Eigen::Affine2f placing = textureTransform(base_colour);
    for (TexturePlace& place : places) {
      place = placing * place;
      place.y() = 1.0f - place.y();
    }
    places.resize(vertices, noTexturePlace());
    return places;
  }

  void addMoved(const Primitive& primitive, const std::vector<Vec3>& morphed, const Eigen::Affine3d& transform) {
    std::vector<Vec3> positions;
    positions.reserve(morphed.size());
    for (const Vec3& position : morphed) positions.push_back(transform * position);
    addPrimitive(primitive, positions, transform.linear().determinant() < 0.0);
  }

  void addSkinned(const Primitive& primitive, const std::vector<Vec3>& morphed,
                  const std::vector<Eigen::Affine3d>& joints) {
    const std::vector<Eigen::Affine3d> carriers = blendJoints(primitive, joints);
    std::vector<Vec3> positions;
    double turned = 0.0;
    for (std::size_t v = 0; v < morphed.size(); ++v) {
      positions.push_back(carriers[v] * morphed[v]);
      turned += carriers[v].linear().determinant() < 0.0 ? 1.0 : -1.0;
    }
    addPrimitive(primitive, positions, turned > 0.0);
  }

  /// The mean of its joints for each vertex, by its weights. A vertex of no weight follows its first joint.
  std::vector<Eigen::Affine3d> blendJoints(const Primitive& primitive, const std::vector<Eigen::Affine3d>& joints) {
    const std::size_t vertices = primitive.positions.size();
    if (primitive.joint_sets.empty()) primitive.where.fail("a skinned primitive without JOINTS_0 and WEIGHTS_0");
    Eigen::Affine3d nothing;
    nothing.matrix().setZero();
    std::vector<Eigen::Affine3d> carriers(vertices, nothing);
    std::vector<double> sums(vertices, 0.0);
    std::vector<std::size_t> first_joints(vertices, 0);
    for (const auto& [joint_accessor, weight_accessor] : primitive.joint_sets) {
      const auto numbers = accessors_.vectors<Eigen::Vector4d>(joint_accessor);
      const auto weights = accessors_.vectors<Eigen::Vector4d>(weight_accessor);
      spend(numbers.size() + weights.size(), primitive.where);
      if (numbers.size() != vertices || weights.size() != vertices) {
        joint_accessor.fail("joints and weights need one entry for each vertex");
      }
      const bool is_first = &joint_accessor == &primitive.joint_sets.front().first;
      for (std::size_t v = 0; v < vertices; ++v) {
        if (is_first) first_joints[v] = jointAt(numbers[v][0], joints.size(), joint_accessor);
        for (Eigen::Index i = 0; i < 4; ++i) {
          if (weights[v][i] == 0.0) continue;
          carriers[v].matrix() +=
              weights[v][i] * joints[jointAt(numbers[v][i], joints.size(), joint_accessor)].matrix();
          sums[v] += weights[v][i];
        }
      }
    }
    for (std::size_t v = 0; v < vertices; ++v) {
      if (sums[v] > 0.0) {
        carriers[v].matrix() /= sums[v];
      } else {
        carriers[v] = joints[first_joints[v]];
      }
    }
    return carriers;
  }

  static std::size_t jointAt(double number, std::size_t joints, JsonValue where) {
    if (number >= 0.0 && number < static_cast<double>(joints) && number == std::floor(number)) {
      return static_cast<std::size_t>(number);
    }
    where.fail(fmt::format("joint {} is out of range; the skin has {}", number, joints));
  }

  void addPrimitive(const Primitive& primitive, const std::vector<Vec3>& positions, bool mirrored) {
    spend(countItems(primitive), primitive.where);
    const std::size_t first = mesh_.positions.size();
    if (first + positions.size() >= kNoIndex) primitive.where.fail("too many vertices for 32-bit indices");
    mesh_.positions.insert(mesh_.positions.end(), positions.begin(), positions.end());
    if (places_ != nullptr) places_->insert(places_->end(), primitive.places.begin(), primitive.places.end());
    addTriangles(primitive, static_cast<Index>(first), mirrored);
    checkTriangleCount(mesh_.triangles.size(), file_.name);
  }

  std::vector<Index> readIndices(JsonValue primitive, std::size_t vertices) {
    const JsonValue accessor = primitive["indices"];
    std::vector<Index> indices(accessor ? 0 : vertices);
    for (Index i = 0; i < indices.size(); ++i) indices[i] = i;
    if (accessor) indices = accessors_.indices(accessor);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] < vertices) continue;
      if (!file_.options.keep_wrong_indices) {
        accessor.fail(fmt::format("index {} uses vertex {}, but there are only {}", i, indices[i], vertices));
      }
      indices[i] = kNoIndex;
    }
    return indices;
  }

  static std::size_t countItems(const Primitive& primitive) {
    return 1 + primitive.positions.size() + primitive.indices.size();
  }

  void spend(std::size_t items, JsonValue where) {
    spent_ += items;
    if (spent_ > accessors_.maxItems()) where.fail("meshes are shown more often than a file of this size can mean");
  }

  void addTriangles(const Primitive& primitive, Index first, bool mirrored) {
    const auto& indices = primitive.indices;
    const std::size_t step = primitive.mode == kTriangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < indices.size(); i += step) {
      Triangle t = {indices[primitive.mode == kTriangleFan ? 0 : i], indices[i + 1], indices[i + 2]};
      const bool turned = primitive.mode == kTriangleStrip && i % 2 == 1;
      if (turned != mirrored) std::swap(t[1], t[2]);
      for (Index& v : t) v = v == kNoIndex ? kNoIndex : v + first;
      mesh_.triangles.push_back(t);
    }
  }

  const MeshFile& file_;
  TexturePlaces* places_;  // null: not requested
  JsonValue root_;
  GltfAccessors accessors_;
  std::vector<JsonValue> base_colours_;  // per material, when places are requested
  GltfPose pose_;
  std::vector<JsonValue> meshes_;
  std::vector<std::optional<std::vector<Primitive>>> primitives_;  // per mesh, read when first shown
  std::size_t spent_ = 0;  // vertices, indices, moves and weights that were read or shown
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh readGltf(const MeshFile& file, TexturePlaces* places) {
  const GltfParts parts = splitGltf(file);
  const JsonDocument document(parts.json, {file.name, !parts.is_glb, parts.json_offset});
  checkNeeds(document.root());
  return GltfReader(file, parts, document, places).read();
}

}  // namespace palpate::mesh
