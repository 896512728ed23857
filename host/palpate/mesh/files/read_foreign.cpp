// Every other format (3mf, dae, fbx, ...) through assimp. Off by default: its readers are not hardened against hostile
// files the way ours are, and an error of theirs names no place. The only file that knows assimp; it installs itself
// while the program starts (as base/host_environment.cpp does) and is not compiled without assimp (PALPATE_ASSIMP=OFF).
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>

#include "palpate/base/error.h"
#include "palpate/mesh/files/detail/readers.h"

// A name for the linker. NOLINTBEGIN(readability-identifier-naming)
extern "C" {
extern const int palpate_host_reads_foreign_meshes;
const int palpate_host_reads_foreign_meshes = 1;
}
// NOLINTEND(readability-identifier-naming)

namespace palpate::mesh {

namespace {

/// Polygons cut, points and lines apart from triangles, nodes' transforms applied.
constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices;

std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

void addTriangles(const aiMesh& part, TriangleMesh& mesh) {
  const auto first = static_cast<Index>(mesh.positions.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    mesh.positions.emplace_back(p.x, p.y, p.z);
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

TriangleMesh readByAssimp(const MeshFile& file, const std::string& extension) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(file.bytes.data(), file.bytes.size(), kSteps, extension.c_str());
  if (scene == nullptr) throw Error::inFile(file.name, oneLine(importer.GetErrorString()));
  TriangleMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) addTriangles(*scene->mMeshes[m], mesh);
  checkTriangleCount(mesh.triangles.size(), file.name);
  return mesh;
}

[[maybe_unused]] const bool kInstalled = [] {
  useForeignReader(readByAssimp);
  return true;
}();

}  // namespace

}  // namespace palpate::mesh
