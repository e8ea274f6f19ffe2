// Large arrays that all threads fill.
#pragma once

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace phos {

/// Leaves the new values of a resize unset, so that the thread that fills a page is the first to touch it.
template <class T>
struct ColumnAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T>);
  template <class U>
  struct rebind {
    using other = ColumnAllocator<U>;
  };

  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
};

/// A vector whose values are unset until they are written.
template <class T>
using Column = std::vector<T, ColumnAllocator<T>>;

}  // namespace phos
