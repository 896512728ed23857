#include "palpate/classroom/row_sink.h"

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/classroom/class_store.h"
#include "palpate/training/records/store.h"

namespace palpate::classroom {

namespace {

using training::AnyRow;

constexpr std::string_view kDeleted = "deleted";  // in the file's audit

class FileSink : public RowSink {
 public:
  FileSink(const std::filesystem::path& file, const std::optional<training::ClassRow>& of)
      : store_(file, training::Store::Open::create_too) {
    store_.holdCopies();
    if (of) store_.keep(*of);
  }

  Kept keep(std::span<const AnyRow> rows) override {
    Kept kept;
    training::RowTables& tables = store_.rows();
    training::SqlTransaction transaction(tables.sql());
    for (const AnyRow& row : rows) {
      tables.sql().run("SAVEPOINT one");
      try {
        keepOne(tables, row);
        tables.sql().run("RELEASE SAVEPOINT one");
        kept.keys.push_back(training::outboxKey(row));
      } catch (const Error& error) {
        tables.sql().run("ROLLBACK TO SAVEPOINT one");
        ++kept.refused;
        kept.why = error.what();
      }
    }
    transaction.commit();
    return kept;
  }

 private:
  static void keepOne(training::RowTables& tables, const AnyRow& row) {
    if (const auto* deletion = std::get_if<training::DeletionRow>(&row)) return obey(tables, *deletion);
    if (!isOfDeleted(tables, row)) tables.keep(row, training::RowTables::Update::when_newer);
  }
  /// Who was made before the deletion; what belongs to them is refused for want of them.
  static bool isOfDeleted(training::RowTables& tables, const AnyRow& row) {
    const auto gone = [&tables](const training::Uuid& id, std::int64_t made_ms) {
      const auto at = tables.noted(kDeleted, training::deletedMark(id));
      return at && made_ms <= *at;
    };
    if (const auto* trainee = std::get_if<training::TraineeRow>(&row)) return gone(trainee->id, trainee->created_ms);
    if (const auto* sitting = std::get_if<training::SittingRow>(&row)) return gone(sitting->trainee, sitting->start_ms);
    return false;
  }
  static void obey(training::RowTables& tables, const training::DeletionRow& deletion) {
    for (const training::TraineeRow& trainee : tables.trainees()) {
      const bool meant = training::deletedMark(trainee.id) == deletion.trainee_sha256;
      if (meant && trainee.created_ms <= deletion.at_ms) tables.erase(trainee.id);
    }
    tables.note(deletion.at_ms, "station", kDeleted, deletion.trainee_sha256);
  }

  training::Store store_;
};

class DatabaseSink : public RowSink {
 public:
  DatabaseSink(std::string connection, const std::optional<training::ClassRow>& of)
      : connection_(std::move(connection)), class_(of) {}

  Kept keep(std::span<const AnyRow> rows) override {
    if (!store_) {
      store_.emplace(connection_);
    } else if (!store_->connected()) {
      store_->reconnect();
    }
    if (class_) store_->rows().keep(*class_);
    class_.reset();
    ClassStore::Kept kept = store_->keep(rows);
    return {std::move(kept.keys), kept.refused.size(), kept.refused.empty() ? std::string() : kept.refused.back().why};
  }

 private:
  std::string connection_;
  std::optional<training::ClassRow> class_;  // until it is kept
  std::optional<ClassStore> store_;
};

}  // namespace

std::unique_ptr<RowSink> fileSink(const std::filesystem::path& file, const std::optional<training::ClassRow>& of) {
  return std::make_unique<FileSink>(file, of);
}
std::unique_ptr<RowSink> databaseSink(const std::string& connection, const std::optional<training::ClassRow>& of) {
  return std::make_unique<DatabaseSink>(connection, of);
}

}  // namespace palpate::classroom
