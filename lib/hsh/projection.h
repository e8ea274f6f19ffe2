// From functions of direction to coefficients and back.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "hsh/basis.h"
#include "hsh/quadrature.h"

namespace phos {

/// A function of a unit direction in the local frame, z up.
using DirectionalFunction = std::function<double(double x, double y, double z)>;

/// Coefficients c_i = integral f H_i dw (no cosine), by quadrature; count() of them. The quadrature must
/// cover the domain of the basis (the hemisphere for HSH). Throws Error(usage) for a bad order.
std::vector<double> project(const DirectionalFunction& f, BasisKind kind, int order,
                            const Quadrature& quadrature);

/// From samples: direction k carries `value[k]`, drawn with density pdf[k] per sr: c = 1/N sum value H / pdf.
/// A sample with pdf <= 0 or a value that is not finite is left out and counted in `rejected`.
std::vector<double> project_samples(BasisKind kind, int order, std::span<const double> x,
                                    std::span<const double> y, std::span<const double> z,
                                    std::span<const double> value, std::span<const double> pdf,
                                    std::size_t* rejected = nullptr);

/// sum c_i H_i at a direction; the order is that of coefficients.size().
double reconstruct(std::span<const double> coefficients, BasisKind kind, double x, double y, double z);

/// Energy (sum of squares) of each band.
std::vector<double> energy_by_band(std::span<const double> coefficients);
/// 1 - sum of squares of the bands below each order / energy: entry n-1 is what order n leaves out, relative,
/// clamped at 0. `energy` is the integral of f^2 over the domain.
std::vector<double> error_by_order(std::span<const double> coefficients, double energy);

/// Damping of high bands against ringing, in place. For display of incoming light alone: in shading it does
/// harm.
enum class Window : unsigned char { none, hann, lanczos };
void apply_window(Window window, std::span<double> coefficients);

}  // namespace phos
