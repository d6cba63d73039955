/* How the explorer shows scenes of these kinds of picture: src/extensions/explorer/README.md. */
Object.assign(PRESETS, {
  horseshoe: (scene) => ({ view: disk(), ...saddle(scene) }),
  twist({ ball: { k, g }, energy }) {
    const { p } = geometry.fixedPoint(k, g, energy);
    const orbits = fan(p + 0.005, p + 0.2, 20, 3000);
    return { view: disk(p, 0, 0.3), orbits, chart: "rotation", panel: "chart", chosen: 0 };
  },
  curves: (scene) => ({ view: disk(), orbits: orbitsOf(scene), chosen: 0 }),
  graph: (scene) => ({ view: disk(), orbits: orbitsOf(scene), chosen: 0 }),
});
