// From functions of direction to coefficients and back.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "hsh/basis.h"
#include "hsh/quadrature.h"

namespace phos::inline hsh {

/// A function of a unit direction in the local frame, z up.
using DirectionalFunction = std::function<double(double x, double y, double z)>;

/// Coefficients c_i = integral f H_i dw (no cosine), by quadrature; count() of them. The quadrature must
/// cover the domain of the basis (the hemisphere for HSH; for SH of a function that is 0 below the horizon
/// too). Throws Error(usage) for a bad order, Error(numerical) where f is not finite.
std::vector<double> project(const DirectionalFunction& f, BasisKind kind, int order,
                            const Quadrature& quadrature);

/// From samples: direction k carries `value[k]`, drawn with density pdf[k] per sr: c = 1/N sum value H / pdf.
/// With uniform pdf the variances of all n^2 coefficients add up to (n^2 |f|^2 - |c|^2) / N, so that the
/// noise is n^2 / N of the energy: stratify. A sample with pdf <= 0 or anything that is not finite counts as
/// 0, and in `rejected`. Throws Error(usage) for a bad order.
std::vector<double> project_samples(BasisKind kind, int order, std::span<const double> x,
                                    std::span<const double> y, std::span<const double> z,
                                    std::span<const double> value, std::span<const double> pdf,
                                    std::size_t* rejected = nullptr);

/// sum c_i H_i at a direction; the order follows from coefficients.size(). Here and below: throws
/// Error(usage) where that is no square of an order.
double reconstruct(std::span<const double> coefficients, BasisKind kind, double x, double y, double z);

/// Energy (sum of squares) of each band.
std::vector<double> energy_by_band(std::span<const double> coefficients);
/// 1 - sum of squares of the bands below each order / energy: entry n-1 is the relative energy that order n
/// leaves out, clamped at 0. `energy` is the integral of f^2 over the domain.
std::vector<double> error_by_order(std::span<const double> coefficients, double energy);

/// Damping of high bands l against ringing, in place, with u = l / order: (1 + cos(pi u)) / 2 (hann),
/// sin(pi u) / (pi u) (lanczos). For display of incoming light alone: in shading it does harm.
enum class Window : unsigned char { none, hann, lanczos };
void apply_window(Window window, std::span<double> coefficients);

}  // namespace phos::inline hsh
