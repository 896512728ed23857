// The rules of exported functions, for all files of this folder that have some.
//
// Text and bytes are passed as pointer and length, in memory that the caller gets from palpate_take and frees itself.
// Functions that can fail return an error: a text that is valid until the next call, or null on success.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>

#define PALPATE_EXPORT extern "C" __attribute__((used, visibility("default")))

namespace palpate::web {

/// Keeps a text alive for the caller until the next call.
const char* keptText(std::string text);

/// The text of an exception, or null. After any exception the engine stays usable.
template <class Call>
const char* catchError(Call&& call) noexcept {
  try {
    std::forward<Call>(call)();
    return nullptr;
  } catch (const std::bad_alloc&) {
    return "there is not enough memory in this page; try a smaller mesh";
  } catch (const std::exception& error) {
    return keptText(error.what());
  } catch (...) {
    return "something went wrong";
  }
}

}  // namespace palpate::web
