// glTF and GLB: all triangles of the default scene, moved by their nodes into one mesh. Materials, skins, morph
// targets, animations, cameras, lights, points and lines are passed over.
//
// Not read through assimp: version 5.2.5 overflows the stack on deeply nested JSON and on long chains of nodes, and its
// errors name no place. Checking a file so well that neither can happen is nearly all of the work of reading it.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "palpate/mesh/files/detail/gltf_data.h"
#include "palpate/mesh/files/detail/json.h"
#include "palpate/mesh/files/detail/readers.h"

namespace palpate::mesh {

namespace {

enum Mode : int { kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

/// A node may show a mesh again and again, so a short file can ask for any number of triangles. What is more than this
/// many times the bytes of the file and its buffers is an attack, not a mesh.
constexpr std::size_t kMaxPerByte = 8;

constexpr std::size_t kMaxTextureSets = 64;

Eigen::Affine3d matrixOf(JsonValue node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  const auto numbers = node["matrix"].items();
  if (numbers.size() != 16) node["matrix"].fail("a matrix needs 16 numbers");
  for (Eigen::Index i = 0; i < 16; ++i) {
    transform.matrix()(i % 4, i / 4) = numbers[static_cast<std::size_t>(i)].number();
  }
  transform.makeAffine();
  return transform;
}

template <int Size>
Eigen::Matrix<double, Size, 1> vectorOr(JsonValue array, const Eigen::Matrix<double, Size, 1>& fallback) {
  if (!array) return fallback;
  const auto numbers = array.items();
  if (numbers.size() != Size) array.fail(fmt::format("{} numbers are expected", Size));
  Eigen::Matrix<double, Size, 1> result;
  for (std::size_t i = 0; i < Size; ++i) result[static_cast<Eigen::Index>(i)] = numbers[i].number();
  return result;
}

Eigen::Affine3d transformOf(JsonValue node) {
  if (node["matrix"]) return matrixOf(node);
  const Vec3 move = vectorOr<3>(node["translation"], Vec3::Zero());
  const Eigen::Vector4d turn = vectorOr<4>(node["rotation"], Eigen::Vector4d(0, 0, 0, 1));
  const Vec3 scale = vectorOr<3>(node["scale"], Vec3::Ones());
  const Eigen::Quaterniond rotation(turn.w(), turn.x(), turn.y(), turn.z());
  return Eigen::Translation3d(move) * rotation.normalized() * Eigen::Scaling(scale);
}

class GltfReader {
 public:
  GltfReader(const MeshFile& file, const GltfParts& parts, const JsonDocument& document, TexturePlaces* places)
      : file_(file),
        places_(places),
        root_(document.root()),
        accessors_(file, root_, parts.binary),
        nodes_(root_["nodes"].items()),
        meshes_(root_["meshes"].items()),
        primitives_(meshes_.size()),
        visited_(nodes_.size(), false) {
    if (places_ != nullptr) base_colours_ = baseColours(root_);
    budget_ = 1000 + kMaxPerByte * accessors_.bytes();
  }

  TriangleMesh read() {
    refuseCompression();
    if (nodes_.empty()) {
      for (std::size_t m = 0; m < meshes_.size(); ++m) addMesh(m, Eigen::Affine3d::Identity());
    } else {
      addNodes(roots());
    }
    return std::move(mesh_);
  }

 private:
  void refuseCompression() const {
    for (const JsonValue extension : root_["extensionsRequired"].items()) {
      const std::string name = extension.text();
      if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression") {
        extension.fail(fmt::format("geometry compressed with {} cannot be read", name));
      }
    }
  }

  /// The nodes of the scene that the file wants shown; without scenes all that are nobody's children.
  std::vector<std::size_t> roots() const {
    const auto scenes = root_["scenes"].items();
    if (scenes.empty()) return orphans();
    const JsonValue chosen = root_["scene"];
    return nodeIndices(scenes[chosen ? chosen.index(scenes.size(), "scene") : 0]["nodes"]);
  }

  std::vector<std::size_t> orphans() const {
    std::vector<bool> is_child(nodes_.size(), false);
    for (const JsonValue node : nodes_) {
      for (std::size_t child : nodeIndices(node["children"])) is_child[child] = true;
    }
    std::vector<std::size_t> result;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (!is_child[n]) result.push_back(n);
    }
    return result;
  }

  std::vector<std::size_t> nodeIndices(JsonValue list) const {
    std::vector<std::size_t> indices;
    for (const JsonValue item : list.items()) indices.push_back(item.index(nodes_.size(), "node"));
    return indices;
  }

