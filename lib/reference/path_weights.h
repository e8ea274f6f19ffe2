// Weights of all the ways in which one path of light can be made from both ends (balance heuristic), from few
// numbers a vertex.
//
// A sub-path grows vertex by vertex from a lamp or from an eye. f_i is the area density with which vertex i
// was made, g'_i = |cos_i| / d^2 the geometry factor back along the edge to i+1, rho_i the density per sr
// with which i sends back to i-1 when entered from i+1. Summed over all strategies that leave the end of the
// sub-path to the other side, the densities over the density of the connection at vertex i are
//   b_i (U_i + rho_i V_i),   U_i = kappa_i / f_i + eta_i,   V_(i+1) = (g'_i / f_(i+1)) (U_i + rho_i V_i),
// where b_i is the area density with which the other side would make i, kappa_i is 1 where i-1 and i can be
// connected (neither scatters as a mirror does), and eta_i = (light paths an eye path) x pi r^2 where the two
// ends of a path may be merged at i within r, else 0. These are dVCM, dVC and dVM of Georgiev, Krivanek,
// Davidovic and Slusallek 2012 in one; without merging, Veach 1997, chapter 10. In double: densities span the
// squares of distances from 1e-6 to 1e6 m.
#pragma once

namespace phos::inline reference {

/// Numbers of the last vertex of a sub-path.
struct SubPathEnd {
  double connect = 0;  ///< kappa / f
  double merge = 0;    ///< eta
  double before = 0;   ///< V

  /// b (U + rho V): all strategies in which the other side makes this vertex too, over this one.
  double left_to_the_other(double b, double rho) const { return b * (connect + merge + rho * before); }
  /// V of the next vertex. `back` = g'_i / f_(i+1). At a mirror there is neither connection nor merging.
  double next_before(double back, double rho, bool mirror) const {
    return back * ((mirror ? 0 : connect + merge) + rho * before);
  }
  /// Strategies in which the paths are connected on this side of a vertex that they are merged at, over the
  /// merging.
  double instead_of_merging(double eta, double rho) const { return (connect + rho * before) / eta; }
};

/// Weight of a strategy from the sums over those that leave more to one side and to the other.
inline double balance(double one_side, double other_side) { return 1 / (1 + one_side + other_side); }

}  // namespace phos::inline reference
