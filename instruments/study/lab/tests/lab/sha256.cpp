// By the system's own program, which shares nothing with ours.
#include "lab/tests/lab/sha256.h"

#include "palpate/base/text.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate::test {

std::string sha256(std::string_view bytes) {
  const support::TemporaryFolder folder;
  writeFile(folder.path() / "bytes", bytes);
  return support::runProgram("/usr/bin/sha256sum", "bytes", folder.path()).out.substr(0, 64);
}

}  // namespace palpate::test
