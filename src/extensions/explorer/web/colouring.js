/*
 * The section in colour: grids of orbits over what is in sight, first a coarse one, which is a preview
 * and follows a drag. Each cell has the exponent and the rotation number after 200 impacts, and a
 * verdict once its orbit is decided.
 */
const GRIDS = { exponent: [60, 300], rotation: [60, 300], verdict: [60, 100, 200] }; // cells along a side
const DRAGGED = 40; // cells along a side of the coarse grid while a person drags
const CHUNK = 792; // most orbits of a request, in full SIMD lanes; a change waits for at most one
const EXPONENTS = [0.005, 0.5]; // the ends of the scale
const MOST = 0.9; // share of cells that are decided before shares are shown
const RIM = 0.9995; // section radii from the middle, beyond which no cell has its orbit
const QUIET_GROWTH = 1.8; // after 200 impacts: below, a preview calls an orbit regular
const LOW_ENERGY = 2; // g^2
const WRONG = { low: 1.3, high: 0.3 }; // per cent of starts, below and above, see README.md
const PAUSE = 200; // ms of a drag or film without a change, after which finer grids are computed

/** What the legend says of the verdicts of cells: the rule, and how often it is wrong. */
function shortFormNotes({ g, energy }) {
  const rate = energy < LOW_ENERGY * g * g ? WRONG.low : WRONG.high;
  return ["short form:", `${rate} % wrong`];
}

class Grid {
  constructor(size) {
    this.size = size;
    this.known = new Uint8Array(size * size);
    this.verdict = new Uint8Array(size * size);
    for (const name of ["exponent", "rotation", "growth"]) this[name] = new Float64Array(size * size);
  }

  /** Take over results; with `mirrored` also those of the mirror images, by the reversor. */
  take(result, mirrored = false) {
    const { size } = this;
    const put = (cell, i) => {
      this.known[cell] = 1;
      for (const name of ["exponent", "rotation", "growth", "verdict"]) {
        if (result[name]) this[name][cell] = result[name][i];
      }
    };
    result.index.forEach((cell, i) => {
      put(cell, i);
      if (mirrored) put((size - 1 - Math.floor(cell / size)) * size + (cell % size), i);
    });
  }

  /** Call cells regular or chaotic that are not decided. */
  guess() { this.growth.forEach((growth, cell) => (this.verdict[cell] ||= growth < QUIET_GROWTH ? 1 : 2)); }

  /** Whether a cell's rotation number is shown. */
  turns(cell) { return this.verdict[cell] < 2 && this.growth[cell] < QUIET_GROWTH; }

  /** The colours of all cells, 0 where nothing is known or decided. */
  inks(by, range, colours) {
    const ramp = Uint32Array.from({ length: 256 }, (_, i) => packed(mixed(colours.ramp, i / 255)));
    const verdicts = Uint32Array.from(["surface", "regular", "chaotic", "undecided", "undecided"],
      (name) => packed(colours[name]));
    const sea = packed(colours.sea);
    const low = by === "exponent" ? Math.log(range[0]) : range[0];
    const scale = 255 / ((by === "exponent" ? Math.log(range[1]) : range[1]) - low);
    const ink = (known, cell) => {
      if (!known) return 0;
      if (by === "verdict") return this.verdict[cell] ? verdicts[this.verdict[cell]] : 0;
      if (by === "rotation" && !this.turns(cell)) return sea;
      const value = by === "exponent" ? Math.log(Math.max(1e-9, this.exponent[cell])) : this.rotation[cell];
      return Number.isNaN(value) ? sea : ramp[Math.min(255, Math.max(0, Math.round((value - low) * scale)))];
    };
    const inks = new Uint32Array(this.known.length + 1); // the last one is of what is outside
    this.known.forEach((known, cell) => (inks[cell] = ink(known, cell)));
    return inks;
  }
}

class Colouring {
  constructor(page) {
    this.page = page;
    this.key = "";
    this.window = null;
    this.computing = false; // whether a coarse grid is
  }

  /** Compute for what is in sight now, unless that is done or under way; at once or a little later. */
  update(delay = 0) {
    const { state, section } = this.page;
    clearTimeout(this.waits);
    if (state.map === "none") {
      Object.assign(this, { key: "", window: null, later: null });
      this.page.controls?.status();
      return;
    }
    this.waits = setTimeout(() => {
      const window = section.window();
      const { k, g, energy, map } = state;
      const key = JSON.stringify([k, g, energy, map, window]);
      if (!window || key === this.key) return;
      this.key = key;
      clearTimeout(this.finer);
      this.compute({ k, g, energy }, window, map, () => key === this.key);
    }, delay);
  }

  /**
   * Compute the coarse grid and then finer ones; the old picture stays until there is a new one. A
   * coarse grid that is under way is completed, so that a drag shows some: only the last request waits.
   */
  async compute(ball, window, map, wanted) {
    this.later = null;
    if (this.computing) {
      this.later = [ball, window, map, wanted];
      return;
    }
    this.computing = true;
    const drags = this.page.controls.ball.editing && !this.page.sweeping;
    const [coarse, ...finer] = GRIDS[map];
    const grids = [drags ? DRAGGED : coarse, ...finer].map((size) => new Grid(size));
    const mirrored = window.q[0] === -window.q[1];
    const chunks = this.chunks(grids[0].size, window, mirrored);
    const first =
      await Promise.all(chunks.map((chunk) => this.page.pool.ask("pixels", { ...ball, ...chunk })));
    this.computing = false;
    const { later } = this;
    if (later) this.compute(...later); // while the page draws this one
    if (this.page.state.map === map) {
      for (const result of first) grids[0].take(result, mirrored);
      if (map === "verdict") grids[0].guess();
      Object.assign(this, { window, grids, by: map, energy: ball.energy, level: 0, left: 0 });
      this.draw();
    }
    if (later || !wanted()) return;
    const moving = this.page.sweeping || this.page.controls.ball.editing;
    this.finer = setTimeout(() => this.refine(ball, map, wanted), moving ? PAUSE : 0);
  }

