/* How the explorer shows scenes of these kinds of picture: src/extensions/explorer/README.md. */
Object.assign(PRESETS, {
  spread: () => ({ view: disk(), orbits: fan(0.55, 0.68, 8, 20000), panel: "chart", chosen: 0 }),
  clusters: () => ({ orbits: fan(0.6, 0.6, 1, 10000), chosen: 0, span: 60 }),
  rotation: () => ({
    view: disk(), orbits: fan(-0.46, -0.03, 44, 2000), chart: "rotation", panel: "chart", chosen: 0,
  }),
  jumps: (scene) => ({ view: disk(), orbits: orbitsOf(scene), jump: true, chosen: 0 }),
  flux(scene) {
    const branches = { outer: { length: 1.4 }, inner: { length: 1 } };
    return { view: disk(), ...saddle({ ...scene, type: "hyperbolic", branches }) };
  },
  last_curve({ between: [from, to] }) {
    return { view: disk(0.5 * (from + to), 0, 0.16), orbits: fan(from, to, 16, 8000), chosen: 0 };
  },
  exclusion: (scene) => ({ view: disk(), orbits: orbitsOf(scene), colour: "verdict", chosen: 0 }),
});
