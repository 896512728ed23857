#include "palpate/base/thread_priority.h"

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace palpate {

void lowerPriority([[maybe_unused]] int nice) {
#ifdef __linux__
  setpriority(PRIO_PROCESS, 0, nice);
#endif
}

}  // namespace palpate