  /// Depth first with a stack of its own: a chain of a million nodes is legal.
  void addNodes(const std::vector<std::size_t>& roots) {
    struct Pending {
      std::size_t node;
      Eigen::Affine3d parent;
    };
    std::vector<Pending> pending;
    const auto push = [&](std::vector<std::size_t> nodes, const Eigen::Affine3d& parent) {
      std::reverse(nodes.begin(), nodes.end());  // the first comes off the stack first
      for (const std::size_t node : nodes) {
        if (visited_[node]) nodes_[node].fail("the node is shown twice: nodes must form a tree");
        visited_[node] = true;
        pending.push_back({node, parent});
      }
    };
    push(roots, Eigen::Affine3d::Identity());
    while (!pending.empty()) {
      const Pending next = pending.back();
      pending.pop_back();
      const JsonValue node = nodes_[next.node];
      const Eigen::Affine3d transform = next.parent * transformOf(node);
      if (const JsonValue mesh = node["mesh"]) addMesh(mesh.index(meshes_.size(), "mesh"), transform);
      push(nodeIndices(node["children"]), transform);
    }
  }

  /// A primitive as the file holds it, before a node moves it.
  struct Primitive {
    JsonValue where;
    int mode = kTriangles;
    std::vector<Vec3> positions;
    std::vector<Index> indices;
    TexturePlaces places;  // when they are asked for
  };

  void addMesh(std::size_t mesh, const Eigen::Affine3d& transform) {
    if (!primitives_[mesh]) primitives_[mesh] = readPrimitives(meshes_[mesh]);
    for (const Primitive& primitive : *primitives_[mesh]) addPrimitive(primitive, transform);
    report(file_.progress, "reading", 0.5);
  }

  std::vector<Primitive> readPrimitives(JsonValue mesh) {
    std::vector<Primitive> primitives;
    for (const JsonValue json : mesh["primitives"].items()) {
      const auto mode = static_cast<int>(json["mode"].indexOr(kTriangles, kTriangleFan + 1, "mode"));
      if (mode < kTriangles) continue;
      const JsonValue attribute = json["attributes"]["POSITION"];
      if (!attribute) json.fail("a primitive without POSITION");
      Primitive primitive{json, mode, accessors_.positions(attribute), {}, {}};
      primitive.indices = indicesOf(json, primitive.positions.size());
      if (places_ != nullptr) primitive.places = placesOf(json, primitive.positions.size());
      spend(primitive);
      primitives.push_back(std::move(primitive));
    }
    return primitives;
  }

  /// Where the base colour lies; none where there is no such attribute. glTF counts v downwards.
  TexturePlaces placesOf(JsonValue primitive, std::size_t vertices) const {
    const JsonValue base_colour = baseColourOf(base_colours_, primitive);
    const std::size_t set = base_colour["texCoord"].indexOr(0, kMaxTextureSets, "texCoord");
    const JsonValue attribute = primitive["attributes"][fmt::format("TEXCOORD_{}", set)];
    TexturePlaces places;
    if (attribute) places = accessors_.places(attribute);
    for (TexturePlace& place : places) place.y() = 1.0f - place.y();
    places.resize(vertices, noTexturePlace());
    return places;
  }

  void addPrimitive(const Primitive& primitive, const Eigen::Affine3d& transform) {
    spend(primitive);
    const std::size_t first = mesh_.positions.size();
    if (first + primitive.positions.size() >= kNoIndex) {
      primitive.where.fail("more vertices than 32-bit indices can name");
    }
    for (const Vec3& position : primitive.positions) mesh_.positions.push_back(transform * position);
    if (places_ != nullptr) places_->insert(places_->end(), primitive.places.begin(), primitive.places.end());
    const bool mirrored = transform.linear().determinant() < 0.0;
    addTriangles(primitive, static_cast<Index>(first), mirrored);
    checkTriangleCount(mesh_.triangles.size(), file_.name);
  }

  std::vector<Index> indicesOf(JsonValue primitive, std::size_t vertices) const {
    const JsonValue accessor = primitive["indices"];
    std::vector<Index> indices(accessor ? 0 : vertices);
    for (Index i = 0; i < indices.size(); ++i) indices[i] = i;
    if (accessor) indices = accessors_.indices(accessor);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] < vertices) continue;
      if (!file_.options.keep_wrong_indices) {
        accessor.fail(fmt::format("index {} names vertex {}, but there are {}", i, indices[i], vertices));
      }
      indices[i] = kNoIndex;
    }
    return indices;
  }

  void spend(const Primitive& primitive) {
    const std::size_t amount = 1 + primitive.positions.size() + primitive.indices.size();
    if (amount > budget_) primitive.where.fail("meshes are shown more often than a file of this size can mean");
    budget_ -= amount;
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
  TexturePlaces* places_;  // null: not asked for
  JsonValue root_;
  GltfAccessors accessors_;
  std::vector<JsonValue> base_colours_;  // of each material, when places are asked for
  std::vector<JsonValue> nodes_;
  std::vector<JsonValue> meshes_;
  std::vector<std::optional<std::vector<Primitive>>> primitives_;  // of each mesh, read when first shown
  std::vector<bool> visited_;
  std::size_t budget_ = 0;  // vertices and indices that may still be read or shown
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh readGltf(const MeshFile& file, TexturePlaces* places) {
  const GltfParts parts = splitGltf(file);
  const JsonDocument document(parts.json, {file.name, !parts.is_glb, parts.json_offset});
  return GltfReader(file, parts, document, places).read();
}

}  // namespace palpate::mesh
