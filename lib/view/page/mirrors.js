// Flat mirrors and panes: views of the scene in those that matter most, each drawn by an eye behind the mirror, so that
// its pixels are those of the picture. There is one reflection; surfaces in a mirror reflect nothing themselves.
import {makeTexture} from './gl.js';
import {dot, length, row, scale, subtract} from './vector.js';

const MOST = 2;                // mirrors of a view
const LEAST = 0.002;           // of solid angle times reflectance

export class Mirrors {
  constructor(gl, mirror, mesh, size) {
    Object.assign(this, {gl, size, taken: []});
    this.planes = Array.from({length: mirror.rows}, (_, i) => {
      const parts = mesh.shiny.filter((part) => part.mirror === i);
      return {
        normal: row(mirror.plane, i, 4).slice(0, 3), offset: mirror.plane[4 * i + 3], centre: row(mirror.centre, i),
        area: mirror.area[i], parts, reflectance: Math.max(0, ...parts.map((part) => mesh.materials[part.material].reflectance)),
      };
    });
  }

  // What a mirror weighs in a view: the solid angle that it takes up, times its reflectance.
  #weight(plane, eye) {
    const way = subtract(plane.centre, eye.position), far = length(way), extent = Math.sqrt(plane.area);
    if (eye.perspective && dot(way, eye.backward()) > extent) return 0;  // behind the eye
    const height = Math.abs(dot(plane.normal, eye.position) + plane.offset);
    return plane.reflectance * Math.min(6, plane.area * Math.max(height, 0.05 * far) / Math.max(far, extent, 1e-9) ** 3);
  }

  // The view of an eye in a mirror: reflected at its plane, without the parts behind it.
  #view(plane, view) {
    const {normal: n} = plane, height = dot(n, view.eye) + plane.offset, side = Math.sign(height) || 1;
    const axes = [0, 1, 2].map((k) => [view.axes[k], view.axes[3 + k], view.axes[6 + k]])
        .map((r) => subtract(r, scale(n, 2 * dot(r, n))));
    return {
      ...view, eye: subtract(view.eye, scale(n, 2 * height)), axes: [0, 1, 2].flatMap((k) => axes.map((r) => r[k])), mirrored: true,
      backward: axes[2], cut: [...scale(n, side), side * plane.offset - 1e-5 * this.size],
    };
  }

  // Draws the views in the mirrors that matter. `drawing` draws and bakes views.
  prepare(drawing, eye, view, accuracy) {
    this.taken = this.planes.map((plane) => ({plane, weight: this.#weight(plane, eye)})).filter(({weight}) => weight > LEAST)
        .sort((a, b) => b.weight - a.weight).slice(0, MOST).map(({plane}) => plane);
    const {width, height} = drawing.canvas;
    for (const plane of this.taken) {
      if (plane.width !== width || plane.height !== height) {
        if (plane.map) this.gl.deleteTexture(plane.map);
        Object.assign(plane, {width, height, map: makeTexture(this.gl, this.gl.RGBA32F, width, height)});
      }
      drawing.lightOf(this.#view(plane, view), accuracy);
      drawing.bake(plane.map);
    }
  }

  // Adds what their parts of a kind reflect to the bound target.
  shine(mesh, program, view, drawn) {
    for (const plane of this.taken)
      mesh.draw(program, {...view, by_cube: false, mirrored_map: {unit: 2, target: this.gl.TEXTURE_2D, id: plane.map}}, plane.parts.filter(drawn));
  }
}
