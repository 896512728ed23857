// Presses of the mouse as the training window draws them, and what of them is read off the picture.
//
//   site, change ─ MouseFinger, contact ─► skin, finger, rings ─ Studio ─► picture ─► EyeReading, pixels
//
// A reading comes from pixels alone: where the drawn finger is in the close view, how wide the rings are in the whole
// picture. Depth, force and stiffness are not asked.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/scene/world.h"
#include "palpate/training/trainee/body_touch.h"
#include "palpate/view/picture.h"

namespace palpate::study {

/// Force of the mouse's press in training, N.
inline constexpr double kEyePressN = 2.0;

/// Reading of one press, pixels.
struct EyeReading {
  double sink = 0.0;   ///< in the close view: motion of the finger's cuff since it touched
  double rings = 0.0;  ///< in the whole picture: half of the rings' width
};

/// Takes the pictures. Needs what OffscreenContext needs; one thread.
class EyePictures {
 public:
  /// The body and places of a test of this protocol. Throws Error.
  explicit EyePictures(const training::Protocol& protocol);
  ~EyePictures();

  int sites() const;
  /// A press on this site while the place hidden there has this change; 0: none is.
  EyeReading read(int site, double change);
  /// The picture of the same press.
  view::Image picture(int site, double change, double force_n);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Both readings of every site, without and with a change.
struct EyeSites {
  double change = 0.0;  ///< declared, of compliance
  std::vector<EyeReading> normal;
  std::vector<EyeReading> stiffer;
};

/// `sites` of them, evenly spread; at most all.
EyeSites readSites(EyePictures& pictures, double change, int sites, const Progress& progress);

}  // namespace palpate::study
