// The picture that a glTF file gives its surface: the base colour of a material.
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/json.h"
#include "palpate/mesh/readers.h"

namespace palpate::mesh {

/// The `baseColorTexture` of each material, or none: looked up once, however many primitives refer to one material.
std::vector<JsonValue> baseColours(JsonValue root);
/// That of a primitive's material, or none.
JsonValue baseColourOf(const std::vector<JsonValue>& base_colours, JsonValue primitive);

/// The image file of the first primitive in the file that has a base colour; empty when none has. Throws Error.
std::string readGltfPicture(const MeshFile& file);

}  // namespace palpate::mesh
