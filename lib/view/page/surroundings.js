// Cube maps of the scene about curved mirrors and glass, and about flat ones that have no view of their own.
import {add, cross, length, matrixOfRows, scale, subtract} from './vector.js';

const MOST = 6;                // cube maps
const SIDE = 256;
const X = [1, 0, 0], Y = [0, 1, 0], Z = [0, 0, 1], minus = (v) => scale(v, -1);
const FACES = [[minus(Z), minus(Y)], [Z, minus(Y)], [X, Z], [X, minus(Z)], [X, minus(Y)], [minus(X), minus(Y)]];  // right, up

const faceEye = (position, [right, up]) => ({
  position, perspective: true, halfHeight: 1, backward: () => cross(right, up), axes: () => matrixOfRows(right, up, cross(right, up)),
});

// Bounds of a part.
function boundsOf(part, {vertex, triangle}) {
  const lo = [Infinity, Infinity, Infinity], hi = [-Infinity, -Infinity, -Infinity];
  for (let i = 3 * part.first; i < 3 * (part.first + part.count); ++i)
    for (let k = 0; k < 3; ++k) {
      const v = vertex.position[3 * triangle.corner[i] + k];
      lo[k] = Math.min(lo[k], v), hi[k] = Math.max(hi[k], v);
    }
  return {lo, hi};
}

export class Surroundings {
  constructor(gl, scene, mesh) {
    Object.assign(this, {gl, mesh});
    const parts = mesh.shiny.map((part) => {
      const {lo, hi} = boundsOf(part, scene);
      return {part, middle: scale(add(lo, hi), 0.5), size: length(subtract(hi, lo))};
    }).sort((a, b) => b.size - a.size);
    this.probes = [];
    for (const {part, middle, size} of parts) {
      const apart = (probe) => length(subtract(probe.middle, middle));
      const nearest = this.probes.reduce((best, probe) => !best || apart(probe) < apart(best) ? probe : best, null);
      if (nearest && (this.probes.length === MOST || apart(nearest) < 0.5 * size)) nearest.parts.push(part);
      else this.probes.push({middle, parts: [part], map: null});
    }
  }

  // Draws the maps of the parts that need one, once for each `state` of the light.
  prepare(drawing, accuracy, state, taken) {
    this.others = new Set(this.mesh.shiny.filter((part) => !taken.some((plane) => plane.parts.includes(part))));
    const needed = this.probes.filter((probe) => probe.parts.some((part) => this.others.has(part)));
    const missing = needed.filter((probe) => probe.state !== state);
    if (!missing.length) return;
    const gl = this.gl;
    drawing.withTargets(SIDE, SIDE, () => {
      for (const probe of missing) {
        probe.map ??= gl.createTexture();
        gl.bindTexture(gl.TEXTURE_CUBE_MAP, probe.map);
        if (!probe.state) gl.texStorage2D(gl.TEXTURE_CUBE_MAP, 1, gl.RGBA32F, SIDE, SIDE);
        for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_CUBE_MAP, name, drawing.floatFilter);
        const own = new Set(probe.parts);
        FACES.forEach((face, i) => {
          drawing.lightOf(drawing.viewOf(faceEye(probe.middle, face), SIDE, SIDE), accuracy,
                          this.mesh.parts.filter((part) => !own.has(part)), drawing.sets.slice(0, 1));
          drawing.bakeFace(probe.map, i, SIDE);
        });
        probe.state = state;
      }
    });
  }

  // Adds what the parts of a kind reflect to the bound target.
  shine(program, view, drawn) {
    for (const probe of this.probes)
      if (probe.map)
        this.mesh.draw(program, {...view, by_cube: true, cube_middle: probe.middle, cube_map: {unit: 3, target: this.gl.TEXTURE_CUBE_MAP, id: probe.map}},
                       probe.parts.filter((part) => this.others.has(part) && drawn(part)));
  }
}
