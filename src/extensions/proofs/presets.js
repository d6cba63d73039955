"use strict";
/* How the explorer shows scenes of these kinds of picture: src/extensions/explorer/README.md. */
Object.assign(PRESETS, {
  horseshoe: (scene) => ({ view: disk(), ...saddle(scene) }),
  twist({ ball: { k, g }, energy }) {
    const { p } = geometry.fixedPoint(k, g, energy);
    return { view: disk(p, 0, 0.3), orbits: fan(p + 0.005, p + 0.2, 20, 3000), chart: "rotation", chosen: 0 };
  },
  curves: (scene) => ({ view: disk(), orbits: orbitsOf(scene), chosen: 0 }),
  graph: (scene) => ({ view: disk(), orbits: orbitsOf(scene), chosen: 0 }),
});
