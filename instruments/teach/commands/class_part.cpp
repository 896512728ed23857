#include "teach/commands/class_part.h"

#include <optional>

#include "cli/kit/commands.h"
#include "cli/kit/families.h"
#include "cli/kit/options.h"

namespace palpate::app {

namespace {

std::optional<training::ClassPart>& installedClassPart() {
  static std::optional<training::ClassPart> part;
  return part;
}

}  // namespace

void installClassPart(const training::ClassPart& part) { installedClassPart() = part; }

const training::ClassPart& classPart() {
  if (!installedClassPart()) throw ExitWith(becomeFamily(*findFamilyCommand({"class"}), typedWords()));
  return *installedClassPart();
}

}  // namespace palpate::app
