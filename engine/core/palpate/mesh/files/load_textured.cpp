// The textured triangles of a file, through the readers of `load`: nothing is welded, because a vertex here belongs to
// one place in the picture.
#include <algorithm>

#include "palpate/mesh/files/detail/gltf_data.h"
#include "palpate/mesh/files/detail/readers.h"

namespace palpate::mesh {

namespace {

TriangleMesh readWithPlaces(const MeshFile& file, Format format, TexturePlaces& places) {
  if (format == Format::obj) return readObj(file, &places);
  if (format == Format::gltf || format == Format::glb) return readGltf(file, &places);
  return {};
}

void dropUnusable(TexturedMesh& textured) {
  const std::vector<Vec3>& at = textured.mesh.positions;
  const auto unusable = [&](Index v) {
    return v >= textured.places.size() || !textured.places[v].allFinite() || !isUsable(at[v]);
  };
  std::erase_if(textured.mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), unusable) || areaVector2(at[t[0]], at[t[1]], at[t[2]]).isZero(0.0);
  });
}

TexturedMesh loadFrom(const MeshFile& file, Format format) {
  TexturedMesh textured;
  textured.mesh = readWithPlaces(file, format, textured.places);
  dropUnusable(textured);
  toMillimetres(textured.mesh, format, file.options.unit_mm);
  return textured;
}

}  // namespace

TexturedMesh loadTextured(const std::filesystem::path& file, const LoadOptions& options, const Progress& progress) {
  report(progress, "reading the texture coordinates", 0.0);
  return withMeshFile(file, options, progress, loadFrom);
}

TexturedMesh loadTexturedFromMemory(std::string_view bytes, Format format, std::string_view name,
                                    const LoadOptions& options, const Progress& progress) {
  PassedOver passed_over;  // reported by the surface's reader
  return loadFrom({bytes, name, options, progress, {}, passed_over}, format);
}

std::string basePictureOf(const std::filesystem::path& file) {
  LoadOptions options;
  options.allow_foreign = true;  // nothing of such a file is read: it just has no picture
  return withMeshFile(file, options, {}, [](const MeshFile& mesh_file, Format format) {
    return format == Format::gltf || format == Format::glb ? readGltfPicture(mesh_file) : std::string();
  });
}

std::vector<std::filesystem::path> filesBeside(const std::filesystem::path& file) {
  LoadOptions options;
  options.allow_foreign = true;  // nothing of such a file is read here
  return withMeshFile(file, options, {}, [](const MeshFile& mesh_file, Format format) {
    const bool is_gltf = format == Format::gltf || format == Format::glb;
    return is_gltf ? filesBesideGltf(mesh_file) : std::vector<std::filesystem::path>();
  });
}

}  // namespace palpate::mesh
