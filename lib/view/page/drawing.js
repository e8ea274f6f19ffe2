// The picture: visible surfaces, splatted records, light of lamps, and the way to the screen.
import {Lamps} from './lamps.js';
import {Mesh} from './mesh.js';
import {makeTexture, Program, Target} from './gl.js';
import {Records} from './records.js';

const SKY_WIDTH = 256, SKY_HEIGHT = 128;
export const MEASURED = 96;  // pixels on a side of a measurement

const SHADERS = ['scene.vert', 'holes', 'gbuffer.frag', 'shadow.frag', 'picture.vert', 'direct.frag', 'splat.vert', 'splat.frag',
                 'quantity', 'measure.frag', 'show.frag', 'overlay.vert', 'overlay.frag'];

// The texts of the shaders, and of the weight.
export async function loadShaders(load) {
  const names = [...SHADERS, 'weight'];
  const texts = await Promise.all(names.map((name) => load(`/${name}.glsl`)));
  return Object.fromEntries(names.map((name, i) => [name, texts[i]]));
}

export class Drawing {
  constructor(canvas, shaders, scene, records, palette) {
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
      measure: program('measure', 'picture.vert', 'quantity', 'measure.frag'),
      show: program('show', 'picture.vert', 'quantity', 'show.frag'),
      overlay: program('overlay', 'overlay.vert', 'overlay.frag'),
    };
    this.canvas = canvas;
    this.mesh = new Mesh(gl, scene);
    this.records = new Records(gl, records);
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
    for (const target of [this.surfaces, this.direct, this.splat]) target?.remove();
    this.canvas.width = width, this.canvas.height = height;
    this.surfaces = new Target(gl, width, height, [float, float, float, float], true);
    this.direct = new Target(gl, width, height, [float]);
    this.splat = new Target(gl, width, height, [float]);
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

  #textures() {
    const map = (unit, id) => ({unit, target: this.gl.TEXTURE_2D, id});
    const [position, normal, reflectance, emission] = this.surfaces.textures;
    return {
      position_map: map(0, position), normal_map: map(1, normal), reflectance_map: map(2, reflectance),
      emission_map: map(5, emission), direct_map: map(6, this.direct.textures[0]), splat_map: map(7, this.splat.textures[0]),
      sky_map: map(8, this.skyMap), palette_map: map(9, this.paletteMap), has_sky: this.hasSky,
    };
  }

  // The light of a view. `accuracy`: of the records.
  light(eye, accuracy) {
    const gl = this.gl, view = this.view = this.#view(eye);
    this.surfaces.bind();
    this.surfaces.clear();
    this.mesh.draw(this.programs.gbuffer, view);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    this.splat.bind();
    this.splat.clear();
    const textures = this.#textures();
    this.records.splat(this.programs.splat, {...view, accuracy, inverse_accuracy: 1 / accuracy,
                                             position_map: textures.position_map, normal_map: textures.normal_map});
    this.direct.bind();
    this.direct.clear();
    if (!this.records.holdsDirect)
      this.lamps.light(this.programs.direct, {position_map: textures.position_map, normal_map: textures.normal_map,
                                              reflectance_map: textures.reflectance_map});
    gl.disable(gl.BLEND);
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

  #read(target, quantity, measured_size = [target.width, target.height]) {
    const gl = this.gl, {width, height} = target, values = new Float32Array(4 * width * height);
    target.bind();
    this.programs.measure.use({...this.view, ...this.#textures(), picture_size: [this.canvas.width, this.canvas.height],
                               measured_size, quantity});
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

  // A quantity at one pixel from the bottom left; 1 where a surface is visible; 1 where no record reaches it.
  valueAt([x, y], quantity) {
    this.onePixel ??= new Target(this.gl, 1, 1, [this.gl.RGBA32F]);
    const {width, height} = this.canvas;  // measure.frag.glsl then looks at the middle of that pixel
    return this.#read(this.onePixel, quantity, [0.5 * width / (x + 0.5), 0.5 * height / (y + 0.5)]);
  }

  // The place that is visible there, m.
  placeAt([x, y]) {
    const gl = this.gl, place = new Float32Array(4);
    this.surfaces.bind();
    gl.readPixels(x, y, 1, 1, gl.RGBA, gl.FLOAT, place);
    return place.subarray(0, 3);
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
