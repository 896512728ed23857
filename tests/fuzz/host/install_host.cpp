// Before a fuzzer's first input: files and threads.
#include "palpate/scene/host.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  palpate::installHost();
  return 0;
}
