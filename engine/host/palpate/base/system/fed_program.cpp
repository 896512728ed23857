#include "palpate/base/system/fed_program.h"

namespace palpate::system {

std::string FedProgram::said() {
  std::rewind(words_.get());
  std::string all;
  for (int c = std::fgetc(words_.get()); c != EOF; c = std::fgetc(words_.get())) all += static_cast<char>(c);
  return all;
}

}  // namespace palpate::system
