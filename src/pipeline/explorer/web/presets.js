"use strict";
/*
 * Presets: the paper's figures and the pictures behind the verdicts on its statements. Numbers come
 * from the blocks of config.yaml in the page's data, texts from presets.json; here is from where to
 * look at what. Each entry makes the part of the state that differs from a fresh one.
 */
const HOME_VIEW = { kind: "surface", azimuth: 115, elevation: 40, x: 0, y: 0, half: HOME.surface[2] };
const PRESETS = {
  fig2: (scene) => surface(scene),
  fig3: (scene, all) => inTime(scene, all),
  fig4: (scene, all) => inTime(scene, all),
  fig5: (scene) => ({ ...surface(scene), periods: [scene.period], branches: branchesOf(scene) }),
  fig6: (scene) => closeUp(scene),
  fig7: (scene) => ({ orbits: orbitsOf(scene), chosen: 0 }),
  fig8: (scene) => surface(scene),
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
};

/** The state of the page that shows a preset. */
function presetState(name, scenes) {
  const scene = scenes[name];
  const { k, g } = scene.ball;
  const base = { ...freshState(), k, g, energy: scene.energy, preset: name };
  return { ...base, ...PRESETS[name](scene, scenes) };
}

function disk(x = 0, y = 0, half = HOME.disk[2]) {
  return { ...HOME_VIEW, kind: "disk", x, y, half };
}

/** The window of a close-up in (x, xdot), in the disk. */
function closeUp(scene) {
  const { axes, ball, energy } = scene;
  const { k, g } = ball;
  const [x, v] = [axes.x, axes.xdot].map(({ limits }) => 0.5 * (limits[0] + limits[1]));
  const w = Math.sqrt((2 * energy + 2 * g * x - k * x * x - v * v) / k);
  const { centre, radius, height } = geometry.section(k, g, energy);
  const half = (0.55 * (axes.x.limits[1] - axes.x.limits[0])) / radius;
  const view = disk((x - centre) / radius, (v - k * w) / height, half);
  return { view, ...saddle({ ...scene, branches: { outer: scene, inner: scene } }) };
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
    orbits: context,
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
