#include "mesh_fuzz.h"

// glTF and GLB are distinguished by their first bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return palpate::fuzzMesh(data, size, palpate::mesh::Format::gltf);
}
