// Memory that is there before it is needed.
#pragma once

#include <cstddef>
#include <vector>

namespace palpate {

/// Empties the vector and gives it room for `count` elements, every page of it touched. After a plain reserve() the
/// system finds each page when it is first written: a page fault in whatever servo tick that is.
template <class T>
void reserveTouched(std::vector<T>& items, std::size_t count) {
  items.clear();
  items.resize(count);
  items.clear();
}

}  // namespace palpate
