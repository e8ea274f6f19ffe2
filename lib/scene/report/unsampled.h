// Which ways of light an estimator does not sample, so that its standard error does not hold them.
#pragma once

#include <string>
#include <vector>

#include "core/counters.h"
#include "file/container.h"
#include "file/tool.h"
#include "scene/report/light_ways.h"

namespace phos::inline scene {

/// How light is looked for.
enum class Sampler : std::uint8_t {
  path_tracing,               ///< from sensor or eye, with shadow rays: reference/eye_path_tracer.h
  gathering,                  ///< rays of records, and of sensors beyond them: estimate/gather.h
  gathering_beside_caustics,  ///< the same beside caustic photons, which travel with the cache
  photons,                    ///< from the lamps
};

/// Light that is found by rays which happen to hit a lamp counts as sampled from so many expected hits on:
/// below, mean +- 2 standard errors misses the truth more often than one says (docs/methods.md#g6-2).
inline constexpr double kExpectedHits = 10;

/// Rays that a record usually has, and a sensor beyond them.
inline constexpr double kUsualRays = 1024;

/// Is light that goes this way in an estimate of so many samples, and in its standard error? For each sampler
/// and kind of way one table (in the .cpp) says: always, never, or by hits, samples x hit_share of them.
bool samples(Sampler sampler, const LightWay& way, double samples);
/// The ways that are not.
std::vector<LightWay> unsampled(const std::vector<LightWay>& ways, Sampler sampler, double samples);

/// The ways of two lists, ways of the first list first: ways of one lamp and kind are one, with the larger
/// share, the lesser hit_share, and the materials of both.
std::vector<LightWay> united(std::vector<LightWay> ways, const std::vector<LightWay>& more);

/// The least samples with which all ways that can be sampled so, in no more than `most`, are; 0: none has to
/// be.
std::int64_t samples_wanted(const std::vector<LightWay>& ways, Sampler sampler, std::int64_t most);

/// A line on a way that is not: lamp "sun" reaches surfaces by way of mirror "wall", which path tracing does
/// not sample ..., with the method that does.
std::string unsampled_line(const LightWay& way, Sampler sampler, double samples);

/// A warning for each, but for no more than kShownWays; with --strict Error(numerical) instead. Also the
/// figure "unsampled" of --stats. `what` (a file, say) begins the line if it is not empty.
void tell_unsampled(Tool& tool, const std::vector<LightWay>& ways, Sampler sampler, double samples,
                    const std::string& what = "");
inline constexpr std::size_t kShownWays = 3;

/// A file's records do not hold these ways; nothing is noted where there are none, so that such files stay
/// as they always were.
void note_unsampled(Provenance& provenance, const std::vector<LightWay>& ways);
std::vector<LightWay> unsampled_in(const Provenance& provenance);
/// Warns as above of the files that say so. All their ways.
std::vector<LightWay> tell_unsampled_in(Tool& tool, const std::vector<Container>& files);
/// Of a file whose records are kept beside new ones: `kept` are its ways, `missed` the ways of the new
/// records, which are told already. Warns as above of ways that the file alone states. The ways of both,
/// united.
std::vector<LightWay> tell_unsampled_kept(Tool& tool, const std::string& path,
                                          const std::vector<LightWay>& kept,
                                          const std::vector<LightWay>& missed);

}  // namespace phos::inline scene
