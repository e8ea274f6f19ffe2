// What an interrupted film has left: entries that are no records are not believed, and what is believed can
// be written again.
#include <cmath>
#include <cstring>

#include "file/hash.h"
#include "radiance/cache.h"
#include "random_choice.h"
#include "reading.h"
#include "temporal/journal.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using namespace phos;

constexpr const char* kKey = "key";  // as fuzz_corpora writes them

struct Nothing : Estimator {
  std::unique_ptr<Worker> make_worker() const override { return std::make_unique<Worker>(); }
  Made make(const RecordSite& site, Worker&) const override {
    Made made;
    made.record.radius_m = 1, made.record.normal = {0, 0, 1}, made.item = site.item;
    return made;
  }
};

void require_record(const Made& made) {
  PHOS_CHECK(is_finite(made.record.irradiance) && made.record.radius_m > 0, made.record.radius_m);
  if (!made.radiance) return;
  const RadianceRecord& r = *made.radiance;
  const std::size_t n = 3 * static_cast<std::size_t>(r.order() * r.order());
  PHOS_CHECK(r.light.size() == n && (r.gradient_x.empty() || r.gradient_x.size() == n), r.light.size());
  PHOS_CHECK(is_finite(r) && r.gradient_x.size() == r.gradient_y.size(), n);
}

void read(const std::string& path) {
  std::size_t found = 0;
  {
    EstimateJournal journal(path, kKey, true);
    found = journal.found();
    const Nothing nothing;
    for (const std::int64_t group : {0, 64}) {
      const JournalEstimator estimator(nothing, journal, group);
      const auto worker = estimator.make_worker();
      for (std::uint64_t item = 0; item < 8; ++item)
        require_record(estimator.make({Vec3(0), {0, 0, 1}, item}, *worker));
    }
  }
  const EstimateJournal again(path, kKey, true);
  PHOS_CHECK(again.found() >= found, again.found(), " of ", found, " are left");
}

/// Checksums of the entries, as far as their sizes lead.
void seal(std::string& bytes) {
  std::size_t at = bytes.find('\n');
  if (at == std::string::npos) return;
  for (++at; bytes.size() - at >= 16;) {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + at, sizeof size);
    if (size > bytes.size() - at - 16) {
      size = bytes.size() - at - 16;  // the last one
      std::memcpy(bytes.data() + at, &size, sizeof size);
    }
    const std::uint64_t sum = hash_text(std::string_view(bytes).substr(at + 16, size)).low;
    std::memcpy(bytes.data() + at + 8, &sum, sizeof sum);
    at += 16 + size;
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  fuzz::Choice choice(seed);
  size = LLVMFuzzerMutate(data, size, most);
  std::string bytes(fuzz::characters(data, size));
  if (!choice.once_in(8)) seal(bytes);
  return fuzz::put(bytes, data, size, most);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "film.journal");
  return fuzz::answers([&] { read(path); });
}
