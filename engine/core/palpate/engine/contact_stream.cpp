// Each structure is walked once, for writing and for reading.
#include "palpate/engine/contact_stream.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/byte_wire.h"
#include "palpate/base/error.h"

namespace palpate::engine {

namespace {

constexpr std::string_view kSkinBegins = "PSK1";
constexpr std::string_view kFrameBegins = "PFR1";
static_assert(kSkinBegins.back() == kStreamVersion && kFrameBegins.back() == kStreamVersion);

[[noreturn]] void refuseStream(const char* what, const WireReader& reader) {
  throw Error(fmt::format("{}: byte {}: {}", what, reader.position(), reader.cause()));
}

// --- contacts

enum ContactPart : std::uint8_t { kHasContour = 1, kHasCurves = 2, kAllParts = 3 };

std::uint8_t computePartFlags(const deform::Contact& contact) {
  std::uint8_t parts = 0;
  if (contact.tangential_contour.contour.count > 0) parts |= kHasContour;
  if (contact.layered) parts |= kHasCurves;
  return parts;
}

template <class Wire, class Region>
void walkRegion(Wire& wire, Region& region) {
  wire.place(region.half_major);
  wire.real(region.aspect);
}

template <class Wire, class Contour>
void walkContour(Wire& wire, Contour& on_surface) {
  auto& contour = on_surface.contour;
  wire.count(contour.count, maps::kMinContourRadii, maps::kMaxContourRadii);
  for (std::size_t i = 0; i < contour.count; ++i) wire.real(contour.log_radii[i]);
  wire.place(on_surface.axis_x);
  wire.place(on_surface.axis_y);
}

template <class Wire, class Shape>
void walkCurves(Wire& wire, Shape& shape) {
  wire.real(shape.press.radius_mm);
  for (auto& term : shape.press.down.terms) wire.real(term);
  for (auto& term : shape.press.outward.terms) wire.real(term);
  for (auto& term : shape.drag.terms) wire.real(term);
}

template <class Wire, class Contact>
void walkContact(Wire& wire, Contact& contact) {
  auto parts = computePartFlags(contact);
  wire.word(parts, std::uint8_t{kAllParts});
  wire.place(contact.anchor);
  wire.count(contact.anchor_triangle, Index{0}, kNoIndex);
  wire.place(contact.normal);
  wire.real(contact.depth_mm);
  wire.place(contact.drag_mm);
  walkRegion(wire, contact.normal_region);
  walkRegion(wire, contact.tangential_region);
  if ((parts & kHasContour) != 0) walkContour(wire, contact.tangential_contour);
  if ((parts & kHasCurves) == 0) return;
  if constexpr (Wire::kReads) contact.layered.emplace();
  walkCurves(wire, *contact.layered);
}

template <class Wire, class Finger>
void walkFinger(Wire& wire, Finger& finger) {
  wire.word(finger.touch, contact::Touch::slip);
  wire.shown(finger.tip);
  if (finger.touch == contact::Touch::free) {
    if constexpr (Wire::kReads) finger.proxy = finger.tip;
    return;
  }
  wire.shown(finger.proxy);
  wire.shown(finger.normal);
  wire.shown(finger.force);
  wire.shown(finger.depth_mm);
}

template <class List>
void walkCount(WireWriter& wire, const List& list, std::uint32_t most) {
  wire.whole(static_cast<std::uint16_t>(std::min<std::size_t>(list.size(), most)));
}

template <class List>
void walkCount(WireReader& wire, List& list, std::uint32_t most) {
  const std::uint32_t count = wire.whole<std::uint16_t>();
  if (count > most) wire.fail("more than there can be");
  list.clear();
  list.resize(wire.ok() ? count : 0);
}

void walkTick(WireWriter& wire, std::uint64_t tick) { wire.whole(tick); }
void walkTick(WireReader& wire, std::uint64_t& tick) { tick = wire.whole<std::uint64_t>(); }

template <class Wire, class Frame>
void walkFrame(Wire& wire, Frame& frame) {
  wire.text(kFrameBegins);
  walkTick(wire, frame.tick);
  wire.real(frame.lift_mm);
  walkCount(wire, frame.fingers, kMaxStreamedFingers);
  walkCount(wire, frame.contacts, kMaxStreamedContacts);
  const std::size_t fingers = std::min<std::size_t>(frame.fingers.size(), kMaxStreamedFingers);
  const std::size_t contacts = std::min<std::size_t>(frame.contacts.size(), kMaxStreamedContacts);
  for (std::size_t i = 0; i < fingers; ++i) walkFinger(wire, frame.fingers[i]);
  for (std::size_t i = 0; i < contacts; ++i) walkContact(wire, frame.contacts[i]);
}

bool onSkin(const StreamedFrame& frame, Index triangles) {
  return std::all_of(frame.contacts.begin(), frame.contacts.end(),
                     [&](const deform::Contact& contact) { return contact.anchor_triangle < triangles; });
}

// --- skin

template <class Wire, class Mesh>
void walkMesh(Wire& wire, Mesh& mesh) {
  for (auto& position : mesh.positions) wire.place(position);
  const auto vertices = static_cast<Index>(mesh.positions.size());
  for (auto& triangle : mesh.triangles) {
    for (auto& corner : triangle) wire.count(corner, Index{0}, vertices - 1);
  }
}

}  // namespace

std::string encodedSkin(const mesh::TriangleMesh& mesh, std::span<const float> breath_share) {
  std::string bytes;
  bytes.reserve(16 + 24 * mesh.positions.size() + 12 * mesh.triangles.size() + 4 * breath_share.size());
  WireWriter writer(bytes);
  writer.text(kSkinBegins);
  writer.whole(static_cast<std::uint32_t>(mesh.positions.size()));
  writer.whole(static_cast<std::uint32_t>(mesh.triangles.size()));
  writer.whole(static_cast<std::uint32_t>(breath_share.size()));
  walkMesh(writer, mesh);
  for (const float share : breath_share) writer.real(share);
  return bytes;
}

StreamedSkin decodeSkin(std::string_view bytes) {
  WireReader reader(bytes);
  reader.text(kSkinBegins);
  const std::uint64_t vertices = reader.whole<std::uint32_t>();
  const std::uint64_t triangles = reader.whole<std::uint32_t>();
  const std::uint64_t shares = reader.whole<std::uint32_t>();
  if (vertices == 0 && triangles > 0) reader.fail("triangles without vertices");
  if (shares != 0 && shares != vertices) reader.fail("another number of shares than of vertices");
  // Before memory is allocated: a few bytes must not cost gigabytes.
  if (!reader.has(24 * vertices + 12 * triangles + 4 * shares)) refuseStream("skin", reader);
  StreamedSkin skin;
  skin.mesh.positions.resize(static_cast<std::size_t>(vertices));
  skin.mesh.triangles.resize(static_cast<std::size_t>(triangles));
  skin.breath_share.resize(static_cast<std::size_t>(shares));
  walkMesh(reader, skin.mesh);
  for (float& share : skin.breath_share) reader.real(share);
  reader.end();
  if (!reader.ok()) refuseStream("skin", reader);
  return skin;
}

void encodeFrame(const StreamedFrame& frame, std::string& bytes) {
  bytes.clear();
  WireWriter writer(bytes);
  walkFrame(writer, frame);
}

bool decodeFrame(std::string_view bytes, Index triangles, StreamedFrame& frame) {
  WireReader reader(bytes);
  walkFrame(reader, frame);
  reader.end();
  if (reader.ok() && onSkin(frame, triangles)) return true;
  frame.tick = 0;
  frame.lift_mm = 0.0;
  frame.fingers.clear();
  frame.contacts.clear();
  return false;
}

}  // namespace palpate::engine
