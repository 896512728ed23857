// The record of a station: an SQLite file that holds every trainee, session, block and trial, and the outbox of rows
// that a class has not acknowledged yet. Rows are on the disk once `save` returns.
//
//   Session::drainRows ─ save ─► NAME.results ─► reports, exports, outbox ─► class
//
// STRICT tables, WAL, synchronous FULL, foreign keys. One thread at a time; any number of processes.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/training/records/row_tables.h"
#include "palpate/training/records/rows.h"

namespace palpate::training {

/// A row in the form for the wire, and its number in the queue.
struct OutboxEntry {
  std::int64_t number = 0;
  std::string kind;  ///< the table: "session", "block", "trial", "event", ...; "delete"
  Uuid row;          ///< outboxKey (row_json.h), which acknowledgements name: a newer state of a block has another
  std::string body;  ///< JSON (row_json.h)
};

class Store {
 public:
  enum class Open { existing, create_too, read_only };
  /// Migrates an older schema, inside one transaction. Throws Error if `file` is not a records file or has a newer
  /// schema. `max_wait`: what is read or written waits so long where another program holds the file, and then throws
  /// Error; 5 s unless given.
  Store(const std::filesystem::path& file, Open how, std::optional<std::chrono::milliseconds> max_wait = {});
  /// Empty, gone with the object, for copies of what another database holds; messages call it so.
  static Store inMemory(const std::string& called);
  ~Store();
  Store(Store&&) noexcept;

  // Each is one transaction, durable on return. Existing rows are updated (by id). Throws Error.
  void save(const StationRow& row);
  void save(const ClassRow& row);
  void save(const TraineeRow& row);
  void save(const ProtocolRow& row);
  void save(std::span<const Row> rows);
  void storeAnyRows(std::span<const AnyRow> rows);

  // Reading; in the order of their times.
  std::vector<StationRow> stations();
  std::vector<ClassRow> classes();
  std::vector<TraineeRow> trainees();
  std::optional<TraineeRow> trainee(const Uuid& id);
  std::vector<ProtocolRow> protocols();
  std::vector<SessionRow> sessions(const Uuid& trainee = {});  ///< empty: of all
  std::vector<BlockRow> blocks(const Uuid& session);
  std::vector<TrialRow> trials(const Uuid& block);  ///< with their visits
  std::vector<EventRow> events(const Uuid& session);

  /// The newest block of this kind that was interrupted, with its session; nothing: none.
  using Interrupted = InterruptedBlock;
  std::optional<Interrupted> interrupted(const Uuid& trainee, SessionKind kind);
  /// The newest finished block that measured a threshold (tests, examination, retention).
  std::optional<BlockRow> lastMeasured(const Uuid& trainee);

  // The outbox: filled by `save` once a class is joined. A row that waits is replaced in its place by a newer version.
  /// Remembered in the file. When it is switched on, whatever is there already goes into it.
  void fillOutbox(bool on);
  bool fillsOutbox() const;
  /// Inside the caller's transaction (deletion.h).
  void queueDeletion(const DeletionRow& notice);
  std::vector<OutboxEntry> waiting(std::size_t most);  ///< oldest first; without those that were refused
  void acknowledged(std::span<const Uuid> rows);       ///< away with them, durable
  std::size_t waitingCount();                          ///< with those that were refused
  /// A class would not have these rows: they stay, and are not among `waiting` until they must be tried again.
  void refused(std::span<const Uuid> rows, std::string_view why);
  std::size_t refusedCount();
  void tryRefusedAgain();
  /// Handles deletions of trainees in the class, for every station: queues this station's receipt after the waiting
  /// rows and before later ones.
  void applyDeletionNotice(std::span<const std::string> marks);

  /// The secret of a class whose trainees sit here (trainee_code.h), remembered in the file, so that codes can be
  /// found.
  void rememberTraineeKey(const std::string& class_id, const std::string& key);
  /// Every pseudonym that a code may have here: per class, with its secret and, as older ones are, without.
  std::vector<Uuid> derivePseudonyms(std::string_view code);

  /// Remembered in the file: rows of other computers, of a class; the recordings that they name lie there.
  void holdCopies();
  bool holdsCopies() const;

  /// For what reads the records of a station and of a class alike, and for `deletion.h`.
  RowTables& rows();

  const std::filesystem::path& file() const;  ///< its name, where it is in memory
  std::filesystem::path folder() const;       ///< the file's folder: recordings are in it

 private:
  struct Impl;
  explicit Store(std::unique_ptr<Impl> tables);
  std::unique_ptr<Impl> impl_;
};

// The default place of the records.

/// $XDG_DATA_HOME/palpate/palpate.results, or ~/.local/share/palpate/palpate.results. Throws Error without a home.
std::filesystem::path defaultRecords();

}  // namespace palpate::training
