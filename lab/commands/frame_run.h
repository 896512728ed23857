// Times whole pictures of a back under a finger that wanders: the numbers of `palpate study bench frame`.
#pragma once

#include <cstddef>
#include <string>

#include "palpate/view/look.h"
#include "palpate/view/stereo.h"

namespace palpate::app {

struct FrameRun {
  std::size_t triangles = 41582;  ///< of the skin; the bones come on top
  bool trunk = false;             ///< the closed built-in body, on which opaque skin hides the bones; else the torso
  view::Shading shading = view::Shading::gouraud;
  view::StereoMode stereo = view::StereoMode::mono;
  int width = 1280;
  int height = 720;
  double skin_opacity = 1.0;
  bool labels = true;
  bool close = false;    ///< the camera stands near the finger, so that most of the skin is outside the picture
  bool cull = true;      ///< false: skin outside the picture is drawn too
  double seconds = 2.0;  ///< how long to repeat
};

/// Milliseconds a picture: mean over the finger's places, of each place's shortest time.
struct FrameFigures {
  std::size_t triangles = 0;       ///< of the skin
  std::size_t bone_triangles = 0;  ///< beneath it
  std::string renderer;            ///< what OpenGL says of itself
  double deform_ms = 0.0;
  double upload_ms = 0.0;
  double draw_ms = 0.0;  ///< until the last pixel is there, labels and stereo included
  double frameMs() const { return deform_ms + upload_ms + draw_ms; }
  double fps = 0.0;                ///< 1000 / frame_ms: each step waits for the one before
  double covered = 0.0;            ///< share of the window that the skin takes
  double uploaded_vertices = 0.0;  ///< a picture
  double first_frame_ms = 0.0;     ///< from nothing but the world to the first picture in memory
};

/// Throws Error where nothing can be drawn, and for counts the body cannot have.
FrameFigures measureFrames(const FrameRun& run);

}  // namespace palpate::app
