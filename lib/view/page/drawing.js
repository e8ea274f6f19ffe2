// The picture: visible surfaces, splatted records, light of lamps, and the way to the screen.
import {GlossRecords} from './gloss.js';
import {Lamps} from './lamps.js';
import {lightTargets, removeTargets} from './light_targets.js';
import {materialMap} from './materials.js';
import {Mesh} from './mesh.js';
import {Reflections} from './reflections.js';
import {makeTexture, Program, Target} from './gl.js';
import {Records} from './records.js';

const SKY_WIDTH = 256, SKY_HEIGHT = 128;
export const MEASURED = 96;  // pixels on a side of a measurement

const SHADERS = ['scene.vert', 'holes', 'gbuffer.frag', 'shadow.frag', 'picture.vert', 'direct.frag', 'rectangle', 'splat.vert', 'splat.frag',
                 'data', 'glint', 'gloss.vert', 'gloss.frag', 'specular', 'veil.frag', 'shine.frag', 'bake.frag', 'quantity', 'measure.frag', 'show.frag', 'overlay.vert', 'overlay.frag'];

// The texts of the shaders, and of the weight.
export async function loadShaders(load) {
  const names = [...SHADERS, 'weight'];
  const texts = await Promise.all(names.map((name) => load(`/${name}.glsl`)));
  return Object.fromEntries(names.map((name, i) => [name, texts[i]]));
}

