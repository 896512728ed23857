// How pictures of a scene look unless the user says otherwise: where from, in which light, which colours, one eye or
// two. Words are those of the rooms that draw; palpate/view/scene_view.h turns these settings into theirs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::scene {

struct ViewSettings {
  std::string side = "back";
  double yaw_deg = 0.0;    ///< turned from that side; positive sees more of the patient's right
  double pitch_deg = 0.0;  ///< positive looks from above
  double zoom = 1.0;       ///< 1 shows the whole body
  std::optional<Vec3> look_at_mm;

  std::string shading = "skin";
  std::string colours = "plain";
  std::vector<std::string> show;  ///< overlays
  double opacity = 1.0;           ///< of the skin
  std::string finger = "sphere";
  bool white_background = false;
  bool texture = true;  ///< of the body, where it has one
  bool detail = true;   ///< pores

  std::string stereo = "mono";
  double eye_distance_mm = 63.0;
  double convergence_mm = 0.0;
  bool swap_eyes = false;
  std::optional<Vec3> head_mm;  ///< between the eyes, in the frame of the screen
  double screen_height_mm = 300.0;
};

}  // namespace palpate::scene
