// Skin, forms and contacts as bytes, for programs that deform the same skin elsewhere, a browser above all.
//
//   World ─ encodedSkin, encodedForms ─► once ──────────► decodeSkin, decodeForms ─► deform::Skin, Deformer ─┐
//   fingers ─ StreamedFrame ─ encodeFrame ─► 60 times/s ─► decodeFrame ─► contacts ─────────────────────────┴─► surface
//
// Deformation depends on nothing but skin, forms and contacts, so the far side has the same surface, on the same
// machine bit by bit. Little endian; places as double, values for display as float. The skin in the body's own order.
// Decoders do not trust their bytes: sizes, ranges, words and triangles are checked before they are used.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/contact/finger_state.h"
#include "palpate/deform/contact.h"
#include "palpate/deform/forms.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/scene/world.h"
#include "palpate/trace/sample.h"

namespace palpate::engine {

/// Version of the bytes; every message begins with its kind and this. Both sides must have the same.
inline constexpr char kStreamVersion = '1';

inline constexpr std::uint32_t kMaxStreamedFingers = 64;
inline constexpr std::uint32_t kMaxStreamedContacts = 1024;

struct StreamedSkin {
  mesh::TriangleMesh mesh;
  /// Per vertex, the share of StreamedFrame::lift_mm that it moves along +z; empty where the body does not breathe.
  std::vector<float> breath_share = {};
};

/// One finger in one frame, rounded to floats: it is shown, not computed with. For a free one only the tip is sent: it
/// has no normal, force and depth, and its proxy is the tip.
struct StreamedFinger {
  Vec3 tip = Vec3::Zero();  ///< mm; 1e4 or more from the body: no place
  Vec3 proxy = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit, out of the skin
  Vec3 force = Vec3::Zero();   ///< on the finger as the skin gives it, N
  double depth_mm = 0.0;
  contact::Touch touch = contact::Touch::free;
};

struct StreamedFrame {
  std::uint64_t tick = 0;  ///< in which it was felt
  double lift_mm = 0.0;    ///< lift by the breath
  std::vector<StreamedFinger> fingers = {};
  std::vector<deform::Contact> contacts = {};  ///< contacts of all fingers, for Deformer::apply
};

/// Positions, triangles and shares of the breath (one per vertex, or none).
std::string encodedSkin(const mesh::TriangleMesh& mesh, std::span<const float> breath_share = {});
/// Throws Error naming the byte: wrong kind, version or size, a place that is not finite, a triangle of a vertex that
/// is not there.
StreamedSkin decodeSkin(std::string_view bytes);

std::string encodedForms(const deform::FormSettings& forms);
/// Throws Error likewise. Deformer checks the profile.
deform::FormSettings decodeForms(std::string_view bytes);

/// Replaces `bytes`; allocates only while they grow. Not more than kMaxStreamedFingers and kMaxStreamedContacts.
void encodeFrame(const StreamedFrame& frame, std::string& bytes);
/// Replaces `frame`. False unless the bytes are a frame for a skin of `triangles` triangles: then it is empty, an
/// untouched body. Allocates only while lists grow.
bool decodeFrame(std::string_view bytes, Index triangles, StreamedFrame& frame);

// A world and its fingers as they are sent.

/// The skin with its motion by breath. Cold.
std::string encodedSkinOf(const scene::World& world);

/// LivingSkin's forms for this number of fingers, strain included.
std::string encodedFormsOf(const scene::World& world, std::size_t fingers);

/// A frame with room for this number of fingers and their dents.
StreamedFrame frameFor(std::size_t fingers);

/// Computes the skin's frame from these samples of one tick; `frame` comes from frameFor. No allocation.
void fillFrame(const scene::World& world, std::span<const trace::Sample> samples, StreamedFrame& frame) noexcept;

}  // namespace palpate::engine
