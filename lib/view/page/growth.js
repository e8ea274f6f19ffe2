// Asks the server for records where the view has none, and draws them. Holes come first; then, while the eye rests, points
// that only far records reach, and the picture is drawn with a smaller accuracy.
import {OpenPoints} from './open_points.js';

const REST_MS = 500;  // the eye rests
const BUSY_MS = 30, LOOK_MS = 100, IDLE_MS = 500;  // between messages
const LOOKS = 4;  // without an open point end a level
const TRIES = 4;  // at a place: some surfaces get no records
const CELLS = 500;  // places along the scene
const MOST_CELLS = 1e5;  // that are remembered
const STATES = ['The first records are being prepared', '', 'No more records fit', 'The program makes no more records'];

export class Growth {
  // `about`: {records_per_frame, accuracy, least_share, save}; `changed` is called when there are new records.
  constructor(about, messages, drawing, panel, changed) {
    Object.assign(this, {about, messages, drawing, panel, changed, pose: '', tries: new Map(), since: 0, waiting: 0, state: 0,
                         records: 0, next: 0, saves: 0, save: false, busy: true, share: 1});
    this.shares = [1, Math.SQRT1_2, 0.5].filter((share) => share >= about.least_share);
    this.open = new OpenPoints(drawing);
    this.first = drawing.records.count;
    this.#restart(0);
    panel.section.hidden = false;
    panel.save.hidden = !about.save;
    panel.save.onclick = () => { this.save = true; this.next = 0; };
    panel.grows.onchange = () => this.#tell();
    this.socket = new WebSocket(`ws://${location.host}/socket`);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => this.#ready();
    this.socket.onmessage = (event) => this.#take(messages.read(event.data, 'grown'));
    this.socket.onclose = () => this.busy = true;
  }

  // After a frame is drawn. `accuracy`: of the records, while the eye moves.
  step(now, eye, accuracy) {
    const pose = [...eye.position, ...eye.right, ...eye.up, accuracy].join();
    if (pose !== this.pose) this.pose = pose, this.#restart(now);
    if (this.busy || now < this.next) return;
    const points = this.waiting === 0 ? this.#look(now, accuracy) : [];
    this.#send(points);
    this.next = now + (points.length || this.waiting ? BUSY_MS : this.#looks() ? LOOK_MS : IDLE_MS);
  }

  // For a page without a screen: the records that are there, then so many frames, and the records of each before the next.
  // Requests for `beat` keep its clock.
  async settle(frames, accuracy, draw, beat) {
    let settled = false;
    const beats = (async () => { while (!settled) await beat(); })();
    while (this.busy) await beat();
    for (let i = 0; i <= frames; ++i) {
      draw();
      this.#send(i > 0 ? this.#choose(this.open.find(accuracy)) : []);
      do {
        while (this.busy) await beat();
        if (this.waiting || this.more) this.#send([]);
      } while (this.busy);
    }
    draw();
    settled = true;
    await beats;
  }

  #restart(now) {
    Object.assign(this, {moved: now, level: 0, looks: 0, next: 0});
    if (this.share !== 1) this.share = 1, this.changed();
  }

  #looks() { return this.panel.grows.checked && this.state < 2 && this.level <= this.shares.length; }

  // Points to ask for. Level 0: holes; then by shares of the accuracy at which records were placed.
  #look(now, accuracy) {
    const {shares, level} = this;
    if (!this.#looks() || (level > 0 && now - this.moved < REST_MS)) return [];
    const points = this.#choose(this.open.find(this.#wanted(accuracy)));
    this.looks = points.length ? 0 : this.looks + 1;
    if (this.looks >= LOOKS) {
      if (level > 0 && this.share !== shares[level - 1]) this.share = shares[level - 1], this.changed();
      ++this.level, this.looks = 0;
      this.#tell();
    }
    return points;
  }

  #wanted(accuracy) { return this.level === 0 ? accuracy : this.about.accuracy * this.shares[this.level - 1]; }

  // Some of the points, all over the picture, that have not been asked for in vain.
  #choose(points) {
    const fresh = points.filter(({position}) => (this.tries.get(this.#cell(position)) ?? 0) < TRIES);
    const chosen = [];
    if (this.tries.size > MOST_CELLS) this.tries.clear();
    for (let left = fresh.length; left > 0 && chosen.length < this.about.records_per_frame; --left) {
      const i = Math.floor(Math.random() * left), point = fresh[i], cell = this.#cell(point.position);
      fresh[i] = fresh[left - 1];
      this.tries.set(cell, (this.tries.get(cell) ?? 0) + 1);
      chosen.push(point);
    }
    return chosen;
  }

  #cell(position) { return `${this.level} ${position.map((p) => Math.round(p / this.drawing.size * CELLS)).join(' ')}`; }

  #send(points) {
    const share = this.level === 0 ? 1 : this.shares[this.level - 1];
    this.busy = true;
    this.socket.send(this.messages.write('wish', {
      wish: {since: [this.since], share: [share], save: [this.save ? 1 : 0]},
      point: {position: points.flatMap((p) => p.position), normal: points.flatMap((p) => p.normal)},
    }));
    this.save = false;
  }

  #ready() { this.busy = false; }

  #take({growth, record}) {
    [this.since, this.waiting, this.state, this.records] = [growth.serial[0], growth.waiting[0], growth.state[0], growth.records[0]];
    this.more = growth.more[0] !== 0;
    if (this.more) this.next = 0;
    if (growth.save_failed[0]) this.panel.saved.textContent = 'The file cannot be written; see the terminal';
    else if (growth.saves[0] !== this.saves) this.panel.saved.textContent = 'Saved';
    else if (record.rows) this.panel.saved.textContent = '';
    this.saves = growth.saves[0];
    if (record.rows) {
      this.drawing.records.put(record, this.first);
      this.changed();
    }
    this.#tell();
    this.#ready();
  }

  #tell() {
    const done = this.level > this.shares.length ? ', fine enough for this view' : this.level > 0 ? ', no hole in this view' : '';
    const words = STATES[this.state] || (this.waiting ? `${this.waiting} places wait` : '');
    this.panel.text.textContent = `${this.records} new${done}${words ? `. ${words}.` : ''}`;
  }
}
