"use strict";
/*
 * Presets: the paper's figures and the pictures behind the verdicts on its statements. Numbers come
 * from the blocks of config.yaml in the page's data; here is what to see, and from where.
 */
const PRESETS = [
  {
    name: "fig2",
    title: "Figure 2: islands and the sea",
    see: "Closed curves are regular motion, chains of six small ones belong to a period-six orbit, and the grey points are one orbit that wanders: chaos.",
    make: (scene) => surface(scene),
  },
  {
    name: "fig3",
    title: "Figure 3: the fixed point in time",
    see: "The two curves touch at each impact and never cross, and every flight is like the one before.",
    make: (scene, all) => inTime(scene, all),
  },
  {
    name: "fig4",
    title: "Figure 4: the period-six orbit in time",
    see: "After six impacts the motion repeats itself; the six points lie in the six small islands.",
    make: (scene, all) => inTime(scene, all),
  },
  {
    name: "fig5",
    title: "Figure 5: branches of the saddles",
    see: "Stable (green) and unstable (blue) branches leave the saddles, do not join but cross, fold and fill the sea.",
    make: (scene) => ({ ...surface(scene), periods: [scene.period], branches: branchesOf(scene) }),
  },
  {
    name: "fig6",
    title: "Figure 6: close-up of one saddle",
    see: "Branches of other saddles arrive along those of this one and swing across them; every crossing leads from one saddle to another.",
    make(scene) {
      const { x, xdot } = scene.axes;
      const mean = ([low, high]) => 0.5 * (low + high);
      const { k, g } = scene.ball;
      const [a, v] = [mean(x.limits), mean(xdot.limits)];
      const w = Math.sqrt((2 * scene.energy + 2 * g * a - k * a * a - v * v) / k);
      const { centre, radius, height } = geometry.section(k, g, scene.energy);
      const half = (0.55 * (x.limits[1] - x.limits[0])) / radius;
      return {
        view: { ...HOME_VIEW, kind: "disk", x: (a - centre) / radius, y: (v - k * w) / height, half },
        ...saddle({ ...scene, branches: { outer: scene, inner: scene } }),
      };
    },
  },
  {
    name: "fig7",
    title: "Figure 7: exponents of three chaotic orbits",
    see: "The exponents of three orbits stay above zero and differ in the third digit even after 200,000 impacts.",
    make: (scene) => ({ view: HOME_VIEW, orbits: orbitsOf(scene), chart: "exponent", chosen: 0 }),
  },
  {
    name: "fig8",
    title: "Figure 8: a lower energy",
    see: "Chains of ten and twelve islands and a thin chaotic band: at this energy most motion is regular.",
    make: (scene) => surface(scene),
  },
  {
    name: "spread",
    title: "Claim: the exponent of the sea",
    see: "Eight orbits of one sea give eight different exponents: the paper's 0.235 is one such draw about 0.232.",
    make: () => ({ view: disk(), orbits: fan(0.55, 0.68, 8, 20000), chart: "exponent", chosen: 0 }),
  },
  {
    name: "clusters",
    title: "Claim: clusters of impacts",
    see: "Short flights come in clusters between long ones: press play, or step from impact to impact.",
    make: () => ({ view: HOME_VIEW, orbits: fan(0.6, 0.6, 1, 10000), chosen: 0, span: 60 }),
  },
  {
    name: "rotation",
    title: "Claim: rotation numbers",
    see: "The rotation number varies with the start, and is constant where islands lock it: the flat parts of the chart below.",
    make: () => ({ view: disk(), orbits: fan(-0.46, -0.03, 44, 2000), chart: "rotation", chosen: 0 }),
  },
  {
    name: "jumps",
    title: "Claim: where the map jumps",
    see: "The two curves on which the map and its inverse jump lie in the chaotic sea and avoid the islands.",
    make: (scene) => ({ view: disk(), orbits: orbitsOf(scene), jump: true, chosen: 0 }),
  },
  {
    name: "flux",
    title: "Claim: the gaps between branches",
    see: "The outer branches cross in wide lobes; the inner ones nearly coincide and close the main island in.",
    make: (scene) => ({
      view: disk(),
      ...saddle({ ...scene, type: "hyperbolic", branches: { outer: { length: 1.4 }, inner: { length: 1 } } }),
    }),
  },
  {
    name: "last_curve",
    title: "Claim: the edge of the main island",
    see: "Between curves and sea lies a last curve; outside it small chains of islands are left over.",
    make: (scene) => ({
      view: disk(0.5 * (scene.between[0] + scene.between[1]), 0, 0.16),
      orbits: fan(scene.between[0], scene.between[1], 16, 8000),
      chosen: 0,
    }),
  },
  {
    name: "horseshoe",
    title: "Proof: the horseshoe's branches",
    see: "Outer branches of the saddles cross at a large angle, which is what makes a horseshoe.",
    make: (scene) => ({ view: disk(), ...saddle(scene) }),
  },
  {
    name: "twist",
    title: "Proof: twist around the fixed point",
    see: "Away from the fixed point the rotation number falls, as Moser's twist theorem needs it.",
    make: (scene) => {
      const { p } = geometry.fixedPoint(scene.ball.k, scene.ball.g, scene.energy);
      return { view: disk(p, 0, 0.3), orbits: fan(p + 0.005, p + 0.2, 20, 3000), chart: "rotation", chosen: 0 };
    },
  },
];

const HOME_VIEW = { kind: "surface", azimuth: 115, elevation: 40, x: 0, y: 0, half: HOME.surface[2] };

function disk(x = 0, y = 0, half = HOME.disk[2]) {
  return { ...HOME_VIEW, kind: "disk", x, y, half };
}

/** The state of the page that shows a preset. */
function presetState(name, scenes) {
  const preset = PRESETS.find((entry) => entry.name === name);
  const scene = scenes[name];
  const { k, g } = scene.ball;
  const base = { ...freshState(), k, g, energy: scene.energy, preset: name };
  return { ...base, ...preset.make(scene, scenes) };
}

function orbitsOf({ starts, impacts, sea = [] }) {
  return starts.map((p, i) => ({
    p,
    q: 0,
    impacts: Array.isArray(impacts) ? impacts[i] : impacts,
    back: false,
    sea: sea.includes(i),
  }));
}

function surface(scene) {
  const { azimuth, elevation } = scene.view ?? HOME_VIEW;
  return { view: { ...HOME_VIEW, azimuth, elevation }, orbits: orbitsOf(scene), chosen: 0 };
}

function inTime({ period, type, duration }, all) {
  const context = orbitsOf(all.fig2).filter((orbit) => !orbit.sea);
  return {
    view: HOME_VIEW,
    orbits: context,
    chosen: -1,
    motion: { period, type, nth: 0 },
    periods: [period],
    span: duration,
  };
}

/** A saddle with its branches, and in time. */
function saddle(scene) {
  const { period, type } = scene;
  return { periods: [period], branches: branchesOf(scene), motion: { period, type, nth: 0 }, span: 30 };
}

function branchesOf({ period, type, branches }) {
  return Object.entries(branches).map(([side, { length }]) => ({
    period, type, nth: 0, saddle: -1, kind: "both", side, length,
  }));
}

function fan(from, to, count, impacts) {
  return Array.from({ length: count }, (_, i) => ({
    p: count > 1 ? Number((from + ((to - from) * i) / (count - 1)).toPrecision(12)) : from,
    q: 0, impacts, back: false, sea: false,
  }));
}
