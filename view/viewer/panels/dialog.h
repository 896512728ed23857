// A dialog in the middle of the window, which owns mouse and keyboard until it is closed: by its buttons, Enter or Esc.
#pragma once

namespace palpate::viewer {

/// `open` is where its caller keeps whether it is wanted. Call endDialog if it returns true.
bool beginDialog(const char* title, bool& open);
void endDialog(bool& open);

/// In this frame, also on the keypad.
bool enterPressed();

}  // namespace palpate::viewer
