"use strict";
/* Families: the periodic orbits on the section at all energies at which Newton's method follows them. */
class Families {
  constructor(page) {
    this.page = page;
    this.found = new Map(); // by ball and by what names the orbit: its samples, in the order of energy
  }

  get shown() {
    const { k, g } = this.page.state;
    return [...this.found.values()].filter((family) => family.k === k && family.g === g && family.samples.length);
  }

  /** Follow the orbits on the section that are not followed yet, if the diagram is shown. */
  async update() {
    const { k, g, energy, chart } = this.page.state;
    if (chart !== "families") return;
    for (const { orbit, one } of this.page.shownPeriodic().filter(({ one }) => one.type !== "near")) {
      const key = [k, g, writeMotion(one)].join();
      if (this.found.has(key)) continue;
      const family = { k, g, period: orbit.period, samples: [] };
      this.found.set(key, family);
      family.samples = await this.page.pool.ask("family", { k, g, energy, orbit });
      this.page.drawChart();
    }
    this.page.controls.listFamilies();
  }

  draw(canvas) {
    const { pen, width, height } = fitted(canvas);
    const colours = readColours();
    const { state } = this.page;
    const samples = this.shown.flatMap((family) => family.samples);
    const energies = samples.map(({ energy }) => energy);
    const across = energies.length ? [Math.min(...energies, state.energy), Math.max(...energies, state.energy)] : geometry.energyBounds(state.k, state.g);
    const frame = { left: 50, top: 24, right: 26, bottom: 36 };
    this.plot = new Plot(pen, { width, height, frame, colours, across, up: [-1, 1] });
    this.plot.axes("E", "place x in section radii");
    for (const { energy, trace, places } of samples) {
      for (const [p] of places) this.plot.dot([energy, p], Math.abs(trace) < 2 ? colours.regular : colours.chaotic, 1.2);
    }
    this.plot.vertical(state.energy, colours.focus);
    this.plot.key([["elliptic", colours.regular], ["hyperbolic", colours.chaotic]]);
  }

  /** Open the section at the orbit whose point in the diagram is nearest to a point of the screen. */
  openAt(left, top) {
    const apart = ([a, b]) => Math.hypot(a - left, b - top);
    let best = { distance: 20 };
    for (const { period, samples } of this.shown) {
      for (const sample of samples) {
        for (const place of sample.places) {
          const distance = apart(this.plot.at([sample.energy, place[0]]));
          if (distance < best.distance) best = { distance, period, sample, place };
        }
      }
    }
    if (best.sample) this.open(best.period, best.sample, best.place);
  }

  open(period, { energy, places }, place = places[0]) {
    const { controls, state } = this.page;
    controls.takeBall({ k: state.k, g: state.g, E: energy });
    controls.refresh();
    this.page.findNear(place, period, 1.5);
  }
}
