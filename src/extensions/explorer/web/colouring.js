"use strict";
/*
 * The section in colour: a grid of orbits over what is in sight, first a coarse one. Each cell has the
 * exponent and the rotation number after 200 impacts, and a verdict once its orbit is decided.
 */
const GRIDS = { exponent: [60, 300], rotation: [60, 300], verdict: [60, 200] }; // cells along a side
const CHUNK = 528; // orbits of a request, in full SIMD lanes; a change waits for at most one
const EXPONENTS = [0.005, 0.5]; // the ends of the scale
const UNDECIDED_GROWTH = 2.2; // below which a rotation number is shown before the verdict

class Grid {
  constructor(size) {
    this.size = size;
    this.known = new Uint8Array(size * size);
    this.verdict = new Uint8Array(size * size);
    for (const name of ["exponent", "rotation", "growth"]) this[name] = new Float64Array(size * size);
  }

  take(result) {
    result.index.forEach((cell, i) => {
      this.known[cell] = 1;
      for (const name of ["exponent", "rotation", "growth", "verdict"]) {
        if (result[name]) this[name][cell] = result[name][i];
      }
    });
  }

  /** Whether a cell's rotation number is shown. */
  turns(cell) {
    const verdict = this.verdict[cell];
    return verdict === 1 || (!verdict && this.growth[cell] < UNDECIDED_GROWTH);
  }

  /** The colours of all cells, 0 where nothing is known. */
  inks(by, range, colours) {
    const ramp = Uint32Array.from({ length: 256 }, (_, i) => packed(mixed(colours.ramp, i / 255)));
    const verdicts = Uint32Array.from(["surface", "regular", "chaotic", "undecided", "undecided"], (name) => packed(colours[name]));
    const sea = packed(colours.sea);
    const low = by === "exponent" ? Math.log(range[0]) : range[0];
    const scale = 255 / ((by === "exponent" ? Math.log(range[1]) : range[1]) - low);
    return Uint32Array.from(this.known, (known, cell) => {
      if (!known) return 0;
      if (by === "verdict") return verdicts[this.verdict[cell]];
      if (by === "rotation" && !this.turns(cell)) return sea;
      const value = by === "exponent" ? Math.log(Math.max(1e-9, this.exponent[cell])) : this.rotation[cell];
      return Number.isNaN(value) ? sea : ramp[Math.min(255, Math.max(0, Math.round((value - low) * scale)))];
    });
  }
}

class Colouring {
  constructor(page) {
    this.page = page;
    this.key = "";
    this.window = null;
  }

  /** Compute for what is in sight now, unless that is done or under way; at once or a little later. */
  update(delay = 0) {
    const { state, section } = this.page;
    clearTimeout(this.waits);
    if (state.map === "none") {
      if (this.window) setText("map-note", "");
      Object.assign(this, { key: "", window: null });
      return;
    }
    this.waits = setTimeout(() => {
      const window = section.window();
      const { k, g, energy, map } = state;
      const key = JSON.stringify([k, g, energy, map, window]);
      if (!window || key === this.key) return;
      this.key = key;
      this.compute({ k, g, energy }, window, map, () => key === this.key);
    }, delay);
  }

  /** Compute the coarse grid and then the fine one; the old picture stays until there is a new one. */
  async compute(ball, window, map, wanted) {
    const grids = GRIDS[map].map((size) => new Grid(size));
    const [coarse, fine] = grids;
    const first = await Promise.all(this.chunks(coarse.size, window).map((chunk) => this.page.pool.ask("pixels", { ...ball, ...chunk }, wanted)));
    if (!wanted()) return;
    first.forEach((result) => coarse.take(result));
    const open = this.chunks(fine.size, window).map((chunk) => ({ ...ball, ...chunk }));
    Object.assign(this, { window, grids, by: map, energy: ball.energy, left: open.length });
    this.draw();
    const follow = async (request) => {
      const result = await this.page.pool.ask("pixels", request, wanted);
      if (!result) return;
      fine.take(result);
      this.left -= 1;
      if (map !== "exponent" && result.rest.index.length) {
        this.left += 1;
        follow({ ...ball, rest: result.rest, done: result.done });
      }
      this.drawSoon();
    };
    open.forEach(follow);
  }

