#include "temporal/film/lives.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/float_traps.h"
#include "temporal/film/file.h"

namespace phos::inline temporal {

namespace {

/// The share of a place that has records from frame `begin` to before `end`.
float fade_at(std::int64_t frame, std::int64_t begin, std::int64_t end, const FilmInfo& film) {
  const auto share = [&](std::int64_t frames) {
    return std::min(1.f, static_cast<float>(frames) / static_cast<float>(film.fade + 1));
  };
  const float in = begin > film.frames.first ? share(frame - begin + 1) : 1.f;
  const float out = end <= film.frames.last ? share(end - frame) : 1.f;
  return in * out;
}

}  // namespace

const char* what_is_wrong(const Life& life, const Life* before, const FilmInfo& film) {
  const NoFloatTraps traps;  // files may hold numbers that are not finite
  if (!(life.birth < life.end)) return "an end that is not after its birth";
  if (life.birth < film.frames.first || life.end > film.frames.last + 1) return "a life outside of the film";
  if (before && life.chain < before->chain) return "a chain before that of the record before it";
  if (before && life.chain == before->chain && life.birth < before->end)
    return "a life that begins before that of its chain's record before it ends";
  if (!std::isfinite(life.rate) || life.rate < 0) return "a rate that is not finite or negative";
  const Anchor& a = life.anchor;
  if (a.triangle == kNoTriangle) return nullptr;
  constexpr float kSlack = 1e-4f;
  if (!(a.u >= -kSlack && a.v >= -kSlack && a.u + a.v <= 1 + kSlack)) return "an anchor outside its triangle";
  if (!(std::fabs(glm::length(life.turn) - 1) <= kSlack)) return "a turn that is not of unit length";
  return nullptr;
}

void LifeColumns::append(const Life& life) {
  birth.push_back(life.birth), end.push_back(life.end);
  chain.push_back(life.chain), rate.push_back(life.rate);
  anchor.push_back(life.anchor.triangle);
  for (const float x : {life.anchor.u, life.anchor.v}) uv.push_back(x);
  for (const float x : {life.turn.x, life.turn.y, life.turn.z, life.turn.w}) turn.push_back(x);
  moving = moving || life.anchor.triangle != kNoTriangle;
}

void LifeColumns::add_to(TensorWriter& file) const {
  file.add<std::int32_t>("birth", birth);
  file.add<std::int32_t>("end", end);
  file.add<std::uint32_t>("chain", chain);
  file.add<float>("rate", rate);
  if (!moving) return;
  file.add<std::uint32_t>("anchor", anchor);
  file.add<float>("anchor_uv", uv);
  file.add<float>("anchor_turn", turn);
}

std::vector<Life> read_lives(const TensorReader& file) {
  const auto birth = file.values<std::int32_t>("birth"), end = file.values<std::int32_t>("end");
  const auto chain = file.values<std::uint32_t>("chain");
  const auto rate = file.values<float>("rate");
  std::vector<Life> lives(birth.size());
  for (std::size_t i = 0; i < lives.size(); ++i) {
    lives[i].birth = birth[i], lives[i].end = end[i];
    lives[i].chain = chain[i], lives[i].rate = rate[i];
  }
  if (!file.has("anchor")) return lives;
  const auto anchor = file.values<std::uint32_t>("anchor");
  const auto uv = file.values<float>("anchor_uv"), turn = file.values<float>("anchor_turn");
  for (std::size_t i = 0; i < lives.size(); ++i) {
    lives[i].anchor = {anchor[i], uv[2 * i], uv[2 * i + 1]};
    lives[i].turn = {turn[4 * i + 3], turn[4 * i], turn[4 * i + 1], turn[4 * i + 2]};
  }
  return lives;
}

std::vector<Alive> alive_at(std::size_t n, const std::function<const Life&(std::size_t)>& life,
                            const FilmInfo& film, std::int64_t frame) {
  std::vector<Alive> alive;
  const auto follows = [&](std::size_t i) {
    return life(i).chain == life(i - 1).chain && life(i).birth == life(i - 1).end;
  };
  // Record by record that follow one another.
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    end = begin + 1;
    while (end < n && follows(end)) ++end;
    const std::int64_t birth = life(begin).birth, death = life(end - 1).end;
    if (frame < birth || frame >= death) continue;
    std::size_t i = begin;
    while (life(i).end <= frame) ++i;
    alive.push_back({i, fade_at(frame, birth, death, film)});
  }
  return alive;
}

