"use strict";
/*
 * Presets: the scenes of config.yaml, which are in the page's data, by their kinds of picture. Here is
 * from where to look at what; presets.json has a title and a sentence for scenes of the paper, of its
 * claims and of proofs. Each entry makes the part of the state that differs from a fresh one.
 */
const HOME_VIEW = { kind: "surface", azimuth: 115, elevation: 40, x: 0, y: 0, half: HOME.surface[2] };
const PRESETS = {
  portrait: surface,
  motion: inTime,
  tangle: (scene) => ({ ...surface(scene), periods: [scene.period], branches: branchesOf(scene) }),
  closeup: closeUp,
  exponents: (scene) => ({ orbits: orbitsOf(scene), chosen: 0 }),
  spread: () => ({ view: disk(), orbits: fan(0.55, 0.68, 8, 20000), chosen: 0 }),
  clusters: () => ({ orbits: fan(0.6, 0.6, 1, 10000), chosen: 0, span: 60 }),
  rotation: () => ({ view: disk(), orbits: fan(-0.46, -0.03, 44, 2000), chart: "rotation", chosen: 0 }),
  jumps: (scene) => ({ view: disk(), orbits: orbitsOf(scene), jump: true, chosen: 0 }),
  flux(scene) {
    const branches = { outer: { length: 1.4 }, inner: { length: 1 } };
    return { view: disk(), ...saddle({ ...scene, type: "hyperbolic", branches }) };
  },
  last_curve({ between: [from, to] }) {
    return { view: disk(0.5 * (from + to), 0, 0.16), orbits: fan(from, to, 16, 8000), chosen: 0 };
  },
  horseshoe: (scene) => ({ view: disk(), ...saddle(scene) }),
  twist({ ball: { k, g }, energy }) {
    const { p } = geometry.fixedPoint(k, g, energy);
    return { view: disk(p, 0, 0.3), orbits: fan(p + 0.005, p + 0.2, 20, 3000), chart: "rotation", chosen: 0 };
  },
  curves: (scene) => ({ view: disk(), orbits: orbitsOf(scene), chosen: 0 }),
  exclusion: (scene) => ({ view: disk(), orbits: orbitsOf(scene), chosen: 0 }),
  graph: (scene) => ({ view: disk(), orbits: orbitsOf(scene), chosen: 0 }),
};

/** The state of the page that shows a scene, given by its name: `fig2`, or `below/fig2` of a variant. */
function presetState(name, scenes) {
  const scene = scenes[name];
  const { k, g } = scene.ball;
  const base = { ...freshState(), k, g, energy: scene.energy, preset: name };
  return { ...base, ...PRESETS[scene.picture](scene, scenes) };
}

function disk(x = 0, y = 0, half = HOME.disk[2]) {
  return { ...HOME_VIEW, kind: "disk", x, y, half };
}

/** The window of a close-up in (x, xdot), in the disk; the whole disk where a scene has no limits. */
function closeUp(scene) {
  const { axes, ball } = scene;
  const lines = saddle({ ...scene, branches: { outer: scene, inner: scene } });
  if (!axes) return { view: disk(), ...lines };
  const [x, xdot] = [axes.x, axes.xdot].map(({ limits }) => 0.5 * (limits[0] + limits[1]));
  const { radius } = geometry.section(ball.k, ball.g, scene.energy);
  const half = (0.55 * (axes.x.limits[1] - axes.x.limits[0])) / radius;
  return { view: disk(...placeOf({ x, xdot }, scene), half), ...lines };
}

/** The place of a start: a fraction, or a point with x and either y or xdot. */
function placeOf(start, scene) {
  const { k, g } = scene.ball;
  return typeof start === "number" ? [start, 0] : geometry.placeAt(k, g, scene.energy, ...pointOf(start, scene));
}

function pointOf({ x, xdot, y }, { ball: { k, g }, energy }) {
  const udot = Math.sqrt((2 * energy + 2 * g * x - k * x * x - xdot * xdot) / k);
  return [x, y ?? xdot - k * udot];
}

function orbitsOf(scene) {
  const { starts, impacts, sea = [] } = scene;
  return starts.slice(0, MOST_ORBITS).map((start, i) => {
    const [p, q] = placeOf(start, scene);
    const count = Array.isArray(impacts) ? impacts[i] : impacts;
    const xy = typeof start === "number" ? null : pointOf(start, scene);
    return { p, q, xy, impacts: Math.min(count, MOST_IMPACTS), back: false, sea: sea.includes(i) };
  });
}

function surface(scene) {
  const { azimuth, elevation } = scene.view ?? HOME_VIEW;
  return { view: { ...HOME_VIEW, azimuth, elevation }, orbits: orbitsOf(scene), chosen: 0 };
}

/** A periodic orbit in time, among the regular orbits of a portrait of the same ball and energy. */
function inTime(scene, scenes) {
  const { period, type, duration, ball, energy } = scene;
  const portrait = Object.values(scenes).find(
    (other) => other.picture === "portrait" && other.ball.k === ball.k && other.ball.g === ball.g && other.energy === energy,
  );
  const orbits = portrait ? orbitsOf(portrait).filter((orbit) => !orbit.sea) : [];
  return { orbits, motion: { period, type, nth: 0 }, periods: [period], span: duration };
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
    q: 0, xy: null, impacts, back: false, sea: false,
  }));
}
