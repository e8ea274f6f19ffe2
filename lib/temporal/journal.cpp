#include "temporal/journal.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <type_traits>

#include "core/error.h"
#include "file/hash.h"
#include "radiance/check.h"
#include "record/check.h"

namespace phos::inline temporal {
namespace {

constexpr std::string_view kHeader = "phos film journal 3 ";
constexpr std::uint64_t kMostNumbers = 1u << 20;  // in one vector of an entry: beyond it is damage

class Writer {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  void numbers(const std::vector<float>& v) {
    value(std::uint64_t{v.size()});
    bytes_.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(float));
  }
  void text(const std::string& s) {
    value(std::uint64_t{s.size()});
    bytes_ += s;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads the bytes that Writer wrote; good() is false once there were fewer than asked for.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : left_(bytes) {}
  template <class T>
  void value(T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (const std::string_view b = take(sizeof v); good_) std::memcpy(&v, b.data(), sizeof v);
  }
  void numbers(std::vector<float>& v) {
    std::uint64_t n = 0;
    value(n);
    if (n > kMostNumbers) good_ = false;
    const std::string_view b = take(n * sizeof(float));
    if (!good_) return;
    v.resize(n);
    if (n > 0) std::memcpy(v.data(), b.data(), b.size());
  }
  void text(std::string& s) {
    std::uint64_t n = 0;
    value(n);
    s = take(n);
  }
  bool good() const { return good_; }
  bool done() const { return good_ && left_.empty(); }

 private:
  std::string_view take(std::uint64_t n) {
    good_ = good_ && n <= left_.size();
    if (!good_) return {};
    const std::string_view taken = left_.substr(0, n);
    left_.remove_prefix(n);
    return taken;
  }
  std::string_view left_;
  bool good_ = true;
};

/// The same members for both ways.
template <class Way, class Record>
void irradiance(Way& way, Record& r) {
  way.value(r.position), way.value(r.normal), way.value(r.irradiance), way.value(r.stderr_lx);
  way.value(r.distance_m), way.value(r.radius_m), way.value(r.weight), way.value(r.shared);
  for (int c = 0; c < 3; ++c) way.value(r.rotation_gradient[c]), way.value(r.translation_gradient[c]);
}
void put(Writer& out, const IrradianceRecord& r) {
  irradiance(out, r);
  out.value(static_cast<std::uint8_t>(r.footprint != nullptr));
  if (r.footprint) out.value(r.footprint->x()), out.value(r.footprint->axes());
}
void get(Reader& in, IrradianceRecord& r) {
  irradiance(in, r);
  std::uint8_t shaped = 0;
  in.value(shaped);
  if (!shaped) return;
  Vec3 x(0);
  AdaptiveFootprint::Axes axes;
  in.value(x), in.value(axes);
  r.footprint = std::make_shared<AdaptiveFootprint>(x, r.normal, axes);
}
template <class Way, class Record>
void radiance(Way& way, Record& r) {
  way.value(r.position), way.value(r.frame), way.value(r.distance_m), way.value(r.radius_m),
      way.value(r.weight), way.value(r.shared);
  way.numbers(r.light), way.numbers(r.gradient_x), way.numbers(r.gradient_y), way.numbers(r.stderr_light);
}

void put(Writer& out, const std::shared_ptr<const RadianceRecord>& r) {
  out.value(static_cast<std::uint8_t>(r != nullptr));
  if (!r) return;
  radiance(out, *r);
  out.value(static_cast<std::uint8_t>(r->footprint_m.has_value()));
  if (r->footprint_m) out.value(*r->footprint_m);
}
std::shared_ptr<const RadianceRecord> get(Reader& in) {
  std::uint8_t there = 0;
  in.value(there);
  if (!there) return nullptr;
  auto r = std::make_shared<RadianceRecord>();
  radiance(in, *r);
  std::uint8_t shaped = 0;
  in.value(shaped);
  if (shaped) in.value(r->footprint_m.emplace());
  return r;
}

void put(Writer& out, const Made& made) {
  put(out, made.record);
  out.value(made.least_radius_m), out.value(made.site_least_m), out.value(made.site_most_m);
  out.value(made.least_share);
  put(out, made.radiance);
  out.value(static_cast<std::uint8_t>(made.ahead != nullptr));
  if (!made.ahead) return;
  put(out, made.ahead->record);
  out.value(made.ahead->holes);
  put(out, made.ahead->radiance);
}
void get(Reader& in, Made& made) {
  get(in, made.record);
  in.value(made.least_radius_m), in.value(made.site_least_m), in.value(made.site_most_m);
  in.value(made.least_share);
  made.radiance = get(in);
  std::uint8_t looks_ahead = 0;
  in.value(looks_ahead);
  if (!looks_ahead) return;
  auto ahead = std::make_shared<Ahead>();
  get(in, ahead->record);
  in.value(ahead->holes);
  ahead->radiance = get(in);
  made.ahead = std::move(ahead);
}

/// The bytes are not as they were written: nothing after them is believed. (Irradiance of radiance records
/// may be below zero.)
bool is_damaged(const IrradianceRecord& record, const RadianceRecord* radiance) {
  if (!radiance) return what_is_wrong(record);
  return radiance->order() < 1 || what_is_wrong(*radiance) || !is_finite(record.irradiance) ||
         !(record.radius_m > 0 && std::isfinite(record.radius_m));
}
bool is_damaged(const Made& made) {
  return is_damaged(made.record, made.radiance.get()) ||
         (made.ahead && is_damaged(made.ahead->record, made.ahead->radiance.get()));
}

std::uint64_t checksum(std::string_view bytes) { return hash_text(bytes).low; }

std::string contents_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

EstimateJournal::EstimateJournal(const std::string& path, const std::string& key, bool go_on)
    : path_(path), key_(key) {
  std::size_t whole = 0;  // bytes of whole entries
  if (go_on) whole = read(contents_of(path));
  if (whole > 0) {
    std::filesystem::resize_file(path, whole);
    file_.open(path, std::ios::binary | std::ios::app);
  } else {
    entries_.clear();
    file_.open(path, std::ios::binary | std::ios::trunc);
    file_ << kHeader << key << '\n';
    file_.flush();
  }
  if (!file_)
    throw Error(ExitCode::bad_input, path,
                "cannot be written, and it keeps the finished part of the film; free some space, or choose "
                "another folder");
}

EstimateJournal::~EstimateJournal() = default;

/// Returns how many bytes are whole entries of this run; 0: another run's.
std::size_t EstimateJournal::read(const std::string& bytes) {
  const std::string head = std::string(kHeader) + key_ + '\n';
  if (bytes.compare(0, head.size(), head) != 0) return 0;
  std::size_t at = head.size();
  while (bytes.size() - at >= 2 * sizeof(std::uint64_t)) {
    std::uint64_t size = 0, sum = 0;
    std::memcpy(&size, bytes.data() + at, sizeof size);
    std::memcpy(&sum, bytes.data() + at + sizeof size, sizeof sum);
    const std::size_t begin = at + sizeof size + sizeof sum;
    if (size > bytes.size() - begin) break;
    const std::string_view body(bytes.data() + begin, size);
    if (checksum(body) != sum) break;
    Reader in(body);
    Id id;
    Entry entry;
    in.value(id.first), in.value(id.second);
    get(in, entry.made);
    std::uint64_t events = 0;
    in.value(events);
    for (std::uint64_t i = 0; i < events && in.good(); ++i) {
      std::string name;
      std::uint64_t count = 0;
      in.text(name), in.value(count);
      entry.events[name] = count;
    }
    if (!in.done() || is_damaged(entry.made)) break;
    entry.made.item = id.second;
    entries_.insert_or_assign(id, std::move(entry));
    at = begin + size;
  }
  return at;
}

const EstimateJournal::Entry* EstimateJournal::find(const Id& id) const {
  const auto found = entries_.find(id);
  return found == entries_.end() ? nullptr : &found->second;
}

void EstimateJournal::add(const Id& id, const Made& made, const Counters& events) {
  Writer out;
  out.value(id.first), out.value(id.second);
  put(out, made);
  out.value(std::uint64_t{events.counts().size()});
  for (const auto& [name, count] : events.counts()) out.text(name), out.value(count);
  const std::uint64_t size = out.bytes().size(), sum = checksum(out.bytes());
  const std::lock_guard lock(mutex_);
  file_.write(reinterpret_cast<const char*>(&size), sizeof size);
  file_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  file_.write(out.bytes().data(), static_cast<std::streamsize>(size));
  if (!file_) throw Error(ExitCode::bad_input, path_, "cannot be written (is the disk full?)");
  ++added_;
}

/// Throws the same error with more words, if it is an interruption.
void EstimateJournal::tell_kept(const Error& e) {
  if (e.code() != ExitCode::interrupted) return;
  file_.flush();
  throw Error(e.code(), path_,
              text("interrupted; ", found() + added_,
                   " estimates are kept here: the same command with --reuse goes on"));
}

void EstimateJournal::finish() {
  file_.close();
  std::error_code ignored;  // it is of no use any more, and does no harm
  std::filesystem::remove(path_, ignored);
}

struct JournalEstimator::Inner : Worker {
  std::unique_ptr<Worker> worker;
};

std::unique_ptr<Estimator::Worker> JournalEstimator::make_worker() const {
  auto own = std::make_unique<Inner>();
  own->worker = inner_.make_worker();
  return own;
}

Made JournalEstimator::make(const RecordSite& site, Worker& worker) const {
  auto& own = static_cast<Inner&>(worker);
  const EstimateJournal::Id id{group_, site.item};
  if (const EstimateJournal::Entry* entry = journal_.find(id)) {
    for (const auto& [name, count] : entry->events) own.counters.add(name, count);
    return entry->made;
  }
  own.worker->counters = Counters();
  Made made = inner_.make(site, *own.worker);
  own.counters.merge(own.worker->counters);
  journal_.add(id, made, own.worker->counters);
  return made;
}

}  // namespace phos::inline temporal
