#include "class/tests/support/postgres_server.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace palpate::support {

namespace {

constexpr const char* kPostgresPrograms = "/usr/lib/postgresql/15/bin/";

}  // namespace

bool PostgresServer::run(const std::string& command) const {
  const std::string line =
      "cd '" + folder_ + "' && " + as_user_ + kPostgresPrograms + command + " >>'" + folder_ + "/log' 2>&1 </dev/null";
  return std::system(line.c_str()) == 0;
}

std::unique_ptr<PostgresServer> PostgresServer::started() {
  if (!std::filesystem::exists(std::string(kPostgresPrograms) + "initdb")) return nullptr;
  std::unique_ptr<PostgresServer> server(new PostgresServer);
  std::string folder = "/tmp/palpate_pg_XXXXXX";  // short: a socket's path has at most 107 letters
  if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no folder for PostgreSQL");
  server->folder_ = folder;
  if (::getuid() == 0) {
    if (std::system(("chown postgres '" + folder + "'").c_str()) != 0) return nullptr;
    server->as_user_ = "runuser -u postgres -- ";
  }
  if (!server->run("initdb -D data -U palpate -A trust --no-sync -E UTF8 --locale=C.UTF-8")) {
    throw std::runtime_error("initdb: see " + folder + "/log");
  }
  server->start();
  return server;
}

void PostgresServer::start() {
  const std::string options = "-k " + folder_ + " -h '' -c shared_buffers=16MB -c max_wal_size=64MB -c jit=off";
  if (!run("pg_ctl -D data -w -t 60 -o \"" + options + "\" start")) {
    throw std::runtime_error("pg_ctl start: see " + folder_ + "/log");
  }
}

void PostgresServer::kill() {
  std::ifstream file(folder_ + "/data/postmaster.pid");
  pid_t process = 0;
  if (!(file >> process) || process <= 1) return;
  ::kill(process, SIGSTOP);  // it must not see the others die and bring the house in order
  const std::string children = "pkill -9 -P " + std::to_string(process);
  if (std::system(children.c_str()) < 0) return;
  ::kill(process, SIGKILL);
  while (::kill(process, 0) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

std::string PostgresServer::connection(const std::string& database) {
  run("createdb -h '" + folder_ + "' -U palpate " + database);  // there already: so be it
  return "host=" + folder_ + " user=palpate dbname=" + database;
}

PostgresServer::~PostgresServer() {
  run("pg_ctl -D data -w -m immediate stop");
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace palpate::support
