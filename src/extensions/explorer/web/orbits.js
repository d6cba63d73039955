/* The orbits on the screen: their first impacts, and what is known about each. */
const KEPT = 50000; // impacts of an orbit that are kept; later ones are computed again to draw them

/** Give the regular orbits the hues in turn, so that those that start beside each other differ. */
function assignHues(orbits, hues) {
  const regular = orbits.filter((one) => !one.isSea() && one.settled && one.facts?.verdict !== "undecided");
  regular.forEach((orbit, i) => (orbit.hue = i % hues));
}

/** What is shown of an orbit's facts: a chaotic one has no rotation number. */
function shownFacts(facts) { return facts?.verdict === "chaotic" ? { ...facts, rotation: NaN } : facts; }

class Orbit {
  constructor({ p, q, xy, impacts, back, sea }, page) {
    Object.assign(this, { p, q, xy, impacts, back, sea, page });
    this.clear();
  }

  clear() {
    this.key = Orbit.keys = (Orbit.keys ?? 0) + 1;
    this.count = 0; // impacts so far, of which the first are `kept`
    this.kept = 0;
    this.last = null; // the last state that is kept, before it is mirrored
    this.pace = 12; // impacts asked for at once, which grows, so that one sees it begin
    this.facts = null;
    this.refused = ""; // why it stops before its end
    this.endless = false; // whether it continues until it is stopped
    this.hue = null; // one of the style sheet's, if it is regular
    this.history = []; // [impacts, exponent so far]
    for (const name of ["x", "xdot", "udot", "tau"]) this[name] = new Float64Array(256);
  }

  get done() { return !this.start || this.refused !== "" || (!this.endless && this.count >= this.impacts); }

  /** Whether the worker is still to be asked for something. */
  get waits() { return !this.done || Boolean(this.start && !this.refused && !this.facts?.verdict); }

  /** Add impacts that the worker has computed, and keep the first ones. */
  append(piece, k) {
    this.k = k;
    const size = Math.min(piece.x.length, KEPT - this.kept);
    if (size) this.last = ["x", "xdot", "udot"].map((name) => piece[name][size - 1]);
    this.mirror(piece);
    for (const name of ["x", "xdot", "udot", "tau"]) {
      if (this.kept + size > this[name].length) {
        const larger = new Float64Array(Math.min(KEPT, Math.max(this.kept + size, 2 * this[name].length)));
        larger.set(this[name]);
        this[name] = larger;
      }
      this[name].set(piece[name].slice(0, size), this.kept);
    }
    this.kept += size;
    this.count += piece.x.length;
    this.facts = shownFacts(piece.facts);
    this.refused = piece.refused ?? "";
    const [before] = this.history.at(-1) ?? [0];
    if (piece.facts && (this.count > 1.01 * before || this.done))
      this.history.push([this.count, piece.facts.exponent]);
  }

  /** Turn impacts of the worker in place into those of a backward orbit, if this is one. */
  mirror({ x, xdot, udot }) {
    if (!this.back) return;
    for (let i = 0; i < x.length; i++) {
      [x[i], xdot[i], udot[i]] = pseudorigid.reverse(this.k, x[i], xdot[i], udot[i]);
    }
  }

  /** The state before impact i; 0 is the start. */
  stateAt(i) { return i === 0 ? this.start : [this.x[i - 1], this.xdot[i - 1], this.udot[i - 1]]; }
  isSea() { return Boolean(this.sea || this.facts?.verdict === "chaotic"); }

  /** Whether it is the one that the time view shows, which is highlighted. */
  get chosen() { return this.page.orbits[this.page.state.chosen] === this; }

  colour(colours) {
    const by = this.page.state.colour;
    if (by === "rotation" || by === "exponent") {
      const [low, high] = this.page.range();
      const value = this.facts?.[by] ?? NaN;
      return Number.isFinite(value) ? mixed(colours.ramp, (value - low) / (high - low)) : colours.sea;
    }
    if (this.chosen && this.isSea()) return colours.ink;
    if (by === "verdict") return colours[`${this.facts?.verdict}-orbit`] ?? colours.ink;
    if (this.isSea()) return colours.sea;
    return this.hue === null ? colours.ink : colours.hues[this.hue];
  }

  /** Whether it is known well enough to get a colour. */
  get settled() { return Boolean(this.facts?.verdict || (this.count && this.done)); }

  /** The rotation number with the digits that mean something. */
  get rotationText() {
    if (!this.facts || !Number.isFinite(this.facts.rotation)) return "–";
    return shortNumber(this.facts.rotation, this.facts.verdict === "regular" ? 8 : 3);
  }

  get startText() {
    if (this.xy) return `x = ${shortNumber(this.xy[0])}, y = ${shortNumber(this.xy[1])}`;
    return this.q === 0 ? shortNumber(this.p, 5) : `${shortNumber(this.p, 4)}, ${shortNumber(this.q, 4)}`;
  }
}
