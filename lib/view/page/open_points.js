// Visible points that no record reaches at an accuracy.
import {Target} from './gl.js';

const SIDE = 64;  // pixels looked at, each way
const STEP = [0.7548776662466927, 0.5698402909980532];  // of shifts, which fill the square evenly

export class OpenPoints {
  constructor(drawing) {
    const gl = drawing.gl;
    Object.assign(this, {drawing, gl, looks: 0});
    this.looked = new Target(gl, SIDE, SIDE, [gl.RGBA32F, gl.RGBA32F]);
  }

  // [{position, normal}] of the picture as it was drawn last, in no order. Each look looks at other pixels.
  find(accuracy) {
    const {gl, drawing} = this, {width, height} = drawing.canvas, map = (unit, id) => ({unit, target: gl.TEXTURE_2D, id});
    if (this.reach?.width !== width || this.reach.height !== height) {
      this.reach?.remove();
      this.reach = new Target(gl, width, height, [gl.RGBA32F]);
    }
    const position_map = map(0, drawing.targets.surfaces.textures[0]), normal_map = map(1, drawing.targets.surfaces.textures[1]);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    this.reach.bind();
    this.reach.clear();
    drawing.records.splat(drawing.programs.splat, {...drawing.view, accuracy, inverse_accuracy: 1 / accuracy, position_map, normal_map});
    gl.disable(gl.BLEND);
    this.looked.bind();
    const shift = STEP.map((step) => this.looks * step % 1);
    ++this.looks;
    drawing.programs.open.use({picture_size: [width, height], looked_size: [SIDE, SIDE], shift, position_map, normal_map,
                               reach_map: map(2, this.reach.textures[0])});
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const [positions, normals] = [0, 1].map((i) => {
      const values = new Float32Array(4 * SIDE * SIDE);
      gl.readBuffer(gl.COLOR_ATTACHMENT0 + i);
      gl.readPixels(0, 0, SIDE, SIDE, gl.RGBA, gl.FLOAT, values);
      return values;
    });
    gl.readBuffer(gl.COLOR_ATTACHMENT0);
    const points = [];
    for (let i = 0; i < 4 * SIDE * SIDE; i += 4) {
      if (!(positions[i + 3] > 0)) continue;
      const position = Array.from(positions.subarray(i, i + 3)), normal = Array.from(normals.subarray(i, i + 3));
      if ([...position, ...normal].every(Number.isFinite) && Math.hypot(...normal) > 0) points.push({position, normal});
    }
    return points;
  }
}
