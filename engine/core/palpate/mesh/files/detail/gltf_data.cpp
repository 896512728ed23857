// GLB chunks, base64 and files next to the glTF, accessors by component type, and the picture of the first base colour.
//
// Based on: Khronos Group, glTF 2.0 specification, 3.6 (buffers, accessors), 3.8 (textures), 4 (GLB); RFC 4648
// (base64), RFC 2397 (data URIs), RFC 3986 (relative references).
#include "palpate/mesh/files/detail/gltf_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "palpate/base/base64.h"
#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/detail/byte_reader.h"

namespace palpate::mesh {

namespace {

/// Extensions that pack the bytes of a view. Based on: EXT_meshopt_compression, KHR_meshopt_compression.
constexpr std::array<std::string_view, 2> kViewCompressions = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
/// Any size or offset of a file is below this; doubles hold it exactly.
constexpr std::uint64_t kExactInADouble = std::uint64_t{1} << 53;
constexpr std::size_t kAnySize = std::min<std::uint64_t>(kExactInADouble, std::numeric_limits<std::size_t>::max());

// --- component types of accessors ---

enum ComponentType : int { kByte = 5120, kUnsignedByte, kShort, kUnsignedShort, kUnsignedInt = 5125, kFloat };

/// 0 for an unknown component type.
std::size_t bytesOf(int component_type) {
  constexpr std::array<std::size_t, 7> kBytes = {1, 1, 2, 2, 0, 4, 4};  // from kByte on
  return component_type >= kByte && component_type <= kFloat ? kBytes[component_type - kByte] : 0;
}

/// -128 of a signed byte means -1 like -127 (section 3.6.2.2).
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

/// "file:", "https:"; not the colon of "./a:b.bin".
bool hasScheme(std::string_view uri) { return uri.substr(0, uri.find_first_of("/?#")).find(':') != uri.npos; }

/// Files next to the glTF file or in folders below it; a user's file may not read anything else.
std::filesystem::path pathBeside(const MeshFile& file, const std::string& uri, JsonValue where) {
  const std::string name = decodePercent(uri);
  const std::filesystem::path relative = pathOf(name).lexically_normal();
  const bool leaves_folder = !relative.empty() && *relative.begin() == "..";
  if (file.folder.empty()) where.fail("it refers to another file, but has no folder to search");
  if (relative.has_root_path() || leaves_folder || hasScheme(uri)) {
    where.fail("a buffer may only be a file in the same folder or below");
  }
  if (name.find('\0') != std::string::npos) where.fail("a file name must not contain a zero byte");
  return file.folder / relative;
}

constexpr std::string_view kData = "data:";

bool isData(std::string_view uri) { return inSmallLetters(uri.substr(0, kData.size())) == kData; }

/// `data:[media type][;base64],bytes`: of any media type, escaped by percent signs or not; base64 may have line breaks.
std::string bytesOfData(std::string_view uri, JsonValue where) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) where.fail("a data URI without a comma");
  std::string data = decodePercent(uri.substr(comma + 1));
  if (!inSmallLetters(uri.substr(0, comma)).ends_with(";base64")) return data;
  std::erase_if(data, [](char c) { return std::string_view(" \t\r\n\f").find(c) != std::string_view::npos; });
  std::optional<std::string> bytes = bytesOfBase64(data);
  if (!bytes) where.fail("a data URI that is not base64");
  return *std::move(bytes);
}

std::size_t readCount(JsonValue where, JsonValue count) {
  if (!count) where.fail("an accessor needs a count");
  return count.index(kAnySize, "count");
}

template <class Vector>
constexpr std::string_view accessorType() {
  constexpr std::array<std::string_view, 5> kTypes = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  return Vector::SizeAtCompileTime == 16 ? "MAT4" : kTypes[Vector::SizeAtCompileTime];
}

/// Padded with blanks, by some programs with zeros.
std::string_view withoutPadding(std::string_view json) { return json.substr(0, json.find_last_not_of('\0') + 1); }

// --- the picture ---

JsonValue firstBaseColour(JsonValue root) {
  const std::vector<JsonValue> base_colours = baseColours(root);
  for (const JsonValue mesh : root["meshes"].items()) {
    for (const JsonValue primitive : mesh["primitives"].items()) {
      if (const JsonValue base_colour = findBaseColour(base_colours, primitive)) return base_colour;
    }
  }
  return {};
}

/// texture -> image
JsonValue findImage(JsonValue root, JsonValue base_colour) {
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
  if (bytes.number<std::uint32_t>() != 2)
    throw Error::atByte(file.name, 4, "GLB version is not supported; expected version 2");
  const auto promised = bytes.number<std::uint32_t>();
  if (promised > file.bytes.size() || promised < kGlbHeaderBytes) {
    throw Error::atByte(file.name, 8,
                        fmt::format("the header declares {} bytes, but the file has {}", promised, file.bytes.size()));
  }
  if (promised < file.bytes.size())
    file.passed_over.leaveOut("bytes after the end of the GLB", file.bytes.size() - promised);
  bytes = ByteReader(file.bytes.substr(0, promised), file.name, kGlbHeaderBytes);
  for (std::size_t chunk = 0; bytes.bytesLeft() > 0; ++chunk) {
    const auto length = bytes.number<std::uint32_t>();
    const auto type = bytes.number<std::uint32_t>();
    if (chunk == 0 && type != kJsonChunk)
      throw Error::atByte(file.name, kGlbHeaderBytes, "the first chunk is not JSON");
    const std::size_t start = bytes.position();
    const auto content = bytes.readBytes(length, "a chunk is longer than the file");
    if (chunk == 0) std::tie(parts.json, parts.json_offset) = std::pair(withoutPadding(content), start);
    if (chunk == 1 && type == kBinaryChunk) parts.binary = content;
  }
  return parts;
}

