// Choices of a mutator.
#pragma once

#include <cstdint>
#include <random>

namespace phos::fuzz {

class Choice {
 public:
  explicit Choice(unsigned seed) : engine_(seed + 1) {}
  /// 0 .. n - 1
  std::size_t below(std::size_t n) { return n == 0 ? 0 : engine_() % n; }
  bool once_in(std::size_t n) { return below(n) == 0; }
  template <class List>
  const auto& of(const List& list) {
    return list[below(std::size(list))];
  }

 private:
  std::minstd_rand engine_;
};

}  // namespace phos::fuzz
