// Builds the shapes of the look. They keep their memory from picture to picture; key ellipses and partition, which are
// too slow for every picture, are made when first shown and kept.
#include "palpate/view/overlays/overlays.h"

#include "palpate/view/overlays/cut_away.h"
#include "palpate/view/overlays/lump_marks.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/overlays/muscle_marks.h"
#include "palpate/view/overlays/section.h"

namespace palpate::view {

namespace {

constexpr double kArrowSpacingMm = 6.0;
constexpr Index kMaxNormals = 6000;
constexpr int kRings = 8;

void clear(OverlayShapes& shapes) {
  shapes.patches.points.clear();
  shapes.thin.points.clear();
  shapes.bold.points.clear();
  shapes.seen_through.points.clear();
  shapes.solid.points.clear();
}

}  // namespace

const OverlayShapes& Overlays::shapes(const Look& look, const DrawnSkin& skin, std::span<const FingerMark> fingers) {
  clear(shapes_);
  if (look.overlays.none()) return shapes_;
  addPartition(look);
  addBody(look, skin);
  for (const FingerMark& finger : fingers) addFinger(look, skin, finger.contact);
  const FingerMark* cut = look.shows(Overlay::section) ? sectionFinger(fingers) : nullptr;
  if (cut != nullptr) addSection(world_, skin, cut->contact, shapes_.bold);
  addBeneath(look, skin, fingers);
  return shapes_;
}

void Overlays::addBeneath(const Look& look, const DrawnSkin& skin, std::span<const FingerMark> fingers) {
  if (look.shows(Overlay::lumps)) addLumps(world_, fingers, skin, shapes_.solid);
  if (look.shows(Overlay::cut)) {
    if (const auto plane = cutPlane(world_, fingers)) {
      addCutLine(world_, skin, *plane, kCutLineMm, kCutPaint, shapes_.bold);
    }
  }
  if (!look.shows(Overlay::pressure)) return;
  if (!pads_) pads_.emplace(world_);
  const std::vector<PadReading> pads = pads_->read(fingers, skin.liftMm());
  const double top_kpa = padScaleTop(pads);
  for (const PadReading& pad : pads) addPad(pad, top_kpa, world_, skin, shapes_.seen_through, shapes_.thin);
}

void Overlays::addPartition(const Look& look) {
  if (look.shows(Overlay::leaf_boxes)) addLeafBoxes(*partition().partition, shapes_.thin);
  if (look.shows(Overlay::planes)) addPlanes(*partition().partition, shapes_.thin, shapes_.patches);
}

void Overlays::addBody(const Look& look, const DrawnSkin& skin) {
  if (look.shows(Overlay::muscles)) {
    if (!muscles_) muscles_ = muscleSheets(world_);
    for (const MuscleSheet& muscle : *muscles_) addMuscle(muscle, skin, shapes_.patches, shapes_.thin);
  }
  if (look.shows(Overlay::arrows)) addDisplacements(world_, skin, kArrowSpacingMm, shapes_.thin);
  if (look.shows(Overlay::normals)) addNormals(skin, kMaxNormals, shapes_.thin);
  if (look.shows(Overlay::ellipses)) {
    for (const Outline& outline : keyEllipses()) addOutline(outline, skin, kKeyEllipsePaint, shapes_.thin);
  }
}

void Overlays::addFinger(const Look& look, const DrawnSkin& skin, const contact::FingerOutput& contact) {
  if (look.shows(Overlay::detecting_box)) addDetectingBox(partition(), contact, shapes_.bold);
  if (look.shows(Overlay::haptic_triangles)) addHapticTriangles(partition(), world_, skin, contact, shapes_.patches);
  if (look.shows(Overlay::contact)) addContactMarks(contact, shapes_.bold);
  if (contact.touch != contact::Touch::free) addTouch(look, skin, contact);
}

void Overlays::addTouch(const Look& look, const DrawnSkin& skin, const contact::FingerOutput& contact) {
  if (look.shows(Overlay::ellipses)) addContactEllipses(world_, contact, skin, shapes_.bold);
  if (look.shows(Overlay::rings)) addRings(world_, skin, contact.anchor_triangle, kRings, shapes_.thin);
}

const ShownPartition& Overlays::partition() {
  if (!partition_) partition_ = makeShownPartition(world_);
  return *partition_;
}

const std::vector<Outline>& Overlays::keyEllipses() {
  if (!key_ellipses_) key_ellipses_ = keyOutlines(world_);
  return *key_ellipses_;
}

}  // namespace palpate::view
