// Irradiance records as instances of a rectangle.
import {attribute} from './gl.js';

const LOOP_CORNERS = 32;

export class Records {
  constructor(gl, {cache, record}) {
    this.gl = gl;
    this.count = record.rows;
    this.accuracy = cache.accuracy[0];
    this.holdsDirect = cache.holds_direct[0] !== 0;
    const once = {divisor: 1};
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    const position = attribute(gl, 0, record.position, 3, once);
    const inverseRadius = attribute(gl, 1, record.inverse_radius, 1, once);
    const normal = attribute(gl, 2, record.normal, 3, once);
    attribute(gl, 3, record.front_limit, 1, once);
    attribute(gl, 4, record.irradiance, 3, once);
    attribute(gl, 5, record.weight, 1, once);
    attribute(gl, 6, record.over_limit, 1, once);
    for (const [at, values] of [[7, record.turn], [10, record.translation]]) {
      let buffer = null;
      for (let c = 0; c < 3; ++c)
        buffer = attribute(gl, at + c, values, 3, {divisor: 1, stride: 36, offset: 12 * c, buffer});
    }
    this.marks = gl.createVertexArray();
    gl.bindVertexArray(this.marks);
    attribute(gl, 0, null, 3, {divisor: 1, buffer: position});
    attribute(gl, 1, null, 1, {divisor: 1, buffer: inverseRadius});
    attribute(gl, 2, null, 3, {divisor: 1, buffer: normal});
    gl.bindVertexArray(null);
  }

  // Adds light and weights to the bound target.
  splat(program, uniforms) {
    const gl = this.gl;
    program.use(uniforms);
    gl.bindVertexArray(this.array);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.count);
    gl.bindVertexArray(null);
  }

  // Places, and the edges of their zones.
  mark(program, uniforms, zones) {
    const gl = this.gl;
    gl.bindVertexArray(this.marks);
    if (zones) {
      program.use({...uniforms, corners: LOOP_CORNERS, ink: [1, 1, 1, 0.5]});
      gl.drawArraysInstanced(gl.LINE_LOOP, 0, LOOP_CORNERS, this.count);
    }
    program.use({...uniforms, corners: 0, ink: [1, 0.3, 0.1, 1]});
    gl.drawArraysInstanced(gl.POINTS, 0, 1, this.count);
    gl.bindVertexArray(null);
  }
}
