// The end of every entry of the C interface: a code, and a text in the caller's palpate_error. No exception passes it.
#pragma once

#include <string>

#include "palpate.h"
#include "palpate/scene/host.h"

namespace palpate::c_api {

/// The caller's mistake, PALPATE_ARGUMENT.
struct ArgumentError {
  const char* message;
};

/// Throws ArgumentError.
inline void require(bool holds, const char* message) {
  if (!holds) throw ArgumentError{message};
}

/// Returns the code of the current exception; only within a catch. Fills the caller's error, where there is one.
int32_t answerToException(palpate_error* error) noexcept;
int32_t answerOk(palpate_error* error) noexcept;

/// Does the work; exceptions become codes.
template <class Work>
int32_t answered(palpate_error* error, Work&& work) noexcept {
  try {
    work();
    return answerOk(error);
  } catch (...) {
    return answerToException(error);
  }
}

/// The same for work that makes a handle, as a program's first work does: `*out` is null unless it succeeds.
template <class Handle, class Work>
int32_t answeredWith(Handle** out, palpate_error* error, Work&& work) noexcept {
  if (out != nullptr) *out = nullptr;
  return answered(error, [&] {
    require(out != nullptr, "out is null");
    installHost();
    *out = work();
  });
}

}  // namespace palpate::c_api
