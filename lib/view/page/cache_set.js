// A set of caches: groups of lamps, each with its records and its weight, and the light that these bring to a view.
import {makeTexture, Target} from './gl.js';

const ROW = 1024;  // texels of a row of the table of weights (quantity.glsl)

export class CacheSet {
  // `groups`: [{name, lamps, records}], lamps by their rows in the scene.
  constructor(gl, {label, groups}, lampCount) {
    Object.assign(this, {gl, label, lampCount});
    this.groups = groups.map((group) => ({...group, weight: 1}));
    this.holdsDirect = groups.every((group) => group.records.holdsDirect);
    this.rows = Math.max(1, Math.ceil(lampCount / ROW));
    this.weightMap = makeTexture(gl, gl.R32F, ROW, this.rows);
  }

  get count() { return this.groups.reduce((sum, group) => sum + group.records.count, 0); }
  get weights() { return this.groups.map((group) => group.weight); }
  get lit() { return this.groups.filter((group) => group.weight > 0); }

  // Of each lamp, by the groups that `counts` is true of; lamps of no group are dark.
  lampWeights(counts = () => true) {
    const weights = new Float32Array(this.lampCount);
    for (const group of this.groups)
      if (counts(group)) for (const lamp of group.lamps) weights[lamp] = group.weight;
    return weights;
  }

  resize(width, height) {
    this.remove();
    this.direct = new Target(this.gl, width, height, [this.gl.RGBA32F]);
    this.splat = new Target(this.gl, width, height, [this.gl.RGBA32F]);
  }

  remove() {
    this.direct?.remove();
    this.splat?.remove();
  }

  // The light of a view. `reach`: of records, times their own accuracy; `scratch`: a target as large as the picture.
  light({splat, compose, direct}, lamps, view, reach, surfaces, scratch) {
    const gl = this.gl;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    const drawRecords = ({records}, target) => {
      const accuracy = reach * records.accuracy;
      target.bind();
      target.clear();
      records.splat(splat, {...view, ...surfaces, accuracy, inverse_accuracy: 1 / accuracy});
    };
    if (this.groups.length === 1 && this.groups[0].weight === 1) {
      drawRecords(this.groups[0], this.splat);
    } else {
      this.splat.clear([0, 0, 0, 1]);
      for (const group of this.lit) {
        drawRecords(group, scratch);
        this.#compose(compose, scratch, group.weight);
      }
    }
    this.direct.clear();
    this.direct.bind();
    lamps.light(direct, surfaces, this.lampWeights((group) => !group.records.holdsDirect));
    gl.disable(gl.BLEND);
    this.#tellWeights();
  }

  // Adds a group's light. A pixel that a group does not reach is a hole (the least alpha).
  #compose(program, scratch, weight) {
    const gl = this.gl;
    this.splat.bind();
    gl.blendEquationSeparate(gl.FUNC_ADD, gl.MIN);
    program.use({weight, group_map: {unit: 2, target: gl.TEXTURE_2D, id: scratch.textures[0]}});
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.blendEquation(gl.FUNC_ADD);
  }

  #tellWeights() {
    const gl = this.gl, texels = new Float32Array(ROW * this.rows);
    texels.set(this.lampWeights());
    gl.bindTexture(gl.TEXTURE_2D, this.weightMap);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, ROW, this.rows, gl.RED, gl.FLOAT, texels);
  }
}
