#include "teach/window/training_screen.h"

#include <fmt/format.h>

namespace palpate::viewer {

std::vector<std::string> wordsOf(const TrainingScreen& screen) {
  std::vector<std::string> words = {screen.title, screen.progress, screen.notice, screen.keys, screen.corner};
  words.insert(words.end(), screen.lines.begin(), screen.lines.end());
  if (screen.entry) {
    words.push_back(screen.entry->label);
    words.push_back(screen.entry->text);
  }
  for (const TrainingButton& button : screen.buttons) {
    words.insert(words.end(), {button.label, button.line, button.badge});
  }
  for (const SiteMark& site : screen.sites) {
    words.push_back(fmt::format("{}", site.number));
    words.push_back(site.word);
  }
  std::erase(words, std::string());
  return words;
}

}  // namespace palpate::viewer
