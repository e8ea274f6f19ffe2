// What shaders read of each material, by the number that the G-buffer keeps (position.w: the material and 1).
import {dataTexture} from './data.js';

// Texel 0: mean reflectance of gloss. Texel 1: order, first row and rows of the lobe that reads radiance records.
export function materialMap(gl, material, lobe) {
  const values = new Float32Array(8 * material.rows);
  for (let i = 0; i < material.rows; ++i) values.set(material.gloss.subarray(3 * i, 3 * i + 3), 8 * i);
  for (let i = 0; i < lobe.rows; ++i)
    values.set([lobe.order[i], lobe.first_row[i], lobe.row_count[i]], 8 * lobe.material[i] + 4);
  return dataTexture(gl, values, 4, 'materials');
}
