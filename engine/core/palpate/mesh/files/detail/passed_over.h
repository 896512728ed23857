// A log of what a reader passed over in a file, reported once per kind: where first, and how often.
//
// Faults that do not change the surface never make a file fail, in any format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpate::mesh {

/// Unit of the places in a file.
enum class FilePlace : std::uint8_t { line, byte };

class PassedOver {
 public:
  /// `what` is one of a reader's few sentences, so a row costs a handful of comparisons. For a file with ever new ones
  /// (words of its own) kMaxKinds of them are reported.
  void add(std::string_view what, std::size_t place, FilePlace kind = FilePlace::line);

  /// Shape in the file that the mesh leaves out, by its name: points, lines, curved surfaces. At most kMaxKinds of a
  /// file's own names are reported.
  void leaveOut(std::string_view what, std::size_t count = 1);

  /// "left out: lines (3), points (1)"; empty for nothing.
  std::string leftOut() const;

  /// One a kind: "scan.ply:8: the row has more numbers than the header names; they are passed over (12 times)", and
  /// one of all that is left out.
  std::vector<std::string> sentences(std::string_view file) const;

  static constexpr std::size_t kMaxKinds = 12;

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
