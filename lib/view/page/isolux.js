// Isolux lines: their step, and the places of their numbers.
import {roundUp} from './exposure.js';

// About eight lines up to `high`.
export const stepFor = (high) => roundUp(high / 8);

// [{x, y, level}] of numbers on lines, x and y from 0 to 1 from the lower left, apart from each other. `grid`: values
// {size, value(i), there(i)} of size x size pixels, row by row from below.
export function labelsOf({size, value, there}, step, {apart = 0.12, most = 24} = {}) {
  const labels = [];
  const free = (x, y) => labels.every((label) => Math.hypot(label.x - x, label.y - y) > apart);
  for (let row = 1; row < size - 1 && labels.length < most; ++row)
    for (let column = 0; column + 1 < size && labels.length < most; ++column) {
      const i = row * size + column;
      if (!there(i) || !there(i + 1)) continue;
      const [low, high] = [value(i), value(i + 1)].sort((a, b) => a - b), level = Math.floor(high / step);
      if (Math.floor(low / step) !== level - 1) continue;  // none, or an edge
      const x = (column + 1) / size, y = (row + 0.5) / size;
      if (x > 0.03 && x < 0.97 && free(x, y)) labels.push({x, y, level: level * step});
    }
  return labels;
}
