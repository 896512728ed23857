// Walks through the text of a mesh file word by word and knows the line it is in.
//
// Shared by the readers of OBJ, PLY, OFF and text STL, so that all of them open a file the same way (a byte order mark,
// lines that end in LF, CR LF or CR, words in capitals) and report the place of a mistake the same way.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "palpate/base/progress.h"

namespace palpate::mesh {

/// A format's rules besides words and lines.
struct TextRules {
  char comment = '\0';     ///< starts a comment that ends with the line, at the begin of a word; '\0': none
  bool continues = false;  ///< a backslash at the end of a line, glued to a word or not: the next line continues it
};

class TextReader {
 public:
  /// `name` is the file in messages. Text, name and progress must outlive the reader, which is why none has a default:
  /// it would be gone at the end of the statement. Starts on line 1, behind a byte order mark. Throws Error for UTF-16.
  TextReader(std::string_view text, std::string_view name, const Progress& progress, TextRules rules = {});

  /// The next word of this line; empty at its end or where a comment begins.
  std::string_view word();
  /// The next word of this line, even where a comment would begin: a name.
  std::string_view nameWord();
  /// The next word in this line or a later one; empty at the end of the text.
  std::string_view wordAnywhere();
  /// The rest of this line of the file, comments and all.
  std::string_view restOfLine() const;
  /// Goes to the start of the next line; false when there is none.
  bool nextLine();
  /// Goes to the next line with a word; false when there is none.
  bool nextFilledLine();

  /// A number from a word; `what` names it in the message. Windows' older spellings of "not a number" (-1.#IND,
  /// 1.#QNAN, 1.#INF) are refused, too.
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
  std::string_view wordUpTo(char comment);
  /// The position after the line end that a backslash at `at` joins; 0: none.
  std::size_t behindContinuation(std::size_t at) const;
  std::size_t behindLineEnd(std::size_t at) const;
  void reportProgress();

  std::string_view text_;
  std::string_view name_;
  const Progress& progress_;
  TextRules rules_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  std::size_t next_report_ = 0;
};

/// The word's number, or one that is not finite: for values that are not used.
double numberOrNone(std::string_view word);

/// Whether the word is the keyword (in small letters), in either case.
bool isWord(std::string_view word, std::string_view keyword);

/// A word of the file, fit for a message: short, and without bytes that a terminal would act on.
std::string shown(std::string_view word);

}  // namespace palpate::mesh
