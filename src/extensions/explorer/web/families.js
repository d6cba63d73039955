/* Families: the periodic orbits on the section at all energies at which Newton's method follows them. */
class Families {
  constructor(page) {
    this.page = page;
    this.found = new Map(); // by ball and by what names the orbit: its samples, in the order of energy
  }

  get shown() {
    const { k, g } = this.page.state;
    return [...this.found.values()].filter((one) => one.k === k && one.g === g && one.samples.length);
  }

  /** Follow the orbits on the section that are not followed yet, if the diagram is shown. */
  update() {
    const { k, g, energy, chart } = this.page.state;
    if (chart !== "families") return;
    this.page.controls.listFamilies();
    this.page.shownPeriodic().forEach(async ({ orbit, one }) => {
      const key = [k, g, writeMotion(one)].join();
      if (one.type === "near" || this.found.has(key)) return;
      const family = { k, g, one, period: orbit.period, samples: [] };
      this.found.set(key, family);
      family.samples = await this.page.pool.ask("family", { k, g, energy, orbit });
      this.page.drawChart();
      this.page.controls.listFamilies();
    });
  }

  draw(canvas) {
    const colours = readColours();
    const { state } = this.page;
    const samples = this.shown.flatMap((family) => family.samples);
    const energies = samples.map(({ energy }) => energy);
    const across = energies.length ? [Math.min(...energies, state.energy),
      Math.max(...energies, state.energy)] : geometry.energyBounds(state.k, state.g);
    this.plot = Plot.on(canvas, { across, up: [-1, 1] });
    this.plot.axes("E", "place x in section radii");
    for (const { energy, trace, places } of samples) {
      for (const [p] of places)
        this.plot.dot([energy, p], Math.abs(trace) < 2 ? colours.elliptic : colours.hyperbolic, 1.2);
    }
    this.plot.vertical(state.energy, colours.focus);
    this.plot.key([["elliptic", colours.elliptic], ["hyperbolic", colours.hyperbolic]]);
  }

  /** Open the section at the orbit whose point in the diagram is nearest to a point of the screen. */
  openAt(left, top) {
    const near = this.shown.flatMap((family) => family.samples.flatMap((sample) =>
      sample.places.map(([p]) => {
        const [a, b] = this.plot.at([sample.energy, p]);
        return { family, sample, distance: Math.hypot(a - left, b - top) };
      })));
    const [best] = near.sort((a, b) => a.distance - b.distance);
    if (best?.distance < 20) this.open(best.family, best.sample);
  }

  /** Go to the energy of a sample and show its orbit. */
  open({ period, one }, { energy }) {
    const { page } = this;
    const { k, g, periods } = page.state;
    page.mark();
    Object.assign(page.state,
      { periods: [...new Set([...periods, period])], motion: one, time: 0, chosen: -1 });
    page.controls.ball.editing = true; // one entry of the history
    page.controls.ball.takeBall({ k, g, E: energy });
    page.controls.refresh();
    page.controls.hint(`The orbit of period ${period} at E = ${shortNumber(energy, 6)} is shown in time.`);
  }
}