std::string bytesOfUri(const MeshFile& file, JsonValue uri, std::uint64_t max_bytes) {
  const std::string text = uri.text();
  return isData(text) ? bytesOfData(text, uri) : readFile(pathBeside(file, text, uri), max_bytes);
}

GltfAccessors::GltfAccessors(const MeshFile& file, JsonValue root, std::string_view binary)
    : file_(file), binary_(binary), bytes_(file.bytes.size()) {
  for (const JsonValue buffer : root["buffers"].items()) buffers_.push_back({.where = buffer});
  for (const JsonValue view : root["bufferViews"].items()) views_.push_back(parseView(view));
  for (const JsonValue accessor : root["accessors"].items()) accessors_.push_back(parseAccessor(accessor));
}

// Missing or wrong parts are reported on use only: animations may hold what meshes may not.

GltfAccessors::View GltfAccessors::parseView(JsonValue view) {
  View outline{.where = view,
               .buffer = view["buffer"],
               .length = view["byteLength"],
               .offset = view["byteOffset"],
               .stride = view["byteStride"],
               .compression = {}};
  for (const std::string_view name : kViewCompressions) {
    if (view["extensions"][name]) outline.compression = name;
  }
  return outline;
}

GltfAccessors::Accessor GltfAccessors::parseAccessor(JsonValue accessor) {
  return {.where = accessor,
          .view = accessor["bufferView"],
          .type = accessor["type"],
          .component_type = accessor["componentType"],
          .count = accessor["count"],
          .offset = accessor["byteOffset"],
          .normalised = accessor["normalized"].isTrue(),
          .sparse = accessor["sparse"]};
}

const GltfAccessors::Accessor& GltfAccessors::accessorAt(JsonValue accessor_index) const {
  return accessors_[accessor_index.index(accessors_.size(), "accessor")];
}

std::string_view GltfAccessors::bytesOfBuffer(JsonValue buffer_index) {
  Buffer& buffer = buffers_[buffer_index.index(buffers_.size(), "buffer")];
  if (!buffer.is_read) readBuffer(buffer);
  return buffer.bytes;
}

void GltfAccessors::readBuffer(Buffer& buffer) {
  const JsonValue length = buffer.where["byteLength"];
  if (!length) buffer.where.fail("a buffer without byteLength");
  if (const JsonValue uri = buffer.where["uri"]) {
    buffer.owned = bytesOfUri(file_, uri, file_.options.max_bytes - bytes_);
    buffer.bytes = buffer.owned;
    if (!isData(uri.text())) bytes_ += buffer.bytes.size();
  } else if (&buffer == buffers_.data()) {
    buffer.bytes = binary_;
  }
  const std::size_t promised = length.index(kAnySize, "byteLength");
  if (promised > buffer.bytes.size()) {
    length.fail(fmt::format("the buffer declares {} bytes, but has {}", promised, buffer.bytes.size()));
  }
  buffer.bytes = buffer.bytes.substr(0, promised);
  buffer.is_read = true;
}

/// A packed view may refer, besides its packed bytes, to a copy that is not packed; a buffer that is only a placeholder
/// for one has no bytes.
std::string_view GltfAccessors::bytesOfView(JsonValue view_index) {
  const View& view = views_[view_index.index(views_.size(), "bufferView")];
  if (!view.buffer || !view.length) view.where.fail("a bufferView needs buffer and byteLength");
  const std::size_t buffer = view.buffer.index(buffers_.size(), "buffer");
  const bool is_there = buffers_[buffer].where["uri"] || (buffer == 0 && !binary_.empty());
  if (!view.compression.empty() && !is_there) {
    view.where.fail(fmt::format("geometry compressed with {} cannot be read", view.compression));
  }
  const std::string_view bytes = bytesOfBuffer(view.buffer);
  const std::size_t start = view.offset.indexOr(0, bytes.size() + 1, "byteOffset");
  return bytes.substr(start, view.length.index(bytes.size() - start + 1, "byteLength"));
}

