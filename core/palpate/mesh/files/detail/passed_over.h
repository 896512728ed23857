// What a reader passed over in a file, told once a kind: where first, and how often.
//
// A fault that takes nothing from the surface never decides about the file, in any format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpate::mesh {

/// How the places of a file are called.
enum class FilePlace : std::uint8_t { line, byte };

class PassedOver {
 public:
  /// `what` is one of a reader's few sentences, so a row costs a handful of comparisons. A file that brings ever new
  /// ones (words of its own) gets kMostKinds of them told.
  void add(std::string_view what, std::size_t place, FilePlace kind = FilePlace::line);

  /// What the file holds of its body and is no part of the mesh, by its name: points, lines, curved surfaces. Of a
  /// stranger's names kMostKinds are told.
  void leaveOut(std::string_view what, std::size_t count = 1);

  /// "left out: lines (3), points (1)"; empty for nothing.
  std::string leftOut() const;

  /// One a kind: "scan.ply:8: the row has more numbers than the header names; they are passed over (12 times)", and
  /// one of all that is left out.
  std::vector<std::string> sentences(std::string_view file) const;

  static constexpr std::size_t kMostKinds = 12;

 private:
  struct Kind {
    std::string what;
    std::size_t first;
    FilePlace place;
    std::size_t count = 1;
  };
  std::vector<Kind> kinds_;
  std::vector<std::pair<std::string, std::size_t>> left_out_;
};

}  // namespace palpate::mesh
