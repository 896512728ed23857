// What every mesh fuzzer does: read the bytes, then inspect and repair what came out. Any outcome is fine but a crash,
// a sanitizer's finding, a hang, or an exception that is not Error.
#pragma once

#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/repair.h"
#include "palpate/mesh/validate.h"

namespace palpate {

inline int fuzzMesh(const std::uint8_t* data, std::size_t size, mesh::Format format) {
  try {
    mesh::LoadOptions options;
    options.keep_wrong_indices = size % 2 == 1;  // both ways, chosen by something the fuzzer controls
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    mesh::TriangleMesh surface = mesh::loadFromMemory(bytes, format, "fuzz", options);
    mesh::validate(surface);
    const mesh::RepairResult repaired = mesh::repair(std::move(surface));
    const mesh::TexturedMesh textured = mesh::loadTexturedFromMemory(bytes, format, "fuzz", options);
    if (!textured.mesh.triangles.empty()) mesh::textureOn(repaired.mesh, textured);
  } catch (const Error&) {
    // The one clear answer to a bad file.
  }
  return 0;
}

}  // namespace palpate
