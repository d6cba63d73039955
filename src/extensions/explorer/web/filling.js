/*
 * Orbits that fill a window after a zoom. They begin at places spread evenly over what is in sight, in
 * cells of a grid that no orbit has met yet. The same window and size of the page give the same orbits.
 */
const CELLS = 48; // along a side
const STARTS = 4000;
const SPREAD = [0.7548776662466927, 0.5698402909980532]; // the R2 sequence of M. Roberts
const RARE = 0.1; // returns of an orbit, on average, below which orbits are not followed further
const SEEDS = 16; // orbits that begin together, before the cells that they met are known
const MOST_POINTS = 1000000;
const SETTLED = 250; // ms after which a view is filled

/** An orbit of which only the points in the window are kept. */
class WindowOrbit {
  constructor({ x, xdot, udot, facts }, index, page) {
    Object.assign(this, { x, xdot, udot, facts: shownFacts(facts), page, kept: x.length, hue: index % HUES });
    Object.assign(this, { chosen: false, settled: true, few: true });
  }

  isSea() { return this.facts.verdict !== "regular"; }
  colour(colours) { return Orbit.prototype.colour.call(this, colours); }
}

class Filling {
  constructor(page) {
    this.page = page;
    this.key = "";
    this.orbits = [];
    this.done = false;
  }

  /** What fills the window, in a line. */
  get words() {
    const { orbits, done, rare } = this;
    if (!done || !orbits.length) return "";
    const regular = COUNT.format(orbits.filter((orbit) => !orbit.isSea()).length);
    const began = `${COUNT.format(orbits.length)} orbits began in this window, ${regular} of them regular`;
    return rare ? `${began}. They return to it too rarely to draw curves.` : `The window is full: ${began}.`;
  }

  /** Fill what is in sight now, unless that is done or under way. */
  update() {
    const { state, section } = this.page;
    const { k, g, energy, view } = state;
    clearTimeout(this.waits);
    const wanted = state.fill && view.half < HOME[view.kind][2] - 0.1;
    const key = wanted ? JSON.stringify([k, g, energy, view, section.width, section.height]) : "";
    if (key === this.key) return;
    this.key = key;
    this.done = false;
    this.waits = setTimeout(() => this.run(key), wanted ? SETTLED : 0);
  }

  async run(key) {
    const { page } = this;
    const { section } = page;
    this.orbits = [];
    section.drawPoints();
    const window = key && section.window();
    page.controls.status();
    if (!window) return;
    const { k, g, energy } = page.state;
    const low = geometry.pointAt(k, g, energy, window.p[0], window.q[0]);
    const high = geometry.pointAt(k, g, energy, window.p[1], window.q[1]);
    const range = { x: [low.x, high.x], y: [low.y, high.y] };
    const met = new Uint8Array(CELLS * CELLS);
    const share =
      (value, [from, to]) => Math.min(CELLS - 1, Math.floor((CELLS * (value - from)) / (to - from)));
    let points = 0;
    let next = 0;
    while (points < MOST_POINTS) {
      const places = [];
      for (; next < STARTS && places.length < SEEDS; next++) {
        const [across, up] = SPREAD.map((step) => (0.5 + next * step) % 1);
        const cell = Math.floor(up * CELLS) * CELLS + Math.floor(across * CELLS);
        const [p, q] =
          [[across, window.p], [up, window.q]].map(([part, [from, to]]) => from + part * (to - from));
        if (!met[cell] && geometry.stateAt(k, g, energy, { p, q })) places.push([p, q]);
      }
      const count = this.orbits.length;
      this.rare = count >= 4 * SEEDS && points < (1 + RARE) * count;
      if (!places.length) break;
      const requests = [];
      for (let i = 0; i < places.length; i += 4) {
        const request = { k, g, energy, places: places.slice(i, i + 4), window: range, brief: this.rare };
        requests.push(page.pool.ask("fill", request, () => key === this.key));
      }
      const found = (await Promise.all(requests)).flat();
      if (key !== this.key) return;
      for (const orbit of found) {
        for (let i = 0; i < orbit.x.length; i++) {
          met[share(orbit.xdot[i] - k * orbit.udot[i], range.y) * CELLS + share(orbit.x[i], range.x)] = 1;
        }
        points += orbit.x.length;
        const one = new WindowOrbit(orbit, this.orbits.length, page);
        this.orbits.push(one);
        section.plot(one, one, 0, one.kept);
      }
      section.showPoints();
    }
    this.done = true;
    if (["rotation", "exponent"].includes(page.state.colour)) section.look();
    page.controls.status();
  }
}
