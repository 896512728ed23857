// Reads with a time limit, then draws triangles into a depth buffer, one light, no OpenGL: it would cost the display's
// thread its frames, and another thread has no context.
#include "view/viewer/files/file_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/stopwatch.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/validate.h"
#include "palpate/scene/scene_file.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr view::Pixel kGround = {38, 40, 44};
constexpr double kMarginShare = 0.06;
constexpr std::size_t kMaxWords = 160;  // letters

std::string kindOf(const fs::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return kind;
}

/// The box of the triangles' finite vertices; one broken vertex must not make the rest invisible.
Eigen::AlignedBox3d finiteBox(const mesh::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& position : mesh.positions) {
    if (position.allFinite()) box.extend(position);
  }
  return box;
}

/// A depth buffer with the light of the nearest surface.
class Sheet {
 public:
  Sheet(int width, int height) : image_(width, height, kGround), depth_(image_.pixels.size(), kNothing) {}

  /// Corners in pixels, the third coordinate towards the eye.
  void draw(const std::array<Vec3, 3>& corners, double light) {
    const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    const Vec2 a = corners[0].head<2>(), b = corners[1].head<2>(), c = corners[2].head<2>();
    const double area = cross(b - a, c - a);
    if (area == 0.0 || !std::isfinite(area)) return;
    for (int y = firstPixel(low.y()); y <= lastPixel(high.y(), image_.height); ++y) {
      for (int x = firstPixel(low.x()); x <= lastPixel(high.x(), image_.width); ++x) {
        const Vec2 p(x + 0.5, y + 0.5);
        const double u = cross(b - p, c - p) / area, v = cross(c - p, a - p) / area, w = 1.0 - u - v;
        if (u < 0.0 || v < 0.0 || w < 0.0) continue;
        put(x, y, u * corners[0].z() + v * corners[1].z() + w * corners[2].z(), light);
      }
    }
  }
  view::Image releaseImage() { return std::move(image_); }

 private:
  static constexpr double kNothing = -std::numeric_limits<double>::infinity();

  static double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
  static int firstPixel(double low) { return std::max(0, static_cast<int>(std::floor(low - 0.5))); }
  static int lastPixel(double high, int pixels) { return std::min(pixels - 1, static_cast<int>(std::ceil(high))); }

  void put(int x, int y, double depth, double light) {
    double& nearest =
        depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x)];
    if (!(depth > nearest)) return;
    nearest = depth;
    const auto level = [&](double full) { return static_cast<std::uint8_t>(std::lround(full * light)); };
    image_.at(x, y) = {level(232.0), level(206.0), level(188.0)};
  }

  view::Image image_;
  std::vector<double> depth_;
};

/// From the body's frame to right, up and towards the eye.
Mat3 eyeAxes() {
  constexpr double kYaw = 0.45, kPitch = 0.22;  // rad
  Mat3 turn, tilt;
  turn << std::cos(kYaw), 0.0, -std::sin(kYaw), 0.0, 1.0, 0.0, std::sin(kYaw), 0.0, std::cos(kYaw);
  tilt << 1.0, 0.0, 0.0, 0.0, std::cos(kPitch), -std::sin(kPitch), 0.0, std::sin(kPitch), std::cos(kPitch);
  return tilt * turn;
}

mesh::MeshWithChannels loadInTime(const fs::path& file, const mesh::LoadOptions& options, double max_seconds) {
  const auto started = Clock::now();
  return mesh::loadWithChannels(file, options, [&](std::string_view, double) {
    if (secondsSince(started) > max_seconds) throw Error("no preview: reading takes too long");
  });
}

FilePreview previewOfMesh(const fs::path& file, const mesh::LoadOptions& options, const PreviewLimits& limits) {
  const auto [mesh, channels, notes] = loadInTime(file, options, limits.max_seconds);
  const Vec3 size = finiteBox(mesh).isEmpty() ? Vec3::Zero() : Vec3(finiteBox(mesh).sizes());
  FilePreview preview;
  if (options.unit_mm == 0.0 && hasNoUnit(file)) preview.longest_units = size.maxCoeff();
  preview.words = trf("{} triangles, {:.4g} x {:.4g} x {:.4g}{}", mesh.triangles.size(), size.x(), size.y(), size.z(),
                      preview.longest_units ? "" : " mm");
  for (std::string note : notes) {
    if (note.starts_with(file.string())) note.replace(0, file.string().size(), file.filename().string());
    preview.notes.push_back(oneLine(note, kMaxWords));
  }
  preview.picture = smallPicture(mesh, limits);
  return preview;
}

