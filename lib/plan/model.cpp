#include "plan/model.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline plan {
namespace {

constexpr double kNormal95 = 1.6449;  ///< 95th percentile of the standard normal distribution

}  // namespace

const char* name_of(Knob knob) {
  constexpr const char* kNames[] = {"photons",      "accuracy",      "rays",         "pixel_samples",
                                    "edge_samples", "light_rays",    "gloss_rays",   "sensor_rays",
                                    "records",      "gloss_records", "records_read", "pixels"};
  return kNames[at(knob)];
}

double Monomial::at(const Knobs& knobs) const {
  double product = 1;
  for (const auto& [knob, power] : powers) product *= std::pow(knobs[phos::at(knob)], power);
  return product;
}

void Posynomial::fit(std::span<const Observation> observations, std::uint64_t seed) {
  std::vector<FitRow> rows;
  for (const Observation& o : observations) {
    FitRow& row = rows.emplace_back(FitRow{{}, o.value, o.sigma});
    for (const Monomial& term : terms_) row.term.push_back(term.at(o.knobs));
  }
  if (rows.empty()) return set(std::vector<double>(terms_.size(), 0));
  fit_ = fit_with_draws(rows, kDraws, seed);
}

void Posynomial::fit_noise(std::vector<Observation> observations, std::uint64_t seed) {
  constexpr int kPasses = 3;
  double doubt2 = 0, n = 0;
  for (const Observation& o : observations)
    if (o.value > 0) doubt2 += std::pow(o.sigma / o.value, 2), n += 1;
  fit(observations, seed);
  for (int pass = 1; pass < kPasses && n > 0; ++pass) {
    std::vector<double> sigma;
    for (const Observation& o : observations) sigma.push_back(std::sqrt(doubt2 / n) * best(o.knobs));
    if (*std::min_element(sigma.begin(), sigma.end()) <= 0) return;
    for (std::size_t i = 0; i < sigma.size(); ++i) observations[i].sigma = sigma[i];
    fit(observations, seed);
  }
}

void Posynomial::set(std::vector<double> coefficients) {
  PHOS_CHECK(coefficients.size() == terms_.size(), coefficients.size(), " for ", terms_.size(), " terms");
  fit_ = {coefficients, std::vector<std::vector<double>>(kDraws, coefficients), 1};
}

void Posynomial::scale(std::size_t guess, double factor) {
  for (double& c : fit_.of(guess)) c *= factor;
}

void Posynomial::extend(const std::string& like, Monomial term, double factor) {
  const auto found =
      std::find_if(terms_.begin(), terms_.end(), [&](const Monomial& m) { return m.what == like; });
  if (found == terms_.end()) return;
  const auto i = static_cast<std::size_t>(found - terms_.begin());
  terms_.push_back(std::move(term));
  if (fit_.best.empty()) return;  // not fitted yet
  for (std::size_t guess = 0; guess <= kDraws; ++guess) fit_.of(guess).push_back(factor * fit_.of(guess)[i]);
}

void Posynomial::add(std::size_t guess, std::size_t i, double more) { fit_.of(guess)[i] += more; }

double Posynomial::value(const Knobs& knobs, std::size_t guess) const {
  const std::vector<double>& coefficients = fit_.of(guess);
  double sum = 0;
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    if (coefficients[i] > 0) sum += coefficients[i] * terms_[i].at(knobs);
  return sum;
}

std::vector<double> Posynomial::parts(const Knobs& knobs) const {
  std::vector<double> out;
  for (std::size_t i = 0; i < terms_.size(); ++i)
    out.push_back(fit_.best.empty() ? 0 : fit_.best[i] * terms_[i].at(knobs));
  return out;
}

double PlanModel::best(const Knobs& knobs) const {
  double sum = 0;
  for (const auto& [name, p] : part) sum += p.best(knobs);
  return sum;
}

Interval PlanModel::predict(const Knobs& knobs, double doubt) const {
  std::vector<double> sums(Posynomial::kDraws, 0);
  for (const auto& [name, p] : part)
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += p.value(knobs, i);
  std::sort(sums.begin(), sums.end());
  Interval interval;
  interval.value = best(knobs);
  const double low = std::min(sums[sums.size() / 20], interval.value),
               high = std::max(sums[sums.size() - 1 - sums.size() / 20], interval.value);
  if (measured > 0) doubt *= std::min(1.0, std::fabs(interval.value / measured - 1));
  const double own = kNormal95 * doubt * interval.value;  // independent of the measurements: in quadrature
  interval.low = std::max(0.0, interval.value - std::hypot(interval.value - low, own));
  interval.high = interval.value + std::hypot(high - interval.value, own);
  return interval;
}

Posynomial* PlanModel::find(const std::string& name) {
  for (auto& [n, p] : part)
    if (n == name) return &p;
  return nullptr;
}

const Posynomial* PlanModel::find(const std::string& name) const {
  return const_cast<PlanModel*>(this)->find(name);
}

Json PlanModel::to_json(const Knobs& knobs) const {
  Json out = Json::Object{};
  for (const auto& [name, p] : part) {
    Json terms = Json::Array{};
    const std::vector<double> values = p.parts(knobs);
    for (std::size_t i = 0; i < p.terms().size(); ++i) {
      Json term;
      term["what"] = p.terms()[i].what;
      Json powers = Json::Object{};
      for (const auto& [knob, power] : p.terms()[i].powers) powers[name_of(knob)] = power;
      term["powers"] = powers;
      term["coefficient"] = i < p.coefficients().size() ? p.coefficients()[i] : 0.0;
      term["value"] = values[i];
      terms.push_back(term);
    }
    out[name] = terms;
  }
  return out;
}

}  // namespace phos::inline plan
