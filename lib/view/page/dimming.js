// Weights of groups of lamps, and the sliders that set them.

// `name` among `names`, or the likest by the letters that both begin with.
function likest(name, names) {
  const same = (a) => {
    let n = 0;
    while (n < Math.min(a.length, name.length) && a[n] === name[n]) ++n;
    return n;
  };
  return [...names].sort((a, b) => same(b) - same(a))[0];
}

// Weights by name. `words`: "NAME:WEIGHT", or "WEIGHT" of caches without names. Throws an Error for another name.
export function weightsOf(names, words) {
  const weights = new Map(names.map((name) => [name, 1]));
  for (const word of words) {
    const end = word.lastIndexOf(':'), name = word.slice(0, Math.max(end, 0)), digits = word.slice(end + 1);
    const weight = digits.trim() ? Number(digits) : NaN;
    if (!weights.has(name)) {
      const likely = likest(name, names);
      throw new Error(`there is no group "${name}"; ` +
                      (likely ? `did you mean "${likely}"?` : 'the caches have no names: give weight=W'));
    }
    if (!(weight >= 0 && weight < 1e6)) throw new Error(`the weight "${digits}" is no number from 0 to 1e6`);
    weights.set(name, weight);
  }
  return weights;
}

export class Dimming {
  // `changed` is called when a weight has changed. Groups of one name in two sets have one weight.
  constructor({section, list, all}, sets, words, changed) {
    this.sets = sets;
    const names = [...new Set(sets.flatMap((set) => set.groups.map((group) => group.name)))];
    this.weights = weightsOf(names, words);
    this.sliders = names.map((name) => this.#slider(list, name, changed));
    all.onclick = () => {
      names.forEach((name) => this.weights.set(name, 1));
      for (const tell of this.sliders) tell();
      this.apply();
      changed();
    };
    section.hidden = false;
    this.apply();
  }

  #slider(list, name, changed) {
    const label = document.createElement('label'), input = document.createElement('input'), output = document.createElement('output');
    Object.assign(input, {type: 'range', min: 0, max: 100, step: 1});
    label.append(`${name || 'all lamps'} `, output, ' %', input);
    list.append(label);
    const tell = () => {
      const percent = 100 * this.weights.get(name);
      input.value = percent, output.textContent = +percent.toPrecision(4);
    };
    input.oninput = () => {
      this.weights.set(name, input.value / 100);
      tell();
      this.apply();
      changed();
    };
    tell();
    return tell;
  }

  apply() {
    for (const set of this.sets) for (const group of set.groups) group.weight = this.weights.get(group.name);
  }
}
