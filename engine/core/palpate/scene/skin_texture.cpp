// A mesh file is read a second time, with coordinates, because the skin keeps places and triangles only; then each
// corner of the skin looks its coordinates up by place (mesh/textured_mesh.h). The picture stays as its file's
// bytes; only the first are looked at, so that a wrong file is told already here. Load time.
#include "palpate/scene/skin_texture.h"

#include <fmt/format.h>

#include <charconv>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/body_parts.h"

namespace palpate::scene {

namespace {

/// Far more than a photograph of a back needs; bounds what a wrong file name can cost.
constexpr std::size_t kMaxPictureBytes = std::size_t{256} << 20;

bool isPicture(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n") || bytes.starts_with("\xff\xd8\xff"); }

bool isGltf(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".gltf" || extension == ".glb";
}

std::string pictureFrom(const std::filesystem::path& file) {
  if (!isGltf(file)) return readFile(file, kMaxPictureBytes);
  std::string picture = mesh::basePictureOf(file);
  if (picture.empty()) throw Error::inFile(file.string(), "has no base colour texture");
  return picture;
}

std::string checkedPicture(const TextureSource& source) {
  std::string picture;
  try {
    picture = pictureFrom(source.file);
  } catch (const Error& error) {
    failForTexture(source, error.what());
  }
  if (!isPicture(picture)) failForTexture(source, source.file.string() + ": is neither a PNG nor a JPEG picture");
  return picture;
}

mesh::TexturedMesh loadTexturedMesh(const BodySettings& body, const Progress& progress) {
  mesh::LoadOptions options = loadOptionsOf(body);
  mesh::TexturedMesh textured = mesh::loadTextured(body.file, options, progress);
  if (textured.mesh.triangles.empty()) {
    failForTexture(body.texture, body.file.string() + ": has no texture coordinates (OBJ, glTF and GLB can)");
  }
  for (Vec3& position : textured.mesh.positions) position *= body.scale;
  return textured;
}

/// The halves meet where the skin turns away from both.
std::vector<mesh::TextureCorners> backAndFront(const mesh::TriangleMesh& skin) {
  const Eigen::AlignedBox3d box = mesh::boundingBox(skin);
  std::vector<mesh::TextureCorners> corners;
  corners.reserve(skin.triangles.size());
  for (const Triangle& t : skin.triangles) {
    const Vec3 normal = mesh::areaVector2(skin, t);
    mesh::TextureCorners& places = corners.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 share = (skin.positions[t[i]] - box.min()).cwiseQuotient(box.sizes());
      const double across = normal.z() >= 0.0 ? 0.5 * share.x() : 1.0 - 0.5 * share.x();
      places[i] = Vec2(across, share.y()).cast<float>();
    }
  }
  return corners;
}

MadeSkin madeSkin(std::uint64_t seed, const mesh::TriangleMesh& skin, std::span<const body::SkinLandmark> landmarks) {
  const Eigen::AlignedBox3d box = mesh::boundingBox(skin);
  MadeSkin made{.seed = seed, .size_mm = box.sizes().head<2>()};
  for (const body::SkinLandmark& landmark : landmarks) {
    if (landmark.name.starts_with("spinous_")) made.spine_mm.emplace_back((landmark.position - box.min()).head<2>());
  }
  return made;
}

constexpr std::string_view kMade = "made";

}  // namespace

std::optional<std::uint64_t> madeSeed(const TextureSource& source) {
  const std::string name = source.file.filename().string();
  if (name == kMade) return 1;
  if (!name.starts_with(std::string(kMade) + ":")) return std::nullopt;
  const std::string_view number = std::string_view(name).substr(kMade.size() + 1);
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), seed);
  if (error != std::errc() || end != number.data() + number.size()) {
    failForTexture(source, fmt::format("the seed in '{}' must be a whole number, as in made:7", name));
  }
  return seed;
}

void failForTexture(const TextureSource& source, std::string_view cause) {
  const std::string message = fmt::format("[body] texture: {}", cause);
  if (source.line == 0) throw Error(message);
  throw Error::atLine(source.scene_file, source.line, message);
}

std::shared_ptr<const SkinTexture> loadSkinTexture(const BodySettings& body, const mesh::TriangleMesh& skin,
                                                   std::span<const body::SkinLandmark> landmarks,
                                                   const Progress& progress) {
  if (body.texture.file.empty()) return nullptr;
  if (const auto seed = madeSeed(body.texture)) {
    if (body.kind == BodyKind::mesh) failForTexture(body.texture, "made is for the trunk, the torso and the back");
    return std::make_shared<const SkinTexture>(
        SkinTexture{body.texture, {}, backAndFront(skin), madeSkin(*seed, skin, landmarks)});
  }
  std::string picture = checkedPicture(body.texture);
  if (body.kind != BodyKind::mesh) {
    return std::make_shared<const SkinTexture>(SkinTexture{body.texture, std::move(picture), backAndFront(skin)});
  }
  const mesh::TexturedMesh textured = loadTexturedMesh(body, progress);
  return std::make_shared<const SkinTexture>(
      SkinTexture{body.texture, std::move(picture), mesh::textureOn(skin, textured, progress)});
}

}  // namespace palpate::scene