GltfAccessors::Elements GltfAccessors::elements(JsonValue where, JsonValue view_index, JsonValue offset,
                                                JsonValue component_type, std::size_t count, std::size_t components) {
  const std::string_view bytes = bytesOfView(view_index);
  if (!component_type) where.fail("an accessor needs a componentType");
  Elements found{};
  found.component_type = static_cast<int>(component_type.index(kFloat + 1, "componentType"));
  const std::size_t size = bytesOf(found.component_type) * components;
  if (size == 0) component_type.fail("not a component type");
  const JsonValue stride = views_[view_index.index(views_.size(), "bufferView")].stride;
  found.stride = stride.indexOr(size, kAnySize, "byteStride");
  if (found.stride == 0) found.stride = size;
  if (found.stride < size) where.fail("byteStride is smaller than one element");

  const std::size_t start = offset.indexOr(0, bytes.size() + 1, "byteOffset");
  const std::size_t room = bytes.size() - start;
  const std::size_t most = room < size ? 0 : (room - size) / found.stride + 1;
  found.count = count;
  if (found.count > most) {
    where.fail(fmt::format("the accessor declares {} elements, but the bufferView has {}", found.count, most));
  }
  found.data = bytes.data() + start;
  return found;
}

GltfAccessors::Sparse GltfAccessors::parseSparse(const Accessor& accessor, std::size_t count, std::size_t components) {
  const JsonValue sparse = accessor.sparse;
  const JsonValue indices = sparse["indices"];
  const JsonValue values = sparse["values"];
  if (!indices["bufferView"] || !values["bufferView"]) sparse.fail("a sparse accessor needs indices and values");
  const std::size_t changed = readCount(sparse, sparse["count"]);
  const Elements at =
      elements(sparse, indices["bufferView"], indices["byteOffset"], indices["componentType"], changed, 1);
  Sparse found{
      {}, elements(sparse, values["bufferView"], values["byteOffset"], accessor.component_type, changed, components)};
  for (std::size_t i = 0; i < changed; ++i) {
    const double place = componentAt(at.data + i * at.stride, at.component_type, false);
    if (!(place >= 0.0 && place < static_cast<double>(count))) {
      sparse.fail(fmt::format("a sparse accessor changes element {} of {}", place, count));
    }
    found.places.push_back(static_cast<Index>(place));
  }
  return found;
}

template <class Vector>
std::vector<Vector> GltfAccessors::vectors(JsonValue accessor_index) {
  using Scalar = typename Vector::Scalar;
  constexpr std::size_t kNumbers = Vector::SizeAtCompileTime;
  const Accessor& accessor = accessorAt(accessor_index);
  if (!accessor.type || accessor.type.text() != accessorType<Vector>()) {
    accessor.where.fail(fmt::format("type {} is expected", accessorType<Vector>()));
  }
  const std::size_t count = readCount(accessor.where, accessor.count);
  const auto read = [&](const Elements& found, std::size_t i) {
    const std::size_t bytes = bytesOf(found.component_type);
    Vector vector;
    for (std::size_t k = 0; k < kNumbers; ++k) {
      const char* data = found.data + i * found.stride + k * bytes;
      vector(static_cast<Eigen::Index>(k)) =
          static_cast<Scalar>(componentAt(data, found.component_type, accessor.normalised));
    }
    return vector;
  };

  std::vector<Vector> result;
  if (accessor.view) {
    const Elements found =
        elements(accessor.where, accessor.view, accessor.offset, accessor.component_type, count, kNumbers);
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) result.push_back(read(found, i));
  }
  const Sparse sparse = accessor.sparse ? parseSparse(accessor, count, kNumbers) : Sparse{};
  if (!accessor.view) {
    if (count > maxItems()) accessor.where.fail(fmt::format("{} zeros, more than a file of this size can mean", count));
    result.assign(count, Vector::Zero());
  }
  for (std::size_t i = 0; i < sparse.places.size(); ++i) result[sparse.places[i]] = read(sparse.values, i);
  return result;
}

template std::vector<Vec3> GltfAccessors::vectors(JsonValue);
template std::vector<Vec2f> GltfAccessors::vectors(JsonValue);
template std::vector<Eigen::Vector4d> GltfAccessors::vectors(JsonValue);
template std::vector<Eigen::Matrix4d> GltfAccessors::vectors(JsonValue);

std::vector<Index> GltfAccessors::indices(JsonValue accessor_index) {
  const JsonValue type = accessorAt(accessor_index).component_type;
  const std::size_t number = type.indexOr(0, kFloat + 1, "componentType");
  if (number != kUnsignedByte && number != kUnsignedShort && number != kUnsignedInt) {
    accessor_index.fail("indices must be unsigned whole numbers");
  }
  std::vector<Index> result;
  for (const auto& scalar : vectors<Eigen::Matrix<double, 1, 1>>(accessor_index)) {
    result.push_back(static_cast<Index>(scalar.value()));
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

JsonValue findBaseColour(const std::vector<JsonValue>& base_colours, JsonValue primitive) {
  const JsonValue index = primitive["material"];
  return index ? base_colours[index.index(base_colours.size(), "material")] : JsonValue();
}

std::string readGltfPicture(const MeshFile& file) {
  const GltfParts parts = splitGltf(file);
  const JsonDocument document(parts.json, {file.name, !parts.is_glb, parts.json_offset});
  const JsonValue base_colour = firstBaseColour(document.root());
  if (!base_colour) return {};
  const JsonValue image = findImage(document.root(), base_colour);
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
