// Sorts exceptions into codes. Texts of the C++ library go to the caller as they are: they name the system's trouble.
#include "answers.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <new>
#include <string_view>

#include "palpate/base/error.h"
#include "structs.h"

namespace palpate::c_api {

namespace {

int32_t answer(palpate_error* error, int32_t code, std::string_view message, std::size_t line = 0) noexcept {
  if (!isUsable(error)) return code;
  palpate_error whole = {};
  whole.code = code;
  whole.line = static_cast<int32_t>(std::min<std::size_t>(line, std::numeric_limits<int32_t>::max()));
  putText(message, whole.message);
  toCaller(whole, error);
  return code;
}

}  // namespace

int32_t answerOk(palpate_error* error) noexcept { return answer(error, PALPATE_OK, ""); }

int32_t answerToException(palpate_error* error) noexcept {
  try {
    throw;
  } catch (const ArgumentError& mistake) {
    return answer(error, PALPATE_ARGUMENT, mistake.message);
  } catch (const Error& refused) {
    return answer(error, PALPATE_REFUSED, refused.what(), refused.line());
  } catch (const std::bad_alloc&) {
    return answer(error, PALPATE_MEMORY, "not enough memory");
  } catch (const std::exception& failed) {
    return answer(error, PALPATE_FAILED, failed.what());
  } catch (...) {
    return answer(error, PALPATE_FAILED, "an unknown failure");
  }
}

}  // namespace palpate::c_api

const char* palpate_version() noexcept { return PALPATE_VERSION; }
