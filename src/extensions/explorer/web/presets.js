/*
 * Presets: the scenes of config.yaml, which are in the page's data, by their kinds of picture. Here is
 * what they are made of. A part's presets.js has a function for each of its kinds, which makes the
 * part of the state that differs from a fresh one.
 */
const HOME_VIEW = { kind: "surface", azimuth: 115, elevation: 40, x: 0, y: 0, half: HOME.surface[2] };
const PRESETS = {}; // kind of picture -> a function (scene, all scenes), in presets.js of its part

/** The state of the page that shows a scene, given by its name: `fig2`, or `below/fig2` of a variant. */
function presetState(name, scenes) {
  const scene = scenes[name];
  const { k, g } = scene.ball;
  const base = { ...freshState(), k, g, energy: scene.energy, preset: name };
  return { ...base, ...PRESETS[scene.picture](scene, scenes) };
}

function disk(x = 0, y = 0, half = HOME.disk[2]) { return { ...HOME_VIEW, kind: "disk", x, y, half }; }

/** The place of a start: a fraction, or a point with x and either y or xdot. */
function placeOf(start, scene) {
  const { k, g } = scene.ball;
  return typeof start === "number" ? [start, 0]
    : geometry.placeAt(k, g, scene.energy, ...pointOf(start, scene));
}

function pointOf({ x, xdot, y }, { ball: { k, g }, energy }) {
  const udot = Math.sqrt((2 * energy + 2 * g * x - k * x * x - xdot * xdot) / k);
  return [x, y ?? xdot - k * udot];
}

function orbitsOf(scene) {
  const { starts, impacts } = scene;
  return starts.slice(0, MOST_ORBITS).map((start, i) => {
    const [p, q] = placeOf(start, scene);
    const count = Array.isArray(impacts) ? impacts[i] : impacts;
    const xy = typeof start === "number" ? null : pointOf(start, scene);
    return { p, q, xy, impacts: Math.min(count, MOST_IMPACTS), back: false, sea: false };
  });
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
