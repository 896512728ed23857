#include "apps/palpate/written_mesh.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/palpate/named_mesh.h"
#include "palpate/base/error.h"
#include "palpate/mesh/save.h"

namespace palpate::app {

namespace {

int writeInChild(const std::string& name, const std::filesystem::path& file) {
  try {
    mesh::save(file, meshFrom(name));
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "palpate: {}\n", error.what());
    return 1;
  }
}

}  // namespace

WrittenMesh::WrittenMesh(const std::string& file_or_name) : file_(file_or_name) {
  if (isMeshFile(file_or_name)) return;
  file_ = std::filesystem::temp_directory_path() / fmt::format("palpate_{}_{}.stl", file_or_name, getpid());
  const pid_t child = fork();
  if (child == 0) _exit(writeInChild(file_or_name, file_));
  int status = 0;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child;
  written_ = true;
  if (ended && WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  throw Error(file_or_name + ": could not be made and written to a temporary file");
}

WrittenMesh::~WrittenMesh() {
  std::error_code ignored;
  if (written_) std::filesystem::remove(file_, ignored);
}

}  // namespace palpate::app
