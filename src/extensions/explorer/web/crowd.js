/*
 * Many orbits in the worker: those of the pixels of a section in colour, and those that fill a window.
 * The first follow the kernel in SIMD lanes. Their verdicts are a short form of the rule of
 * dynamics/regularity.py: most end after 2,000 impacts, where chaotic orbits may still look regular.
 */
const VERDICTS = ["", "regular", "chaotic", "undecided", "undefined"];
const crowd = (() => {
  const SHOWN = 200; // impacts behind a pixel's exponent and rotation number
  const SHARES = Array.from({ length: SHOWN }, (_, i) => (i + 0.5) / SHOWN);
  const WEIGHT = SHARES.reduce((sum, share) => sum + (share * (1 - share)) ** 3, 0); // of the turns
  const LEVELS = [500, 1000, 2000, 4000, 8000, 16000, 32000, 64000]; // at which orbits are judged
  const DECISIVE = 2000; // impacts from which on the growth decides alone
  const GROWTH = 2.2;
  const SURE = { growth: 4.4, size: 15 }; // of a chaotic orbit before, as in kernel/verdict.py
  const SUMS = ["second", "third", "fourth"]; // of G over the quarters of a level but the first
  const ENOUGH = 800; // points in the window of an orbit that fills it
  const PROMISING = 4; // points after TRIED impacts of an orbit that is followed further
  const TRIED = 20000;
  const LONGEST = 400000;
  const PIECE = 8000;

  /** What the orbits from places [p, q, p, q, ...] do in 200 impacts, and those that are undecided. */
  function begin({ k, g, energy, places, index }) {
    const n = index.length;
    const states = Object.fromEntries(["x", "xdot", "udot"].map((name) => [name, new Float64Array(n)]));
    for (let i = 0; i < n; i++) {
      const state = geometry.stateAt(k, g, energy, { p: places[2 * i], q: places[2 * i + 1] });
      [states.x[i], states.xdot[i], states.udot[i]] = state ?? [NaN, NaN, NaN];
    }
    const orbits = pseudorigid.crowd(k, states, geometry.fixedPoint(k, g, energy).x);
    for (const name of SUMS) orbits[name] = new Float64Array(n);
    const early = new Float64Array(n);
    const late = new Float64Array(n);
    const follow = follower(k, g, energy, orbits);
    follow(0, 50);
    follow(50, 100, early);
    follow(100, 125);
    follow(125, 150, orbits.second);
    follow(150, 200, late, orbits.second);
    const growth = late.map((value, i) => (value - early[i]) / 50);
    const rotation = orbits.weighted.map((value) => value / WEIGHT);
    const exponent = pseudorigid.exponents(orbits, SHOWN);
    const verdict = verdicts(orbits, growth, SHOWN);
    return { index, exponent, rotation, growth, verdict, rest: rest(orbits, index, verdict), done: SHOWN };
  }

  /** Follow undecided orbits to the next length at which they are judged. */
  function further({ k, g, energy, rest: { index, orbits }, done }) {
    const level = LEVELS.find((length) => length > done);
    const follow = follower(k, g, energy, orbits);
    if (level === LEVELS[0]) {
      follow(200, 250, orbits.second);
      follow(250, 375, orbits.third);
      follow(375, 500, orbits.fourth);
    } else {
      orbits.second = orbits.third.map((value, i) => value + orbits.fourth[i]);
      for (const name of ["third", "fourth"]) orbits[name].fill(0);
      follow(done, 0.75 * level, orbits.third);
      follow(0.75 * level, level, orbits.fourth);
    }
    const growth = orbits.fourth.map((value, i) => (value - orbits.second[i]) / (level / 4));
    const verdict = verdicts(orbits, growth, level);
    return { index, verdict, rest: rest(orbits, index, verdict), done: level };
  }

  /** A function that follows orbits over some impacts and adds the sums of G to arrays. */
  function follower(k, g, energy, orbits) {
    const { x, rotation } = geometry.fixedPoint(k, g, energy);
    const expected = Number.isNaN(rotation) ? 0.5 : rotation;
    return (from, to, ...sums) => {
      pseudorigid.followMany(k, g, orbits, { centre: x, expected, from, to, span: SHOWN });
      for (const sum of sums) orbits.grown.forEach((value, i) => (sum[i] += value));
    };
  }

  /** The verdicts, as places in VERDICTS, that are possible after some impacts. */
  function verdicts({ sum, length, whole }, growth, impacts) {
    return Uint8Array.from(growth, (value, i) => {
      if (Number.isNaN(value)) return 4;
      if (value > SURE.growth && sum[i] + Math.log(length[i]) > SURE.size) return 2;
      const turned = 2 * whole[i] <= impacts;
      if (impacts < DECISIVE || !(turned || impacts === LEVELS.at(-1))) return 0;
      if (value >= GROWTH) return 2;
      return turned ? 1 : 3;
    });
  }

  /** The undecided of some orbits, with their pixels. */
  function rest(orbits, index, verdict) {
    const open = verdict.map((known) => (known ? 0 : 1));
    const chosen = (values) => values.filter((_, i) => open[i]);
    return { index: chosen(index),
      orbits: Object.fromEntries(Object.entries(orbits).map(([name, values]) => [name, chosen(values)])) };
  }

  /**
   * The orbits from places, each with its points in a window of (x, y). A regular one that returns is
   * followed until it has drawn its curve there, unless `brief`.
   */
  function fill({ k, g, energy, places, window, brief }) {
    return places.map(([p, q]) => {
      const state = geometry.stateAt(k, g, energy, { p, q });
      const points = { x: [state[0]], xdot: [state[1]], udot: [state[2]] };
      const collect = ({ x, xdot, udot }) => {
        for (let i = 0; i < x.length; i++) {
          const y = xdot[i] - k * udot[i];
          if (!(x[i] >= window.x[0] && x[i] <= window.x[1] && y >= window.y[0] && y <= window.y[1])) continue;
          points.x.push(x[i]);
          points.xdot.push(xdot[i]);
          points.udot.push(udot[i]);
        }
      };
      const follower = new analysis.Follower(k, g, energy, state);
      const first = follower.advance(DECISIVE);
      collect(first);
      let facts = follower.facts(!brief);
      if (brief) facts.verdict = first.size.at(-1) > SURE.size ? "chaotic" : "regular"; // one of many
      const goesOn = () =>
        !brief && facts.verdict === "regular" && points.x.length < ENOUGH &&
        follower.impacts < (points.x.length > PROMISING ? LONGEST : TRIED);
      while (goesOn()) {
        collect(follower.advance(PIECE));
        facts = follower.facts();
      }
      const { verdict, rotation, exponent } = facts;
      return {
        ...Object.fromEntries(Object.entries(points)
          .map(([name, values]) => [name, Float64Array.from(values)])),
        facts: { verdict, rotation, exponent },
      };
    });
  }

  return { begin, further, fill };
})();
