// The scene as a file: what of the viewer's state is written, and into which words.
//
//   session ─ sceneToSave ─► Scene ─ the lines of what changed (scene/scene_writer.h) ─► file
#pragma once

#include <filesystem>
#include <string>

#include "palpate/scene/scene.h"
#include "palpate/view/look.h"
#include "palpate/view/stereo.h"

namespace palpate::viewer {

struct ViewerState;

/// Where the scene is kept, and what stood there when it was last read or written here.
struct SceneDocument {
  std::filesystem::path file = {};  ///< absolute; empty: none yet
  std::string text = {};
  std::string title = {};  ///< of a preset, which has no file: "Virtual Haptic Back"; tr() shows it
};
/// Of a scene file; of none, or one that cannot be read, an empty one.
SceneDocument documentOf(const std::filesystem::path& file);

/// There is something at `target` that this document has neither read nor written.
bool wouldOverwrite(const SceneDocument& document, const std::filesystem::path& target);

/// How it was looked at when the scene was opened or saved: what differs from it is saved.
struct OpenedLook {
  view::Look look = {};
  view::StereoSettings stereo = {};
  bool camera_moved = false;  ///< by the user
};

/// The scene with what was changed of its look ([view]); with the camera, too, if the user has moved it.
scene::Scene sceneToSave(const ViewerState& viewer);
/// The same without the camera: turning the body is looking, not changing.
scene::Scene sceneAsChanged(const ViewerState& viewer);
/// The camera as [view] says it, in hundredths of a degree and tenths of a millimetre.
void keepCamera(const ViewerState& viewer, scene::ViewSettings& view);

struct SceneWriting {
  SceneDocument document;      ///< as it is from now on
  bool as_it_was = false;      ///< it said all that already: nothing was written
  std::filesystem::path kept;  ///< the old words, where they could not be kept in the file itself
};
/// Writes it into the words of the document. Throws Error naming the file.
SceneWriting writeScene(const scene::Scene& scene, const SceneDocument& document, const std::filesystem::path& target);

}  // namespace palpate::viewer
