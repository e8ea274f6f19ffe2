#include "splat/picture/pixel_shader.h"

#include "radiance/tree.h"
#include "splat/events.h"

namespace phos::inline splat {

void ShadingResult::join(const ShadingResult& other) {
  looked_up += other.looked_up, missed += other.missed;
  gloss_looked_up += other.gloss_looked_up, gloss_missed += other.gloss_missed;
  log.counters.merge(other.log.counters);
  log.misses.insert(log.misses.end(), other.log.misses.begin(), other.log.misses.end());
  log.gloss_misses.insert(log.gloss_misses.end(), other.log.gloss_misses.begin(),
                          other.log.gloss_misses.end());
}

PixelShader::PixelShader(const RayScene& rays, const Shading& shading, const RenderOptions& options,
                         const Doublings& doublings, bool cached_direct,
                         const EnvironmentHarmonics* environment)
    : rays_(rays),
      shading_(shading),
      options_(options),
      doublings_(doublings),
      cached_direct_(cached_direct),
      shows_lux_(LayerSet(options.layers).has(Layer::illuminance)),
      environment_(environment) {}

PixelSample PixelShader::shade(const SampleOfPixel& sample, const Ray& ray, const SurfacePoint& point,
                               const Splat& splat, const SharedLight* shared, ShadingResult& result) const {
  PixelSample light;
  Bsdf bsdf(rays_.scene(), point);
  const Vec3 wo = -ray.direction;
  // What the samples of a pixel share, and each one's own.
  RandomStream sequence(options_.seed, Stage::direct_light, sample.pixel);
  if (sample.at_edge) sequence.start_bounce(1);
  const std::int64_t most = options_.pixel_samples + options_.edge_samples;
  const std::int64_t index = sample.index + (sample.at_edge ? options_.pixel_samples : 0);
  RandomStream random(options_.seed, Stage::specular,
                      sample.pixel * static_cast<std::uint64_t>(most) + static_cast<std::uint64_t>(index));
  light.emission = emitted_luminance(rays_.scene(), point, wo);
  light.albedo = bsdf.diffuse_reflectance();
  // Harmonics know lobes as tables do: before look_from().
  const bool by_rays = !from_environment(point, bsdf, wo, light, result.log);
  const bool trace_gloss = bsdf.has_gloss() && !gloss_from_cache(point, wo, splat, light, result);
  if (trace_gloss) bsdf.look_from(wo);
  if (bsdf.has_diffuse()) {
    ++result.looked_up;
    from_cache(point, bsdf, splat, light, result);
  } else if (shows_lux_) {
    lux_from_cache(point, bsdf, splat, light, result);
  }
  from_lights(sample, point, bsdf, wo, shared,
              options_.shadow_filter != ShadowFilter::none ? splat.lamps : nullptr, by_rays, trace_gloss,
              sequence, light);
  from_caustics(sample, point, bsdf, wo, bsdf.has_gloss() && !trace_gloss, light, result.log);
  if (bsdf.transmits_diffusely()) from_other_side(sample, point, bsdf, wo, sequence, light, result);
  if (trace_gloss) from_gloss(sample, point, bsdf, wo, by_rays, sequence, random, light, result.log);
  light.specular = shading_.specular(point, bsdf, wo, 0, Rgb(1), false, random, result.log);
  return light;
}

Interpolated PixelShader::from_records(const SurfacePoint& point) const {
  ShadingLog log;
  const Bsdf bsdf(rays_.scene(), point);
  const bool shows = bsdf.has_diffuse() || (shows_lux_ && is_dark(point, bsdf));
  const Interpolated found = shows ? shading_.cached(point, log) : Interpolated();
  return log.misses.empty() ? found : Interpolated();
}

bool PixelShader::is_dark(const SurfacePoint& point, const Bsdf& bsdf) const {
  return !bsdf.scatters() && !bsdf.has_specular() && !rays_.scene().material[point.material].emits();
}

PixelSample PixelShader::background(const Ray& ray) const {
  PixelSample light;
  light.emission = background_luminance(rays_.scene(), ray.direction);
  return light;
}

void PixelShader::from_cache(const SurfacePoint& point, const Bsdf& bsdf, const Splat& splat,
                             PixelSample& light, ShadingResult& result) const {
  Interpolated light_here = splat.found;
  light.weight = light_here.weight;
  if (!(light_here.weight > 0)) {
    // On the rim of a record rounding decides, and the lookup that places records has the last word: else
    // the loop over misses would ask for the same point for ever.
    const std::size_t misses = result.log.misses.size();
    light_here = shading_.cached(point, result.log);
    if (result.log.misses.size() > misses)
      ++result.missed;
    else
      light.weight = light_here.weight;
  }
  if (!(light_here.weight > 0)) return;
  const Rgb reflected = bsdf.diffuse_reflectance() / kPi;
  light.indirect = light_here.irradiance * reflected;
  light.indirect_error += light_here.stderr_lx * reflected;
  light.illuminance_lx += luminance(light_here.irradiance);
}

/// Where nothing is reflected diffusely, records light nothing but the layer of illuminance. They are placed
/// on black surfaces; lamps, mirrors, glass and metal have those that reach them.
void PixelShader::lux_from_cache(const SurfacePoint& point, const Bsdf& bsdf, const Splat& splat,
                                 PixelSample& light, ShadingResult& result) const {
  if (is_dark(point, bsdf)) {
    ++result.looked_up;
    return from_cache(point, bsdf, splat, light, result);
  }
  ShadingLog none;
  const Interpolated found = splat.found.weight > 0 ? splat.found : shading_.cached(point, none);
  if (found.weight > 0) light.illuminance_lx += luminance(found.irradiance);
}

bool PixelShader::gloss_from_cache(const SurfacePoint& point, const Vec3& wo, const Splat& splat,
                                   PixelSample& light, ShadingResult& result) const {
  Rgb radiance, error;
  if (splat.gloss.w > 0) {
    radiance = Rgb(splat.gloss) / splat.gloss.w, error = Rgb(splat.gloss_error) / splat.gloss.w;
  } else {
    // As of irradiance, the lookup has the last word.
    const std::size_t misses = result.log.gloss_misses.size();
    const std::optional<GlossyLight> found = shading_.recorded(point, wo, result.log);
    if (result.log.gloss_misses.size() > misses) ++result.gloss_looked_up, ++result.gloss_missed;
    if (!found) return false;
    radiance = found->radiance, error = found->stderr_cd;
  }
  ++result.gloss_looked_up;
  light.glossy += radiance;
  light.indirect_error += error;  // the same records may hold the light of the Lambert part: no quadrature
  return true;
}

/// Samples of a pixel that take turns to look for caustic photons, which they share: all see much the same of
/// them where no edge is.
int PixelShader::caustic_turns(const SampleOfPixel& sample) const {
  if (sample.at_edge) return 1;
  constexpr int kMost = 4;
  for (int turns = kMost; turns > 1; --turns)
    if (options_.pixel_samples % turns == 0) return turns;
  return 1;
}

/// What caustic photons bring to the diffuse lobe, and with `gloss` to those that read radiance records.
void PixelShader::from_caustics(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf,
                                const Vec3& wo, bool gloss, PixelSample& light, ShadingLog& log) const {
  const bool lux = bsdf.has_diffuse() || (shows_lux_ && bsdf.takes_light());
  if (!shading_.has_caustics() || !(lux || gloss)) return;
  const int turns = caustic_turns(sample);
  if ((static_cast<std::size_t>(sample.index) + sample.pixel) % static_cast<std::size_t>(turns) != 0) return;
  const auto stands_for = static_cast<float>(turns);
  const LocalDensity found = shading_.caustic(point, log, light.illuminance_lx);
  const Rgb reflected = stands_for * bsdf.diffuse_reflectance() / kPi, error = found.stderr_lx();
  light.indirect += found.irradiance * reflected;
  if (lux) light.illuminance_lx += stands_for * luminance(found.irradiance);
  Rgb unsure = error * reflected;
  if (gloss) {
    const Rgb shown = stands_for * CausticLight::gloss(found, bsdf, wo, log.caustics);
    light.glossy += shown;
    const float lux = luminance(found.irradiance);
    if (lux > 0) unsure += glm::abs(shown) * (luminance(error) / lux);
  }
  // Samples of a pixel share the photons, so that it does not average out; records know nothing of them.
  light.indirect_error = glm::sqrt(light.indirect_error * light.indirect_error + unsure * unsure);
}

/// The rays of each sample, of the rays for a whole pixel: at least one, if there are any.
int PixelShader::rays_of_each(bool at_edge, std::int64_t of_pixel) const {
  const std::int64_t samples = options_.pixel_samples + (at_edge ? options_.edge_samples : 0);
  return static_cast<int>((of_pixel + samples - 1) / samples);
}

bool PixelShader::single_rays(bool at_edge) const {
  return rays_of_each(at_edge, options_.light_samples) == 1 ||
         rays_of_each(at_edge, options_.gloss_samples) == 1;
}

/// This sample's part of the rays for the whole pixel.
SampleRange PixelShader::range(const SampleOfPixel& sample, std::int64_t of_pixel, int doublings) const {
  const int n = rays_of_each(sample.at_edge, of_pixel) << doublings;
  const std::int64_t group = sample.at_edge ? options_.edge_samples : options_.pixel_samples;
  return {sample.index * n, n, static_cast<int>(group) * n};
}

SampleRange PixelShader::lamp_range(const SampleOfPixel& sample) const {
  return range(sample, options_.light_samples, Doublings::of(doublings_.direct, sample.pixel));
}

SampleRange PixelShader::gloss_range(const SampleOfPixel& sample) const {
  return range(sample, options_.gloss_samples, Doublings::of(doublings_.gloss, sample.pixel));
}

bool PixelShader::from_environment(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                                   PixelSample& light, ShadingLog& log) const {
  if (!environment_ || !(bsdf.has_diffuse() || bsdf.has_gloss() || shows_lux_)) return false;
  const std::optional<EnvironmentHarmonics::Light> found = environment_->light(point, bsdf, wo);
  if (!found) return false;
  if (found->clamped) log.counters.count(kDarkerThanBlackEvent);
  light.direct += found->gloss;
  if (cached_direct_) return true;
  light.direct += found->irradiance_lx * bsdf.diffuse_reflectance() / kPi;
  light.illuminance_lx += luminance(found->irradiance_lx);
  return true;
}

void PixelShader::from_lights(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf,
                              const Vec3& wo, const SharedLight* shared, const LampsAt* lamps,
                              bool environment, bool gloss_by_rays, RandomStream& sequence,
                              PixelSample& light) const {
  const bool diffuse = bsdf.has_diffuse() && !cached_direct_;
  if (options_.direct == DirectBy::none) return;
  if (!(diffuse || bsdf.has_gloss())) {
    if (shows_lux_ && !cached_direct_) lux_from_lights(sample, point, bsdf, wo, shared, environment, light);
    return;
  }
  from_mirrors(sample, point, bsdf, wo, gloss_by_rays, sequence, light);
  // What lamps show in gloss is not shared. Where rays look for gloss anyway, shadow maps leave it to them.
  const bool own = bsdf.has_gloss() && !lamps && (options_.direct == DirectBy::interleaved || !gloss_by_rays);
  // Rays that look for gloss find lamps with an area, and no others.
  if (lamps && bsdf.has_gloss())
    light.direct += lamps->point_gloss + (gloss_by_rays ? Rgb(0) : lamps->extended_gloss);
  if (shared && !own) {
    if (cached_direct_) return;
    const Rgb reflected = bsdf.diffuse_reflectance() / kPi;
    light.direct += shared->illuminance * reflected;
    light.variance += shared->variance * DVec3(reflected) * DVec3(reflected);
    if (options_.direct == DirectBy::interleaved) light.noisy += shared->illuminance * reflected;
    light.illuminance_lx += luminance(shared->illuminance);
    return;
  }
  const DirectLight direct =
      shading_.direct(point, bsdf, wo, lamp_range(sample), gloss_by_rays ? gloss_range(sample).count : 0,
                      sequence, environment);
  light.direct += direct.radiance;
  light.noisy += direct.radiance;
  light.variance += direct.variance;
  if (!cached_direct_) light.illuminance_lx += luminance(direct.illuminance);
}

/// Lamps on surfaces that reflect nothing of them, such as black surfaces, mirrors and clear glass.
void PixelShader::lux_from_lights(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf,
                                  const Vec3& wo, const SharedLight* shared, bool environment,
                                  PixelSample& light) const {
  // Own random numbers: other layers are the same without this one.
  RandomStream own(options_.seed, Stage::direct_light, sample.pixel);
  if (sample.at_edge) own.start_bounce(1);
  const SampleRange rays = lamp_range(sample);
  light.illuminance_lx += luminance(shading_.mirrored(point, bsdf, wo, false, rays, own).illuminance);
  light.illuminance_lx += luminance(
      shared ? shared->illuminance : shading_.direct(point, bsdf, wo, rays, 0, own, environment).illuminance);
}

/// What comes through a sheet of the light on its other side, which no splat tells of.
void PixelShader::from_other_side(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf,
                                  const Vec3& wo, RandomStream& sequence, PixelSample& light,
                                  ShadingResult& result) const {
  const Shading::Through through =
      shading_.through(point, bsdf, wo, lamp_range(sample), sequence, result.log);
  ++result.looked_up;
  result.missed += through.missed;
  light.indirect += through.indirect;
  light.indirect_error += through.indirect_stderr;
  if (options_.direct == DirectBy::none) return;
  light.direct += through.direct.radiance;
  light.noisy += through.direct.radiance;
  light.variance += through.direct.variance;
}

void PixelShader::from_mirrors(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf,
                               const Vec3& wo, bool gloss_by_rays, RandomStream& sequence,
                               PixelSample& light) const {
  const DirectLight mirrored =
      shading_.mirrored(point, bsdf, wo, gloss_by_rays, lamp_range(sample), sequence);
  light.direct += mirrored.radiance;
  light.noisy += mirrored.radiance;
  if (!cached_direct_) light.illuminance_lx += luminance(mirrored.illuminance);
}

void PixelShader::from_gloss(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf,
                             const Vec3& wo, bool environment, RandomStream& sequence, RandomStream& random,
                             PixelSample& light, ShadingLog& log) const {
  // Shadow maps light diffuse surfaces only: the lamps in glossy surfaces are left to these rays.
  const int light_samples = options_.direct == DirectBy::traced || options_.direct == DirectBy::interleaved
                                ? lamp_range(sample).count
                                : 0;
  const GlossLight gloss = shading_.gloss(point, bsdf, wo, gloss_range(sample), light_samples, 0, sequence,
                                          random, log, environment);
  light.glossy += gloss.radiance;
  light.noisy += gloss.radiance;
  light.variance += gloss.variance;
  if (options_.direct == DirectBy::none) return;
  light.direct += gloss.from_lamps;
  light.noisy += gloss.from_lamps;
}

}  // namespace phos::inline splat
