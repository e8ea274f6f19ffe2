// The safetensors layout: header and tensor table, read from bytes that nobody vouches for.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "file/container.h"
#include "file/limits.h"
#include "file/provenance.h"

namespace phos::inline file {

inline constexpr auto kMaxHeaderBytes = kMostHeaderBytes.as<std::size_t>();
inline constexpr std::size_t kDataAlignment = 64;

struct LayoutHeader {
  Json table;              ///< tensor name -> {"dtype","shape","data_offsets"}
  Metadata metadata;       ///< __metadata__
  std::size_t data_begin;  ///< byte at which the tensors start
};

/// First step: the header alone. Throws Error(bad_input): empty, truncated, another kind of file, malformed.
LayoutHeader read_layout_header(std::span<const std::byte> file, const std::string& where);

/// Second step: the tensors, as views of `file`. They must be aligned, in known dtypes, and cover the data
/// without overlap or hole. Throws Error(bad_input).
std::map<std::string, Tensor> read_layout_tensors(const LayoutHeader& header, std::span<const std::byte> file,
                                                  const std::string& where);

/// Length prefix and padded header for these tensors, and the order in which their bytes follow (wide dtypes
/// first, then by name, so that each is aligned without holes).
struct LayoutPlan {
  std::string header;
  std::vector<const Tensor*> order;
};
LayoutPlan plan_layout(const std::map<std::string, Tensor>& tensors, const Metadata& metadata);

/// Length prefix and header of a phos container; empty for any other file.
std::span<const std::byte> phos_header_bytes(std::span<const std::byte> file);
/// Does the file begin as a phos container does, and end within its header?
bool is_cut_in_header(std::span<const std::byte> file);

}  // namespace phos::inline file
