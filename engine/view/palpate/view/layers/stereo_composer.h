// Combines the two eyes' pictures: side by side, one above the other, red-cyan, or row by row.
//
// Each eye is drawn whole into a target of its own, then one pass combines them. Anaglyphs are mixed in linear light,
// clamped and encoded again; mixing the encoded values would make ghosts brighter.
// Based on: Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001, with the matrices published
// for LCD screens in 2009; Rec. 709 luma.
#pragma once

#include <memory>

#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/offscreen.h"
#include "palpate/view/stereo.h"

namespace palpate::view {

/// Needs a current context; belongs to its thread.
class StereoComposer {
 public:
  StereoComposer();

  /// The target of one eye, in this size; made again only when the size changes.
  const Target& eye(Eye eye, const EyePicture& picture);

  /// Combines the eyes in `framebuffer` (0 = the window's). A row of an interlaced picture is `row_height` pixels high:
  /// the supersampling, so that each eye keeps its own rows in the reduced picture.
  void compose(const StereoSettings& settings, GLuint framebuffer, int width, int height, int row_height = 1) const;

 private:
  void copy(const StereoSettings& settings, GLuint framebuffer, int width, int height) const;
  void mix(const StereoSettings& settings, GLuint framebuffer, int width, int height, int row_height) const;

  std::unique_ptr<Target> left_, right_;
  Program mixer_;
  GlVertexArray nothing_;  ///< the mixing triangle consists of vertex numbers
};

}  // namespace palpate::view
