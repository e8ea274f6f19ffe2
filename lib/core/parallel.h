// Deterministic parallel loops on oneTBB. What runs in a chunk, and the order in which partial results are
// joined, do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/column.h"

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

/// Of two sorted runs: how many of the first are among the least `k` of both.
template <class T>
std::size_t of_first_run(std::span<const T> first, std::span<const T> second, std::size_t k) {
  std::size_t least = k > second.size() ? k - second.size() : 0, most = std::min(k, first.size());
  while (least < most) {
    const std::size_t middle = (least + most) / 2;
    if (second[k - middle - 1] < first[middle])
      most = middle;
    else
      least = middle + 1;
  }
  return least;
}

/// Sorts by operator<; equal items, which must then be the same, in any order. Holds twice the items.
template <class T>
void parallel_sort(Column<T>& items, std::size_t chunk) {
  const std::size_t n = items.size();
  parallel_chunks(n, chunk, [&](std::size_t begin, std::size_t end) {
    std::sort(items.data() + begin, items.data() + end);
  });
  Column<T> merged(n > chunk ? n : 0);
  for (std::size_t run = chunk; run < n; run *= 2) {
    // Each chunk of the merged run finds the parts of the two runs that go into it.
    parallel_chunks(n, chunk, [&](std::size_t begin, std::size_t end) {
      const std::size_t from = begin / (2 * run) * (2 * run), middle = std::min(n, from + run);
      const std::span<const T> first(items.data() + from, middle - from);
      const std::span<const T> second(items.data() + middle, std::min(n, middle + run) - middle);
      const std::size_t a = of_first_run(first, second, begin - from);
      const std::size_t b = of_first_run(first, second, end - from);
      std::merge(first.begin() + static_cast<std::ptrdiff_t>(a),
                 first.begin() + static_cast<std::ptrdiff_t>(b),
                 second.begin() + static_cast<std::ptrdiff_t>(begin - from - a),
                 second.begin() + static_cast<std::ptrdiff_t>(end - from - b), merged.data() + begin);
    });
    items.swap(merged);
  }
}

}  // namespace phos
