// Irradiance records as instances of a rectangle.
import {attribute} from './gl.js';

const LOOP_CORNERS = 32;

// A column of values with room for more; rows that nobody has set hold `empty`.
class Column {
  constructor(gl, values, components, empty) {
    Object.assign(this, {gl, values, components, empty, buffer: gl.createBuffer()});
    this.#upload();
  }

  #upload() {
    const {gl} = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, this.values, gl.STATIC_DRAW);
  }

  // `count` rows of `from`, from row `first` on, go to row `to` and those after it.
  set(from, first, count, to) {
    const {gl, components} = this, end = (to + count) * components;
    if (end > this.values.length) {
      const more = new Float32Array(Math.max(2 * this.values.length, end)).fill(this.empty, this.values.length);
      more.set(this.values);
      this.values = more;
      this.#upload();
    }
    const rows = from.subarray(first * components, (first + count) * components);
    this.values.set(rows, to * components);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferSubData(gl.ARRAY_BUFFER, 4 * to * components, rows);
  }
}

const COMPONENTS = {position: 3, inverse_radius: 1, normal: 3, front_limit: 1, irradiance: 3, weight: 1, over_limit: 1,
                    turn: 9, translation: 9};

export class Records {
  constructor(gl, {cache, record}) {
    this.gl = gl;
    this.count = record.rows;
    this.accuracy = cache.accuracy[0];
    this.holdsDirect = cache.holds_direct[0] !== 0;
    const empty = (name) => name === 'inverse_radius' ? 1e30 : 0;  // reaches nothing
    this.columns = Object.fromEntries(Object.entries(COMPONENTS).map(
        ([name, components]) => [name, new Column(gl, record[name], components, empty(name))]));
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    const once = (at, name) => attribute(gl, at, null, COMPONENTS[name], {divisor: 1, buffer: this.columns[name].buffer});
    ['position', 'inverse_radius', 'normal', 'front_limit', 'irradiance', 'weight', 'over_limit'].forEach((name, at) => once(at, name));
    for (const [at, name] of [[7, 'turn'], [10, 'translation']])
      for (let c = 0; c < 3; ++c)
        attribute(gl, at + c, null, 3, {divisor: 1, stride: 36, offset: 12 * c, buffer: this.columns[name].buffer});
    this.marks = gl.createVertexArray();
    gl.bindVertexArray(this.marks);
    ['position', 'inverse_radius', 'normal'].forEach((name, at) => once(at, name));
    gl.bindVertexArray(null);
  }

  // New records, and new values of such: each goes to its row, counted from `first`.
  put({rows, row, ...values}, first) {
    for (let begin = 0, end = 1; begin < rows; begin = end++) {
      while (end < rows && row[end] === row[end - 1] + 1) ++end;
      const to = first + row[begin];
      for (const [name, column] of Object.entries(this.columns)) column.set(values[name], begin, end - begin, to);
      this.count = Math.max(this.count, to + end - begin);
    }
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
