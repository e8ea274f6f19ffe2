// Deterministic parallel loops on oneTBB. What runs in a chunk, and the order in which partial results are
// joined, do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace phos {

/// Number of threads for every loop after this call; 0 means all cores.
void set_threads(int threads);
int thread_count();

/// Denormals become zero in the calling thread (x86 FTZ and DAZ). set_threads and every loop's workers call
/// it.
void set_flush_to_zero();

/// Calls body(begin, end) for [0,n) cut in chunks of `chunk` items, in any order and in parallel. The first
/// exception is rethrown. Throws Error(interrupted) between chunks once the user has asked to stop.
void parallel_chunks(std::size_t n, std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& body);

/// body(i) for i in [0,n).
template <class Body>
void parallel_for(std::size_t n, std::size_t chunk, const Body& body) {
  parallel_chunks(n, chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// One partial result per chunk, computed in parallel, joined in chunk order: join(total, partial). `make` is
/// called as make(begin, end) and returns a T.
template <class T, class Make, class Join>
T parallel_reduce(std::size_t n, std::size_t chunk, T total, const Make& make, const Join& join) {
  std::vector<T> partial((n + chunk - 1) / chunk);
  parallel_chunks(n, chunk,
                  [&](std::size_t begin, std::size_t end) { partial[begin / chunk] = make(begin, end); });
  for (T& p : partial) join(total, p);
  return total;
}

/// Sorts by operator<; equal items, which must then be the same, in any order. Holds up to twice the items.
template <class T>
void parallel_sort(std::vector<T>& items, std::size_t chunk) {
  const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  parallel_chunks(items.size(), chunk,
                  [&](std::size_t begin, std::size_t end) { std::sort(at(begin), at(end)); });
  for (std::size_t run = chunk; run < items.size(); run *= 2)
    parallel_chunks(items.size(), 2 * run, [&](std::size_t begin, std::size_t end) {
      std::inplace_merge(at(begin), at(std::min(begin + run, end)), at(end));
    });
}

}  // namespace phos
