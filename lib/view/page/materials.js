// What shaders read of each material, by the number that the G-buffer keeps (position.w: the material and 1).
import {dataTexture} from './data.js';

const TEXELS = 3;  // of a material, as data.glsl has it

// Texel 0: mean reflectance of gloss, and the kind of its glints. Texel 1: order, first row and rows of the lobe that
// reads radiance records. Texel 2: peak and width of glints.
export function materialMap(gl, material, lobe = {rows: 0}) {
  const values = new Float32Array(4 * TEXELS * material.rows);
  const set = (i, texel, numbers) => values.set(numbers, 4 * (TEXELS * i + texel));
  const rgb = (field, i) => field.subarray(3 * i, 3 * i + 3);
  for (let i = 0; i < material.rows; ++i) {
    set(i, 0, [...rgb(material.gloss, i), material.glint[i]]);
    set(i, 2, [...rgb(material.glint_peak, i), material.glint_width[i]]);
  }
  for (let i = 0; i < lobe.rows; ++i) set(lobe.material[i], 1, [lobe.order[i], lobe.first_row[i], lobe.row_count[i]]);
  return dataTexture(gl, values, 4, 'materials');
}
