// The picture: visible surfaces, splatted records, light of lamps, and the way to the screen.
import {CacheSet} from './cache_set.js';
import {Lamps} from './lamps.js';
import {Mesh} from './mesh.js';
import {makeTexture, Program, Target} from './gl.js';
import {Records} from './records.js';
import {wiped} from './wipe.js';

const SKY_WIDTH = 256, SKY_HEIGHT = 128;
export const MEASURED = 96;  // pixels on a side of a measurement

const SHADERS = ['scene.vert', 'holes', 'gbuffer.frag', 'shadow.frag', 'picture.vert', 'direct.frag', 'splat.vert', 'splat.frag',
                 'compose.frag', 'quantity', 'measure.frag', 'show.frag', 'isolux.frag', 'overlay.vert', 'overlay.frag'];

// The texts of the shaders, and of the weight.
export async function loadShaders(load) {
  const names = [...SHADERS, 'weight'];
  const texts = await Promise.all(names.map((name) => load(`/${name}.glsl`)));
  return Object.fromEntries(names.map((name, i) => [name, texts[i]]));
}

export class Drawing {
  // `sets`: [{label, groups: [{name, lamps, records}]}] with messages of records.
  constructor(canvas, shaders, scene, sets, palette) {
    const gl = this.gl = canvas.getContext('webgl2', {antialias: false, alpha: false, preserveDrawingBuffer: true});
    if (!gl) throw new Error('this browser has no WebGL 2');
    for (const name of ['EXT_color_buffer_float', 'EXT_float_blend'])
      if (!gl.getExtension(name)) throw new Error(`this browser or its graphics card lacks ${name}, which adds light in floats`);
    gl.getExtension('OES_texture_float_linear');
    const program = (name, vertex, ...fragment) => new Program(gl, name, shaders[vertex], fragment.map((f) => shaders[f]).join(''));
    this.programs = {
      gbuffer: program('gbuffer', 'scene.vert', 'holes', 'gbuffer.frag'),
      shadow: program('shadow', 'scene.vert', 'holes', 'shadow.frag'),
      direct: program('direct', 'picture.vert', 'direct.frag'),
      splat: program('splat', 'splat.vert', 'weight', 'splat.frag'),
      compose: program('compose', 'picture.vert', 'compose.frag'),
      measure: program('measure', 'picture.vert', 'quantity', 'measure.frag'),
      show: program('show', 'picture.vert', 'quantity', 'show.frag'),
      isolux: program('isolux', 'picture.vert', 'quantity', 'isolux.frag'),
      overlay: program('overlay', 'overlay.vert', 'overlay.frag'),
    };
    this.canvas = canvas;
    this.mesh = new Mesh(gl, scene);
    this.sets = sets.map(({label, groups}) => new CacheSet(gl, {
      label, groups: groups.map((group) => ({...group, records: new Records(gl, group.records)})),
    }, scene.lamp.rows));
    this.share = 0.5;  // of the first set, left of the wipe
    this.records = this.sets[0].groups[0].records;
    this.needsLamps = this.sets.some((set) => !set.holdsDirect);
    const skyLamp = scene.scene.sky_lamp[0];
    this.skyLampNumber = skyLamp < scene.lamp.rows ? skyLamp + 1 : 0;
    this.lamps = new Lamps(gl, scene, this.mesh, this.programs.shadow);
    this.paletteMap = makeTexture(gl, gl.RGBA8, 256, 1);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    const rgba = new Uint8Array(1024).map((_, i) => i % 4 === 3 ? 255 : palette[3 * (i >> 2) + i % 4]);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 256, 1, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
    this.hasSky = scene.sky.rows > 0;
    this.skyMap = makeTexture(gl, gl.RGB32F, SKY_WIDTH, SKY_HEIGHT);
    if (this.hasSky) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, SKY_WIDTH, SKY_HEIGHT, gl.RGB, gl.FLOAT, scene.sky.luminance);
    const lo = scene.scene.bounds_lo, hi = scene.scene.bounds_hi;
    this.size = Math.hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
    this.centre = [0, 1, 2].map((k) => (lo[k] + hi[k]) / 2);
    this.measured = new Target(gl, MEASURED, MEASURED, [gl.RGBA32F]);
  }

  resize(width, height) {
    if (this.surfaces?.width === width && this.surfaces.height === height) return;
    const gl = this.gl, float = gl.RGBA32F;
    for (const target of [this.surfaces, this.scratch]) target?.remove();
    this.canvas.width = width, this.canvas.height = height;
    this.surfaces = new Target(gl, width, height, [float, float, float, float], true);
    this.scratch = new Target(gl, width, height, [float]);
    for (const set of this.sets) set.resize(width, height);
  }

  // The uniforms of a camera (walk.js: Eye).
  #view(eye) {
    const half = [eye.halfHeight * this.canvas.width / this.canvas.height, eye.halfHeight];
    const far = Math.hypot(...eye.position.map((p, k) => p - this.centre[k])) + this.size;
    return {
      eye: eye.position, axes: eye.axes(), half_size: half, perspective: eye.perspective,
      lens: [1 / half[0], 1 / half[1], 0, 0], range: [1e-3 * this.size, far],
      margin: [2 / this.canvas.width, 2 / this.canvas.height], backward: eye.backward(),
    };
  }

  #textures(set) {
    const map = (unit, id) => ({unit, target: this.gl.TEXTURE_2D, id});
    const [position, normal, reflectance, emission] = this.surfaces.textures;
    return {
      position_map: map(0, position), normal_map: map(1, normal), reflectance_map: map(2, reflectance),
      emission_map: map(5, emission), direct_map: map(6, set.direct.textures[0]), splat_map: map(7, set.splat.textures[0]),
      lamp_weight_map: map(10, set.weightMap), sky_lamp_number: this.skyLampNumber,
      sky_map: map(8, this.skyMap), palette_map: map(9, this.paletteMap), has_sky: this.hasSky,
    };
  }

  // The light of a view. `accuracy`: of the records of the first group; others keep the ratio to theirs.
  light(eye, accuracy) {
    const view = this.view = this.#view(eye), reach = accuracy / this.records.accuracy;
    this.surfaces.clear();
    this.mesh.draw(this.programs.gbuffer, view);
    const {position_map, normal_map, reflectance_map} = this.#textures(this.sets[0]);
    for (const {set} of wiped(this.sets, this.share, this.canvas.width))
      set.light(this.programs, this.lamps, view, reach, {position_map, normal_map, reflectance_map}, this.scratch);
  }

  // Calls `draw` with the uniforms of each side of the wipe, where only this side is drawn on, `width` pixels in all.
  #eachSide(width, height, draw) {
    const gl = this.gl;
    gl.enable(gl.SCISSOR_TEST);
    for (const part of wiped(this.sets, this.share, width)) {
      gl.scissor(part.x, 0, part.width, height);
      draw({...this.view, ...this.#textures(part.set), picture_size: [this.canvas.width, this.canvas.height]}, part.set);
    }
    gl.disable(gl.SCISSOR_TEST);
  }

  // To the screen: `look` has the uniforms of show.frag.glsl, and isolux_step, 0 for no lines; `marks`: '', 'places' or
  // 'zones'.
  show(look, marks, accuracy) {
    const gl = this.gl, {width, height} = this.canvas;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    this.#eachSide(width, height, (uniforms, set) => {
      this.programs.show.use({...uniforms, ...look});
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      if (look.isolux_step > 0) this.#isolux(uniforms, look);
      if (!marks) return;
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      for (const {records} of set.lit)
        records.mark(this.programs.overlay, {...uniforms, accuracy: accuracy * records.accuracy / this.records.accuracy},
                     marks === 'zones');
      gl.disable(gl.BLEND);
    });
  }

  // Of illuminance: of all of it where luminance is shown.
  #isolux(uniforms, {quantity, isolux_step}) {
    this.programs.isolux.use({...uniforms, quantity: quantity === 0 ? 1 : quantity, isolux_step});
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
  }

  // Draws into a target of floats, and reads it.
  #read(target, draw) {
    const gl = this.gl, {width, height} = target, values = new Float32Array(4 * width * height);
    target.clear();
    this.#eachSide(width, height, draw);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, values);
    return values;
  }

  // Pixels of the measurement, row by row from below: luminance, 1 where a surface is visible, 1 where no record reaches.
  measure(quantity, target = this.measured) {
    return this.#read(target, (uniforms) => {
      this.programs.measure.use({...uniforms, measured_size: [target.width, target.height], quantity});
      this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
    });
  }

  // The point of the scene that is visible at a place, from 0 to 1 from the upper left; null: none is.
  pointAt(x, y) {
    const gl = this.gl, {width, height} = this.surfaces, pixel = new Float32Array(4);
    const at = (share, size) => Math.min(size - 1, Math.max(0, Math.floor(share * size)));
    this.surfaces.bind();
    gl.readPixels(at(x, width), height - 1 - at(y, height), 1, 1, gl.RGBA, gl.FLOAT, pixel);
    return pixel[3] > 0 ? Array.from(pixel.subarray(0, 3)) : null;
  }

  // Waits until all is drawn.
  finish() { this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4)); }

  // Values of a quantity at a grid of pixels where a surface is visible, in rising order.
  values(quantity) {
    const read = this.measure(quantity);
    const found = new Float32Array(MEASURED * MEASURED);
    let n = 0;
    for (let i = 0; i < found.length; ++i)
      if (read[4 * i + 1] > 0) found[n++] = read[4 * i];
    return found.subarray(0, n).sort();
  }

  // Luminance of a quantity in each pixel, from the top.
  pixels(quantity) { return this.#fromTop((target) => this.measure(quantity, target)); }

  // 1 in each pixel before a step of illuminance, from the top.
  isoluxPixels(quantity, isolux_step) {
    return this.#fromTop((target) => this.#read(target, (uniforms) => this.#isolux(uniforms, {quantity, isolux_step})));
  }

  // The first component of what `draw` draws into a target as large as the picture and reads.
  #fromTop(draw) {
    const {width, height} = this.canvas, target = new Target(this.gl, width, height, [this.gl.RGBA32F]);
    const read = draw(target);
    target.remove();
    const values = new Float32Array(width * height);
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x) values[(height - 1 - y) * width + x] = read[4 * (y * width + x)];
    return values;
  }
}
