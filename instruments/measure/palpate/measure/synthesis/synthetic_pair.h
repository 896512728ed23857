// Two photographs of a dotted back, before and after a stick drags its skin, and the truth that they show.
//
//   SyntheticCase ─ renderPair ─► before, after, truth ─► measurePair (measurement.h), tests, the study, files
//
// Each picture is painted by inverse mapping: the chart of the back is projected as a fine mesh, each pixel looks up
// the place of the skin that it sees, and one painted skin serves all pictures.
#pragma once

#include <vector>

#include "palpate/measure/dot_grid.h"
#include "palpate/measure/field/skin_field.h"
#include "palpate/measure/photograph.h"
#include "palpate/measure/synthesis/synthetic_case.h"

namespace palpate::measure {

struct TrueDot {
  GridSite site;                 ///< counted from the bottom left of the stencil
  Vec2 skin_mm = Vec2::Zero();   ///< where the hand set it
  Vec2 moved_mm = Vec2::Zero();  ///< along the skin by the stick, without the body's own motion
  Vec2 before_px = Vec2::Zero();
  Vec2 after_px = Vec2::Zero();
  double covered = 0.0;  ///< share of it that stick or hand hide in the second picture
  bool hidden() const { return covered > 0.5; }
};

/// In the frame of the skin (skin_field.h): the chart of the back, arc length from its middle.
struct SyntheticTruth {
  std::vector<TrueDot> dots;
  std::vector<Vec2> strays_px;  ///< in the first picture
  SkinField field;              ///< for a half space only contact and peak
  KeyEllipse at_2_mm;           ///< every sd is 0
  KeyEllipse at_4_mm;
  double drag_deg = 0.0;
  Vec2 contact_px = Vec2::Zero();  ///< in the first picture
  Vec2 tip_px = Vec2::Zero();      ///< the same place of the skin in the second
  double px_per_mm = 0.0;          ///< in the middle of the back
};

struct SyntheticPair {
  Photograph before;
  Photograph after;
  SyntheticTruth truth;
};

/// A picture of a pair: `again` is a second one before the press, when the body may have moved.
enum class Moment : unsigned char { before, after, again };

/// Without the losses of JPEG.
Photograph renderPicture(const SyntheticCase& made, Moment moment);
/// Pictures as from a camera: through JPEG of the case's quality.
SyntheticPair renderPair(const SyntheticCase& made);
SyntheticTruth computeTruth(const SyntheticCase& made);

/// The picture after JPEG compression.
Photograph throughJpeg(const Photograph& picture, int quality);
/// The bytes of such a file, without times.
std::vector<std::uint8_t> jpegBytes(const Photograph& picture, int quality);

// Pictures are worked on one core while this lives: for work that is shared among threads by pairs, and for its times.

/// OpenCV's number of threads is one for the whole process: one of these at a time.
class OneThread {
 public:
  OneThread();
  ~OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_ = 0;
};

}  // namespace palpate::measure
