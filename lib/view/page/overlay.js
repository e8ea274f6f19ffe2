// Lines and words over the picture, as SVG.
import {dot, subtract} from './vector.js';

const SVG = 'http://www.w3.org/2000/svg';

// Where a point of the scene is seen: from 0 to 1 from the upper left. Null: behind the eye.
export function seenAt(eye, aspect, point) {
  const way = subtract(point, eye.position), along = -dot(way, eye.backward());
  const depth = eye.perspective ? along : 1;
  if (!(depth > 1e-6) || !(along > 0)) return null;
  return [0.5 + 0.5 * dot(way, eye.right) / (depth * eye.halfHeight * aspect), 0.5 - 0.5 * dot(way, eye.up) / (depth * eye.halfHeight)];
}

export class Overlay {
  constructor(svg) { this.svg = svg; }

  clear() { this.svg.replaceChildren(); }

  #add(kind, attributes, text = '') {
    const element = document.createElementNS(SVG, kind);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.textContent = text;
    this.svg.append(element);
  }

  // Places from 0 to 1 from the upper left.
  line(a, b) {
    const ends = {x1: `${100 * a[0]}%`, y1: `${100 * a[1]}%`, x2: `${100 * b[0]}%`, y2: `${100 * b[1]}%`};
    this.#add('line', {...ends, class: 'under'});
    this.#add('line', ends);
  }
  point([x, y]) { this.#add('circle', {cx: `${100 * x}%`, cy: `${100 * y}%`, r: 4}); }
  word([x, y], text) { this.#add('text', {x: `${100 * x}%`, y: `${100 * y}%`}, text); }
}
