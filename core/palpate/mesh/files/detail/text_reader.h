// Walks through the text of a mesh file word by word and knows the line it is in.
//
// Shared by the readers of OBJ, PLY, OFF and text STL, so that all of them tell the place of a mistake the same way.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "palpate/base/progress.h"

namespace palpate::mesh {

class TextReader {
 public:
  /// `name` is the file in messages. Text, name and progress must outlive the reader, which is why none has a default:
  /// it would be gone at the end of the statement. Starts on line 1.
  TextReader(std::string_view text, std::string_view name, const Progress& progress);

  /// The next word of this line; empty at its end.
  std::string_view word();
  /// The next word in this line or a later one; empty at the end of the text.
  std::string_view wordAnywhere();
  /// What is left of this line.
  std::string_view restOfLine() const;
  /// To the start of the next line; false when there is none.
  bool nextLine();
  /// To the next line that holds a word and does not start with `comment`; false when there is none.
  bool nextFilledLine(char comment);

  /// A number out of a word; `what` names it in the message.
  double number(std::string_view word, std::string_view what) const;
  /// A whole number within [low, high] out of a word.
  long long whole(std::string_view word, std::string_view what, long long low, long long high) const;

  std::size_t line() const { return line_; }
  /// Offset of the next byte to read.
  std::size_t position() const { return position_; }
  /// Bytes of text not read yet: bounds what can still follow.
  std::size_t bytesLeft() const { return text_.size() - position_; }
  /// Throws Error at this line.
  [[noreturn]] void fail(std::string_view cause) const;

 private:
  void reportProgress();

  std::string_view text_;
  std::string_view name_;
  const Progress& progress_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  std::size_t next_report_ = 0;
};

/// A word of the file as a message may show it: short, and without bytes that a terminal would act on.
std::string shown(std::string_view word);

}  // namespace palpate::mesh
