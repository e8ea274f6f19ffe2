// Regular grids of sensors: on a surface of the scene, or as a horizontal workplane.
#pragma once

#include <optional>
#include <string>

#include "core/options.h"
#include "sense/sensors.h"

namespace phos::inline sense {

enum class Axis { x, y, z };

struct GridOptions {
  std::optional<double> spacing_m;
  std::string mesh;                ///< name of the node whose surfaces carry the grid
  std::optional<double> height_m;  ///< of a workplane over the floor
  double margin_m = 0;
  Axis up = Axis::y;
};

void declare_options(Options& options, GridOptions& grid);

/// Throws Error(usage) unless the sensors are either in a file or on one kind of grid.
void check(const GridOptions& grid, const std::string& points_path);
/// From the file if there is one, else on the grid. Points of a grid that are in solid glass are left out, as
/// those of a workplane in other solids are. Throws Error(bad_input) for a point of the file that is in solid
/// glass.
Sensors find_sensors(const std::string& points_path, const GridOptions& grid, const RayScene& rays);

/// The lowest surface that faces up and is level, at least a hundredth of the scene's plan in size; the
/// bottom of the scene if there is none. m along `up`. A double-sided surface that faces down counts where no
/// inside of a solid lies above it: floors of building models whose fronts face outwards.
float floor_level_m(const RayScene& rays, Axis up);

/// On the front of the node's surfaces. A flat piece that fills most of its smallest rectangle and has room
/// for four points, or is the whole mesh, has a grid of its own: along the rectangle's sides, centred, points
/// not nearer to them than the margin. Other pieces (of curved surfaces) have points as often as their area
/// asks, and no margin. Throws Error(usage) for an unknown node.
Sensors mesh_grid(const Scene& scene, const GridOptions& grid);

/// Facing up, height_m above the floor, centred in the scene's plan. Left out and counted: points with
/// nothing below, points inside of solids or behind walls, points nearer than the margin to any surface
/// beside them.
Sensors workplane(const RayScene& rays, const GridOptions& grid);

}  // namespace phos::inline sense
