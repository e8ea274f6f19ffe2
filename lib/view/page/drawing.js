// The picture: visible surfaces, splatted records, light of lamps, and the way to the screen.
import {CacheSet} from './cache_set.js';
import {GlossRecords} from './gloss.js';
import {Lamps} from './lamps.js';
import {lightTargets, removeTargets} from './light_targets.js';
import {materialMap} from './materials.js';
import {Mesh} from './mesh.js';
import {Reflections} from './reflections.js';
import {makeTexture, Program, Target} from './gl.js';
import {Records} from './records.js';
import {wiped} from './wipe.js';

const SKY_WIDTH = 256, SKY_HEIGHT = 128;
export const MEASURED = 96;  // pixels on a side of a measurement

const SHADERS = ['scene.vert', 'holes', 'gbuffer.frag', 'shadow.frag', 'picture.vert', 'direct.frag', 'rectangle', 'splat.vert', 'splat.frag',
                 'compose.frag', 'data', 'glint', 'gloss.vert', 'gloss.frag', 'specular', 'veil.frag', 'shine.frag', 'bake.frag', 'quantity',
                 'measure.frag', 'show.frag', 'isolux.frag', 'overlay.vert', 'overlay.frag', 'open.frag'];

// The texts of the shaders, and of the weight.
export async function loadShaders(load) {
  const names = [...SHADERS, 'weight'];
  const texts = await Promise.all(names.map((name) => load(`/${name}.glsl`)));
  return Object.fromEntries(names.map((name, i) => [name, texts[i]]));
}

export class Drawing {
  // `sets`: [{label, groups: [{name, lamps, records, gloss}]}] with messages of records. `side`: pixels on the longer side of the
  // picture, which shadow maps are to be fine enough for.
  constructor(canvas, shaders, scene, sets, palette, side) {
    const gl = this.gl = canvas.getContext('webgl2', {antialias: false, alpha: false, preserveDrawingBuffer: true});
    if (!gl) throw new Error('this browser has no WebGL 2');
    for (const name of ['EXT_color_buffer_float', 'EXT_float_blend'])
      if (!gl.getExtension(name)) throw new Error(`this browser or its graphics card lacks ${name}, which adds light in floats`);
    this.floatFilter = gl.getExtension('OES_texture_float_linear') ? gl.LINEAR : gl.NEAREST;
    const text = (names) => names.map((name) => shaders[name]).join('');
    const program = (name, vertex, ...fragment) => new Program(gl, name, text([vertex].flat()), text(fragment));
    this.programs = {
      gbuffer: program('gbuffer', 'scene.vert', 'holes', 'gbuffer.frag'),
      shadow: program('shadow', 'scene.vert', 'holes', 'shadow.frag'),
      direct: program('direct', 'picture.vert', 'data', 'glint', 'direct.frag'),
      splat: program('splat', ['rectangle', 'splat.vert'], 'weight', 'splat.frag'),
      gloss: program('gloss', ['rectangle', 'gloss.vert'], 'weight', 'data', 'gloss.frag'),
      compose: program('compose', 'picture.vert', 'compose.frag'),
      veil: program('veil', 'scene.vert', 'specular', 'veil.frag'),
      shine: program('shine', 'scene.vert', 'specular', 'shine.frag'),
      bake: program('bake', 'picture.vert', 'data', 'quantity', 'bake.frag'),
      measure: program('measure', 'picture.vert', 'data', 'quantity', 'measure.frag'),
      show: program('show', 'picture.vert', 'data', 'quantity', 'show.frag'),
      isolux: program('isolux', 'picture.vert', 'data', 'quantity', 'isolux.frag'),
      overlay: program('overlay', 'overlay.vert', 'overlay.frag'),
      open: program('open', 'picture.vert', 'open.frag'),
    };
    this.canvas = canvas;
    this.mesh = new Mesh(gl, scene);
    this.sets = sets.map(({label, groups}) => new CacheSet(gl, {
      label, groups: groups.map((group) => ({
        ...group, records: new Records(gl, group.records), gloss: new GlossRecords(gl, group.gloss, scene.material),
      })),
    }, scene.lamp.rows));
    this.share = 0.5;  // of the first set, left of the wipe
    this.records = this.sets[0].groups[0].records;
    this.needsLamps = this.sets.some((set) => !set.holdsDirect);
    const skyLamp = scene.scene.sky_lamp[0];
    this.skyLampNumber = skyLamp < scene.lamp.rows ? skyLamp + 1 : 0;
    this.materialMap = materialMap(gl, scene.material);
    this.lamps = new Lamps(gl, scene, this.mesh, this.programs.shadow, this.programs.veil, side);
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
    this.reflections = new Reflections(gl, scene, this.mesh, this.size);
    this.measured = new Target(gl, MEASURED, MEASURED, [gl.RGBA32F]);
  }

  resize(width, height) {
    if (this.targets?.surfaces.width === width && this.targets.surfaces.height === height) return;
    if (this.targets) for (const {targets} of [this, ...this.sets]) removeTargets(targets);
    this.canvas.width = width, this.canvas.height = height;
    this.targets = this.#makeTargets(width, height);
    for (const set of this.sets) set.targets = set.makeTargets(width, height);
  }

