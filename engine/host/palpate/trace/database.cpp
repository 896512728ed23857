// Over SQLite's C interface. What is switched off and limited follows "Defense Against The Dark Arts"
// (sqlite.org/security.html); no limit is near what this project's own statements and files need.
#include "palpate/trace/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"

namespace palpate::trace {

namespace {

/// A recording loses nothing on a disk that stands still for 2 s; less than twice that would end it on a machine that
/// is busy as well.
constexpr std::chrono::milliseconds kMaxWait{5000};

constexpr const char* kInMemory = ":memory:";

// Steps of SQLite's machine, some ten million a second at least. Reading every row of a file, checking it and copying
// it takes less than one for each of its bytes.
constexpr int kStepsBetweenChecks = 10'000;
constexpr std::int64_t kFreeSteps = 10'000'000;
constexpr std::int64_t kStepsPerByte = 4;

struct SizeLimit {
  int which;
  int most;
};
constexpr std::array<SizeLimit, 8> kSizeLimits = {{{SQLITE_LIMIT_SQL_LENGTH, 100'000},
                                                   {SQLITE_LIMIT_COLUMN, 100},
                                                   {SQLITE_LIMIT_EXPR_DEPTH, 100},
                                                   {SQLITE_LIMIT_COMPOUND_SELECT, 10},
                                                   {SQLITE_LIMIT_VDBE_OP, 50'000},
                                                   {SQLITE_LIMIT_FUNCTION_ARG, 20},
                                                   {SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 1000},
                                                   {SQLITE_LIMIT_WORKER_THREADS, 0}}};

struct Switch {
  int which;
  int on;
};
constexpr std::array<Switch, 6> kSwitches = {{{SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                              {SQLITE_DBCONFIG_DEFENSIVE, 1},
                                              {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                              {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                              {SQLITE_DBCONFIG_DQS_DDL, 0},
                                              {SQLITE_DBCONFIG_DQS_DML, 0}}};

thread_local const ReadingWatch* reading_watch = nullptr;

int openFlags(Database::Mode mode) {
  switch (mode) {
    case Database::Mode::read:
      return SQLITE_OPEN_READONLY;
    case Database::Mode::write:
      return SQLITE_OPEN_READWRITE;
    case Database::Mode::create:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  }
  return SQLITE_OPEN_READONLY;
}

/// Why the last call failed: the system's words where it was the system, as OutputFile has them.
std::string wordsFor(sqlite3* database) {
  if (database == nullptr) return "out of memory";
  const int code = ::sqlite3_errcode(database) & 0xff;  // without what it extends
  if (code == SQLITE_CORRUPT) return "is damaged; `palpate body repair` recovers what is left of a recording";
  if (code == SQLITE_NOTADB) return "is not a recording file";
  if (code == SQLITE_INTERRUPT) return "takes longer to read than a file of its size should; reading was stopped";
  const int told = ::sqlite3_system_errno(database);  // 0 where it has been forgotten on the way here
  const int reason = code == SQLITE_FULL ? ENOSPC : told != 0 ? told : errno;
  const bool of_the_system = code == SQLITE_FULL || code == SQLITE_IOERR || code == SQLITE_CANTOPEN;
  if (!of_the_system || reason == 0) return ::sqlite3_errmsg(database);
  return "cannot be written: " + std::generic_category().message(reason);
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { ::sqlite3_finalize(statement); }

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  sqlite3_stmt* statement = nullptr;
  const int result =
      ::sqlite3_prepare_v2(database.database_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
  statement_.reset(statement);
  if (result == SQLITE_OK) return;
  database.rethrowCause();
  database.fail("cannot be asked");
}

Statement& Statement::with(std::int64_t value) {
  if (::sqlite3_bind_int64(statement_.get(), ++bound_, value) != SQLITE_OK) database_.fail("takes no number");
  return *this;
}

Statement& Statement::with(double value) {
  if (::sqlite3_bind_double(statement_.get(), ++bound_, value) != SQLITE_OK) database_.fail("takes no number");
  return *this;
}

Statement& Statement::with(std::string_view text) {
  if (::sqlite3_bind_text64(statement_.get(), ++bound_, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8) !=
      SQLITE_OK) {
    database_.fail("takes no text");
  }
  return *this;
}

Statement& Statement::withBlob(std::string_view bytes) {
  if (::sqlite3_bind_blob64(statement_.get(), ++bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT) != SQLITE_OK) {
    database_.fail("takes no bytes");
  }
  return *this;
}

Statement& Statement::withNull() {
  if (::sqlite3_bind_null(statement_.get(), ++bound_) != SQLITE_OK) database_.fail("takes nothing");
  return *this;
}

bool Statement::next() {
  if (!std::exchange(runs_, true)) database_.guard_->steps = 0;
  const int result = ::sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  runs_ = false;
  const std::string words = wordsFor(database_.database_.get());
  ::sqlite3_reset(statement_.get());
  ::sqlite3_clear_bindings(statement_.get());
  bound_ = 0;
  if (result == SQLITE_DONE) return false;
  database_.rethrowCause();
  throw Error::inFile(database_.name(), words);
}

void Statement::run() {
  while (next()) {
  }
}

int Statement::columns() const { return ::sqlite3_column_count(statement_.get()); }

Statement::Kind Statement::kind(int column) const {
  switch (::sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_INTEGER:
      return Kind::integer;
    case SQLITE_FLOAT:
      return Kind::real;
    case SQLITE_TEXT:
      return Kind::text;
    case SQLITE_BLOB:
      return Kind::blob;
    default:
      return Kind::nothing;
  }
}

bool Statement::isNull(int column) const { return ::sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
std::int64_t Statement::integer(int column) const { return ::sqlite3_column_int64(statement_.get(), column); }
double Statement::real(int column) const { return ::sqlite3_column_double(statement_.get(), column); }

std::string_view Statement::text(int column) const {
  const auto* text = ::sqlite3_column_text(statement_.get(), column);
  if (text == nullptr) return {};
  return {reinterpret_cast<const char*>(text),
          static_cast<std::size_t>(::sqlite3_column_bytes(statement_.get(), column))};
}

std::string_view Statement::blob(int column) const {
  const void* bytes = ::sqlite3_column_blob(statement_.get(), column);
  if (bytes == nullptr) return {};
  return {static_cast<const char*>(bytes), static_cast<std::size_t>(::sqlite3_column_bytes(statement_.get(), column))};
}

void Database::Close::operator()(sqlite3* database) const { ::sqlite3_close(database); }

ReadingWatch::ReadingWatch(std::function<void()> check)
    : check_(std::move(check)), before_(std::exchange(reading_watch, this)) {}
ReadingWatch::~ReadingWatch() { reading_watch = before_; }

Database::Database(const std::filesystem::path& file, Mode mode, const std::filesystem::path& called)
    : name_((called.empty() ? file : called).string()), guard_(std::make_unique<Guard>()) {
  const bool in_memory = file == kInMemory;
  if (!in_memory) guard_->file = file;
  guard_->reads = mode == Mode::read;
  std::error_code error;
  const auto kind = std::filesystem::status(file, error);
  const bool exists = std::filesystem::exists(kind);
  if (mode == Mode::create && exists) throw Error::inFile(name_, "already exists");
  if (mode != Mode::create && !exists) throw Error::inFile(name_, "no such file");
  if (std::filesystem::is_directory(kind)) throw Error::inFile(name_, "is a folder");
  if (exists && !std::filesystem::is_regular_file(kind)) throw Error::inFile(name_, "is not a file");
  if (mode == Mode::create && !in_memory) createPrivateFile(file);
  sqlite3* database = nullptr;
  const int result = ::sqlite3_open_v2(file.string().c_str(), &database,
                                       openFlags(mode) | SQLITE_OPEN_EXRESCODE | SQLITE_OPEN_NOFOLLOW, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK) fail("cannot be opened");
  setMaxWait(kMaxWait);
  harden();
}

void Database::setMaxWait(std::chrono::milliseconds wait) {
  ::sqlite3_busy_timeout(database_.get(), static_cast<int>(wait.count()));
}

void Database::harden() const {
  for (const Switch& one : kSwitches) ::sqlite3_db_config(database_.get(), one.which, one.on, nullptr);
  for (const SizeLimit& limit : kSizeLimits) ::sqlite3_limit(database_.get(), limit.which, limit.most);
  // VACUUM attaches the copy that it makes.
  ::sqlite3_limit(database_.get(), SQLITE_LIMIT_ATTACHED, guard_->reads ? 0 : 1);
  ::sqlite3_progress_handler(database_.get(), kStepsBetweenChecks, &Database::onProgress, guard_.get());
}

/// Called by SQLite, through which nothing may be thrown. Anything but 0 ends the statement.
int Database::onProgress(void* of_database) noexcept {
  Guard& guard = *static_cast<Guard*>(of_database);
  guard.steps += kStepsBetweenChecks;
  if (guard.reads && reading_watch != nullptr) {
    try {
      reading_watch->check();
    } catch (...) {
      guard.ended_by = std::current_exception();
      return 1;
    }
  }
  if (guard.steps <= kFreeSteps || guard.file.empty()) return 0;
  std::error_code error;
  std::int64_t bytes = 0;
  for (const char* companion : {"", "-wal"}) {
    const auto size = std::filesystem::file_size(withEnding(guard.file, companion), error);
    if (!error) bytes += static_cast<std::int64_t>(size);
  }
  return guard.steps > kFreeSteps + kStepsPerByte * bytes ? 1 : 0;
}

void Database::rethrowCause() const {
  if (const std::exception_ptr cause = std::exchange(guard_->ended_by, nullptr)) std::rethrow_exception(cause);
}

void Database::run(const std::string& sql) {
  guard_->steps = 0;
  if (::sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return;
  rethrowCause();
  fail({});
}

void Database::copyInto(const std::filesystem::path& file) {
  ::sqlite3_limit(database_.get(), SQLITE_LIMIT_ATTACHED, 1);
  Statement(*this, "VACUUM INTO ?1").with(file.string()).run();
}

std::int64_t Database::integer(std::string_view sql) {
  Statement statement(*this, sql);
  if (!statement.next()) fail("has no answer");
  return statement.integer(0);
}

std::int64_t Database::changes() const { return ::sqlite3_changes64(database_.get()); }

void Database::fail(std::string_view what) const {
  const std::string words = wordsFor(database_.get());
  throw Error::inFile(name_, what.empty() ? words : fmt::format("{}: {}", what, words));
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const Error&) {  // SQLite has undone it by itself, after a full disk
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

}  // namespace palpate::trace
