// The eye, and how keys, mouse and fingers move it.
import {add, cross, matrixOfRows, normalized, row, scale} from './vector.js';

const KEYS = {KeyW: [0, 0, 1], ArrowUp: [0, 0, 1], KeyS: [0, 0, -1], ArrowDown: [0, 0, -1], KeyA: [-1, 0, 0], ArrowLeft: [-1, 0, 0],
              KeyD: [1, 0, 0], ArrowRight: [1, 0, 0], KeyE: [0, 1, 0], PageUp: [0, 1, 0], KeyQ: [0, -1, 0], PageDown: [0, -1, 0]};
const STEEPEST = 1.55;  // of looking up and down, radians

export class Eye {
  constructor() {
    Object.assign(this, {position: [0, 0, 0], right: [1, 0, 0], up: [0, 1, 0], perspective: true, halfHeight: 0.5});
  }

  // Camera i of the scene.
  take(camera, i) {
    this.position = row(camera.position, i), this.right = row(camera.right, i), this.up = row(camera.up, i);
    this.perspective = camera.perspective[i] !== 0, this.halfHeight = camera.half_height[i];
  }

  // From outside the bounds to their middle.
  takeOutside(centre, size) {
    this.right = [1, 0, 0], this.up = [0, 1, 0], this.perspective = true, this.halfHeight = 0.5;
    this.position = add(centre, [0, 0, size]);
  }

  backward() { return cross(this.right, this.up); }
  axes() { return matrixOfRows(this.right, this.up, this.backward()); }

  // Direction through a place of the picture, -1 to 1 rightwards and upwards, and where it starts.
  ray(x, y, aspect) {
    const across = add(scale(this.right, x * this.halfHeight * aspect), scale(this.up, y * this.halfHeight));
    const forward = scale(this.backward(), -1);
    return this.perspective ? {origin: this.position, direction: add(forward, across)}
                            : {origin: add(this.position, across), direction: forward};
  }

  // Looks elsewhere by these angles; the horizon is level from then on.
  turn(yaw, pitch) {
    const back = this.backward();
    const level = Math.hypot(this.right[0], this.right[2]) > 1e-6 ? Math.atan2(-this.right[2], this.right[0]) : 0;
    const heading = level + yaw;
    const tilt = Math.max(-STEEPEST, Math.min(STEEPEST, Math.asin(Math.max(-1, Math.min(1, -back[1]))) + pitch));
    this.right = [Math.cos(heading), 0, -Math.sin(heading)];
    const forward = [-Math.sin(heading) * Math.cos(tilt), Math.sin(tilt), -Math.cos(heading) * Math.cos(tilt)];
    this.up = cross(this.right, forward);
  }

  // Walks: rightwards, up and forward, m, on the level.
  move([right, up, forward]) {
    const level = (v) => Math.hypot(v[0], v[2]) > 1e-6 ? normalized([v[0], 0, v[2]]) : [0, 0, 0];
    const back = this.backward(), steep = Math.abs(back[1]) > 0.999;
    const ahead = steep ? scale(level(this.up), Math.sign(back[1])) : level(scale(back, -1));
    this.position = add(this.position, add(add(scale(level(this.right), right), scale(ahead, forward)), [0, up, 0]));
  }
}

export class Walk {
  // `changed` is called whenever the eye has moved; `speed` in m/s.
  constructor(canvas, eye, speed, changed) {
    Object.assign(this, {canvas, eye, speed, changed, held: new Set(), pointers: new Map(), last: 0});
    canvas.addEventListener('keydown', (event) => this.#key(event, true));
    canvas.addEventListener('keyup', (event) => this.#key(event, false));
    canvas.addEventListener('blur', () => this.held.clear());
    canvas.addEventListener('pointerdown', (event) => {
      canvas.focus();
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    for (const name of ['pointerup', 'pointercancel'])
      canvas.addEventListener(name, (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener('pointermove', (event) => this.#drag(event));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.eye.move([0, 0, -Math.sign(event.deltaY) * this.speed * 0.2]);
      this.changed();
    }, {passive: false});
  }

  get dragging() { return this.pointers.size > 0; }

  #key(event, down) {
    if (!KEYS[event.code] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    if (down) this.held.add(event.code); else this.held.delete(event.code);
    this.fast = event.shiftKey;
    if (down) this.changed();
  }

  // One pointer looks around; two walk.
  #drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before[0], dy = event.clientY - before[1], per = 2 * this.eye.halfHeight / this.canvas.clientHeight;
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size === 1 && this.eye.perspective) this.eye.turn(dx * per, dy * per);
    else this.eye.move([-dx * this.speed * 0.005, 0, dy * this.speed * 0.005]);
    this.changed();
  }

  // Moves by the keys that are held. True while any is.
  step(now) {
    const seconds = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    if (!this.held.size) return false;
    const way = [0, 0, 0];
    for (const code of this.held) KEYS[code].forEach((v, k) => way[k] += v);
    this.eye.move(scale(way, seconds * this.speed * (this.fast ? 3 : 1)));
    return true;
  }
}
