#include "palpate/classroom/collector.h"

#include "palpate/base/error.h"
#include "palpate/classroom/class_store.h"
#include "palpate/training/records/store.h"

namespace palpate::classroom {

namespace {

KeeperRules keeperRules(const SinkRules& rules) {
  return {rules.of ? rules.of->id : std::string(), rules.station_bytes};
}

class FileSink : public RowSink {
 public:
  FileSink(const std::filesystem::path& file, const SinkRules& rules)
      : store_(file, training::Store::Open::create_too), keeper_(store_.rows(), keeperRules(rules)) {
    store_.holdCopies();
    if (!rules.of) return;
    store_.save(*rules.of);
    store_.rememberTraineeKey(rules.of->id, rules.trainee_key);
  }

  KeptRows save(std::span<const SentRow> rows) override { return keeper_.save(rows); }

 private:
  training::Store store_;
  RowKeeper keeper_;
};

class DatabaseSink : public RowSink {
 public:
  DatabaseSink(std::string connection, const SinkRules& rules) : connection_(std::move(connection)), rules_(rules) {
    refusePassword(connection_);
  }

  KeptRows save(std::span<const SentRow> rows) override {
    if (!store_) {
      store_.emplace(connection_, keeperRules(rules_));
    } else if (!store_->connected()) {
      store_->reconnect();
    }
    if (rules_.of) store_->rows().save(*rules_.of);
    rules_.of.reset();
    return store_->save(rows);
  }
  std::string trouble() const override { return store_ ? store_->notErased() : std::string(); }

 private:
  std::string connection_;
  SinkRules rules_;  // its class until it is kept
  std::optional<ClassStore> store_;
};

}  // namespace

std::unique_ptr<RowSink> fileSink(const std::filesystem::path& file, const SinkRules& rules) {
  return std::make_unique<FileSink>(file, rules);
}
std::unique_ptr<RowSink> databaseSink(const std::string& connection, const SinkRules& rules) {
  return std::make_unique<DatabaseSink>(connection, rules);
}

}  // namespace palpate::classroom
