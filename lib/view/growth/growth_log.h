// The new records of a growing cache, and the order in which they changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "record/irradiance_cache.h"

namespace phos::inline view {

/// Each change of a record has a serial number, from 1 on, so that every page can ask for the changes that it
/// lacks.
class GrowthLog {
 public:
  struct Changes {
    std::vector<std::uint32_t> rows;  ///< of records(), in the order of their last changes
    std::uint32_t serial = 0;         ///< of the last of them; as asked where there is none
    bool more = false;                ///< further changes follow
  };

  /// The records as they are now: those before in their places, with changes, and new ones behind.
  void update(std::vector<IrradianceRecord> now);

  std::span<const IrradianceRecord> records() const { return records_; }
  std::uint32_t serial() const { return serial_; }
  /// Changes after number `serial`, at most `most`.
  Changes since(std::uint32_t serial, std::size_t most) const;

 private:
  std::vector<IrradianceRecord> records_;
  std::vector<std::uint32_t> changed_;                // of each record: number of its last change
  std::map<std::uint32_t, std::uint32_t> by_serial_;  // its row
  std::uint32_t serial_ = 0;
};

}  // namespace phos::inline view
