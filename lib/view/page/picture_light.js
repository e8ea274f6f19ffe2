// The light under the cursor where no server reads it from the caches: that of the picture, at its pixel.
const SAID = 'Values of the picture at this pixel. This page has no server: the exact value from the caches, and its ' +
    'standard error, need phos-view itself.';

export class PictureLight {
  constructor(drawing, answered) {
    Object.assign(this, {drawing, answered, waiting: null});
    const said = document.createElement('p');
    said.id = 'of-picture', said.textContent = SAID;
    document.getElementById('place').closest('section').append(said);
  }

  // Of a place of the picture, from 0 to 1 from the upper left, by a set of caches; once a frame, the newest.
  ask(_ray, set, _weights, [x, y]) {
    if (!this.waiting) requestAnimationFrame(() => this.#answer());
    this.waiting = {set, x, y};
  }

  #answer() {
    const {drawing} = this, {set, x, y} = this.waiting;
    this.waiting = null;
    if (drawing.view) this.answered(readingAt(drawing, set, x, y));
  }
}

// As the server's reading (view/message/format.h), without standard errors. Light that no record gives is unknown.
export function readingAt(drawing, set, x, y) {
  const at = (quantity) => drawing.valueAt(x, y, quantity, set), unless = (unknown, value) => unknown ? NaN : value;
  const [luminance, hit, hole] = at(0), [illuminance] = at(1), [indirect] = at(2), [direct] = at(3), all = drawing.sets[set].holdsDirect;
  return {
    hit, position: drawing.pointAt(x, y) ?? [0, 0, 0], luminance: unless(hole, luminance), illuminance: unless(hole, illuminance),
    indirect: unless(hole || all, indirect), direct: unless(all, direct), has_gloss: 0,
  };
}
