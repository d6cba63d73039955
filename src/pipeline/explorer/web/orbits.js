"use strict";
/* The orbits on the screen: their impacts so far, and what is known about each. */

class Orbit {
  constructor({ p, q, impacts, back, sea }, hue, mode) {
    Object.assign(this, { p, q, impacts, back, sea, hue, mode });
    this.clear();
  }

  clear() {
    Orbit.keys = (Orbit.keys ?? 0) + 1;
    this.key = Orbit.keys;
    this.count = 0;
    this.pace = 12; // impacts asked for at once, which grows, so that one sees it begin
    this.facts = null;
    this.history = []; // [impacts, exponent so far]
    for (const name of ["x", "xdot", "udot", "tau"]) this[name] = new Float64Array(256);
  }

  get done() {
    return !this.start || this.count >= this.impacts;
  }

  /** Add impacts that the worker has computed; those of a backward orbit are mirrored. */
  append(piece, k) {
    const size = piece.x.length;
    for (const name of ["x", "xdot", "udot", "tau"]) {
      if (this.count + size > this[name].length) {
        const larger = new Float64Array(Math.max(this.count + size, 2 * this[name].length));
        larger.set(this[name]);
        this[name] = larger;
      }
      this[name].set(piece[name], this.count);
    }
    if (this.back) {
      for (let i = this.count; i < this.count + size; i++) {
        const state = pseudorigid.reverse(k, this.x[i], this.xdot[i], this.udot[i]);
        [this.x[i], this.xdot[i], this.udot[i]] = state;
      }
    }
    this.count += size;
    this.facts = piece.facts;
    this.history.push([this.count, piece.facts.exponent]);
  }

  /** The state before impact i; 0 is the start. */
  stateAt(i) {
    return i === 0 ? this.start : [this.x[i - 1], this.xdot[i - 1], this.udot[i - 1]];
  }

  isSea() {
    return Boolean(this.sea || this.facts?.verdict === "chaotic");
  }

  colour(colours) {
    if (this.mode() === "verdict") return colours[this.facts?.verdict || "young"];
    return this.sea ? colours.sea : colours.hues[this.hue % colours.hues.length];
  }

  /** The rotation number with the digits that mean something. */
  get rotationText() {
    if (!this.facts || !Number.isFinite(this.facts.rotation)) return "–";
    return shortNumber(this.facts.rotation, this.facts.verdict === "regular" ? 8 : 3);
  }

  get startText() {
    return this.q === 0 ? shortNumber(this.p, 5) : `${shortNumber(this.p, 4)}, ${shortNumber(this.q, 4)}`;
  }
}
