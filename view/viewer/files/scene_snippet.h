// What is seen and felt at this moment as the text of a scene file: for mails, notes, bug reports.
#pragma once

#include <string>

#include "view/viewer/state/session.h"

namespace palpate::viewer {

/// The scene with all changes, the look and the camera. Fingers that touch take the place of the scene's own, each with
/// a script that presses where it is as deep as it is now; what it felt stands in a comment.
std::string sceneSnippet(const Session& session);

}  // namespace palpate::viewer
