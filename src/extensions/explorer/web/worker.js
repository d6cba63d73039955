/*
 * The worker's side of the conversation with compute.js. Each message {id, job, ...} is answered by
 * {id, result} or {id, error}.
 */
const followers = new Map();
let rate = 200; // impacts in a ms, as measured last
const SEEN_FIRST = 300; // impacts of an orbit that are shown before its verdict is computed

const jobs = {
  /** Begin to follow an orbit; the state of a backward one has been mirrored by the page. */
  open({ key, k, g, energy, state }) {
    try {
      followers.set(key, new analysis.Follower(k, g, energy, state));
    } catch ({ message }) {
      followers.set(key, { refused: message });
    }
  },

  reset: () => followers.clear(),
  close: ({ keys }) => keys.forEach((key) => followers.delete(key)),

  /**
   * Follow orbits, [[key, impacts at most], ...], for about `time` ms, which they share, and return
   * the new impacts and the facts of each. At most one verdict is computed at a time.
   */
  advance({ orbits, time }) {
    const known = orbits.filter(([key]) => followers.has(key));
    let judged = false;
    return known.map(([key, most]) => {
      const follower = followers.get(key);
      const impacts = Math.max(1, Math.min(most, Math.round((rate * time) / known.length)));
      const begin = performance.now();
      let piece = { x: [], xdot: [], udot: [], tau: [] };
      try {
        if (!follower.refused && most > 0) piece = follower.advance(impacts);
      } catch ({ message }) {
        follower.refused = message; // where the kernel finds no impact
      }
      const measured = impacts / Math.max(0.01, performance.now() - begin); // clocks may be coarse
      if (impacts > 100) rate = Math.min(2 * rate, Math.max(rate / 2, measured));
      const { x, xdot, udot, tau } = piece;
      const judges =
        !judged && follower.verdict === undefined && (most === 0 || follower.impacts > SEEN_FIRST);
      judged ||= judges;
      return { key, x, xdot, udot, tau, facts: follower.facts?.(judges) ?? null, refused: follower.refused };
    });
  },

  periodic: ({ k, g, energy, period }) => analysis.periodicOrbits(k, g, energy, period),
  near: ({ k, g, energy, p, q, period }) => analysis.nearestOrbit(k, g, energy, p, q, period),
  family: ({ k, g, energy, orbit }) => analysis.family(k, g, energy, orbit),
  branch: ({ k, g, energy, points, spec }) => analysis.traceBranch(k, g, energy, points, spec),
  jump: ({ k, g, energy }) => analysis.jumpCurve(k, g, energy),
  pixels: (request) => request.rest ? crowd.further(request) : crowd.begin(request),
  fill: (request) => crowd.fill(request),
  /** Further impacts of an orbit from a state, of which the page has kept only the first ones. */
  replay: ({ k, g, state, impacts }) => pseudorigid.history(k, g, ...state, impacts),
  /** Compare the orbits of a figure with the committed dataset. */
  check: ({ figure }) => pseudorigid.checkFigure(figure),
};

/** The buffers of all typed arrays in a result, which are handed over instead of copied. */
function buffersOf(value, found = []) {
  if (ArrayBuffer.isView(value)) found.push(value.buffer);
  else if (value && typeof value === "object") Object.values(value).forEach((v) => buffersOf(v, found));
  return found;
}

self.onmessage = ({ data }) => {
  const { id, job } = data;
  try {
    const result = jobs[job](data);
    self.postMessage({ id, result }, buffersOf(result));
  } catch (error) {
    self.postMessage({ id, error: error.message });
  }
};
