// One walk over the parts writes and reads them: see palpate/base/byte_wire.h.
#include "palpate/scene/ready_body.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "palpate/base/byte_wire.h"
#include "palpate/base/error.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

constexpr std::string_view kKind = "palpate body 3";
constexpr std::uint32_t kMaxBodyVertices = 1'000'000;
constexpr std::uint32_t kMaxParts = 1000;  // bones or landmarks
constexpr std::uint32_t kMaxName = 200;    // letters

/// So that small differences of either sign have zeros for high bytes.
template <class Whole>
Whole folded(Whole step) {
  constexpr int kTop = 8 * sizeof(Whole) - 1;
  return (step << 1) ^ (static_cast<Whole>(0) - (step >> kTop));
}
template <class Whole>
Whole unfolded(Whole code) {
  return (code >> 1) ^ (static_cast<Whole>(0) - (code & 1));
}

template <class Whole>
void planes(WireWriter& wire, const std::vector<Whole>& values) {
  std::vector<Whole> codes;
  codes.reserve(values.size());
  Whole before = 0;
  for (const Whole value : values) {
    codes.push_back(folded(static_cast<Whole>(value - before)));
    before = value;
  }
  std::string plane(codes.size(), '\0');
  for (std::size_t byte = 0; byte < sizeof(Whole); ++byte) {
    for (std::size_t i = 0; i < codes.size(); ++i) plane[i] = static_cast<char>(codes[i] >> (8 * byte));
    wire.bytes(plane);
  }
}

template <class Whole>
void planes(WireReader& wire, std::vector<Whole>& values) {
  if (!wire.has(values.size() * sizeof(Whole))) return;
  for (std::size_t byte = 0; byte < sizeof(Whole); ++byte) {
    const std::string_view plane = wire.bytes(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] |= static_cast<Whole>(static_cast<unsigned char>(plane[i])) << (8 * byte);
    }
  }
  Whole before = 0;
  for (Whole& value : values) before = value = before + unfolded(value);
}

/// This and the next are called with a writer and the values, or with a reader and values to fill in, of which only the
/// number is right.
template <class Wire, class Reals>
void realPlanes(Wire& wire, Reals& values) {
  using Real = typename Reals::value_type;
  std::vector<wire::BitsOf<Real>> bits(values.size());
  if constexpr (!Wire::kReads) {
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = wire::bitsOf(values[i]);
  }
  planes(wire, bits);
  if constexpr (Wire::kReads) {
    for (std::size_t i = 0; i < bits.size(); ++i) {
      values[i] = wire::realOf<Real>(bits[i]);
      if (!(std::abs(values[i]) <= static_cast<Real>(kMaxWire))) wire.fail("a number that is not finite, or too large");
    }
  }
}

template <class Wire, class Places>
void placePlanes(Wire& wire, Places& places) {
  std::vector<double> along(places.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < along.size(); ++i) along[i] = places[i][axis];
    realPlanes(wire, along);
    if constexpr (Wire::kReads) {
      for (std::size_t i = 0; i < along.size(); ++i) places[i][axis] = along[i];
    }
  }
}

template <class Wire, class Indices>
void indexPlanes(Wire& wire, Indices& indices, std::size_t below) {
  planes(wire, indices);
  if constexpr (Wire::kReads) {
    for (const Index index : indices) {
      if (index >= below) wire.fail("an index of nothing");
    }
  }
}

template <class Wire, class Mesh>
void walkMesh(Wire& wire, Mesh& mesh) {
  auto vertices = mesh.positions.size();
  auto triangles = mesh.triangles.size();
  wire.count(vertices, std::size_t{1}, std::size_t{kMaxBodyVertices});
  wire.count(triangles, std::size_t{1}, std::size_t{2 * kMaxBodyVertices});
  if constexpr (Wire::kReads) {
    if (!wire.has(24 * vertices + 12 * triangles)) return;
    mesh.positions.assign(vertices, Vec3::Zero());
    mesh.triangles.assign(triangles, Triangle{});
  }
  placePlanes(wire, mesh.positions);
  for (std::size_t corner = 0; corner < 3; ++corner) {
    std::vector<Index> corners(triangles);
    for (std::size_t t = 0; t < triangles; ++t) corners[t] = mesh.triangles[t][corner];
    indexPlanes(wire, corners, vertices);
    if constexpr (Wire::kReads) {
      for (std::size_t t = 0; t < triangles; ++t) mesh.triangles[t][corner] = corners[t];
    }
  }
}

template <class Wire, class Text>
void walkText(Wire& wire, Text& text) {
  auto letters = text.size();
  wire.count(letters, std::size_t{0}, std::size_t{kMaxName});
  if constexpr (Wire::kReads) {
    if (!wire.has(letters)) return;
    text.resize(letters);
    for (char& c : text) c = static_cast<char>(wire.template whole<std::uint8_t>());
  } else {
    wire.text(text);
  }
}

