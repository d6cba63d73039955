/* How the explorer shows scenes of these kinds of picture: src/extensions/explorer/README.md. */
Object.assign(PRESETS, {
  portrait: surface,
  motion: inTime,
  tangle: (scene) => ({ ...surface(scene), periods: [scene.period], branches: branchesOf(scene) }),
  closeup: closeUp,
  exponents: (scene) => ({ orbits: orbitsOf(scene), panel: "chart", chosen: 0 }),
});

/** The window of a close-up in the plane (x, xdot), which is the half ellipsoid seen from above. */
function closeUp(scene) {
  const { axes, ball } = scene;
  const lines = saddle({ ...scene, branches: { outer: scene, inner: scene } });
  const whole = { ...HOME_VIEW, ...ABOVE };
  if (!axes) return { view: whole, ...lines };
  const [x, xdot] = [axes.x, axes.xdot].map(({ limits }) => 0.5 * (limits[0] + limits[1]));
  const { centre, radius } = geometry.section(ball.k, ball.g, scene.energy);
  const half = (0.55 * (axes.x.limits[1] - axes.x.limits[0])) / radius;
  const pivot = (0.2 * ball.k) / Math.sqrt(1 + ball.k);
  return { view: { ...whole, x: (x - centre) / radius, y: xdot / radius - pivot, half }, ...lines };
}

function surface(scene) {
  const { azimuth, elevation } = scene.view ?? HOME_VIEW;
  return { view: { ...HOME_VIEW, azimuth, elevation }, orbits: orbitsOf(scene), chosen: 0 };
}

/** A periodic orbit in time, among the orbits of a portrait of the same ball and energy. */
function inTime(scene, scenes) {
  const { period, type, duration, ball, energy } = scene;
  const portrait = Object.values(scenes).find(
    (other) => other.picture === "portrait" && other.ball.k === ball.k
      && other.ball.g === ball.g && other.energy === energy,
  );
  const orbits = portrait ? orbitsOf(portrait) : [];
  return { orbits, motion: { period, type, nth: 0 }, periods: [period], span: duration };
}