  #makeTargets(width, height) {
    return lightTargets(this.gl, width, height, {panes: this.mesh.panes.length > 0, shine: this.mesh.shiny.length > 0});
  }

  // Calls `draw` with targets of another size, of the first set alone.
  withTargets(width, height, draw) {
    const [set] = this.sets, own = this.targets, ofSet = set.targets;
    this.targets = this.#makeTargets(width, height);
    set.targets = set.makeTargets(width, height);
    draw();
    for (const {targets} of [this, set]) removeTargets(targets);
    this.targets = own, set.targets = ofSet;
  }

  // The uniforms of a camera (walk.js: Eye) whose picture has that size.
  viewOf(eye, width, height) {
    const half = [eye.halfHeight * width / height, eye.halfHeight];
    const far = Math.hypot(...eye.position.map((p, k) => p - this.centre[k])) + this.size;
    return {
      eye: eye.position, axes: eye.axes(), half_size: half, perspective: eye.perspective,
      lens: [1 / half[0], 1 / half[1], 0, 0], range: [1e-3 * this.size, far],
      margin: [2 / width, 2 / height], backward: eye.backward(), cut: [0, 0, 0, 0], mirrored: false,
    };
  }

  #textures(set) {
    const map = (unit, id) => ({unit, target: this.gl.TEXTURE_2D, id});
    const {surfaces, veil, shine} = this.targets, {direct, splat, gloss} = set.targets;
    const [position, normal, reflectance, emission] = surfaces.textures;
    return {
      position_map: map(0, position), normal_map: map(1, normal), reflectance_map: map(2, reflectance),
      emission_map: map(5, emission), direct_map: map(6, direct.textures[0]), glint_map: map(3, direct.textures[1]),
      splat_map: map(7, splat.textures[0]), lamp_weight_map: map(10, set.weightMap), sky_lamp_number: this.skyLampNumber,
      sky_map: map(8, this.skyMap), palette_map: map(9, this.paletteMap), has_sky: this.hasSky,
      material_map: map(11, this.materialMap), gloss_map: map(12, gloss?.textures[0] ?? null), has_gloss: gloss !== null,
      veil_map: map(13, veil?.textures[0] ?? null), has_veil: veil !== null,
      shine_map: map(14, shine?.textures[0] ?? null), has_shine: shine !== null,
    };
  }

  // The light of a view. `accuracy`: of the records of the first group; others keep the ratio to theirs.
  light(eye, accuracy) {
    const view = this.viewOf(eye, this.canvas.width, this.canvas.height);
    this.reflections.prepare(this, eye, view, accuracy);
    this.lightOf(view, accuracy);
    this.reflections.shine(this.programs.shine, this.programs.veil, this.targets.shine, view);
  }

  // The light of the uniforms of a camera, but for reflections.
  lightOf(view, accuracy, parts = this.mesh.parts, sets = wiped(this.sets, this.share, this.canvas.width).map(({set}) => set)) {
    const {surfaces, veil, shine, scratch} = this.targets, reach = accuracy / this.records.accuracy;
    this.view = view;
    surfaces.clear();
    this.mesh.draw(this.programs.gbuffer, view, parts);
    this.#drawVeil(veil, view);
    const {position_map, normal_map, reflectance_map, material_map} = this.#textures(sets[0]);
    for (const set of sets)
      set.light(this.programs, this.lamps, view, reach, {position_map, normal_map, reflectance_map, material_map}, scratch);
    shine?.clear();
  }

  // What the panes before the surfaces leave of the light.
  #drawVeil(veil, view) {
    if (!veil) return;
    const gl = this.gl;
    veil.clear([1, 1, 1, 1]);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ZERO, gl.SRC_COLOR);
    gl.depthMask(false);
    this.mesh.draw(this.programs.veil, view, this.mesh.panes);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  // Luminance and distance of the latest view, into a texture as large as the picture.
  bake(texture) {
    const {width, height} = this.canvas;
    this.#bakeInto(texture, this.gl.TEXTURE_2D, width, height, () => this.#eachSide(width, height, (uniforms) => this.#drawBaked(uniforms)));
  }

  // The same of the first set, into a face of a cube map with `side` texels on a side.
  bakeFace(texture, face, side) {
    const uniforms = {...this.view, ...this.#textures(this.sets[0]), picture_size: [side, side]};
    this.#bakeInto(texture, this.gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, side, side, () => this.#drawBaked(uniforms));
  }

  #drawBaked(uniforms) {
    this.programs.bake.use({...uniforms, quantity: 0});
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
  }

  #bakeInto(texture, target, width, height, draw) {
    const gl = this.gl, framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, target, texture, 0);
    gl.viewport(0, 0, width, height);
    draw();
    gl.deleteFramebuffer(framebuffer);
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
    const gl = this.gl, {surfaces} = this.targets, {width, height} = surfaces, pixel = new Float32Array(4);
    const at = (share, size) => Math.min(size - 1, Math.max(0, Math.floor(share * size)));
    surfaces.bind();
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

  // A quantity of a set at a place, from 0 to 1 from the upper left; 1 where a surface is visible; 1 where no record reaches.
  valueAt(x, y, quantity, set) {
    const gl = this.gl, {width, height} = this.canvas, value = new Float32Array(4);
    const middle = (share, size) => Math.min(size - 1, Math.max(0, Math.floor(share * size))) + 0.5;
    const target = this.onePixel ??= new Target(gl, 1, 1, [gl.RGBA32F]);
    target.bind();
    // measure.frag.glsl then looks at the middle of that pixel.
    const measured_size = [0.5 * width / middle(x, width), 0.5 * height / (height - middle(y, height))];
    this.programs.measure.use({...this.view, ...this.#textures(this.sets[set]), picture_size: [width, height], measured_size, quantity});
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.FLOAT, value);
    return value;
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
