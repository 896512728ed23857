// Data of the panels, besides the scene and the state that is kept between runs (view_state.h): plain data, one struct
// each. The viewer's state has one of every kind; a panel gets those that it shows.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/body/torso.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/servo/loop.h"
#include "palpate/tissue/profile_settings.h"
#include "palpate/window/head_tracker.h"

namespace palpate::scene {
struct World;
}

namespace palpate::viewer {

/// Measured rates; a frame's times in ms.
struct Performance {
  servo::LoopVitals servo;
  std::size_t dropped_samples = 0;
  double deform_ms = 0.0;
  double upload_ms = 0.0;
  double draw_ms = 0.0;
  double frame_ms = 0.0;
  double frames_per_s = 0.0;
  double picture_share = 1.0;  ///< pixels along each side of the body's picture (picture_scale.h)
  std::string graphics;        ///< name of the GL renderer
};

struct Recording {
  bool forces = false;
  std::string forces_file;
  double since_s = 0.0;
  bool sequence = false;
  std::string sequence_folder;
  std::size_t pictures = 0;
  bool film = false;
  double film_since_s = 0.0;

  // The automatic recording.
  bool viewer = false;         ///< it is running
  double length_s = 0.0;       ///< its length
  std::uint64_t dropped = 0;   ///< samples lost to a slow disk
  std::size_t marks = 0;       ///< set in this run
  bool keeping = false;        ///< a copy is being written
  std::string kept_file = {};  ///< the newest copy
};

/// The world's data for panels.
struct WorldFacts {
  std::string name;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  double width_mm = 0.0, height_mm = 0.0, depth_mm = 0.0;
  bool closed = false;
  bool has_bones = false;
  double softest_n_per_mm = 0.0, stiffest_n_per_mm = 0.0;
  std::vector<std::string> notes;
  bool has_picture = false;
  std::shared_ptr<const scene::SkinChannels> channels = nullptr;  ///< numbers and colours of its file, or null
  std::string tissue = {};                                        ///< and its force law, as text
  std::vector<body::SkinLandmark> landmarks = {};                 ///< its named places
};
WorldFacts collectWorldFacts(const scene::World& world);

/// The field for the name of a place to go to.
struct PlaceSearch {
  bool open = false;       ///< it owns the keyboard
  bool focused = false;    ///< and has received it
  bool over_list = false;  ///< the cursor is over the suggestions
  std::string typed = {};
};

/// The open part of the manual (panels/manual_dialog.cpp).
struct ManualShown {
  std::string page = "README.md";   ///< below docs/
  std::string heading = {};         ///< to scroll to, once
  std::vector<std::string> before;  ///< pages to go back to
  std::string searched = {};        ///< text; empty: a page is shown
  std::string outside = {};         ///< the target of a link out of the manual
};

/// A class that is run from this window.
struct ClassShown {
  bool offered = false;       ///< palpate-class is installed
  std::string folder = {};    ///< folder of the running or starting class; empty: none
  bool runs = false;          ///< broker and collector
  bool watched = false;       ///< the teacher's view is open
  bool opened_watch = false;  ///< once, by the class's start
  bool joined = false;        ///< the training of a station is open
  std::string words = {};     ///< the collector's status
  std::string trouble = {};   ///< why it does not run

  bool anything() const { return runs || watched || joined; }
};

/// The tracked head in this frame.
struct SeenHead {
  Vec3 eyes_mm = Vec3::Zero();
  window::HeadTracker::State state = window::HeadTracker::State::waiting;
};

/// The user's displacement profile while it is being drawn.
struct ProfileEdit {
  std::vector<tissue::ProfileKnot> knots;
  std::vector<tissue::ProfileKnot> drawn = {};  ///< last written to its file; empty: not in this run
  int handle = -1;                              ///< the one that is dragged
};

}  // namespace palpate::viewer
