#include "core/parallel.h"

#include <pmmintrin.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <xmmintrin.h>

#include <algorithm>
#include <memory>

#include "core/float_traps.h"
#include "core/interrupt.h"

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace phos {

namespace {

#ifdef PHOS_TRAP_FPE
/// The main thread traps from before main() on, in tests too.
[[maybe_unused]] const int kTrapped = FloatTraps::set(FE_INVALID | FE_DIVBYZERO);
#endif

struct Threads {
  int count = 0;
  std::unique_ptr<tbb::global_control> limit;
};

Threads& threads() {
  static Threads instance;
  return instance;
}

/// Tells the thread sanitizer what the loop library's own synchronisation orders, which it cannot see:
/// memory that was written before the loop is visible in each chunk, and memory that chunks wrote is visible
/// after the loop.
struct LoopOrder {
#ifdef __SANITIZE_THREAD__
  char begin = 0, end = 0;
  void publish() { __tsan_release(&begin); }
  void enter() { __tsan_acquire(&begin); }
  void leave() { __tsan_release(&end); }
  void collect() { __tsan_acquire(&end); }
#else
  void publish() {}
  void enter() {}
  void leave() {}
  void collect() {}
#endif
};

}  // namespace

void set_flush_to_zero() {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

void set_threads(int wanted) {
  Threads& t = threads();
  t.count = wanted > 0 ? wanted : std::max(1, tbb::info::default_concurrency());
  t.limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(t.count));
  set_flush_to_zero();
}

int thread_count() {
  if (threads().count == 0) set_threads(0);
  return threads().count;
}

void parallel_chunks(std::size_t n, std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  if (n == 0) return;
  thread_count();
  const std::size_t chunks = (n + chunk - 1) / chunk;
  LoopOrder order;
  order.publish();
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, chunks, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        order.enter();
        set_flush_to_zero();     // a worker may be new
        const FloatTraps traps;  // and next it may work for a package that does not bear them
        for (std::size_t c = range.begin(); c != range.end(); ++c) {
          throw_if_interrupted();
          body(c * chunk, std::min(n, (c + 1) * chunk));
        }
        order.leave();
      },
      tbb::simple_partitioner());
  order.collect();
}

}  // namespace phos
