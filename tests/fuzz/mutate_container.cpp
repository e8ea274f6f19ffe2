// Mutations of a container that leave its checksums right, so that they reach the readers behind them.
#include <array>
#include <cstring>

#include "columns.h"
#include "file/json_parse.h"
#include "mutate_json.h"
#include "reading.h"
#include "support/tree_stream.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace phos::fuzz {
namespace {

void mutate_bytes(std::vector<std::byte>& bytes, std::size_t most) {
  const std::size_t size = bytes.size();
  bytes.resize(std::max(size, most));
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
}

/// One element becomes a number of the kind that breaks things.
void plant_number(Column& c, Choice& choice) {
  constexpr std::array<std::uint32_t, 14> k32{0,          1,          0x7f800000, 0xff800000, 0x7fc00000,
                                              0xffffffff, 0x80000000, 0x7fffffff, 0x7f7fffff, 0x00000001,
                                              0xbf800000, 0x3f800000, 0x5f000000, 0x00800000};
  constexpr std::array<std::uint64_t, 8> k64{0,
                                             1,
                                             0x7ff0000000000000,
                                             0x7ff8000000000000,
                                             ~std::uint64_t{0},
                                             0x8000000000000000,
                                             0x7fffffffffffffff,
                                             0x3ff0000000000000};
  const std::size_t size = dtype_size(c.dtype);
  if (c.bytes.size() < size) return;
  std::byte* const at = c.bytes.data() + choice.below(c.bytes.size() / size) * size;
  if (size == 8) {
    std::memcpy(at, &choice.of(k64), 8);
  } else {
    std::memcpy(at, &choice.of(k32), std::min<std::size_t>(size, 4));
  }
}

/// All columns of as many rows as this one get or lose the same rows.
void change_rows(Columns& all, const Column& like, Choice& choice) {
  if (like.shape.empty()) return;
  const std::uint64_t rows = like.shape[0],
                      wanted = choice.once_in(4) ? 0 : choice.below(static_cast<std::size_t>(rows) + 3);
  for (auto& [name, c] : all.column) {
    if (c.shape.empty() || c.shape[0] != rows || c.row_bytes() == 0) continue;
    const std::size_t row = c.row_bytes(), size = static_cast<std::size_t>(wanted) * row;
    const std::vector<std::byte> first(
        c.bytes.begin(), c.bytes.begin() + static_cast<std::ptrdiff_t>(std::min(row, c.bytes.size())));
    while (c.bytes.size() < size && !first.empty()) c.bytes.insert(c.bytes.end(), first.begin(), first.end());
    c.bytes.resize(size);
    c.settle_rows();
  }
}

void mutate_column(Columns& all, Choice& choice) {
  auto at = all.column.begin();
  std::advance(at, static_cast<std::ptrdiff_t>(choice.below(all.column.size())));
  Column& c = at->second;
  switch (choice.below(9)) {
    case 0:
    case 1:
      return plant_number(c, choice);
    case 2: {
      const std::size_t size = c.bytes.size();
      if (size == 0) return;
      mutate_bytes(c.bytes, size);
      c.bytes.resize(size);
      return;
    }
    case 3:
      mutate_bytes(c.bytes, c.bytes.size() + 64);
      return c.settle_rows();
    case 4:
      return change_rows(all, Column(c), choice);
    case 5:
      all.column.erase(at);
      return;
    case 6:  // another shape
      c.shape.push_back(1 + choice.below(4));
      return c.settle_rows();
    case 7: {  // another kind of number
      c.dtype = choice.of(kDtypes);
      return c.settle_rows();
    }
    default: {
      auto other = all.column.begin();
      std::advance(other, static_cast<std::ptrdiff_t>(choice.below(all.column.size())));
      const Column copy = other->second;
      c = copy;
    }
  }
}

void mutate_tree(Column& tree) {
  std::optional<std::vector<std::byte>> contents = test::tree_contents(tree.bytes);
  if (!contents) return mutate_bytes(tree.bytes, tree.bytes.size() + 64);
  mutate_bytes(*contents, contents->size() + 64);
  tree.bytes = test::with_contents(tree.bytes, *contents);
  tree.settle_rows();
}

void mutate_header(Provenance& p, Choice& choice) {
  if (choice.once_in(6)) p.counters.add(choice.once_in(2) ? "x" : "clamped radius", 1);
  if (choice.once_in(10)) p.kind = choice.once_in(2) ? FileKind::irradiance : FileKind::radiance;
  p.extra = mutated(p.extra, choice);
}

/// Do the shapes agree with the bytes? A writer aborts over those that do not.
bool whole(const Columns& all) {
  for (const auto& [name, c] : all.column) {
    std::uint64_t n = dtype_size(c.dtype);
    for (const std::uint64_t extent : c.shape) n *= extent;
    if (n != c.bytes.size()) return false;
  }
  return true;
}

std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  Choice choice(seed);
  std::optional<Columns> all = take_apart(characters(data, size));
  if (!all || choice.once_in(12)) return LLVMFuzzerMutate(data, size, most);
  for (std::size_t times = 1 + choice.below(3); times > 0; --times) {
    const auto tree = all->column.find("kdtree");
    if (tree != all->column.end() && choice.once_in(2)) {
      mutate_tree(tree->second);
    } else if (all->column.empty() || choice.once_in(4)) {
      mutate_header(all->provenance, choice);
    } else {
      mutate_column(*all, choice);
    }
  }
  if (!whole(*all)) return size;
  const std::string file = sealed(*all);
  return put(file, data, size, most);
}

}  // namespace
}  // namespace phos::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  try {
    return phos::fuzz::mutate(data, size, most, seed);
  } catch (const phos::Error&) {
    return size;
  }
}
