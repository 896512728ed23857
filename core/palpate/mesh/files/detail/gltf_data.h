// The binary side of glTF, behind readGltf: the GLB container, buffers inside and outside of the file, accessors into
// them, and the picture that lies in one.
//
// Every offset, stride and length of the JSON is checked against the bytes that are really there before anything is
// read. Based on: Khronos Group, glTF 2.0 specification, sections 3.6 (buffers, accessors) and 4 (GLB).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/mesh/files/detail/json.h"
#include "palpate/mesh/files/detail/readers.h"

namespace palpate::mesh {

struct GltfParts {
  std::string_view json;
  std::size_t json_offset = 0;
  std::string_view binary;  ///< of a GLB; empty when it has none
  bool is_glb = false;
};

/// Takes a GLB apart; anything that does not start with "glTF" is JSON as a whole. Throws Error at a byte.
GltfParts splitGltf(const MeshFile& file);

/// What a URI stands for: base64 in the file, or a file beside it. Throws Error.
std::string bytesOfUri(const MeshFile& file, JsonValue uri, std::uint64_t max_bytes);

class GltfAccessors {
 public:
  /// Reads buffers that lie in the file or beside it, and the outline of every accessor once: a file in which many
  /// things refer to one object with many members must not cost their product. Throws Error.
  GltfAccessors(const MeshFile& file, JsonValue root, std::string_view binary);

  /// A VEC3 of any component type, normalised if the accessor says so, in the file's unit.
  std::vector<Vec3> positions(JsonValue accessor_index) const;
  /// A VEC2, likewise.
  std::vector<Vec2f> places(JsonValue accessor_index) const;
  /// A SCALAR of unsigned whole numbers.
  std::vector<Index> indices(JsonValue accessor_index) const;
  std::string_view bytesOfView(JsonValue view_index) const;
  /// Bytes of the file and of all its buffers: what there is to make a mesh of.
  std::size_t bytes() const { return bytes_; }

 private:
  struct View {
    std::string_view bytes;
    std::size_t stride;  // 0: elements follow each other closely
  };
  struct Accessor {
    JsonValue where;
    JsonValue view;
    JsonValue type;
    JsonValue component_type;
    JsonValue count;
    JsonValue offset;
    bool normalised;
    bool sparse;
  };
  /// Checked: count elements of this component type lie within the file.
  struct Elements {
    const char* data;
    std::size_t count;
    std::size_t stride;
    int component_type;
    bool normalised;
  };
  std::string_view readBuffer(const MeshFile& file, JsonValue buffer, bool may_be_binary_chunk,
                              std::string_view binary);
  View readView(JsonValue view) const;
  static Accessor outlineOf(JsonValue accessor);
  Elements elements(JsonValue accessor_index, std::string_view type, std::size_t components) const;
  template <class Vector>
  std::vector<Vector> vectors(JsonValue accessor_index, std::string_view type) const;

  std::vector<std::string_view> buffers_;
  std::vector<std::string> owned_;  // what was decoded or read for buffers_
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
  std::size_t bytes_ = 0;
};

// The picture that a glTF file gives its surface: the base colour of a material.

/// The `baseColorTexture` of each material, or none: looked up once, however many primitives refer to one material.
std::vector<JsonValue> baseColours(JsonValue root);
/// That of a primitive's material, or none.
JsonValue baseColourOf(const std::vector<JsonValue>& base_colours, JsonValue primitive);

/// The image file of the first primitive in the file that has a base colour; empty when none has. Throws Error.
std::string readGltfPicture(const MeshFile& file);

/// Files that its buffers and images are in. Throws Error.
std::vector<std::filesystem::path> filesBesideGltf(const MeshFile& file);

}  // namespace palpate::mesh
