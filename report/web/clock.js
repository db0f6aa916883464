/** The instant that machine and charts show, and its advance. */
export class Clock {
  #listeners = [];
  #last = 0;
  t = 0;
  speed = 1;
  playing = false;

  constructor(duration) {
    this.duration = duration;
  }

  onChange(listener) {
    this.#listeners.push(listener);
    listener(this);
  }

  #tell() {
    for (const listener of this.#listeners) listener(this);
  }

  set(t) {
    this.t = Math.min(Math.max(t, 0), this.duration);
    this.#tell();
  }

  play() {
    if (this.playing) return;
    if (this.t >= this.duration) this.t = 0;
    this.playing = true;
    this.#last = performance.now();
    requestAnimationFrame((now) => this.#tick(now));
    this.#tell();
  }

  pause() {
    this.playing = false;
    this.#tell();
  }

  #tick(now) {
    if (!this.playing) return;
    const t = this.t + (Math.max(0, now - this.#last) / 1000) * this.speed;
    this.#last = now;
    if (t >= this.duration) this.playing = false;
    this.set(t);
    if (this.playing) requestAnimationFrame((next) => this.#tick(next));
  }
}
