#include <string>

#include "cache/placement.h"
#include "core/error.h"

namespace phos {
namespace {

const char* name_of(Quantity q) { return q == Quantity::all ? "all" : "indirect"; }
const char* name_of(GradientMode m) {
  return m == GradientMode::photon ? "photon" : m == GradientMode::hemisphere ? "hemisphere" : "none";
}

/// Takes over what an earlier run recorded, option by option.
class Adoption {
 public:
  Adoption(const Options& given, const Container& earlier) : given_(given), earlier_(earlier) {}

  void number(const char* name, double& value) { value = settle(name, value, &Json::as_number); }
  void number(const char* name, std::optional<double>& value) {
    if (find(name)) value = settle(name, value.value_or(0), &Json::as_number);
  }
  void integer(const char* name, std::int64_t& value) { value = settle(name, value, &Json::as_integer); }
  template <class E>
  void choice(const char* name, E& value, std::initializer_list<E> all) {
    const Json* was = find(name);
    if (!was || !was->is_string()) return;
    if (given_.given(name) && was->as_string() != name_of(value))
      disagree(name, was->as_string(), name_of(value));
    for (const E e : all) {
      if (was->as_string() == name_of(e)) value = e;
    }
  }

 private:
  const Json* find(const std::string& name) const {
    const Json* was = earlier_.provenance().parameters.find(name);
    return was && !was->is_null() ? was : nullptr;
  }
  template <class T>
  T settle(const char* name, T value, T (Json::*as)() const) const {
    const Json* was = find(name);
    if (!was || !was->is_number()) return value;
    const T earlier = (was->*as)();
    if (given_.given(name) && value != earlier) disagree(name, was->dump(), Json(value).dump());
    return earlier;
  }
  [[noreturn]] void disagree(const std::string& name, const std::string& was, const std::string& now) const {
    throw Error(ExitCode::mismatch, earlier_.path(),
                text("was made with --", name, " ", was, ", not ", now, "; leave --", name,
                     " out to add with the same, or make a new file without --add-to"));
  }
  const Options& given_;
  const Container& earlier_;
};

}  // namespace

void adopt_options(RecordOptions& r, const Options& given, const Container& earlier) {
  Adoption from(given, earlier);
  from.number("accuracy", r.accuracy);
  from.number("min-radius", r.min_radius_m);
  from.number("max-radius", r.max_radius_m);
  from.choice("paths", r.paths, {Quantity::indirect, Quantity::all});
  from.choice("gradients", r.gradients, {GradientMode::photon, GradientMode::hemisphere, GradientMode::none});
  from.integer("hemisphere-rings", r.hemisphere_rings);
  from.integer("near-photons", r.near_photons);
  from.integer("min-photons", r.min_photons);
  from.integer("max-photons", r.max_photons);
  from.integer("distance-rays", r.distance_rays);
  from.integer("probes", r.probes);
}

}  // namespace phos
