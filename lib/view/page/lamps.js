// The places that lamps shine from, each with its shadow maps, which are drawn once.
import {makeTexture} from './gl.js';
import {drawVeils} from './lamp_veils.js';
import {across, add, dot, length, matrixOfRows, normalized, row, scale, subtract} from './vector.js';

const SPOT = 2, DIRECTIONAL = 3;  // PlaceShape
const MAP_BYTES = 384 << 20;                // of all maps together
const MAP_TEXELS_A_PIXEL = 4;               // of a side of a map, to those of the picture
const SHARE_WIDTH = 361, SHARE_HEIGHT = 181;

const looking = (forward, up) => {
  const right = [forward[1] * up[2] - forward[2] * up[1], forward[2] * up[0] - forward[0] * up[2],
                 forward[0] * up[1] - forward[1] * up[0]];
  return matrixOfRows(right, up, scale(forward, -1));
};

// A direction off the axis of a lamp and off the walls about it. A surface that crosses the plane of a view close to
// a corner of its own loses its depth to rounding, and walls do so at the plane of a lamp in a ceiling.
function oblique(forward) {
  const [x, y] = across(forward);
  return normalized(add(forward, add(scale(x, 0.45), scale(y, 0.31))));
}

// Forward, four sides, backward.
function cubeAxes(forward) {
  const [x, y] = across(forward), z = forward, minus = (v) => scale(v, -1);
  return [looking(z, x), looking(x, z), looking(minus(x), z), looking(y, z), looking(minus(y), z), looking(minus(z), x)];
}

export class Lamps {
  // `program` draws depths, `veilProgram` the light that panes let through. `side`: pixels on the longer side of the picture.
  constructor(gl, scene, mesh, program, veilProgram, side) {
    Object.assign(this, {gl, mesh, program, veilProgram});
    this.lo = row(scene.scene.bounds_lo, 0), this.hi = row(scene.scene.bounds_hi, 0);
    this.shares = Array.from({length: scene.distribution.rows}, (_, i) => this.#makeShare(scene.distribution, i));
    this.places = Array.from({length: scene.sample.rows}, (_, i) => this.#place(scene.sample, i));
    this.#setSpacings(scene.sample);
    const faces = this.places.reduce((sum, place) => sum + place.axes.length, 0);
    this.size = 2048;
    const texel = mesh.panes.length ? 16 : 4;  // bytes
    while (this.size > 128 && (faces * this.size * this.size * texel > MAP_BYTES || this.size > MAP_TEXELS_A_PIXEL * side)) this.size /= 2;
    this.drawn = 0;
  }

  #makeShare({axes, share}, i) {
    const gl = this.gl, id = makeTexture(gl, gl.R32F, SHARE_WIDTH, SHARE_HEIGHT), size = SHARE_WIDTH * SHARE_HEIGHT;
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, SHARE_WIDTH, SHARE_HEIGHT, gl.RED, gl.FLOAT,
                     share.subarray(i * size, (i + 1) * size));
    const a = row(axes, i, 9);
    return {id, axes: matrixOfRows(a.slice(0, 3), a.slice(3, 6), a.slice(6, 9))};
  }

