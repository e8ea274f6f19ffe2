// The caches that a walk shows: sets to compare, and in each set groups of lamps to dim.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace phos::stage {

/// Files whose records hold the light of the same lamps.
struct CacheGroup {
  std::string name;  ///< "": the only group of a set whose caches have no names
  std::vector<std::string> paths;
  std::string lamps;  ///< --lamps of the files (scene/lamp/shine_only.h); "": all. Filled by read_lamps()
};

struct CacheSet {
  std::vector<CacheGroup> groups;
  bool named() const { return !groups.empty() && !groups[0].name.empty(); }
  std::vector<std::string> paths() const;
};

/// The set that words of a command line name: caches without names are one group, NAME=FILE gives caches a
/// group each. Two files of one name are one group if one holds irradiance and the other radiance. A word
/// that is a file is taken as a path. `where` is the argument in messages ("CACHE", "--compare"). Throws
/// Error(usage) for caches of which some have names and some none, and for a second cache of a group.
CacheSet cache_set(const std::vector<std::string>& words, const std::string& where);

/// Throws Error(usage) where both sets have names and these differ; the message suggests the likest name.
void require_same_groups(const CacheSet& shown, const CacheSet& compared);

/// Fills CacheGroup::lamps by what the files record. Throws Error(mismatch) where files of one group differ.
void read_lamps(CacheSet& set);

/// Throws Error(usage) where a lamp of the scene is in two groups, or one of several groups holds all lamps.
/// Returns the names of the lamps that no group has: they are dark.
std::vector<std::string> require_apart(const CacheSet& set, const Scene& scene);

}  // namespace phos::stage