export class Drawing {
  constructor(canvas, shaders, scene, records, gloss, palette) {
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
      veil: program('veil', 'scene.vert', 'specular', 'veil.frag'),
      shine: program('shine', 'scene.vert', 'specular', 'shine.frag'),
      bake: program('bake', 'picture.vert', 'data', 'quantity', 'bake.frag'),
      measure: program('measure', 'picture.vert', 'data', 'quantity', 'measure.frag'),
      show: program('show', 'picture.vert', 'data', 'quantity', 'show.frag'),
      overlay: program('overlay', 'overlay.vert', 'overlay.frag'),
    };
    this.canvas = canvas;
    this.mesh = new Mesh(gl, scene);
    this.records = new Records(gl, records);
    this.gloss = new GlossRecords(gl, gloss);
    this.materialMap = materialMap(gl, scene.material, gloss.lobe);
    this.lamps = new Lamps(gl, scene, this.mesh, this.programs.shadow, this.programs.veil);
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
    if (this.targets) removeTargets(this.targets);
    this.canvas.width = width, this.canvas.height = height;
    this.targets = this.#makeTargets(width, height);
  }

  #makeTargets(width, height) {
    return lightTargets(this.gl, width, height, {
      gloss: this.gloss.count > 0, panes: this.mesh.panes.length > 0, shine: this.mesh.shiny.length > 0,
    });
  }

  // Calls `draw` with targets of another size.
  withTargets(width, height, draw) {
    const own = this.targets;
    this.targets = this.#makeTargets(width, height);
    draw();
    removeTargets(this.targets);
    this.targets = own;
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

  #textures() {
    const map = (unit, id) => ({unit, target: this.gl.TEXTURE_2D, id});
    const {surfaces, direct, splat, gloss, veil, shine} = this.targets;
    const [position, normal, reflectance, emission] = surfaces.textures;
    return {
      position_map: map(0, position), normal_map: map(1, normal), reflectance_map: map(2, reflectance),
      emission_map: map(5, emission), direct_map: map(6, direct.textures[0]), glint_map: map(3, direct.textures[1]), splat_map: map(7, splat.textures[0]),
      sky_map: map(8, this.skyMap), palette_map: map(9, this.paletteMap), has_sky: this.hasSky,
      material_map: map(11, this.materialMap), gloss_map: map(12, gloss?.textures[0] ?? null), has_gloss: gloss !== null,
      veil_map: map(13, veil?.textures[0] ?? null), has_veil: veil !== null,
      shine_map: map(14, shine?.textures[0] ?? null), has_shine: shine !== null,
    };
  }

  // The light of a view. `accuracy`: of the records.
  light(eye, accuracy) {
    const view = this.viewOf(eye, this.canvas.width, this.canvas.height);
    this.reflections.prepare(this, eye, view, accuracy);
    this.lightOf(view, accuracy);
    this.reflections.shine(this.programs.shine, this.programs.veil, this.targets.shine, view);
  }

  // The light of the uniforms of a camera, but for reflections.
  lightOf(view, accuracy, parts = this.mesh.parts) {
    const gl = this.gl, {surfaces, direct, splat, gloss, veil} = this.targets;
    this.view = view;
    surfaces.bind();
    surfaces.clear();
    this.mesh.draw(this.programs.gbuffer, view, parts);
    this.#drawVeil(veil, view);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    splat.bind();
    splat.clear();
    const textures = this.#textures(), {position_map, normal_map, reflectance_map, material_map} = textures;
    this.records.splat(this.programs.splat, {...view, accuracy, inverse_accuracy: 1 / accuracy, position_map, normal_map});
    if (gloss) {
      gloss.bind();
      gloss.clear();
      const own = this.gloss.accuracy * accuracy / this.records.accuracy;
      this.gloss.splat(this.programs.gloss, {...view, accuracy: own, inverse_accuracy: 1 / own, position_map, normal_map, material_map});
    }
    direct.bind();
    direct.clear();
    if (!this.records.holdsDirect) this.#lightOfLamps({position_map, normal_map, reflectance_map, material_map}, view);
    gl.disable(gl.BLEND);
    this.targets.shine?.bind();
    this.targets.shine?.clear();
  }

  #lightOfLamps(maps, view) {
    this.lamps.light(this.programs.direct, {...maps, viewer: view.eye, backward: view.backward, view_perspective: view.perspective});
  }

  // What the panes before the surfaces leave of the light.
  #drawVeil(veil, view) {
    if (!veil) return;
    const gl = this.gl;
    veil.bind();
    veil.clear([1, 1, 1, 1]);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ZERO, gl.SRC_COLOR);
    gl.depthMask(false);
    this.mesh.draw(this.programs.veil, view, this.mesh.panes);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  // Luminance and distance of the latest view, into a texture of its size.
  bake(texture, target = this.gl.TEXTURE_2D, width = this.canvas.width, height = this.canvas.height) {
    const gl = this.gl, framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, target, texture, 0);
    gl.viewport(0, 0, width, height);
    this.programs.bake.use({...this.view, ...this.#textures(), picture_size: [width, height], quantity: 0});
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.deleteFramebuffer(framebuffer);
  }

  // To the screen: `look` has the uniforms of show.frag.glsl; `marks`: '', 'places' or 'zones'.
  show(look, marks, accuracy) {
    const gl = this.gl, {width, height} = this.canvas;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    this.programs.show.use({...this.view, ...this.#textures(), picture_size: [width, height], ...look});
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    if (!marks) return;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.records.mark(this.programs.overlay, {...this.view, accuracy, position_map: this.#textures().position_map}, marks === 'zones');
    gl.disable(gl.BLEND);
  }

  #read(target, quantity) {
    const gl = this.gl, {width, height} = target, values = new Float32Array(4 * width * height);
    target.bind();
    this.programs.measure.use({...this.view, ...this.#textures(), picture_size: [this.canvas.width, this.canvas.height],
                               measured_size: [width, height], quantity});
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, values);
    return values;
  }

  // Values of a quantity at a grid of pixels where a surface is visible, in rising order.
  values(quantity) {
    const read = this.#read(this.measured, quantity);
    const found = new Float32Array(MEASURED * MEASURED);
    let n = 0;
    for (let i = 0; i < found.length; ++i)
      if (read[4 * i + 1] > 0) found[n++] = read[4 * i];
    return found.subarray(0, n).sort();
  }

  // Luminance of a quantity in each pixel, from the top.
  pixels(quantity) {
    const {width, height} = this.canvas, target = new Target(this.gl, width, height, [this.gl.RGBA32F]);
    const read = this.#read(target, quantity);
    target.remove();
    const values = new Float32Array(width * height);
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x) values[(height - 1 - y) * width + x] = read[4 * (y * width + x)];
    return values;
  }
}