  #corners() {
    return Array.from({length: 8}, (_, i) => [0, 1, 2].map((k) => (i >> k & 1 ? this.hi : this.lo)[k]));
  }

  #place(sample, i) {
    const shape = sample.shape[i], forward = row(sample.forward, i), share = this.shares[sample.distribution[i]];
    const place = {
      lamp: sample.lamp[i], shape, forward, colour: row(sample.colour, i), cone: row(sample.cone, i, 2), two_sided: sample.two_sided[i] !== 0,
      share: share?.id ?? null, luminaire_axes: share?.axes ?? [1, 0, 0, 0, 1, 0, 0, 0, 1],
      eye: row(sample.position, i), perspective: shape !== DIRECTIONAL,
    };
    if (shape === DIRECTIONAL) return this.#directional(place);
    const narrow = shape === SPOT && place.cone[0] > 0.64;
    const cosine = Math.min(place.cone[0], 1 - 1e-6);
    const half = narrow ? 1.02 * Math.sqrt(1 - cosine * cosine) / cosine : 1;
    place.axes = narrow ? cubeAxes(forward).slice(0, 1) : cubeAxes(oblique(forward));
    place.lens = [1 / half, 1 / half, 0, 0];
    place.farthest = Math.max(...this.#corners().map((c) => length(subtract(c, place.eye))));
    // Depth along the view of the nearest point, which may lie in a corner of the picture.
    place.nearest = 0.999 * sample.nearest[i] / Math.sqrt(1 + 2 * half * half);
    place.half = half;
    return place;
  }

  // Half the distance from a place to the nearest of the same lamp, or half the angle.
  #setSpacings({lamp}) {
    const between = (a, b) => a.shape === DIRECTIONAL ? Math.acos(Math.min(1, dot(a.forward, b.forward))) : length(subtract(a.eye, b.eye));
    this.places.forEach((place, i) => {
      let nearest = Infinity;
      for (let k = 0; k < this.places.length; ++k)
        if (k !== i && lamp[k] === lamp[i] && this.places[k].shape === place.shape) nearest = Math.min(nearest, between(place, this.places[k]));
      place.spacing = Number.isFinite(nearest) ? nearest / 2 : 0;
    });
  }

  // Parallel views hold the whole scene.
  #directional(place) {
    const eye = scale(add(this.lo, this.hi), 0.5), [x, y] = across(place.forward);
    const extent = (axis) => Math.max(...this.#corners().map((c) => Math.abs(dot(subtract(c, eye), axis)))) * 1.01;
    const width = extent(y), height = extent(x), radius = length(subtract(this.hi, this.lo)) / 2 * 1.01;
    return Object.assign(place, {
      eye, axes: [looking(place.forward, x)], lens: [1 / width, 1 / height, 0, 0], farthest: radius, nearest: 0,
      half: Math.max(width, height), radius,
    });
  }

  #drawMaps(place) {
    const gl = this.gl;
    place.maps = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, place.maps);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.DEPTH_COMPONENT32F, this.size, this.size, place.axes.length);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D_ARRAY, name, gl.NEAREST);
    const framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.viewport(0, 0, this.size, this.size);
    place.axes.forEach((axes, face) => {
      gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, place.maps, 0, face);
      gl.drawBuffers([gl.NONE]);
      gl.clearBufferfv(gl.DEPTH, 0, [1]);
      this.mesh.draw(this.program, {
        eye: place.eye, axes, lens: place.lens, range: [place.nearest, place.farthest], perspective: place.perspective,
      });
    });
    gl.deleteFramebuffer(framebuffer);
    place.veils = this.mesh.panes.length ? drawVeils(gl, this.mesh, this.veilProgram, place, this.size) : null;
    // Half a texel: of the distance, or m.
    place.bias = place.perspective ? place.half / this.size : 0.5 * place.half * 2 / this.size + 1e-6 * place.radius;
  }

  // Draws the maps of some more places; true once all have them.
  prepare(most) {
    for (let n = 0; n < most && this.drawn < this.places.length; ++n) this.#drawMaps(this.places[this.drawn++]);
    return this.drawn === this.places.length;
  }

  // Adds the light of every place whose maps are drawn to the bound target. `weights`: of each lamp.
  light(program, textures, weights) {
    const gl = this.gl;
    program.use(textures);
    for (const place of this.places.slice(0, this.drawn)) {
      const weight = weights[place.lamp];
      if (!(weight > 0)) continue;
      program.use({
        shape: place.shape, colour: scale(place.colour, weight), forward: place.forward, cone: place.cone, two_sided: place.two_sided,
        eye: place.eye, lens: place.lens, farthest: place.farthest, bias: place.bias, spacing: place.spacing, face_count: place.axes.length,
        axes: place.axes.flat(), luminaire_axes: place.luminaire_axes,
        depth_map: {unit: 3, target: gl.TEXTURE_2D_ARRAY, id: place.maps}, veiled: place.veils !== null,
        veil_map: {unit: 14, target: gl.TEXTURE_2D_ARRAY, id: place.veils?.shares ?? place.maps},
        veil_depth_map: {unit: 15, target: gl.TEXTURE_2D_ARRAY, id: place.veils?.depths ?? place.maps},
        share_map: {unit: 4, target: gl.TEXTURE_2D, id: place.share},
      });
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
  }
}
