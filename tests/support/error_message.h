// What a refused call says.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "palpate/base/error.h"

namespace palpate::support {

/// The message of the Error that `action` throws; "no error" when it throws none. Other exceptions pass through.
template <class Action>
std::string thrownMessage(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace palpate::support
