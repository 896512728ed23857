// The scene as a file: the written part of the viewer's state, and its form.
//
//   viewer state ─ sceneToSave ─► Scene ─ the changed lines (scene/scene_writer.h) ─► file
#pragma once

#include <filesystem>
#include <string>

#include "palpate/scene/scene.h"
#include "palpate/view/look.h"
#include "palpate/view/stereo.h"

namespace palpate::viewer {

struct BodyView;

/// The scene's file, and its text when it was last read or written here.
struct SceneDocument {
  std::filesystem::path file = {};  ///< absolute; empty: none yet
  std::string text = {};
  std::string title = {};  ///< for a preset, which has no file: "Virtual Haptic Back"; tr() shows it
};
/// The document of a scene file; empty for a missing or unreadable one.
SceneDocument loadDocument(const std::filesystem::path& file);

/// Whether there is a file at `target` that this document has neither read nor written.
bool wouldOverwrite(const SceneDocument& document, const std::filesystem::path& target);

/// The look when the scene was opened or saved: differences are saved.
struct OpenedLook {
  view::Look look = {};
  view::StereoSettings stereo = {};
  bool camera_moved = false;  ///< whether the user moved it
};

/// The scene with the changes of its look ([view]); with the camera, too, if the user has moved it.
scene::Scene sceneToSave(const scene::Scene& edited, const BodyView& seen);
/// The same without the camera: turning the body does not change the scene.
scene::Scene sceneAsChanged(const scene::Scene& edited, const BodyView& seen);
/// Stores the camera in [view], in hundredths of a degree and tenths of a millimetre.
void storeCamera(const BodyView& seen, scene::ViewSettings& view);

struct SceneWriting {
  SceneDocument document;      ///< the document from now on
  bool as_it_was = false;      ///< the file is up to date: nothing was written
  std::filesystem::path kept;  ///< the old text, where it could not be kept in the file itself
};
/// Writes the scene into the document's text. Throws Error naming the file.
SceneWriting writeScene(const scene::Scene& scene, const SceneDocument& document, const std::filesystem::path& target);

}  // namespace palpate::viewer
