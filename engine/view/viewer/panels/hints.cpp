#include "view/viewer/panels/hints.h"

#include <iterator>

#include "palpate/base/language.h"

namespace palpate::viewer {

namespace {

using Kind = window::Command::Kind;

struct Hint {
  std::string_view words;
  Kind asks_for;
};
constexpr Hint kHints[] = {
    {toTranslate("Hold the left button on the back to press it"), Kind::press},
    {toTranslate("Scroll while holding: deeper or lighter"), Kind::deepen},
    {toTranslate("Move while holding: pull the skin"), Kind::slide},
    {toTranslate("Drag beside the body, or with the right button: turn"), Kind::orbit},
    {toTranslate("F1: everything else"), Kind::act},
};

const Hint* hintNumber(int i) { return i >= 0 && i < static_cast<int>(std::size(kHints)) ? &kHints[i] : nullptr; }

}  // namespace

std::string_view hintText(int i) {
  const Hint* hint = hintNumber(i);
  return hint != nullptr ? hint->words : std::string_view();
}

void countHint(const window::Command& command, int& hint, bool& wanted) {
  const Hint* present = hintNumber(hint);
  const Kind done = command.kind == Kind::hold ? Kind::press : command.kind;  // a press by a key counts as well
  if (present == nullptr || done != present->asks_for) return;
  if (command.kind == Kind::act && command.action != window::Action::help) return;
  if (hintNumber(++hint) == nullptr) wanted = false;
}

}  // namespace palpate::viewer
