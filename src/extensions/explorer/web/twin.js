/* A second ball, which starts close to the one that is shown in time, and the distance between them. */
const TWIN_IMPACTS = { regular: 1000, chaotic: 200 }; // that are shown
const GROWN = 0.02; // section radii apart, up to which the distance's growth is measured

class Twin {
  constructor(page) { this.page = page; }

  /** Compute both balls from the start of the one in time; `motion` is null without a second one. */
  update() {
    const { k, g, energy, twin, motion: periodic } = this.page.state;
    const motion = this.page.motion;
    Object.assign(this, { motion: null, distances: [], rate: NaN });
    const start =
      motion && (periodic ? motion.points[0].slice(0, 3) : motion.orbit.back ? null : motion.orbit.start);
    if (!twin || !start) return;
    const [x, y] = [start[0], start[1] - k * start[2]];
    const other =
      geometry.chartState(k, g, energy, x + twin, y) ?? geometry.chartState(k, g, energy, x - twin, y);
    if (!other) return;
    const [a, b] = [start, other].map((state) => pseudorigid.history(k, g, ...state, TWIN_IMPACTS.regular));
    const place = ({ x, xdot, udot }, i) => [x[i], (xdot[i] - k * udot[i]) / Math.sqrt(k * (1 + k))];
    const apart = (i) => Math.hypot(...place(a, i).map((value, n) => value - place(b, i)[n]));
    const kept = b.tau.findIndex((tau) => !Number.isFinite(tau));
    const orbit = { ...b, start: other, back: false, kept: kept < 0 ? b.tau.length : kept };
    orbit.stateAt = Orbit.prototype.stateAt;
    this.motion = new OrbitMotion(orbit);
    this.distances = [[0, twin], ...Array.from({ length: orbit.kept }, (_, i) => [i + 1, apart(i)])];
    this.rate = slope(this.distances, GROWN * geometry.section(k, g, energy).radius);
  }

  /** The exponent and verdict of the ball in time, as far as they are known. */
  get facts() {
    const { state, orbits, motion } = this.page;
    if (!state.motion) return orbits[state.chosen]?.facts ?? {};
    if (!motion) return {};
    const { multiplier, period, type } = motion.orbit;
    return { verdict: type === "elliptic" ? "regular" : "chaotic",
      exponent: Math.log(Math.abs(multiplier)) / period };
  }

  /** The distances that are shown, [impacts, distance]. */
  get shown() {
    return this.distances.slice(0, 1 + (TWIN_IMPACTS[this.facts.verdict] ?? TWIN_IMPACTS.chaotic));
  }

  /** How fast the balls separate, in a sentence. */
  get words() {
    const { twin } = this.page.state;
    if (!twin) return "";
    if (!this.motion) return "Choose an orbit that runs forwards: its ball gets a second one beside it.";
    const [impacts, apart] = this.shown.at(-1);
    const { verdict, exponent } = this.facts;
    const far = `after ${impacts} impacts are ${shortNumber(apart, 2)} apart`;
    const after = `They start ${shortNumber(twin)} apart, and ${far}`;
    if (verdict === "regular")
      return `${after}: on a regular orbit the distance grows in proportion to the number of impacts.`;
    if (verdict !== "chaotic" || Number.isNaN(this.rate)) return `${after}.`;
    const growth = `The distance first grows by a factor of exp(${shortNumber(this.rate, 2)}) an impact`;
    return `${after}. ${growth}; the exponent of the orbit is ${shortNumber(exponent, 3)}.`;
  }

  draw(canvas) {
    const { hues } = readColours();
    const { shown } = this;
    const logs = shown.filter(([, apart]) => apart > 0).map(([n, apart]) => [n, Math.log10(apart)]);
    const values = logs.map(([, value]) => value);
    const up = logs.length ? [Math.min(...values) - 0.3, Math.max(...values) + 0.5] : [-6, 0];
    const plot = Plot.on(canvas, { across: [0, Math.max(1, shown.length - 1)], up, decades: true });
    plot.axes("number of impacts", "distance in R");
    plot.line(logs, hues[0], 2);
    const { verdict, exponent } = this.facts;
    const key = [["measured", hues[0]]];
    const law = (name, at) => {
      const line = shown.slice(1).map(([n]) => [n, Math.log10(at(n))]);
      plot.line(line.filter(([, value]) => value < up[1]), hues[1], 1.5);
      key.push([name, hues[1]]);
    };
    if (logs.length && verdict === "chaotic")
      law(`exponent ${shortNumber(exponent, 3)}`, (n) => this.page.state.twin * Math.exp(exponent * n));
    else if (logs.length && verdict === "regular")
      law("in proportion", (n) => (shown.at(-1)[1] * n) / (shown.length - 1));
    plot.key(key);
  }
}

/** The slope of ln y by least squares over points [n, y] before y is larger than `most`; NaN for few. */
function slope(points, most) {
  const end = points.findIndex(([, y]) => !(y > 0 && y < most));
  const used = points.slice(0, end < 0 ? points.length : end).map(([n, y]) => [n, Math.log(y)]);
  const mean = (list) => list.reduce((sum, value) => sum + value, 0) / list.length;
  const [n, l] = [0, 1].map((i) => mean(used.map((point) => point[i])));
  const rate = mean(used.map((point) =>
    (point[0] - n) * (point[1] - l))) / mean(used.map((point) => (point[0] - n) ** 2));
  return used.length > 4 ? rate : NaN;
}
