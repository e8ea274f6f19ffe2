// What stands in a checkout in place of a large file that Git LFS has not fetched.
#pragma once

#include <string_view>

namespace phos::inline file {

/// Are these the bytes of a pointer of Git LFS, and not of the file that it stands for?
bool is_lfs_pointer(std::string_view bytes);

/// What such a file is, for the end of a message.
inline constexpr const char* kLfsPointer =
    "a Git LFS pointer; fetch the file that it stands for (git lfs pull)";

}  // namespace phos::inline file