  /** Compute the finer grids, one after the other. */
  async refine(ball, map, wanted) {
    for (const grid of this.grids.slice(1)) {
      if (!wanted()) return;
      this.level += 1;
      const open = this.chunks(grid.size, this.window).map((chunk) => ({ ...ball, ...chunk }));
      grid.cells = open.reduce((sum, { index }) => sum + index.length, 0);
      this.left = open.length;
      const follow = async (request) => {
        const result = await this.page.pool.ask("pixels", request, wanted);
        if (!result) return;
        grid.take(result);
        this.drawSoon();
        const { rest, done } = result;
        if (map === "verdict" && rest.index.length) await follow({ ...ball, rest, done });
        else this.left -= 1;
      };
      await Promise.all(open.map(follow));
    }
    if (wanted()) this.draw();
  }

  /** The cells of a grid on the section, in rows that jump about, with their middles, or a point in them. */
  chunks(size, { p, q }, half = false) {
    const cells = [];
    const places = [];
    const step = [67, 61, 59].find((prime) => size % prime); // visits each row once
    const [wide, tall] = [p, q].map(([low, high]) => (high - low) / size);
    for (let n = 0; n < size; n++) {
      const row = (n * step) % size;
      if (half && row < size / 2) continue;
      for (let column = 0; column < size; column++) {
        const middle = [p[0] + (column + 0.5) * wide, q[0] + (row + 0.5) * tall];
        const away = Math.hypot(...middle);
        if (away >= 1 + 0.5 * Math.hypot(wide, tall)) continue;
        cells.push(row * size + column);
        places.push(...middle.map((value) => value * Math.min(1, RIM / away)));
      }
    }
    const { workers } = this.page.pool; // each has as much to do
    const parts = workers * Math.ceil(cells.length / CHUNK / workers);
    return Array.from({ length: parts }, (_, i) => {
      const [from, to] = [i, i + 1].map((n) => Math.round((n * cells.length) / parts));
      return { index: Uint32Array.from(cells.slice(from, to)),
        places: Float64Array.from(places.slice(2 * from, 2 * to)) };
    });
  }

  drawSoon() { this.drawing ??= setTimeout(() => this.draw(), this.left ? 120 : 0); }

  draw() {
    clearTimeout(this.drawing);
    this.drawing = null;
    const { section } = this.page;
    section.drawMap();
    section.drawLines();
    this.page.controls.status();
  }

  get done() { return this.window !== null && this.level === this.grids.length - 1 && this.left === 0; }

  /** The ends of the scale of colours; null for verdicts. */
  get range() {
    if (!this.window || this.by === "verdict") return null;
    if (this.by === "exponent") return EXPONENTS;
    const grid = this.grids[0];
    const values =
      [...grid.rotation].filter((_, cell) => grid.known[cell] && grid.turns(cell)).sort((a, b) => a - b);
    if (!values.length) return [0, 1];
    const [low, high] = [0.02, 0.98].map((share) => values[Math.floor(share * (values.length - 1))]);
    return [low, Math.max(high, low + 1e-6)];
  }

  /** The colours of the cells of each grid, 0 where there is none, the finest first. */
  layers(colours) {
    const shown = this.grids.slice(0, this.level + 1).reverse();
    const range = this.range ?? [0, 1];
    return shown.map((grid) => ({ size: grid.size, inks: grid.inks(this.by, range, colours) }));
  }

  /** What is shown so far, in a line. */
  get words() {
    if (!this.window) return "";
    // Shares are those of the finest grid that is complete, or of the first one that has verdicts.
    const last = this.by === "verdict" ? Math.max(Math.min(this.level, 1), this.level - 1) : 0;
    const level = this.done ? this.level : last;
    const grid = this.grids[level];
    const cells = `${grid.size} × ${grid.size} cells`;
    const finer = this.done ? "" : "; finer ones follow";
    if (this.by !== "verdict") return `${cells}, 200 impacts each${finer}.`;
    if (!level) return `A preview of ${cells}, by 200 impacts each; finer ones follow.`;
    const count = (...kinds) => grid.verdict.filter((verdict) => kinds.includes(verdict)).length;
    const decided = count(1, 2, 3, 4);
    const percent = (part, whole) => `${((100 * part) / Math.max(1, whole)).toFixed(1)} %`;
    const known = `${cells}, ${percent(decided, grid.cells)} decided`;
    if (decided < MOST * grid.cells) return `${known} so far${finer}.`; // chaotic ones are decided first
    const [regular, chaotic, open] = [[1], [2], [3, 4]].map((kinds) => percent(count(...kinds), decided));
    return `${known}; of these regular ${regular}, chaotic ${chaotic}, undecided ${open}${finer}.`;
  }
}
