// Floating-point errors as crashes, in builds for hunting them (-DPHOS_TRAP_FPE=ON): an invalid operation
// (0/0, inf - inf, an ordered comparison with NaN, a conversion to an integer that does not hold the value)
// or a division by zero ends the process where it happens. In other builds nothing here does anything.
#pragma once

#ifdef PHOS_TRAP_FPE
#include <cfenv>
#endif

namespace phos {

#ifdef PHOS_TRAP_FPE

/// Traps in this thread while it lives; then as before.
class FloatTraps {
 public:
  FloatTraps() : before_(set(FE_INVALID | FE_DIVBYZERO)) {}
  ~FloatTraps() { set(before_); }
  FloatTraps(const FloatTraps&) = delete;
  FloatTraps& operator=(const FloatTraps&) = delete;

  /// Traps from now on in this thread exactly these; returns those before. What was raised before is
  /// forgotten.
  static int set(int traps) {
    std::feclearexcept(FE_ALL_EXCEPT);
    const int before = fegetexcept();
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept(traps);
    return before;
  }

 private:
  int before_;
};

/// No traps in this thread while it lives: around calls into packages which compute with infinities and NaN
/// on purpose, and around tests with such numbers.
class NoFloatTraps {
 public:
  NoFloatTraps() : before_(FloatTraps::set(0)) {}
  ~NoFloatTraps() { FloatTraps::set(before_); }
  NoFloatTraps(const NoFloatTraps&) = delete;
  NoFloatTraps& operator=(const NoFloatTraps&) = delete;

 private:
  int before_;
};

#else

class [[maybe_unused]] FloatTraps {
 public:
  FloatTraps() {}
};
class [[maybe_unused]] NoFloatTraps {
 public:
  NoFloatTraps() {}
};

#endif

}  // namespace phos