  /** The cells of a grid whose middles lie on the section, in rows that jump about. */
  chunks(size, { p, q }) {
    const cells = [];
    const places = [];
    const step = [67, 61, 59].find((prime) => size % prime); // visits each row once
    for (let n = 0; n < size; n++) {
      const row = (n * step) % size;
      for (let column = 0; column < size; column++) {
        const at = [p[0] + ((column + 0.5) / size) * (p[1] - p[0]), q[0] + ((row + 0.5) / size) * (q[1] - q[0])];
        if (!(at[0] ** 2 + at[1] ** 2 < 1)) continue;
        cells.push(row * size + column);
        places.push(...at);
      }
    }
    return Array.from({ length: Math.ceil(cells.length / CHUNK) }, (_, i) => ({
      index: Uint32Array.from(cells.slice(i * CHUNK, (i + 1) * CHUNK)),
      places: Float64Array.from(places.slice(2 * i * CHUNK, 2 * (i + 1) * CHUNK)),
    }));
  }

  drawSoon() { this.drawing ??= setTimeout(() => this.draw(), this.left ? 120 : 0); }

  draw() {
    clearTimeout(this.drawing);
    this.drawing = null;
    const { section } = this.page;
    section.drawMap();
    section.drawLines();
    setText("map-note", this.words);
  }

  get done() { return this.window !== null && this.left === 0; }

  /** The ends of the scale of colours; null for verdicts. */
  get range() {
    if (!this.window || this.by === "verdict") return null;
    if (this.by === "exponent") return EXPONENTS;
    const grid = this.grids[0];
    const values = [...grid.rotation].filter((_, cell) => grid.known[cell] && grid.turns(cell)).sort((a, b) => a - b);
    if (!values.length) return [0, 1];
    const [low, high] = [0.02, 0.98].map((share) => values[Math.floor(share * (values.length - 1))]);
    return [low, Math.max(high, low + 1e-6)];
  }

  /** A function that returns the colour of a pixel at shares of the window. */
  inks(colours) {
    const [coarse, fine] = this.grids.map((grid) => ({ size: grid.size, inks: grid.inks(this.by, this.range ?? [0, 1], colours) }));
    const ink = ({ size, inks }, across, up) =>
      inks[Math.min(size - 1, Math.floor(up * size)) * size + Math.min(size - 1, Math.floor(across * size))];
    const { p, q } = this.window; // at the rim the middle of a cell may lie outside the section
    const inwards = (share, [low, high]) => share + Math.sign(low / (low - high) - share) / fine.size;
    return (across, up) => {
      if (!(across >= 0 && across < 1 && up >= 0 && up < 1)) return 0;
      return ink(fine, across, up) || ink(coarse, across, up) || ink(fine, inwards(across, p), inwards(up, q));
    };
  }

  /** What is shown so far, in a line. */
  get words() {
    if (!this.window) return "";
    const [coarse, fine] = this.grids;
    const { size } = this.done ? fine : coarse;
    const grid = `${size} × ${size} orbits${this.done ? "" : ", finer ones follow"}`;
    if (this.by !== "verdict") return `${grid}, 200 impacts each.`;
    const counts = [0, 0, 0, 0, 0];
    fine.known.forEach((one, cell) => (counts[fine.verdict[cell]] += one));
    const total = Math.max(1, counts.reduce((sum, count) => sum + count, 0));
    const percent = (count) => `${((100 * count) / total).toFixed(1)} %`;
    const shares = `regular ${percent(counts[1])}, chaotic ${percent(counts[2])}`;
    return `${grid}: ${shares}${this.done ? "" : `, not decided yet ${percent(counts[0])}`}.`;
  }
}
