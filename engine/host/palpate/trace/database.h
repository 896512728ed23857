// SQLite as this project uses it: a file, statements that are prepared once, errors that name the file.
//
// Every file is opened as a stranger's: what its schema may bring along is switched off (views, triggers, functions of
// ours), its sizes are limited, and a statement that takes more steps than a file of its size can need is ended. Which
// tables it may have is known_schema.h's.
//
// All access to a recording file goes through here; no other source includes sqlite3.h.
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace palpate::trace {

class Database;

/// A prepared statement; belongs to the thread of its database, which must outlive it.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);

  // Values for the ?1, ?2, ... of the text, in their order. Each throws Error.
  Statement& with(std::int64_t value);
  Statement& with(double value);
  Statement& with(std::string_view text);
  Statement& withBlob(std::string_view bytes);
  Statement& withNull();

  /// True while there is a row; afterwards the statement may be used again with new values. Throws Error.
  bool next();
  /// For what gives no rows.
  void run();

  // Columns of the row at hand, from 0. Texts and blobs are valid until the next row.
  enum class Kind : std::uint8_t { nothing, integer, real, text, blob };
  int columns() const;
  Kind kind(int column) const;
  bool isNull(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string_view text(int column) const;
  std::string_view blob(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int bound_ = 0;
  bool runs_ = false;  ///< between its first row and its end
};

/// While one lives, a long statement that reads on this thread calls it every few milliseconds; what it throws ends the
/// statement and comes out of it. For Ctrl+C. Statements of files that are written are not ended so.
class ReadingWatch {
 public:
  explicit ReadingWatch(std::function<void()> check);
  ~ReadingWatch();
  ReadingWatch(const ReadingWatch&) = delete;
  ReadingWatch& operator=(const ReadingWatch&) = delete;

  void check() const { check_(); }

 private:
  std::function<void()> check_;
  const ReadingWatch* before_;
};

/// An open file. One thread at a time.
class Database {
 public:
  enum class Mode { read, write, create };

  /// `create` throws for a file that exists, and makes one for its owner alone (mode 0600, which SQLite gives to what
  /// it puts beside the file). Throws Error with the file's name, or what it is called instead, and SQLite's or the
  /// system's words.
  Database(const std::filesystem::path& file, Mode mode, const std::filesystem::path& called = {});

  /// Statements without values, separated by semicolons. Throws Error.
  void run(const std::string& sql);
  /// The first column of the first row. Throws Error, also where there is none.
  std::int64_t integer(std::string_view sql);
  /// Rows that the last statement inserted, changed or deleted.
  std::int64_t changes() const;
  /// All of it into `file`, which is empty or not there. Throws Error.
  void copyInto(const std::filesystem::path& file);

  /// A statement that finds another program writing waits for it so long, and then throws Error. 5 s unless set.
  void setMaxWait(std::chrono::milliseconds wait);

  const std::string& name() const { return name_; }
  [[noreturn]] void fail(std::string_view what) const;

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* database) const;
  };
  /// Limits the cost of a statement, and keeps the exception that ended one.
  struct Guard {
    std::filesystem::path file;  ///< empty: in memory
    bool reads = false;
    std::int64_t steps = 0;  ///< of the statement that was begun last
    std::exception_ptr ended_by = {};
  };
  void harden() const;
  static int onProgress(void* guard) noexcept;
  void rethrowCause() const;

  std::string name_;
  std::unique_ptr<Guard> guard_;  ///< outlives the database, which calls it
  std::unique_ptr<sqlite3, Close> database_;
};

/// All or nothing: without `commit` its end undoes what was written since.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace palpate::trace
