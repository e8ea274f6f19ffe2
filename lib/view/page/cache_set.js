// A set of caches: groups of lamps, each with its records and its weight, and the light that these bring to a view.
import {makeTexture, Target} from './gl.js';

const ROW = 1024;  // texels of a row of the table of weights (quantity.glsl)

export class CacheSet {
  // `groups`: [{name, lamps, records, gloss}], lamps by their rows in the scene.
  constructor(gl, {label, groups}, lampCount) {
    Object.assign(this, {gl, label, lampCount});
    this.groups = groups.map((group) => ({...group, weight: 1}));
    this.holdsDirect = groups.every((group) => group.records.holdsDirect);
    this.rows = Math.max(1, Math.ceil(lampCount / ROW));
    this.weightMap = makeTexture(gl, gl.R32F, ROW, this.rows);
  }

  get count() { return this.groups.reduce((sum, group) => sum + group.records.count, 0); }
  get weights() { return this.groups.map((group) => group.weight); }
  get glossy() { return this.groups.filter((group) => group.gloss.count > 0); }
  get lit() { return this.groups.filter((group) => group.weight > 0); }

  // Of each lamp, by the groups that `counts` is true of; lamps of no group are dark.
  lampWeights(counts = () => true) {
    const weights = new Float32Array(this.lampCount);
    for (const group of this.groups)
      if (counts(group)) for (const lamp of group.lamps) weights[lamp] = group.weight;
    return weights;
  }

  // direct: illuminance by lamps, and their light in gloss; splat: irradiance records; gloss: radiance records, null
  // where there are none.
  makeTargets(width, height) {
    const gl = this.gl, float = gl.RGBA32F, target = (...formats) => new Target(gl, width, height, formats);
    return {direct: target(float, float), splat: target(float), gloss: this.glossy.length ? target(float) : null};
  }

  // The light of a view. `reach`: of records, times their own accuracy; `scratch`: a target as large as the picture.
  light({splat, gloss, compose, direct}, lamps, view, reach, surfaces, scratch) {
    const gl = this.gl, targets = this.targets;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    const draw = (records, program, target) => {
      const accuracy = reach * records.accuracy;
      target.clear();
      records.splat(program, {...view, ...surfaces, accuracy, inverse_accuracy: 1 / accuracy});
    };
    this.#gather(this.groups, targets.splat, compose, scratch, (group, target) => draw(group.records, splat, target));
    if (targets.gloss) this.#gather(this.glossy, targets.gloss, compose, scratch, (group, target) => draw(group.gloss, gloss, target));
    targets.direct.clear();
    const eye = {viewer: view.eye, backward: view.backward, view_perspective: view.perspective};
    lamps.light(direct, {...surfaces, ...eye}, this.lampWeights((group) => !group.records.holdsDirect));
    gl.disable(gl.BLEND);
    this.#tellWeights();
  }

  // The records of groups, each by its weight.
  #gather(groups, target, compose, scratch, draw) {
    if (groups.length === 1 && groups[0].weight === 1) return draw(groups[0], target);
    target.clear([0, 0, 0, 1]);
    for (const group of groups.filter(({weight}) => weight > 0)) {
      draw(group, scratch);
      this.#compose(compose, target, scratch, group.weight);
    }
  }

  // Adds a group's light. A pixel that a group does not reach is a hole (the least alpha).
  #compose(program, target, scratch, weight) {
    const gl = this.gl;
    target.bind();
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
