// A class's PostgreSQL behind the seam of training/records/sql.h. Only this room includes libpq.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/training/records/sql.h"

struct pg_conn;
struct pg_result;

namespace palpate::classroom {

using training::DatabaseAway;

/// Throws Error for an address that has a password in it, which the list of processes would show. libpq finds passwords
/// in ~/.pgpass, in a service file, or in PGPASSWORD.
void refusePassword(const std::string& connection);

/// Converts a server's text for a value of this type (an OID of its catalogue). Throws Error if it does not fit the
/// type.
training::SqlValue postgresValue(unsigned type, std::string_view text);

/// A connection; one thread. It is not made again automatically: `connect` does that, and forgets nothing but the
/// transaction that was under way.
class PostgresSql : public training::Sql {
 public:
  /// `connection` in libpq's form: "host=/run/postgresql dbname=class", "postgresql://...". Does not connect yet.
  /// Throws Error for one with a password (refusePassword).
  explicit PostgresSql(std::string connection);

  void connect();  ///< throws DatabaseAway
  /// Warnings of the server since the last call, one line each; the newest hundred.
  std::vector<std::string> drainWarnings();
  bool connected() const;

  training::Dialect dialect() const override { return training::Dialect::postgresql; }
  // Throw Error for refusals of the server, DatabaseAway if it cannot be reached.
  void run(const std::string& statements) override;
  std::vector<training::SqlValues> ask(std::string_view sql, const training::SqlValues& values = {}) override;
  std::int64_t change(std::string_view sql, const training::SqlValues& values = {}) override;

 private:
  struct Finish {
    void operator()(pg_conn* connection) const;
  };
  struct Clear {
    void operator()(pg_result* result) const;
  };
  using Result = std::unique_ptr<pg_result, Clear>;

  Result checked(pg_result* result);
  Result executed(std::string_view sql, const training::SqlValues& values);
  const std::string& prepared(std::string_view sql);

  std::string settings_;
  std::vector<std::string> warnings_;
  std::unique_ptr<pg_conn, Finish> connection_;
  std::map<std::string, std::string, std::less<>> names_;  // names of statements that the server has prepared
};

}  // namespace palpate::classroom
