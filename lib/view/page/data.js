// Tables of numbers as textures, which shaders read by data.glsl.
import {makeTexture} from './gl.js';

const WIDTH = 2048;

// `values`: rows of 3 or 4 numbers.
export function dataTexture(gl, values, components, what) {
  const rows = Math.max(1, values.length / components), height = Math.ceil(rows / WIDTH);
  if (height > gl.getParameter(gl.MAX_TEXTURE_SIZE))
    throw new Error(`${what} are too many for this graphics card: ${rows} rows`);
  const id = makeTexture(gl, components === 3 ? gl.RGB32F : gl.RGBA32F, WIDTH, height);
  const format = components === 3 ? gl.RGB : gl.RGBA, whole = Math.floor(values.length / (WIDTH * components));
  const upload = (y, width, lines, part) => gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, y, width, lines, format, gl.FLOAT, part);
  if (whole > 0) upload(0, WIDTH, whole, values.subarray(0, whole * WIDTH * components));
  const rest = values.subarray(whole * WIDTH * components);
  if (rest.length) upload(whole, rest.length / components, 1, rest);
  return id;
}
