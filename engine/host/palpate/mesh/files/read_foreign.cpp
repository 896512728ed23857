// Every other format (3mf, dae, fbx, ...) through assimp. Off by default: its readers are not hardened against hostile
// files the way ours are, and an error of theirs names no place. The only file that knows assimp; it is not
// compiled without it (PALPATE_ASSIMP=OFF).
//
// The library is opened when the first such file is read. Loaded with the program it cost each start 10 ms on a busy
// AMD EPYC.
#include "palpate/mesh/files/read_foreign.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>

#include "palpate/base/error.h"
#include "palpate/base/system/library.h"
#include "palpate/mesh/files/detail/readers.h"

namespace palpate::mesh {

namespace {

/// Polygons cut, points and lines apart from triangles, nodes' transforms applied.
constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices;

std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

void addTriangles(const aiMesh& part, const MeshFile& file, TriangleMesh& mesh) {
  const auto first = static_cast<Index>(mesh.positions.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    mesh.positions.emplace_back(p.x, p.y, p.z);
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) {
      file.passed_over.leaveOut(face.mNumIndices == 1 ? "points" : "lines");
      continue;
    }
    mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

/// The used functions of the library.
struct Assimp {
  decltype(&aiImportFileFromMemory) import = nullptr;
  decltype(&aiReleaseImport) release = nullptr;
  decltype(&aiGetErrorString) error = nullptr;  ///< for the last import, whichever thread's
};

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(system::findSymbol(library, name));
  if (function == nullptr) throw Error(std::string(PALPATE_ASSIMP_FILE) + " has no " + name);
}

/// Throws Error where the library is not installed; the next call looks again.
const Assimp& assimp() {
  static const Assimp opened = [] {
    const system::OpenedLibrary library = system::openLibrary(PALPATE_ASSIMP_FILE);
    if (library.handle == nullptr) throw Error("this format requires assimp: " + library.words);
    Assimp found;
    find(library.handle, "aiImportFileFromMemory", found.import);
    find(library.handle, "aiReleaseImport", found.release);
    find(library.handle, "aiGetErrorString", found.error);
    return found;
  }();
  return opened;
}

using Scene = std::unique_ptr<const aiScene, decltype(&aiReleaseImport)>;

Scene imported(const MeshFile& file, const std::string& extension) {
  if (file.bytes.size() > std::numeric_limits<unsigned>::max())
    throw Error("the file is too large for assimp; expected at most 4 GB");
  static std::mutex one_at_a_time;  // for the words of an error
  const std::lock_guard lock(one_at_a_time);
  Scene scene(assimp().import(file.bytes.data(), static_cast<unsigned>(file.bytes.size()), kSteps, extension.c_str()),
              assimp().release);
  if (scene == nullptr) throw Error(oneLine(assimp().error()));
  return scene;
}

Scene importedOrNamed(const MeshFile& file, const std::string& extension) {
  try {
    return imported(file, extension);
  } catch (const Error& error) {
    throw Error::inFile(file.name, error.what());
  }
}

TriangleMesh readByAssimp(const MeshFile& file, const std::string& extension) {
  const Scene scene = importedOrNamed(file, extension);
  TriangleMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) addTriangles(*scene->mMeshes[m], file, mesh);
  checkTriangleCount(mesh.triangles.size(), file.name);
  return mesh;
}

}  // namespace

void installForeignReader() { useForeignReader(readByAssimp); }

}  // namespace palpate::mesh