Json film_header(const FilmInfo& film, const LifeColumns& lives) {
  const auto frames = static_cast<std::size_t>(film.frames.count());
  PHOS_CHECK(film.scene_hash.size() == frames, film.scene_hash.size(), " hashes of ", frames, " frames");
  Json j;
  j["frames"] = Json::Array{film.frames.first, film.frames.last};
  j["temporal_accuracy"] = film.temporal_accuracy;
  j["max_life"] = film.max_life;
  j["gradients"] = name_of(film.gradients);
  j["fade"] = film.fade;
  j["scene_hash"] = Json::Array(film.scene_hash.begin(), film.scene_hash.end());
  std::int64_t chains = 0, lived = 0;
  const std::size_t n = lives.birth.size();
  for (std::size_t i = 0; i < n; ++i) {
    chains += i == 0 || lives.chain[i] != lives.chain[i - 1];
    lived += std::int64_t{lives.end[i]} - lives.birth[i];
  }
  j["chains"] = chains;
  if (n > 0) j["mean_life"] = static_cast<double>(lived) / static_cast<double>(n);
  return j;
}

FilmInfo read_film_info(const Container& file) {
  require_form(FileForm::film, file);
  const Json& film = *file.provenance().extra.find(name_of(FileForm::film));
  const auto refuse = [&](const std::string& name) {
    throw Error(ExitCode::bad_input, file.path(),
                text("its header does not say the film's ", name, "; make the file again"));
  };
  const auto integer = [&](const char* name, const Json* value) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max() - 1;
    if (!value || !value->is_integer() || value->as_integer() < 0 || value->as_integer() > kMost)
      refuse(name);
    return value->as_integer();
  };
  FilmInfo info;
  const std::optional<double> accuracy = accuracy_of(file);
  if (!accuracy) refuse(kAccuracyEntry);
  info.accuracy = *accuracy;
  const Json* frames = film.find("frames");
  if (!frames || !frames->is_array() || frames->as_array().size() != 2) refuse("frames");
  info.frames = {integer("frames", &frames->as_array()[0]), integer("frames", &frames->as_array()[1])};
  if (info.frames.count() < 1) refuse("frames");
  const Json* temporal = film.find("temporal_accuracy");
  if (!temporal || !temporal->is_number() || !(temporal->as_number() > 0)) refuse("temporal_accuracy");
  info.temporal_accuracy = temporal->as_number();
  info.max_life = integer("max_life", film.find("max_life"));
  if (info.max_life < 1) refuse("max_life");
  info.fade = integer("fade", film.find("fade"));
  const Json* gradients = film.find("gradients");
  constexpr TemporalGradients kAll[] = {TemporalGradients::none, TemporalGradients::extrapolated,
                                        TemporalGradients::interpolated};
  const auto found = std::find_if(std::begin(kAll), std::end(kAll), [&](TemporalGradients g) {
    return gradients && *gradients == Json(name_of(g));
  });
  if (found == std::end(kAll)) refuse("gradients");
  info.gradients = *found;
  const Json* hashes = film.find("scene_hash");
  if (!hashes || !hashes->is_array() ||
      hashes->as_array().size() != static_cast<std::size_t>(info.frames.count()))
    refuse("scene_hash of each frame");
  for (const Json& hash : hashes->as_array()) {
    if (!hash.is_string()) refuse("scene_hash of each frame");
    info.scene_hash.push_back(hash.as_string());
  }
  return info;
}

}  // namespace phos::inline temporal
