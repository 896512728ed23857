#include "bench/kernels/kernel_list.h"

#include <iterator>
#include <utility>

namespace palpate::bench {

std::vector<Kernel> makeKernels(std::size_t triangles) {
  std::vector<Kernel> all;
  for (auto* part : {contactKernels, partitionKernels, deformationKernels, buildingKernels}) {
    std::vector<Kernel> kernels = part(triangles);
    std::move(kernels.begin(), kernels.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace palpate::bench
