#include "file/hash.h"

#include <sys/stat.h>
#include <xxhash.h>

#include <bit>
#include <new>

#include "core/error.h"
#include "file/layout.h"
#include "file/mapped_file.h"

namespace phos::inline file {

namespace {

Hash128 from(const XXH128_hash_t& h) { return {h.high64, h.low64}; }

XXH3_state_t* state_of(void* state) { return static_cast<XXH3_state_t*>(state); }

}  // namespace

std::string Hash128::hex() const {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (const std::uint64_t half : {high, low})
    for (int shift = 60; shift >= 0; shift -= 4) out += kDigits[(half >> shift) & 15];
  return out;
}

Hash128 hash_bytes(std::span<const std::byte> bytes) {
  return from(XXH3_128bits(bytes.data(), bytes.size()));
}

Hash128 hash_file(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode))
    throw Error(ExitCode::bad_input, path,
                "is not a regular file; save it to one, so that it can be identified before it is read");
  const MappedFile file(path);
  const std::span<const std::byte> header = phos_header_bytes(file.bytes());
  return hash_bytes(header.empty() ? file.bytes() : header);
}

Hasher::Hasher() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(state_of(state_));
}

Hasher::~Hasher() { XXH3_freeState(state_of(state_)); }

void Hasher::add_bytes(const void* data, std::size_t size) {
  XXH3_128bits_update(state_of(state_), data, size);
}

void Hasher::add(std::string_view s) {
  add(static_cast<std::int64_t>(s.size()));
  add_bytes(s.data(), s.size());
}

void Hasher::add(float v) { add(std::bit_cast<std::uint32_t>(v == 0.f ? 0.f : v)); }

Hash128 Hasher::finish() const { return from(XXH3_128bits_digest(state_of(state_))); }

}  // namespace phos::inline file
