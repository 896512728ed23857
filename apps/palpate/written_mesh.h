// A mesh file for a command that must start from one: the file itself, or a benchmark mesh written for the occasion.
#pragma once

#include <filesystem>
#include <string>

namespace palpate::app {

class WrittenMesh {
 public:
  /// For a name (see meshFrom) the mesh is made and written as binary STL into the folder for temporary files, by a
  /// child process: neither its time nor its memory are this process's. Throws Error.
  explicit WrittenMesh(const std::string& file_or_name);
  /// Removes what was written.
  ~WrittenMesh();
  WrittenMesh(const WrittenMesh&) = delete;
  WrittenMesh& operator=(const WrittenMesh&) = delete;

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  bool written_ = false;
};

}  // namespace palpate::app
