#include "palpate/mesh/gltf_picture.h"

#include "palpate/mesh/gltf_data.h"

namespace palpate::mesh {

namespace {

JsonValue firstBaseColour(JsonValue root) {
  const std::vector<JsonValue> base_colours = baseColours(root);
  for (const JsonValue mesh : root["meshes"].items()) {
    for (const JsonValue primitive : mesh["primitives"].items()) {
      if (const JsonValue base_colour = baseColourOf(base_colours, primitive)) return base_colour;
    }
  }
  return {};
}

/// texture -> image
JsonValue imageOf(JsonValue root, JsonValue base_colour) {
  const auto textures = root["textures"].items();
  const auto images = root["images"].items();
  const JsonValue index = base_colour["index"];
  if (!index) base_colour.fail("a texture without index");
  const JsonValue texture = textures[index.index(textures.size(), "texture")];
  const JsonValue source = texture["source"];
  if (!source) texture.fail("a texture without an image that can be read");
  return images[source.index(images.size(), "image")];
}

}  // namespace

std::vector<JsonValue> baseColours(JsonValue root) {
  std::vector<JsonValue> found;
  for (const JsonValue material : root["materials"].items()) {
    found.push_back(material["pbrMetallicRoughness"]["baseColorTexture"]);
  }
  return found;
}

JsonValue baseColourOf(const std::vector<JsonValue>& base_colours, JsonValue primitive) {
  const JsonValue index = primitive["material"];
  return index ? base_colours[index.index(base_colours.size(), "material")] : JsonValue();
}

std::string readGltfPicture(const MeshFile& file) {
  const GltfParts parts = splitGltf(file);
  const JsonDocument document(parts.json, {file.name, !parts.is_glb, parts.json_offset});
  const JsonValue base_colour = firstBaseColour(document.root());
  if (!base_colour) return {};
  const JsonValue image = imageOf(document.root(), base_colour);
  if (const JsonValue uri = image["uri"]) return bytesOfUri(file, uri, file.options.max_bytes);
  const JsonValue view = image["bufferView"];
  if (!view) image.fail("an image needs uri or bufferView");
  return std::string(GltfAccessors(file, document.root(), parts.binary).bytesOfView(view));
}

}  // namespace palpate::mesh
