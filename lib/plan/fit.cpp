#include "plan/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/random.h"

namespace phos::inline plan {
namespace {

/// A pivot this much smaller than its column's own square sum: the column is told by those before it.
constexpr double kCollinear = 1e-9;

/// Rows over sigma, columns scaled to length 1.
struct Normal {
  std::size_t terms = 0;
  std::vector<double> matrix, right, length;  ///< A^T A, A^T b, of columns
  double squares = 0;                         ///< b^T b

  explicit Normal(std::span<const FitRow> rows) {
    terms = rows.empty() ? 0 : rows[0].term.size();
    PHOS_CHECK(terms <= kMaxTerms, "terms = ", terms);
    length.assign(terms, 0), right.assign(terms, 0), matrix.assign(terms * terms, 0);
    for (const FitRow& row : rows) {
      PHOS_CHECK(row.term.size() == terms && row.sigma > 0, "terms ", row.term.size(), ", sigma ", row.sigma);
      for (std::size_t i = 0; i < terms; ++i)
        length[i] += row.term[i] * row.term[i] / (row.sigma * row.sigma);
    }
    for (double& l : length) l = std::sqrt(l);
    for (const FitRow& row : rows) {
      const double b = row.value / row.sigma;
      squares += b * b;
      for (std::size_t i = 0; i < terms; ++i) {
        const double x = scaled(row, i);
        right[i] += x * b;
        for (std::size_t j = 0; j < terms; ++j) matrix[i * terms + j] += x * scaled(row, j);
      }
    }
  }
  double scaled(const FitRow& row, std::size_t i) const {
    return length[i] > 0 ? row.term[i] / (row.sigma * length[i]) : 0;
  }
};

/// Solves for the terms of `set` by Cholesky's method. False if they are not told apart, or one is negative.
bool solve(const Normal& n, const std::vector<std::size_t>& set, std::vector<double>& x) {
  const auto k = static_cast<Eigen::Index>(set.size());
  Eigen::MatrixXd matrix(k, k);
  Eigen::VectorXd right(k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const std::size_t row = set[static_cast<std::size_t>(i)];
    right[i] = n.right[row];
    for (Eigen::Index j = 0; j < k; ++j)
      matrix(i, j) = n.matrix[row * n.terms + set[static_cast<std::size_t>(j)]];
  }
  const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
  if (cholesky.info() != Eigen::Success ||
      !(cholesky.matrixLLT().diagonal().array().square() > kCollinear).all())
    return false;
  const Eigen::VectorXd solution = cholesky.solve(right);
  x.assign(solution.begin(), solution.end());
  return std::all_of(x.begin(), x.end(), [](double v) { return v >= 0 && std::isfinite(v); });
}

double chi2(std::span<const FitRow> rows, const std::vector<double>& c) {
  double sum = 0;
  for (const FitRow& row : rows) {
    double d = -row.value;
    for (std::size_t i = 0; i < c.size(); ++i) d += c[i] * row.term[i];
    sum += d * d / (row.sigma * row.sigma);
  }
  return sum;
}

/// Standard normal, by Box and Muller.
double normal(RandomStream& random) {
  const double u = 1 - random.uniform_double(), v = random.uniform_double();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

}  // namespace

std::vector<double> fit_nonnegative(std::span<const FitRow> rows) {
  const Normal n(rows);
  std::vector<double> best(n.terms, 0), x;
  double least = n.squares;
  std::vector<std::size_t> set;
  for (std::size_t mask = 1; mask < std::size_t{1} << n.terms; ++mask) {
    set.clear();
    for (std::size_t i = 0; i < n.terms; ++i)
      if (mask >> i & 1) set.push_back(i);
    if (!solve(n, set, x)) continue;
    double left = n.squares;  // b^T b - x^T A^T b
    for (std::size_t i = 0; i < set.size(); ++i) left -= x[i] * n.right[set[i]];
    if (!(left < least - 1e-12 * n.squares)) continue;
    least = left;
    std::fill(best.begin(), best.end(), 0.0);
    for (std::size_t i = 0; i < set.size(); ++i) best[set[i]] = x[i] / n.length[set[i]];
  }
  return best;
}

Fit fit_with_draws(std::span<const FitRow> rows, std::size_t draws, std::uint64_t seed) {
  Fit fit;
  fit.best = fit_nonnegative(rows);
  const auto used = static_cast<std::size_t>(
      std::count_if(fit.best.begin(), fit.best.end(), [](double c) { return c > 0; }));
  if (rows.size() > used)
    fit.misfit = std::max(1.0, std::sqrt(chi2(rows, fit.best) / static_cast<double>(rows.size() - used)));
  std::vector<FitRow> moved(rows.begin(), rows.end());
  for (std::size_t i = 0; i < draws; ++i) {
    RandomStream random(seed, Stage::pilot, i);
    for (std::size_t r = 0; r < moved.size(); ++r)
      moved[r].value = rows[r].value + fit.misfit * rows[r].sigma * normal(random);
    fit.draws.push_back(fit_nonnegative(moved));
  }
  if (draws > 0) std::fill(fit.best.begin(), fit.best.end(), 0.0);
  for (const std::vector<double>& draw : fit.draws)
    for (std::size_t c = 0; c < draw.size(); ++c) fit.best[c] += draw[c] / static_cast<double>(draws);
  return fit;
}

}  // namespace phos::inline plan
