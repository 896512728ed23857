// Mosquitto as a child of this process, with the configuration of a class's folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/classroom/class_folder.h"

namespace palpate::classroom {

/// Where it is installed; empty: it is not.
std::filesystem::path brokerProgram();

class BrokerProcess {
 public:
  /// Writes the configuration again and starts the broker; its output is appended to `log`. Throws Error if mosquitto
  /// is missing or exits at once, with its last words.
  BrokerProcess(const ClassFolder& folder, std::filesystem::path log);
  ~BrokerProcess();  ///< ends it in order
  BrokerProcess(const BrokerProcess&) = delete;
  BrokerProcess& operator=(const BrokerProcess&) = delete;

  bool running();
  void restart();
  void kill();  ///< at once, as a power cut would
  int id() const { return id_; }

 private:
  void start();
  void end(int signal);

  std::filesystem::path configuration_;
  std::filesystem::path log_;
  int id_ = -1;
};

}  // namespace palpate::classroom
