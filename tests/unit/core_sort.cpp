// Sorting by all threads: against std::sort, at sizes around those of chunks and runs.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/random.h"

namespace phos {
namespace {

TEST(ParallelSort, AgreesWithOneThreads) {
  constexpr std::size_t kChunk = 64;
  for (const std::size_t n : {0u, 1u, 63u, 64u, 65u, 128u, 129u, 192u, 500u, 1024u, 1025u, 5000u})
    for (const std::uint32_t values : {1u, 7u, 1u << 31}) {
      RandomStream random(5, Stage::test, n);
      random.start_bounce(0);
      Column<std::uint32_t> items(n);
      for (std::uint32_t& item : items) item = random.bits() % values;
      Column<std::uint32_t> expected = items;
      std::sort(expected.begin(), expected.end());
      parallel_sort(items, kChunk);
      EXPECT_EQ(items, expected) << n << " items of " << values << " values";
    }
}

TEST(ParallelSort, OfSortedAndReversed) {
  Column<int> up(1000), down(1000);
  for (int i = 0; i < 1000; ++i)
    up[static_cast<std::size_t>(i)] = i, down[static_cast<std::size_t>(i)] = 999 - i;
  Column<int> sorted = up;
  parallel_sort(sorted, 32);
  EXPECT_EQ(sorted, up);
  parallel_sort(down, 32);
  EXPECT_EQ(down, up);
}

}  // namespace
}  // namespace phos
