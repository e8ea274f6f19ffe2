// OpenEXR files in memory, and the threads that read and write them.
#pragma once

#include <Iex.h>
#include <ImfIO.h>
#include <ImfThreading.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>

#include "core/parallel.h"

namespace phos::inline image {

class MemoryExrIn : public Imf::IStream {
 public:
  MemoryExrIn(std::string_view bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char* out, int n) override {
    const auto wanted = static_cast<std::size_t>(std::max(n, 0));
    if (wanted > bytes_.size() - at_) throw Iex::InputExc("the file ends too early");
    std::memcpy(out, bytes_.data() + at_, wanted);
    at_ += wanted;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override {
    if (at > bytes_.size()) throw Iex::InputExc("the file ends too early");
    at_ = static_cast<std::size_t>(at);
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

class MemoryExrOut : public Imf::OStream {
 public:
  MemoryExrOut() : OStream("memory") {}
  void write(const char* data, int n) override {
    const auto size = static_cast<std::size_t>(n);
    if (at_ + size > bytes_.size()) {
      if (at_ + size > bytes_.capacity()) bytes_.reserve(2 * (at_ + size));
      bytes_.resize(at_ + size);
    }
    std::memcpy(bytes_.data() + at_, data, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = static_cast<std::size_t>(at); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

inline void use_our_exr_threads() {
  const int workers = thread_count() > 1 ? thread_count() : 0;
  if (Imf::globalThreadCount() != workers) Imf::setGlobalThreadCount(workers);
}

}  // namespace phos::inline image