template <class Wire, class Parts>
void sizeParts(Wire& wire, Parts& parts) {
  auto count = parts.size();
  wire.count(count, std::size_t{0}, std::size_t{kMaxParts});
  if constexpr (Wire::kReads) parts.resize(count);
}

template <class Wire, class Parts>
void walkAnatomy(Wire& wire, Parts& anatomy, std::size_t vertices) {
  sizeParts(wire, anatomy.bones);
  for (auto& bone : anatomy.bones) {
    walkText(wire, bone.name);
    wire.word(bone.kind, body::BoneKind::humerus);
    walkMesh(wire, bone.mesh);
  }
  if constexpr (Wire::kReads) {
    anatomy.depth_mm.assign(vertices, 0.0);
    anatomy.nearest_bone.assign(vertices, 0);
    anatomy.bone_radius_mm.assign(vertices, 0.0f);
  }
  realPlanes(wire, anatomy.depth_mm);
  indexPlanes(wire, anatomy.nearest_bone, anatomy.bones.size());
  realPlanes(wire, anatomy.bone_radius_mm);
  sizeParts(wire, anatomy.landmarks);
  for (auto& landmark : anatomy.landmarks) {
    walkText(wire, landmark.name);
    walkText(wire, landmark.bone);
    for (auto* place : {&landmark.position, &landmark.normal, &landmark.bone_position}) wire.place(*place);
  }
  bool has_support = anatomy.support.has_value();
  wire.word(has_support, true);
  if constexpr (Wire::kReads) {
    if (has_support) anatomy.support.emplace(body::Support{Vec3::Zero(), Vec3::Zero()});
  }
  if (has_support) {
    wire.place(anatomy.support->point);
    wire.place(anatomy.support->normal);
  }
}

template <class Wire, class Body>
void walkBody(Wire& wire, Body& body) {
  wire.text(kKind);
  wire.count(body.triangles, std::size_t{0}, std::size_t{2 * kMaxBodyVertices});
  walkText(wire, body.parts.name);
  wire.word(body.parts.closed, true);
  walkMesh(wire, body.parts.skin);
  walkAnatomy(wire, body.parts.anatomy, body.parts.skin.positions.size());
}

BodyStore& bodyStore() {
  static BodyStore store;
  return store;
}

/// A number to its last bit, in letters.
std::string exactly(double value) { return fmt::format(" {:a}", value); }

std::string exactly(const body::ReliefSettings& relief) {
  // A setting that is new makes this line fail to compile, until the recipe has it.
  const auto& [spine, ribs, scapulae, spine_level, rib_level, scapula_level] = relief;
  std::string text = exactly(spine) + exactly(ribs) + exactly(scapulae);
  for (const auto* levels : {&spine_level, &rib_level, &scapula_level}) {
    for (const double level : *levels) text += exactly(level);
  }
  return text;
}

std::string exactly(const body::TrunkShape& shape) {
  const auto& [stature, girth, mass_index, muscle, kyphosis, lordosis, posture, relief, asymmetry] = shape;
  std::string text;
  for (const double value : {stature, girth, mass_index, muscle, kyphosis, lordosis, asymmetry}) text += exactly(value);
  return text + exactly(relief) + fmt::format(" {}", static_cast<int>(posture));
}

bool fits(const BodyParts& parts) {
  return parts.skin.positions.size() <= kMaxBodyVertices && parts.skin.triangles.size() <= 2 * kMaxBodyVertices;
}

}  // namespace

std::string encodedBody(const ReadyBody& body) {
  std::string bytes;
  WireWriter wire(bytes);
  walkBody(wire, body);
  return bytes;
}

ReadyBody decodeBody(std::string_view bytes, std::string_view what) {
  ReadyBody body;
  WireReader wire(bytes);
  walkBody(wire, body);
  wire.end();
  if (!wire.ok()) throw Error(fmt::format("{}: byte {}: {}", what, wire.position(), wire.cause()));
  return body;
}

std::string bodyRecipe(const BodySettings& settings) {
  if (settings.kind == BodyKind::mesh) return {};
  return fmt::format("{} {} {}{}", wordFor(settings.kind), settings.triangles, settings.bone_triangles,
                     exactly(settings.shape));
}

void setBodyStore(BodyStore store) { bodyStore() = std::move(store); }

std::optional<BodyParts> keptBody(const BodySettings& settings) {
  if (!bodyStore().find) return std::nullopt;
  const std::optional<std::string> bytes = bodyStore().find(bodyRecipe(settings));
  if (!bytes) return std::nullopt;
  try {
    return decodeBody(*bytes, "kept body").parts;
  } catch (const Error&) {
    return std::nullopt;  // it is made again, and takes the damaged one's place
  }
}

void storeBody(const BodySettings& settings, const BodyParts& parts) {
  if (bodyStore().save && fits(parts)) {
    bodyStore().save(bodyRecipe(settings), encodedBody({settings.triangles, parts}));
  }
}

}  // namespace palpate::scene
