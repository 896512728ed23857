// Any bytes as the answers of a PostgreSQL that is not to be trusted: values as text, of any type, any number of
// columns and rows. Reading records from it gives rows or one Error in one line.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/classroom/postgres_sql.h"
#include "palpate/training/records/row_tables.h"
#include "palpate/training/records/schema.h"
#include "palpate/training/records/store.h"

namespace {

using namespace palpate;
using training::SqlValues;

/// Answers with what is left of the input.
class HostileSql : public training::Sql {
 public:
  explicit HostileSql(std::string_view bytes) : bytes_(bytes) {}
  training::Dialect dialect() const override { return training::Dialect::postgresql; }
  void run(const std::string& /*statements*/) override {}
  std::int64_t change(std::string_view /*sql*/, const SqlValues& /*values*/) override { return byte(); }
  std::vector<SqlValues> ask(std::string_view /*sql*/, const SqlValues& /*values*/) override {
    std::vector<SqlValues> rows(byte() % 4);
    const std::size_t columns = byte() % 24;
    for (SqlValues& row : rows) {
      for (std::size_t i = 0; i < columns; ++i) row.push_back(value());
    }
    return rows;
  }

 private:
  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const auto first = static_cast<std::uint8_t>(bytes_.front());
    bytes_.remove_prefix(1);
    return first;
  }
  training::SqlValue value() {
    constexpr std::array<unsigned, 8> kTypes = {0, 16, 20, 21, 23, 25, 701, 2950};
    const unsigned type = kTypes[byte() % kTypes.size()];
    if (type == 0) return std::monostate{};
    const std::size_t length = byte() % 48;
    const std::string_view text = bytes_.substr(0, length);
    bytes_.remove_prefix(std::min(bytes_.size(), text.size()));
    return classroom::postgresValue(type, text);
  }
  std::string_view bytes_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto reads = [&](const auto& what) {
    HostileSql sql(bytes);
    try {
      what(sql);
    } catch (const Error& error) {
      if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
  };
  reads([](HostileSql& sql) { training::readSchemaVersion(sql); });
  reads([](HostileSql& sql) {
    // As copyOfDatabase does: what was read is checked before it is kept.
    training::Store::inMemory("fuzz").storeAnyRows(training::RowTables(sql).all());
  });
  return 0;
}
