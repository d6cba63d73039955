/*
 * Geometry of the section and closed forms of the map. The page and the worker both have this file.
 *
 * A state is [x, xdot, udot] just before an impact; the chart is (x, y = xdot - k udot). The section
 * is the disk with the given centre, radius (along x) and height (along y). A place on it is (p, q)
 * with x = centre + p radius and y = q height, so that it carries over to another ball or energy.
 */
const MOST_PERIOD = 24; // of an orbit near a click
const geometry = {
  section(k, g, energy) {
    const radius = Math.sqrt((2 * energy + (g * g) / k) / k);
    return { centre: g / k, radius, height: Math.sqrt(k * (1 + k)) * radius };
  },

  /** The lowest energy, and the upper bound of eq. (31). */
  energyBounds(k, g) { return [-(g * g) / (2 * k), 0.5 * k - g]; },

  /** The energy above which the map jumps. */
  firstJump(k, g) { return g * g * (1 + 0.5 * k); },

  /** The state of a start, with the bits of the pipeline's `start` and `state_xy`; null outside. */
  stateAt(k, g, energy, { p, q, xy }) {
    if (xy) return geometry.chartState(k, g, energy, ...xy);
    if (!(p * p + q * q < 1)) return null;
    if (q === 0) return pseudorigid.start(k, g, energy, p);
    const { x, y } = geometry.pointAt(k, g, energy, p, q);
    return geometry.chartState(k, g, energy, x, y);
  },

  /** The state at a point of the chart; null outside the section. */
  chartState(k, g, energy, x, y) {
    try {
      return pseudorigid.stateXY(k, g, energy, x, y);
    } catch {
      return null;
    }
  },

  pointAt(k, g, energy, p, q) {
    const { centre, radius, height } = geometry.section(k, g, energy);
    return { x: centre + p * radius, y: q * height };
  },

  placeAt(k, g, energy, x, y) {
    const { centre, radius, height } = geometry.section(k, g, energy);
    return [(x - centre) / radius, y / height];
  },

  /** The largest number in (0, end) up to which `below` holds. */
  root(below, end) {
    let low = 0;
    let high = end;
    for (;;) {
      const middle = 0.5 * (low + high);
      if (middle === low || middle === high) return low > 0 ? low : high;
      if (below(middle)) low = middle;
      else high = middle;
    }
  },

  /** Place p, trace and rotation number (NaN if not elliptic) of the symmetric fixed point. */
  fixedPoint(k, g, energy) {
    const e = energy / (g * g);
    const bend = (t) => 1 - (t * Math.cos(t)) / Math.sin(t);
    const energyOf = (t) => ((1 + k) * t * t + bend(t) ** 2 - 1) / (2 * k);
    const theta = geometry.root((t) => energyOf(t) < e, Math.PI);
    const shear = (bend(theta) * (2 * theta - Math.sin(2 * theta))) / (theta * (1 + k));
    const trace = (2 * (1 + k * (Math.cos(2 * theta) - shear))) / (1 + k);
    const x = (g * (1 - bend(theta))) / k;
    const { centre, radius } = geometry.section(k, g, energy);
    const rotation = Math.abs(trace) <= 2 ? Math.acos(trace / 2) / (2 * Math.PI) : NaN;
    return { x, p: (x - centre) / radius, trace, rotation };
  },
};
