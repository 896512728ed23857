// How what the page calls is exported, for all files of this folder that export something.
//
// Text and bytes come in as pointer and length, in memory that the caller took by palpate_take and gives back itself.
// What can fail gives an error: a text that is valid until the next call, or null when all went well.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>

#define PALPATE_EXPORT extern "C" __attribute__((used, visibility("default")))

namespace palpate::web {

/// Keeps a text alive until the next call, for who asked for it.
const char* keptText(std::string text);

/// The words of what a call threw, or null. Whatever is thrown, the engine stays usable.
template <class Call>
const char* errorOf(Call&& call) noexcept {
  try {
    std::forward<Call>(call)();
    return nullptr;
  } catch (const std::bad_alloc&) {
    return "there is not enough memory for it in this page";
  } catch (const std::exception& error) {
    return keptText(error.what());
  } catch (...) {
    return "something went wrong";
  }
}

}  // namespace palpate::web