FilePreview previewOfScene(const fs::path& file, const PreviewLimits& limits) {
  const scene::Scene scene = scene::load(file);
  const std::string title = scene.title.empty() ? tr("Scene") : oneLine(scene.title);
  if (scene.body.kind != scene::BodyKind::mesh) return {trf("{}, on a built-in body", title), {}, {}};
  FilePreview preview = previewOfMesh(
      scene.body.file, {.unit_mm = scene::millimetresOf(scene.body.unit), .max_bytes = limits.max_bytes}, limits);
  preview.words = fmt::format("{}: {}", title, preview.words);
  preview.longest_units.reset();  // the scene gives the unit
  return preview;
}

}  // namespace

bool hasNoUnit(const fs::path& file) {
  const std::string kind = kindOf(file);
  return mesh::isMeshFile(file) && kind != ".gltf" && kind != ".glb";
}

view::Image smallPicture(const mesh::TriangleMesh& mesh, const PreviewLimits& limits) {
  constexpr std::size_t kBetweenLooks = 256;  // triangles; each may fill the picture
  const auto started = Clock::now();
  Sheet sheet(limits.width, limits.height);
  const Eigen::AlignedBox3d box = finiteBox(mesh);
  const double length = box.isEmpty() ? 0.0 : box.diagonal().norm();
  if (!(length > 0.0) || !std::isfinite(length)) return sheet.releaseImage();
  const Mat3 axes = eyeAxes();
  const double scale = (1.0 - 2.0 * kMarginShare) * std::min(limits.width, limits.height) / length;
  const auto seen = [&](const Vec3& place) -> Vec3 {
    const Vec3 from_middle = axes * ((place - box.center()) * scale);
    return {0.5 * limits.width + from_middle.x(), 0.5 * limits.height - from_middle.y(), from_middle.z()};
  };
  const Vec3 to_light = Vec3(-0.5, 0.6, 0.9).normalized();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i % kBetweenLooks == 0 && secondsSince(started) > limits.max_seconds) break;
    std::array<Vec3, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = seen(mesh.positions[mesh.triangles[i][k]]);
    if (!(corners[0].allFinite() && corners[1].allFinite() && corners[2].allFinite())) continue;
    Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    normal = Vec3(normal.x(), -normal.y(), normal.z()).normalized();  // rows count downwards
    sheet.draw(corners, 0.25 + 0.75 * std::abs(normal.dot(to_light)));
  }
  return sheet.releaseImage();
}

FilePreview previewFile(const fs::path& file, const PreviewLimits& limits) {
  try {
    std::error_code error;
    if (fs::file_size(file, error) > limits.max_bytes && !error) {
      return {trf("{} MB: too large for a preview", fs::file_size(file, error) >> 20), {}, {}};
    }
    if (kindOf(file) == ".toml") return previewOfScene(file, limits);
    if (mesh::isMeshFile(file)) return previewOfMesh(file, {.max_bytes = limits.max_bytes}, limits);
    return {};
  } catch (const std::exception& error) {
    return {oneLine(error.what(), kMaxWords), {}, {}};
  }
}

std::optional<UnitGuess> unitGuess(double longest_units) {
  struct Candidate {
    scene::Unit unit;
    std::string_view name;
    std::string_view answer;
  };
  constexpr std::array kCandidates = {
      Candidate{scene::Unit::metre, toTranslate("metres"), toTranslate("Metres")},
      Candidate{scene::Unit::centimetre, toTranslate("centimetres"), toTranslate("Centimetres")},
      Candidate{scene::Unit::decimetre, toTranslate("decimetres"), toTranslate("Decimetres")}};
  // From a hand to the tallest person.
  constexpr double kShortestMm = 120.0, kLongestMm = 2300.0;
  // Between these, in millimetres, it is a body or a part of one, and no question is needed.
  constexpr double kSmallestPartMm = 40.0;
  if (!(longest_units > 0.0) || (longest_units >= kSmallestPartMm && longest_units <= mesh::kLongestBodyMm)) return {};
  for (const Candidate& candidate : kCandidates) {
    const double length_mm = longest_units * scene::millimetresOf(candidate.unit);
    if (length_mm < kShortestMm || length_mm > kLongestMm) continue;
    const std::string length =
        length_mm < 1000.0 ? trf("{:.0f} cm", 0.1 * length_mm) : trf("{:.2g} m", 1e-3 * length_mm);
    return UnitGuess{candidate.unit,
                     trf("This body is {:.2g} across: {}? It would be {} long.", longest_units,
                         tr(std::string(candidate.name).c_str()), length),
                     std::string(candidate.answer)};
  }
  return {};
}

}  // namespace palpate::viewer
