// GLB chunks, base64 and files beside the glTF, accessors by component type, and the picture of the first base colour.
//
// Based on: Khronos Group, glTF 2.0 specification, 3.6 (buffers, accessors), 3.8 (textures), 4 (GLB); RFC 4648
// (base64).
#include "palpate/mesh/files/detail/gltf_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "palpate/base/base64.h"
#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/detail/byte_reader.h"

namespace palpate::mesh {

namespace {

constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
/// Any size or offset of a file is below this; doubles hold it exactly.
constexpr std::uint64_t kExactInADouble = std::uint64_t{1} << 53;
constexpr std::size_t kAnySize = std::min<std::uint64_t>(kExactInADouble, std::numeric_limits<std::size_t>::max());

// --- component types of accessors ---

enum ComponentType : int { kByte = 5120, kUnsignedByte, kShort, kUnsignedShort, kUnsignedInt = 5125, kFloat };

std::size_t bytesOf(int component_type) {
  switch (component_type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

/// -128 of a signed byte stands for -1 like -127 (section 3.6.2.2).
template <class T>
double component(const char* data, bool normalised) {
  const auto value = static_cast<double>(numberFromBytes<T>(data));
  if (!normalised) return value;
  return std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double componentAt(const char* data, int component_type, bool normalised) {
  switch (component_type) {
    case kByte:
      return component<std::int8_t>(data, normalised);
    case kUnsignedByte:
      return component<std::uint8_t>(data, normalised);
    case kShort:
      return component<std::int16_t>(data, normalised);
    case kUnsignedShort:
      return component<std::uint16_t>(data, normalised);
    case kUnsignedInt:
      return component<std::uint32_t>(data, normalised);
    default:
      return numberFromBytes<float>(data);
  }
}

// --- where a buffer's bytes come from ---

std::string decodeBase64(std::string_view digits, JsonValue where) {
  std::optional<std::string> bytes = bytesOfBase64(digits);
  if (!bytes) where.fail("a data URI that is not base64");
  return *std::move(bytes);
}

/// %20 and the like.
std::string decodePercent(std::string_view uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      result += static_cast<char>(value);
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

/// Files beside the glTF file or in folders below it; a stranger's file does not get to read anything else.
std::filesystem::path pathBeside(const MeshFile& file, const std::string& uri, JsonValue where) {
  const std::string name = decodePercent(uri);
  const std::filesystem::path relative(pathOf(name));
  const bool leaves_folder = std::find(relative.begin(), relative.end(), "..") != relative.end();
  if (file.folder.empty()) where.fail("it refers to another file, and there is no folder to look in");
  if (relative.is_absolute() || leaves_folder || uri.find(':') != std::string::npos) {
    where.fail("a buffer may only be a file in the same folder or below");
  }
  if (name.find('\0') != std::string::npos) where.fail("a file's name cannot hold a zero byte");
  return file.folder / relative;
}

constexpr std::string_view kBase64 = ";base64,";

bool isData(std::string_view uri) { return uri.starts_with("data:") && uri.find(kBase64) != std::string_view::npos; }

// --- the picture ---

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

GltfParts splitGltf(const MeshFile& file) {
  if (!file.bytes.starts_with("glTF")) return {file.bytes, 0, {}, false};
  GltfParts parts;
  parts.is_glb = true;
  ByteReader bytes(file.bytes, file.name, 4);
  if (bytes.number<std::uint32_t>() != 2) throw Error::atByte(file.name, 4, "only version 2 of GLB can be read");
  const auto promised = bytes.number<std::uint32_t>();
  if (promised != file.bytes.size()) {
    throw Error::atByte(file.name, 8,
                        fmt::format("the header promises {} bytes, the file has {}", promised, file.bytes.size()));
  }
  for (std::size_t chunk = 0; bytes.bytesLeft() > 0; ++chunk) {
    const auto length = bytes.number<std::uint32_t>();
    const auto type = bytes.number<std::uint32_t>();
    if (chunk == 0 && type != kJsonChunk)
      throw Error::atByte(file.name, kGlbHeaderBytes, "the first chunk is not JSON");
    const std::size_t start = bytes.position();
    const auto content = bytes.take(length, "a chunk is longer than the file");
    if (chunk == 0) std::tie(parts.json, parts.json_offset) = std::pair(content, start);
    if (chunk == 1 && type == kBinaryChunk) parts.binary = content;
  }
  return parts;
}

std::string bytesOfUri(const MeshFile& file, JsonValue uri, std::uint64_t max_bytes) {
  const std::string text = uri.text();
  if (!isData(text)) return readFile(pathBeside(file, text, uri), max_bytes);
  return decodeBase64(std::string_view(text).substr(text.find(kBase64) + kBase64.size()), uri);
}

GltfAccessors::GltfAccessors(const MeshFile& file, JsonValue root, std::string_view binary)
    : bytes_(file.bytes.size()) {
  const auto buffers = root["buffers"].items();
  owned_.reserve(buffers.size());  // buffers_ points into its strings: they must not move
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    buffers_.push_back(readBuffer(file, buffers[i], i == 0, binary));
  }
  for (const JsonValue view : root["bufferViews"].items()) views_.push_back(readView(view));
  for (const JsonValue accessor : root["accessors"].items()) accessors_.push_back(outlineOf(accessor));
}

std::string_view GltfAccessors::readBuffer(const MeshFile& file, JsonValue buffer, bool may_be_binary_chunk,
                                           std::string_view binary) {
  const JsonValue uri = buffer["uri"];
  const JsonValue length = buffer["byteLength"];
  if (!length) buffer.fail("a buffer without byteLength");
  std::string_view bytes = may_be_binary_chunk ? binary : std::string_view();
  if (uri) {
    owned_.push_back(bytesOfUri(file, uri, file.options.max_bytes - bytes_));
    bytes = owned_.back();
    if (!isData(uri.text())) bytes_ += bytes.size();
  }
  const std::size_t promised = length.index(kAnySize, "byteLength");
  if (promised > bytes.size()) {
    length.fail(fmt::format("the buffer promises {} bytes, there are {}", promised, bytes.size()));
  }
  return bytes.substr(0, promised);
}

GltfAccessors::View GltfAccessors::readView(JsonValue view) const {
  const JsonValue buffer = view["buffer"];
  const JsonValue length = view["byteLength"];
  if (!buffer || !length) view.fail("a bufferView needs buffer and byteLength");
  const std::string_view bytes = buffers_[buffer.index(buffers_.size(), "buffer")];
  const std::size_t start = view["byteOffset"].indexOr(0, bytes.size() + 1, "byteOffset");
  const std::size_t size = length.index(bytes.size() - start + 1, "byteLength");
  return {bytes.substr(start, size), view["byteStride"].indexOr(0, kAnySize, "byteStride")};
}

/// What is missing or wrong is only said when the accessor is used: animations may hold what meshes may not.
GltfAccessors::Accessor GltfAccessors::outlineOf(JsonValue accessor) {
  return {.where = accessor,
          .view = accessor["bufferView"],
          .type = accessor["type"],
          .component_type = accessor["componentType"],
          .count = accessor["count"],
          .offset = accessor["byteOffset"],
          .normalised = accessor["normalized"].isTrue(),
          .sparse = static_cast<bool>(accessor["sparse"])};
}

GltfAccessors::Elements GltfAccessors::elements(JsonValue accessor_index, std::string_view type,
                                                std::size_t components) const {
  const Accessor& accessor = accessors_[accessor_index.index(accessors_.size(), "accessor")];
  if (accessor.sparse) accessor.where.fail("sparse accessors cannot be read");
  if (!accessor.view) accessor.where.fail("an accessor without bufferView cannot be read");
  if (!accessor.component_type || !accessor.count) accessor.where.fail("an accessor needs componentType and count");
  if (!accessor.type || accessor.type.text() != type) accessor.where.fail(fmt::format("type {} is expected", type));
  const View& view = views_[accessor.view.index(views_.size(), "bufferView")];

  Elements found{};
  found.normalised = accessor.normalised;
  found.component_type = static_cast<int>(accessor.component_type.index(kFloat + 1, "componentType"));
  const std::size_t size = bytesOf(found.component_type) * components;
  if (size == 0) accessor.component_type.fail("not a component type");
  found.stride = view.stride == 0 ? size : view.stride;
  if (found.stride < size) accessor.where.fail("byteStride is smaller than one element");

  const std::size_t start = accessor.offset.indexOr(0, view.bytes.size() + 1, "byteOffset");
  const std::size_t room = view.bytes.size() - start;
  const std::size_t most = room < size ? 0 : (room - size) / found.stride + 1;
  found.count = accessor.count.index(kAnySize, "count");
  if (found.count > most) {
    accessor.where.fail(fmt::format("{} elements are promised, the bufferView holds {}", found.count, most));
  }
  found.data = view.bytes.data() + start;
  return found;
}

template <class Vector>
std::vector<Vector> GltfAccessors::vectors(JsonValue accessor_index, std::string_view type) const {
  constexpr std::size_t kAxes = Vector::RowsAtCompileTime;
  const Elements found = elements(accessor_index, type, kAxes);
  const std::size_t bytes = bytesOf(found.component_type);
  std::vector<Vector> result(found.count);
  for (std::size_t i = 0; i < found.count; ++i) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const char* data = found.data + i * found.stride + axis * bytes;
      const double value = componentAt(data, found.component_type, found.normalised);
      result[i][static_cast<Eigen::Index>(axis)] = static_cast<typename Vector::Scalar>(value);
    }
  }
  return result;
}

std::vector<Vec3> GltfAccessors::positions(JsonValue accessor_index) const {
  return vectors<Vec3>(accessor_index, "VEC3");
}

std::vector<Vec2f> GltfAccessors::places(JsonValue accessor_index) const {
  return vectors<Vec2f>(accessor_index, "VEC2");
}

std::string_view GltfAccessors::bytesOfView(JsonValue view_index) const {
  return views_[view_index.index(views_.size(), "bufferView")].bytes;
}

std::vector<Index> GltfAccessors::indices(JsonValue accessor_index) const {
  const Elements found = elements(accessor_index, "SCALAR", 1);
  const int type = found.component_type;
  if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt) {
    accessor_index.fail("indices must be unsigned whole numbers");
  }
  std::vector<Index> result(found.count);
  for (std::size_t i = 0; i < found.count; ++i) {
    result[i] = static_cast<Index>(componentAt(found.data + i * found.stride, type, false));
  }
  return result;
}

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

std::vector<std::filesystem::path> filesBesideGltf(const MeshFile& file) {
  const GltfParts parts = splitGltf(file);
  const JsonDocument document(parts.json, {file.name, !parts.is_glb, parts.json_offset});
  std::vector<std::filesystem::path> files;
  for (const char* list : {"buffers", "images"}) {
    for (const JsonValue part : document.root()[list].items()) {
      const JsonValue uri = part["uri"];
      if (uri && !isData(uri.text())) files.push_back(pathBeside(file, uri.text(), uri));
    }
  }
  return files;
}

}  // namespace palpate::mesh
