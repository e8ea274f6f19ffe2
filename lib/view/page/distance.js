// The distance between two points of the scene.
import {seenAt} from './overlay.js';
import {length, scale, add, subtract} from './vector.js';

// Of two points, m: straight, on the level, and upwards.
export function distanceOf(a, b) {
  const way = subtract(b, a);
  return {straight: length(way), level: Math.hypot(way[0], way[2]), up: way[1]};
}

const metres = (v) => `${(Math.round(1000 * v) / 1000 + 0).toFixed(3)} m`;

export class Distance {
  constructor(output) { Object.assign(this, {output, points: []}); }

  // The first point, the second, or the first of another distance.
  take(point) {
    if (!point) return;
    this.points = this.points.length === 1 ? [this.points[0], point] : [point];
    this.#tell();
  }

  clear() {
    this.points = [];
    this.#tell();
  }

  #tell() {
    const [a, b] = this.points;
    if (!a) return this.output.textContent = '—';
    if (!b) return this.output.textContent = 'from here to …';
    const {straight, level, up} = distanceOf(a, b);
    this.output.textContent = `${metres(straight)} (level ${metres(level)}, up ${metres(up)})`;
  }

  draw(overlay, eye, aspect) {
    const seen = this.points.map((point) => seenAt(eye, aspect, point));
    seen.filter((place) => place).forEach((place) => overlay.point(place));
    if (seen.length < 2 || !seen[0] || !seen[1]) return;
    overlay.line(seen[0], seen[1]);
    const middle = seenAt(eye, aspect, scale(add(this.points[0], this.points[1]), 0.5));
    if (middle) overlay.word(middle, metres(distanceOf(...this.points).straight));
  }
}
