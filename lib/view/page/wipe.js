// The wipe between two sets of caches: the first to the left, the second to the right.

// The parts of a picture `width` pixels wide: [{set, x, width}] from the left. `share`: of the first set.
export function wiped(sets, share, width) {
  if (sets.length < 2) return [{set: sets[0], x: 0, width}];
  const middle = Math.round(Math.min(Math.max(share, 0), 1) * width);
  return [{set: sets[0], x: 0, width: middle}, {set: sets[1], x: middle, width: width - middle}].filter((part) => part.width > 0);
}

export class Wipe {
  // `changed` is called when the share has changed.
  constructor({section, slider, line, labels}, sets, share, changed) {
    Object.assign(this, {slider, line, changed, two: sets.length > 1});
    section.hidden = line.hidden = !this.two;
    if (!this.two) return;
    labels.textContent = `${sets[0].label} | ${sets[1].label}`;
    slider.oninput = () => this.#moved();
    slider.value = 100 * share;
    line.addEventListener('pointerdown', (event) => line.setPointerCapture(event.pointerId));
    line.addEventListener('pointermove', (event) => {
      if (!line.hasPointerCapture(event.pointerId)) return;
      const box = line.parentElement.getBoundingClientRect();
      slider.value = 100 * (event.clientX - box.left) / box.width;
      this.#moved();
    });
    this.#place();
  }

  get share() { return this.two ? this.slider.value / 100 : 1; }

  // The set seen at a place of the picture, 0 to 1 from the left.
  setAt(x) { return this.two && x >= this.share ? 1 : 0; }

  #place() { this.line.style.left = `${100 * this.share}%`; }
  #moved() {
    this.#place();
    this.changed();
  }
}
