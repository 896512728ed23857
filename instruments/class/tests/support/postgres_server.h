// A PostgreSQL 15 of the test's own: in a folder under /tmp, reached through a socket there and nowhere else, gone at
// the end. It refuses to run as root, so as root it runs as its own user.
#pragma once

#include <memory>
#include <string>

namespace palpate::support {

class PostgresServer {
 public:
  /// Null where it is not installed: say so and skip.
  static std::unique_ptr<PostgresServer> started();
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  /// For libpq, to a database of this name, which is made.
  std::string connection(const std::string& database);
  const std::string& folder() const { return folder_; }  ///< its data lie in `data`
  void start();
  void kill();  ///< signal 9, all of it

  static constexpr const char* kNotInstalled = "PostgreSQL 15 is not installed (apt install postgresql-15)";

 private:
  PostgresServer() = default;
  bool run(const std::string& command) const;

  std::string folder_;
  std::string as_user_;  // what a command line begins with
};

}  // namespace palpate::support
