// Asks the server for the light where a ray lands: one question at a time, the newest first.

export class LightQuestions {
  constructor(messages, answered, lost) {
    Object.assign(this, {messages, answered, number: 0, waiting: null, busy: true});
    this.socket = new WebSocket(`ws://${location.host}/socket`);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => this.#next();
    this.socket.onmessage = (event) => {
      const {reading} = messages.read(event.data, 'reading');
      this.#next();
      answered(Object.fromEntries(Object.entries(reading).map(([name, v]) => [name, v.length === 1 ? v[0] : v])));
    };
    this.socket.onclose = lost;
  }

  // `set`: of caches; `weights`: of its groups.
  ask({origin, direction}, set, weights) {
    this.waiting = this.messages.write('question', {ray: {number: [++this.number], set: [set], origin, direction}, group: {weight: weights}});
    if (!this.busy) this.#next();
  }

  #next() {
    this.busy = this.waiting !== null;
    if (this.busy) this.socket.send(this.waiting);
    this.waiting = null;
  }
}
