// Radiance records as instances of a rectangle, and the lobes that read them.
import {dataTexture} from './data.js';
import {attribute} from './gl.js';
import {materialMap} from './materials.js';

export class GlossRecords {
  constructor(gl, {cache, lobe, lobe_row, lobe_number, record, number}, material) {
    Object.assign(this, {gl, count: record.rows, accuracy: cache.accuracy[0]});
    if (!this.count) return;
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    const once = {divisor: 1};
    attribute(gl, 0, record.position, 3, once);
    attribute(gl, 1, record.inverse_radius, 1, once);
    attribute(gl, 2, record.normal, 3, once);
    attribute(gl, 3, record.front_limit, 1, once);
    attribute(gl, 4, record.axis_x, 3, once);
    attribute(gl, 5, record.over_limit, 1, once);
    const own = new Float32Array(4 * this.count);
    for (let i = 0; i < this.count; ++i)
      own.set([record.steepness[i], record.weight[i], record.order[i], record.first_number[i]], 4 * i);
    attribute(gl, 6, own, 4, once);
    gl.bindVertexArray(null);
    const rows = new Float32Array(4 * lobe_row.rows);
    for (let i = 0; i < lobe_row.rows; ++i) rows.set([lobe_row.bands[i], lobe_row.first_number[i]], 4 * i);
    const map = (unit, id) => ({unit, target: gl.TEXTURE_2D, id});
    this.maps = {
      lobe_row_map: map(3, dataTexture(gl, rows, 4, 'lobes')), lobe_number_map: map(4, dataTexture(gl, lobe_number.value, 3, 'lobes')),
      material_map: map(11, materialMap(gl, material, lobe)), number_map: map(5, dataTexture(gl, number.value, 3, 'radiance records')),
    };
  }

  // Adds light towards the eye and weights to the bound target.
  splat(program, uniforms) {
    const gl = this.gl;
    program.use({...uniforms, ...this.maps});
    gl.bindVertexArray(this.array);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.count);
    gl.bindVertexArray(null);
  }
}
