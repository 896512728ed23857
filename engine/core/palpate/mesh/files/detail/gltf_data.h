// The binary side of glTF, behind readGltf: the GLB container, buffers inside and outside of the file, accessors into
// them, and the embedded picture.
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
  std::string_view binary;  ///< chunk of a GLB, or empty
  bool is_glb = false;
};

/// Takes a GLB apart; anything that does not start with "glTF" is JSON as a whole. Throws Error at a byte.
GltfParts splitGltf(const MeshFile& file);

/// Resolves a URI: data in the URI itself (RFC 2397), or a file next to the glTF. Throws Error.
std::string bytesOfUri(const MeshFile& file, JsonValue uri, std::uint64_t max_bytes);

/// A node may show a mesh again and again, and an accessor may promise zeros that take no bytes, so a short file can
/// request any number of triangles. More than this many times the bytes of the file and its buffers is an attack.
inline constexpr std::size_t kMaxGltfItemsPerByte = 8;

/// A buffer is read when the first accessor needs it: what only animations or pictures use never decides about a mesh.
class GltfAccessors {
 public:
  /// Looks once at the outline of every buffer, view and accessor: a file in which many things refer to one object with
  /// many members must not cost their product. `binary` is the chunk of a GLB. Throws Error.
  GltfAccessors(const MeshFile& file, JsonValue root, std::string_view binary);

  /// Vectors of the accessor's type, VEC3 for Vec3, of any component type, normalised if the accessor says so; sparse
  /// ones filled in. Throws Error.
  template <class Vector>
  std::vector<Vector> vectors(JsonValue accessor_index);
  /// A SCALAR of unsigned whole numbers.
  std::vector<Index> indices(JsonValue accessor_index);
  std::string_view bytesOfView(JsonValue view_index);
  /// Without bytes of its own: all zero, except for a sparse accessor's or an extension's data.
  bool isWithoutView(JsonValue accessor_index) const { return !accessorAt(accessor_index).view; }
  /// Limit of items for the file and the buffers read so far.
  std::size_t maxItems() const { return 1000 + kMaxGltfItemsPerByte * bytes_; }

 private:
  struct Buffer {
    JsonValue where;
    bool is_read = false;
    std::string_view bytes{};
    std::string owned{};  // bytes decoded or read for `bytes`
  };
  struct View {
    JsonValue where;
    JsonValue buffer;
    JsonValue length;
    JsonValue offset;
    JsonValue stride;
    std::string_view compression;  // the extension that has packed it; empty: not packed
  };
  struct Accessor {
    JsonValue where;
    JsonValue view;
    JsonValue type;
    JsonValue component_type;
    JsonValue count;
    JsonValue offset;
    bool normalised;
    JsonValue sparse;
  };
  /// Checked: count elements of this component type are within the file.
  struct Elements {
    const char* data;
    std::size_t count;
    std::size_t stride;
    int component_type;
  };
  struct Sparse {
    std::vector<Index> places;
    Elements values;
  };
  static View parseView(JsonValue view);
  static Accessor parseAccessor(JsonValue accessor);
  const Accessor& accessorAt(JsonValue accessor_index) const;
  std::string_view bytesOfBuffer(JsonValue buffer_index);
  void readBuffer(Buffer& buffer);
  Elements elements(JsonValue where, JsonValue view_index, JsonValue offset, JsonValue component_type,
                    std::size_t count, std::size_t components);
  Sparse parseSparse(const Accessor& accessor, std::size_t count, std::size_t components);

  const MeshFile& file_;
  std::string_view binary_;
  std::vector<Buffer> buffers_;
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
  std::size_t bytes_;
};

// The picture of a glTF file's surface: the base colour of a material.

/// The `baseColorTexture` of each material, or null: looked up once, however many primitives refer to one material.
std::vector<JsonValue> baseColours(JsonValue root);
/// That of a primitive's material, or null.
JsonValue findBaseColour(const std::vector<JsonValue>& base_colours, JsonValue primitive);

/// The image file of the file's first primitive with a base colour; empty without one. Throws Error.
std::string readGltfPicture(const MeshFile& file);

/// Files that its buffers and images are in. Throws Error.
std::vector<std::filesystem::path> filesBesideGltf(const MeshFile& file);

}  // namespace palpate::mesh
