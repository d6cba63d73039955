/*
 * What the page finds out about orbits, in the worker. The formulas are those of the package
 * pseudorigid and of the claims: dynamics/regularity.py, atlas/symmetry_line.py and
 * kernel/tangents.py (verdict and numbers of an orbit), dynamics/periodic.py, dynamics/branch.py
 * with dynamics/tracing.py, and extensions/claims/analyses/jumps.py.
 * The impacts come from the kernel, bit for bit; sums here may differ in the last digits.
 */
const analysis = (() => {
  // The rule of dynamics/regularity.py.
  const LENGTHS = [500, 1000, 2000, 4000, 8000, 16000, 32000, 64000]; // impacts
  const RULE = { regular: 0.85, margin: 1, change: 0.5, chaotic: 6, halves: 1e-5, turns: 2, least: 32000 };
  const BLOCKS = 65536; // of sums of an orbit; longer orbits have longer blocks
  const RESOLUTION = 20000; // cells of a symmetry line
  const SAME = 1e-9; // all lengths from here on in section radii
  const CLOSURE = 1e-14;
  const JUMP = 1e-6;
  const NEWTON_STEPS = 5;
  const STARTS = 3600; // of Newton's method around a place, shared by the periods
  const POINTS_OF_IMAGE = 16;
  const MOST_IMAGES = 400;
  const WEAK = 1.5;
  const LARGEST_SPLIT = 0.1;
  const FINEST = 1e-3;
  const MOST_VERTICES = 400000;

  /** The state after some impacts. */
  function iterate(k, g, state, impacts) { return withTime(k, g, state, impacts).slice(0, 3); }

  /** The state after some impacts, and the time of the last flight. */
  function withTime(k, g, [x, xdot, udot], impacts = 1) {
    return pseudorigid.iterate(k, g, x, xdot, udot, impacts);
  }

  // ---------------------------------------------------------------- facts of one orbit

  /** An orbit that is followed on request, with what is known about it so far. */
  class Follower {
    constructor(k, g, energy, state) {
      this.k = k;
      this.start = [k, g, energy, state];
      this.orbit = pseudorigid.follow(k, g, ...state);
      this.impacts = 0;
      this.turns = new Float64Array(1024); // sums over blocks
      this.width = 1; // impacts of a block
      this.blocks = 0;
      this.open = { impacts: 0, turn: 0 }; // the block that is not complete
      this.turnTo = turnCounter(k, g, energy, state);
    }

    /**
     * Follow the orbit over further impacts, and return their states and times of flight. It stops
     * for good before a flight that is not finite, and `refused` says why.
     */
    advance(impacts) {
      const piece = this.orbit.advance(impacts);
      const end =
        piece.tau.findIndex((tau, i) => !Number.isFinite(tau + piece.x[i] + piece.xdot[i] + piece.udot[i]));
      if (end >= 0) {
        for (const name in piece) piece[name] = piece[name].slice(0, end);
        impacts = end;
        this.refused = pseudorigid.TOO_LONG;
      }
      for (let i = 0; i < impacts; i++) this.add(this.turnTo(piece.x[i], piece.xdot[i], piece.udot[i]));
      this.impacts += impacts;
      return piece;
    }

    /** Add an impact to the sums over blocks, which become twice as long where there are too many. */
    add(turn) {
      const { open } = this;
      open.impacts += 1;
      open.turn += turn;
      if (open.impacts < this.width) return;
      if (this.blocks === this.turns.length) this.turns = grown(this.turns);
      this.turns[this.blocks] = open.turn;
      this.blocks += 1;
      open.impacts = open.turn = 0;
      if (this.blocks < BLOCKS) return;
      this.blocks /= 2;
      this.width *= 2;
      for (let i = 0; i < this.blocks; i++) this.turns[i] = this.turns[2 * i] + this.turns[2 * i + 1];
    }

    /** Exponent and rotation number so far, and the verdict; "" if it stops, or is not known yet. */
    facts(judges = true) {
      if (judges) this.verdict ??= typeOf(...this.start); // takes up to 64,000 impacts
      return {
        impacts: this.impacts,
        exponent: this.orbit.exponent(),
        rotation: weightedMean(this.turns, 0, this.blocks) / this.width,
        verdict: (!this.refused && this.verdict) || "",
      };
    }
  }

  /** A function that returns the turn around the fixed point from the state before to the next one. */
  function turnCounter(k, g, energy, state) {
    const fixed = geometry.fixedPoint(k, g, energy);
    const expected = Number.isNaN(fixed.rotation) ? 0.5 : fixed.rotation;
    const round = 1 / Math.sqrt(k * (1 + k)); // the section is a disk in (x, round * y)
    const relative = (x, v, w) => [x - fixed.x, round * (v - k * w)];
    let [p, q] = relative(...state);
    return (x, v, w) => {
      const [r, s] = relative(x, v, w);
      let turn = Math.atan2(q * r - p * s, p * r + q * s) / (2 * Math.PI);
      if (turn < expected - 0.5) turn += 1;
      else if (turn > expected + 0.5) turn -= 1;
      [p, q] = [r, s];
      return turn;
    };
  }

  /** The verdict on the orbit of a state, which depends on the state alone: `judged` of Python. */
  function typeOf(k, g, energy, state) {
    const [x, v, w] = state;
    const fixed = geometry.fixedPoint(k, g, energy);
    const near = Math.abs(x - fixed.x) + Math.abs(v - k * w) <= 1e-12 * (Math.abs(x) + Math.abs(w));
    const still = near && !Number.isNaN(fixed.rotation); // roundings decide the turns
    const turnTo = turnCounter(k, g, energy, state);
    const turns = new Float64Array(LENGTHS.at(-1));
    const sizes = new Float64Array(LENGTHS.at(-1));
    const follower = pseudorigid.follow(k, g, ...state);
    follower.orbit.set([1, 0, 0], 3); // the tangent vector, which is not along a curve on y = 0
    let before = { growth: NaN };
    for (const length of LENGTHS) {
      const start = follower.impacts;
      const piece = follower.advance(length - start);
      sizes.set(piece.size, start);
      for (let i = start; i < length; i++) {
        turns[i] = turnTo(piece.x[i - start], piece.xdot[i - start], piece.udot[i - start]);
      }
      const means =
        [[0, length], [0, length / 2], [length / 2, length]].map((ends) => weightedMean(turns, ...ends));
      const [winding, first, second] = still ? [fixed.rotation, 0, 0] : means;
      const now = { growth: growthOf(sizes, length), winding, apart: Math.abs(first - second) };
      if (Number.isNaN(now.growth)) return "undefined"; // it grazes exactly
      if (Math.min(before.growth, now.growth) > RULE.chaotic) return "chaotic";
      const calm =
        ({ growth, apart }) => Math.abs(growth - RULE.regular) < RULE.margin && apart < RULE.halves;
      const lasting =
        Math.abs(now.growth - before.growth) < RULE.change && Math.abs(winding) * length >= RULE.turns;
      if (length >= RULE.least && calm(before) && calm(now) && lasting) return "regular";
      before = now;
    }
    return "undecided";
  }

  function grown(array) {
    const larger = new Float64Array(2 * array.length);
    larger.set(array);
    return larger;
  }

  /** The growth of a tangent vector over n impacts, by which dynamics/regularity.py classifies orbits. */
  function growthOf(sizes, n) {
    const quarter = Math.floor(n / 4);
    let difference = 0;
    for (let i = 0; i < quarter; i++) difference += sizes[n - quarter + i] - sizes[quarter + i];
    return difference / quarter;
  }

  /** A weighted Birkhoff average with the weights (t (1 - t))^3 of values from `start` to `stop`. */
  function weightedMean(values, start, stop) {
    let sum = 0;
    let weights = 0;
    for (let i = start; i < stop; i++) {
      const t = (i - start + 0.5) / (stop - start);
      const bump = (t * (1 - t)) ** 3;
      sum += bump * values[i];
      weights += bump;
    }
    return sum / weights;
  }

  // ---------------------------------------------------------------- periodic orbits

  /** All symmetric orbits of a prime period that the search shows, by rising |multiplier|. */
  function periodicOrbits(k, g, energy, period) {
    const { radius } = geometry.section(k, g, energy);
    const seen = [];
    const solved = [];
    const near = (a, b) => a.every((value, i) => Math.abs(value - b[i]) < SAME * radius);
    for (const line of symmetryLines(k, g, energy, period)) {
      for (const state of solutions(k, g, line, period, radius)) {
        const points = orbitFrom(k, g, state, period).map((point) => point.slice(0, 3));
        const others = seen.concat(points.slice(1));
        if (others.some((other) => near(other, points[0]))) continue;
        seen.push(...points);
        const [a, , , d] = pseudorigid.tangent(k, g, ...state, period);
        const trace = a + d;
        const limit = CLOSURE * radius * Math.max(1, Math.abs(multiplierOf(trace)) / 50);
        for (const point of points) {
          const [first, gap] = closest(k, g, energy, point, period);
          if (!(gap <= limit)) continue;
          solved.push(described(k, g, first, period, trace));
          break;
        }
      }
    }
    const size = (orbit) => Math.abs(orbit.multiplier);
    solved.sort((a, b) => size(a) - size(b) || a.points[0][0] - b.points[0][0]);
    return solved;
  }

  function described(k, g, state, period, trace) {
    const points = orbitFrom(k, g, state, period);
    const elliptic = Math.abs(trace) < 2;
    const saddle = trace > 0 ? "hyperbolic" : "inverse hyperbolic";
    return {
      period,
      points,
      trace,
      type: elliptic ? "elliptic" : saddle,
      multiplier: multiplierOf(trace),
      rotation: elliptic ? Math.acos(trace / 2) / (2 * Math.PI) : trace > 0 ? 0 : 0.5,
      time: points.reduce((sum, point) => sum + point[3], 0),
    };
  }

  function multiplierOf(trace) {
    const size = Math.abs(trace);
    if (size <= 2) return 1;
    return Math.sign(trace) * 0.5 * (size + Math.sqrt((size - 2) * (size + 2)));
  }

  /** The points [x, xdot, udot, time of the next flight] of an orbit. */
  function orbitFrom(k, g, state, period) {
    const points = [];
    for (let i = 0; i < period; i++) {
      const [x, v, w, tau] = withTime(k, g, state);
      points.push([...state, tau]);
      state = [x, v, w];
    }
    return points;
  }

  /** The lines to search: states along each, parameters, and a defect that is 0 at an orbit. */
  function symmetryLines(k, g, energy, period) {
    const { centre, radius } = geometry.section(k, g, energy);
    const onR = (q) => {
      const udot = (radius * (((1 - q) * (1 + q)) / (1 + q * q))) / Math.sqrt(1 + k);
      return [centre + radius * ((2 * q) / (1 + q * q)), k * udot, udot];
    };
    const symmetricFlight = (state) => {
      const [, v, , tau] = withTime(k, g, state);
      return v - 0.5 * g * tau;
    };
    const cells = Array.from({ length: RESOLUTION }, (_, i) => i);
    const inside = cells.map((i) => (2 * i + 1) / RESOLUTION - 1);
    if (period % 2) return [{ start: onR, parameters: inside, defect: symmetricFlight }];
    const lines = [{ start: onR, parameters: inside, defect: ([, v, w]) => v - k * w }];
    const longest = (radius * Math.sqrt(k)) / g;
    for (const sign of [1, -1]) {
      lines.push({
        start: (theta) => onRP(k, g, energy, theta, sign),
        parameters: cells.map((i) => (longest * (i + 1)) / RESOLUTION),
        defect: symmetricFlight,
      });
    }
    return lines;
  }

  /** The state whose flight is symmetric in time and lasts 2 theta; null if there is none. */
  function onRP(k, g, energy, theta, sign) {
    const cosine = Math.cos(theta);
    const square = g * g * cosine * cosine + k * (2 * energy - g * g * theta * theta);
    if (!(square >= 0)) return null;
    const a = (g * cosine + sign * Math.sqrt(square)) / k;
    const [v, w] = pseudorigid.afterImpact(k, -g * theta, -a * Math.sin(theta));
    if (!(v + w >= 0)) return null;
    const state = [a * cosine, v, w];
    const tau = withTime(k, g, state)[3];
    return Math.abs(tau - 2 * theta) <= 1e-7 * (1 + theta) ? state : null;
  }

  function solutions(k, g, line, period, radius) {
    const value = (parameter) => {
      const state = line.start(parameter);
      return state ? line.defect(iterate(k, g, state, Math.floor(period / 2))) : NaN;
    };
    const values = defects(k, g, line, Math.floor(period / 2));
    const found = [];
    for (const ends of signChanges(value, line.parameters, values)) {
      const [low, high] = ends.map((parameter) => {
        const state = line.start(parameter);
        return state ? [state, gapOf(k, g, state, period)] : [null, Infinity];
      });
      const [state, gap] = low[1] <= high[1] ? low : high;
      if (gap < JUMP * radius) found.push(state); // a jump changes the sign, but does not close
    }
    return found;
  }

  /** The defects at all parameters of a line, NaN beyond its ends; the orbits advance together. */
  function defects(k, g, line, impacts) {
    const starts = line.parameters.map(line.start);
    const column = (i) => Float64Array.from(starts, (state) => (state ? state[i] : NaN));
    const states = { x: column(0), xdot: column(1), udot: column(2), tau: column(0) };
    pseudorigid.iterateMany(k, g, states, impacts);
    const { x, xdot, udot } = states;
    return starts.map((state, i) => (state ? line.defect([x[i], xdot[i], udot[i]]) : NaN));
  }

  /** The ends, neighbouring doubles, of each sign change; values are NaN beyond a line's ends. */
  function signChanges(value, parameters, values) {
    const changes = [];
    for (let i = 0; i + 1 < parameters.length; i++) {
      let [low, high] = [parameters[i], parameters[i + 1]];
      let [atLow, atHigh] = [values[i], values[i + 1]];
      if (Number.isNaN(atLow) && Number.isNaN(atHigh)) continue;
      if (Number.isNaN(atHigh)) {
        [high] = halve(low, high, (q) => !Number.isNaN(value(q)));
        atHigh = value(high);
      } else if (Number.isNaN(atLow)) {
        [, low] = halve(low, high, (q) => Number.isNaN(value(q)));
        atLow = value(low);
      }
      if (atLow * atHigh <= 0) changes.push(halve(low, high, (q) => atLow * value(q) > 0));
    }
    return changes;
  }

  function halve(low, high, goesRight) {
    for (;;) {
      const middle = 0.5 * (low + high);
      if (middle === low || middle === high) return [low, high];
      if (goesRight(middle)) low = middle;
      else high = middle;
    }
  }

  /** The largest coordinate of P^n z - z. */
  function gapOf(k, g, state, period) {
    const after = iterate(k, g, state, period);
    return Math.max(...after.map((value, i) => Math.abs(value - state[i])));
  }

  /** The state nearby from which an orbit closes best, and the gap that it leaves. */
  function closest(k, g, energy, state, period) {
    let best = state;
    let least = Infinity;
    for (let step = 0; state && step < NEWTON_STEPS; step++) {
      const gap = gapOf(k, g, state, period);
      if (!(gap < least)) break;
      [best, least] = [state, gap];
      const [x, y] = pseudorigid.newton(k, g, energy, state[0], state[1] - k * state[2], period, 1);
      state = geometry.chartState(k, g, energy, x, y);
    }
    const ulp = best.map((value) => 2 ** (Math.floor(Math.log2(Math.abs(value) || 1e-300)) - 52));
    let nearest = best;
    for (let n = 0; n < 125; n++) {
      const shift = [Math.floor(n / 25) - 2, (Math.floor(n / 5) % 5) - 2, (n % 5) - 2];
      const near = best.map((value, i) => value + shift[i] * ulp[i]);
      if (near[1] + near[2] < 0) continue;
      const gap = gapOf(k, g, near, period);
      if (gap < least) [nearest, least] = [near, gap];
    }
    return [nearest, least];
  }

  /**
   * The periodic orbit nearest to a place that Newton's method reaches from points around it, of a prime
   * period, or with 0 of any; its first point is the nearest. Null if there is none.
   */
  function nearestOrbit(k, g, energy, p, q, wanted) {
    const { radius, height } = geometry.section(k, g, energy);
    const target = geometry.pointAt(k, g, energy, p, q);
    const size = (x, y) => Math.sqrt((x / radius) ** 2 + (y / height) ** 2);
    const periods = wanted ? [wanted] : Array.from({ length: MOST_PERIOD }, (_, i) => i + 1);
    let found = null;
    let least = Infinity;
    const starts = STARTS / periods.length;
    let [cosine, sine] = [1, 0];
    for (let i = 0; i < starts; i++) {
      const reach = 0.5 * (i / starts) ** 2; // along a spiral, whose bits are the same in all browsers
      if (reach > 2 * least) break;
      [cosine, sine] = [0.6 * sine - 0.8 * cosine, -0.8 * sine - 0.6 * cosine];
      const from = [target.x + reach * radius * cosine, target.y + reach * height * sine];
      for (const period of periods) {
        const [x, y, across, up] = pseudorigid.newton(k, g, energy, ...from, period, 12);
        const away = size(x - target.x, y - target.y);
        if (!(size(across, up) < 1e-10 && away < least * (1 - 1e-6))) continue;
        const state = geometry.chartState(k, g, energy, x, y);
        const [point, gap] = state ? closest(k, g, energy, state, period) : [null, Infinity];
        if (!(gap < JUMP * radius)) continue;
        const divisors = Array.from({ length: period - 1 }, (_, n) => n + 1).filter((n) => period % n === 0);
        if (divisors.some((n) => gapOf(k, g, point, n) < JUMP * radius)) continue;
        [found, least] = [{ point, period }, away];
      }
    }
    if (!found) return null;
    const [a, , , d] = pseudorigid.tangent(k, g, ...found.point, found.period);
    return described(k, g, found.point, found.period, a + d);
  }

  // ---------------------------------------------------------------- branches of a saddle

  /**
   * An unstable branch as a function of u >= 0, whose whole part counts images; or its mirror image,
   * a stable branch.
   */
  class Branch {
    constructor(k, g, energy, points, saddle, side, stable) {
      Object.assign(this, { k, g, energy, stable });
      this.radius = geometry.section(k, g, energy).radius;
      const xy = points.map(([x, v, w]) => [x, v - k * w]);
      this.point = points[saddle].slice(0, 3);
      this.origin = xy[saddle];
      this.period = points.length;
      const [a, b, c, d] = pseudorigid.tangent(k, g, ...this.point, this.period);
      this.multiplier = multiplierOf(a + d);
      let e = Math.abs(b) > Math.abs(c) ? [b, this.multiplier - a] : [this.multiplier - d, c];
      // Outer is away from the middle of the orbit, in coordinates in which the section is round.
      const scale = [1, 1 / Math.sqrt(k * (1 + k))];
      let outward = 0;
      for (const i of [0, 1]) {
        const mean = xy.reduce((sum, point) => sum + point[i], 0) / xy.length;
        outward += (this.origin[i] - mean) * scale[i] * e[i] * scale[i];
      }
      const length = Math.hypot(e[0] * scale[0], e[1] * scale[1]);
      const sign = outward > 0 === (side === "outer") ? 1 : -1;
      e = e.map((value) => (sign * value) / length);
      if (this.multiplier < 0) {
        this.period *= 2;
        this.multiplier *= this.multiplier;
      }
      this.weak = this.multiplier < WEAK;
      // An image that is far longer than the one before is traced in parts, of which the first may do.
      this.parts = this.multiplier > 1e3 ? 16 : 1;
      this.ratio = this.multiplier;
      for (let n = this.parts; n > 1; n /= 2) this.ratio = Math.sqrt(this.ratio);
      this.jumps = energy > geometry.firstJump(k, g);
      this.first = e.map((value) => (1e-6 * this.radius * value) / this.multiplier);
      this.images = MOST_IMAGES;
      if (this.weak) this.images = (MOST_IMAGES * Math.log(WEAK)) / Math.log(this.multiplier);
    }

    at(u) {
      const image = Math.floor(u);
      const part = Math.floor((u - image) * this.parts);
      let sigma = 1 + (this.ratio - 1) * ((u - image) * this.parts - part);
      for (let n = 0; n < part; n++) sigma *= this.ratio;
      const [x, y] = this.origin.map((value, i) => value + sigma * this.first[i]);
      const state = pseudorigid.stateXY(this.k, this.g, this.energy, x, y);
      return this.after(state, image * this.period);
    }

    /**
     * The state at u. Of a weak branch, which takes many images, it is mapped from the image before,
     * from a vertex or a point on the cubic through the four vertices around it: rounding errors
     * would scatter points that are mapped from the first segment.
     */
    next(u, known) {
      if (!this.weak || known.length < 2 * POINTS_OF_IMAGE) return this.at(u);
      const { k } = this;
      const before = u - 1;
      let [low, high] = [0, known.length - 1];
      while (low < high) {
        const middle = (low + high) >> 1;
        if (known[middle].u < before) low = middle + 1;
        else high = middle;
      }
      let state = this.mirror(known[low].state);
      if (known[low].u !== before) {
        const first = Math.min(Math.max(low - 2, 0), known.length - 4);
        const nodes = known.slice(first, first + 4).map((vertex) => vertex.u);
        const rows = known.slice(first, first + 4).map((vertex) => this.mirror(vertex.state));
        const share = (before - nodes[0]) / (nodes[3] - nodes[0]);
        const columns = [rows.map((row) => row[0]), rows.map((row) => row[1] - k * row[2])];
        const ends = columns.map((values) =>
          [0, 1].map((i) => parabola(nodes.slice(i, i + 3), values.slice(i, i + 3), before)),
        );
        const extent = Math.max(...columns.map((values) => Math.max(...values) - Math.min(...values)));
        if (this.jumps && ends.some(([a, b]) => Math.abs(a - b) > 0.5 * extent)) return this.at(u);
        const [x, y] = ends.map(([a, b]) => a + share * (b - a));
        state = geometry.chartState(k, this.g, this.energy, x, y);
        if (!state) return this.at(u);
      }
      return this.after(state, this.period);
    }

    after(state, impacts) {
      const after = iterate(this.k, this.g, state, impacts);
      if (!after.every(Number.isFinite)) throw new Error(pseudorigid.TOO_LONG);
      return this.mirror(after);
    }

    mirror(state) { return this.stable ? pseudorigid.reverse(this.k, ...state) : state; }

    /** Whether the two orbits to where an image begins agree so far. */
    accurate(image, states) {
      if (image < 2) return true;
      let extent = 0;
      for (const i of [0, 1, 2]) {
        const values = states.map((state) => state[i]);
        extent = Math.max(extent, Math.max(...values) - Math.min(...values));
      }
      const before = this.at(image * (1 - 2 ** -52));
      const after = this.at(image);
      return Math.max(...after.map((v, i) => Math.abs(v - before[i]))) <= LARGEST_SPLIT * extent;
    }
  }

  /** The parabola through three values at nodes. */
  function parabola([a, b, c], values, at) {
    const slope = (values[1] - values[0]) / (b - a);
    const bend = ((values[2] - values[1]) / (c - b) - slope) / (c - a);
    return values[0] + (at - a) * (slope + (at - b) * bend);
  }

  /**
   * The polyline of a branch: {x, xdot, udot} with NaN at jumps, and `ended`, the length where
   * rounding errors end it. Lengths are in section radii, `bend` in degrees. An inverse hyperbolic
   * orbit is traced under P^2n. A part of the section that is magnified, `window`: {x, y, half} in
   * the chart with half its size in section radii, is traced as finely as the whole section.
   */
  function traceBranch(k, g, energy, points, spec) {
    const { stable, side, length, distance = 0.01, bend = 10, window } = spec;
    let { saddle } = spec;
    if (stable) {
      // A stable branch is the mirror image of an unstable one, of this orbit or of its mirror image.
      const image = pseudorigid.reverse(k, ...points[saddle].slice(0, 3));
      const gaps = points.map((point) => Math.max(...image.map((value, i) => Math.abs(value - point[i]))));
      const nearest = gaps.indexOf(Math.min(...gaps));
      if (gaps[nearest] < JUMP * geometry.section(k, g, energy).radius) saddle = nearest;
      else points = points.map((point) => pseudorigid.reverse(k, ...point.slice(0, 3)));
    }
    const branch = new Branch(k, g, energy, points, saddle, side, stable);
    const rule = { distance, straight: Math.cos((bend * Math.PI) / 180), finest: () => 1 };
    if (window) rule.finest = magnification(k, g, energy, window);
    let vertices = [];
    let travelled = 0;
    let ended = null;
    let steps = [];
    for (let part = 0; travelled < length; part++) {
      const image = Math.floor(part / branch.parts);
      const recent = vertices.filter((vertex) => vertex.u >= image - 1).map((v) => v.state);
      if (image > branch.images || (branch.weak && !branch.accurate(image, recent))) {
        ended = travelled;
        break;
      }
      // Only what is new, and the last two sides before it, can be too coarse.
      const fixed = vertices.slice(0, Math.max(0, vertices.length - 3));
      let rest = vertices.slice(fixed.length);
      for (let i = 0; i < POINTS_OF_IMAGE; i++) {
        const u = (part + i / POINTS_OF_IMAGE) / branch.parts;
        rest.push({ u, state: branch.next(u, vertices) });
      }
      for (;;) {
        const known = branch.weak ? fixed.concat(rest) : rest;
        const refined = refine(branch, rest, rule, known);
        if (refined.length === rest.length) break;
        rest = refined;
        if (fixed.length + rest.length > MOST_VERTICES) {
          throw new Error(`a branch of more than ${MOST_VERTICES} points: make the length shorter`);
        }
      }
      vertices = fixed.concat(rest);
      steps = sidesOf(vertices, branch.radius);
      travelled = 0;
      for (const step of steps) travelled += step.jump ? 0 : step.length;
    }
    return { ...polyline(branch, vertices, steps, length), ended };
  }

  function isJump(low, high) {
    const middle = 0.5 * (low + high);
    return high - low < 2 ** -40 || middle === low || middle === high;
  }

  function sidesOf(vertices, radius) {
    const sides = [];
    for (let i = 0; i + 1 < vertices.length; i++) {
      const [a, b] = [vertices[i], vertices[i + 1]];
      const step = a.state.map((value, j) => (b.state[j] - value) / radius);
      const length = Math.hypot(...step);
      const indivisible = isJump(a.u, b.u);
      sides.push({ step, length, indivisible, jump: indivisible && length > 1e-6 });
    }
    return sides;
  }

  /** How much finer than usual a side is drawn: as the window magnifies it, or by 1 outside. */
  function magnification(k, g, energy, { x, y, half }) {
    const { radius, height } = geometry.section(k, g, energy);
    const place = ([px, v, w]) => [(px - x) / radius, (v - k * w - y) / height];
    return (a, b) => {
      const [from, to] = [place(a), place(b)];
      const reach = Math.hypot(to[0] - from[0], to[1] - from[1]);
      const meets = [0, 1].every(
        (i) => Math.min(from[i], to[i]) - reach <= half && Math.max(from[i], to[i]) + reach >= -half,
      );
      return meets ? Math.min(1, half) : 1;
    };
  }

  /** The vertices with a further one in the middle of each side that is too long or bends. */
  function refine(branch, vertices, { distance, straight, finest }, known) {
    const sides = sidesOf(vertices, branch.radius);
    const limits = sides.map((_, i) => distance * finest(vertices[i].state, vertices[i + 1].state));
    const coarse = sides.map((side, i) => side.length > limits[i]);
    for (let i = 0; i + 1 < sides.length; i++) {
      const [a, b] = [sides[i], sides[i + 1]];
      const product = a.step.reduce((sum, value, j) => sum + value * b.step[j], 0);
      if (!(product < straight * a.length * b.length)) continue;
      if (!(Math.max(a.length, b.length) > FINEST * Math.min(limits[i], limits[i + 1]))) continue;
      if (a.length >= 0.5 * b.length) coarse[i] = true;
      if (b.length >= 0.5 * a.length) coarse[i + 1] = true;
    }
    const refined = [vertices[0]];
    sides.forEach((side, i) => {
      if (coarse[i] && !side.indivisible) {
        const u = 0.5 * (vertices[i].u + vertices[i + 1].u);
        refined.push({ u, state: branch.next(u, known) });
      }
      refined.push(vertices[i + 1]);
    });
    return refined;
  }

  function polyline(branch, vertices, sides, length) {
    const rows = [branch.mirror(branch.point)];
    let travelled = 0;
    for (let i = 0; i < vertices.length; i++) {
      rows.push(vertices[i].state);
      if (travelled >= length || i >= sides.length) break;
      if (sides[i].jump) rows.push([NaN, NaN, NaN]);
      else travelled += sides[i].length;
    }
    const [x, xdot, udot] = [0, 1, 2].map((i) => Float64Array.from(rows, (row) => row[i]));
    return { x, xdot, udot, travelled };
  }

  // ---------------------------------------------------------------- where the map jumps

  /** The curve where the inverse map jumps, with NaN at gaps, and its length in (x, y). */
  function jumpCurve(k, g, energy, sides = 4000) {
    const { centre, radius, height } = geometry.section(k, g, energy);
    const none = { x: new Float64Array(0), y: new Float64Array(0), length: 0 };
    if (!(centre - radius < -g)) return none;
    const margin = 2 ** -46;
    const depth = (centre + g) / radius;
    const end = Math.sqrt((1 - depth) / (1 + depth)) * (1 - margin);
    const image = (t) => {
      const x = centre - radius * (((1 - t) * (1 + t)) / (1 + t * t));
      const y = (height * 2 * t) / (1 + t * t) / (1 + k);
      const [x1, v1, w1] = iterate(k, g, [x, y, -y], 1);
      return [x1, v1 - k * w1];
    };
    const parameters = Array.from({ length: sides + 1 }, (_, i) => end * (1 - (2 * i) / sides));
    const points = parameters.map(image);
    const span = (i) => {
      const values = points.map((point) => point[i]);
      return Math.max(...values) - Math.min(...values);
    };
    const extent = Math.max(span(0), span(1));
    const apart = (a, b) => Math.max(Math.abs(a[0] - b[0]), Math.abs(a[1] - b[1]));
    const gaps = points.slice(1).map((last, i) => {
      let [low, high] = [parameters[i], parameters[i + 1]];
      let [a, b] = [points[i], last];
      const smallest = Math.max(0.01 * apart(a, b), 1e-9 * extent);
      for (let n = 0; n < 40; n++) {
        if (!(apart(a, b) > smallest)) return false; // the sides only become shorter
        const middle = 0.5 * (low + high);
        const point = image(middle);
        if (apart(a, point) > apart(point, b)) [high, b] = [middle, point];
        else [low, a] = [middle, point];
      }
      return apart(a, b) > smallest;
    });
    const lengthOf = (every) => {
      let total = 0;
      for (let i = 0; i < sides; i += every) {
        if (gaps.slice(i, i + every).some(Boolean)) continue;
        total += Math.hypot(points[i + every][0] - points[i][0], points[i + every][1] - points[i][1]);
      }
      return total;
    };
    const [fine, middle] = [lengthOf(1), lengthOf(2)];
    const x = [];
    const y = [];
    points.forEach((point, i) => {
      x.push(point[0]);
      y.push(point[1]);
      if (gaps[i]) {
        x.push(NaN);
        y.push(NaN);
      }
    });
    return { x: Float64Array.from(x), y: Float64Array.from(y), length: fine + (fine - middle) / 3 };
  }

  /** A periodic orbit at other energies, as far as it can be followed: samples {energy, trace, places}. */
  function family(k, g, energy, { points, period }) {
    const [least, most] = geometry.energyBounds(k, g);
    const longest = (most - least) / 200;
    const chart = ([x, v, w]) => ({ x, y: v - k * w });
    const sides = [-1, 1].map((sign) => {
      const samples = [];
      let last = { energy, ...chart(points[0]) };
      let before = last;
      let search = false; // near a birth, where the trace is almost 2, on the symmetry lines only
      for (let step = longest / 4; step > 1e-6 * (most - least); ) {
        const to = last.energy + sign * step;
        const ahead = last === before ? 0 : (to - last.energy) / (last.energy - before.energy);
        const guess = { x: last.x + ahead * (last.x - before.x), y: last.y + ahead * (last.y - before.y) };
        const state = to > least && to < most && (search ? found : solved)(to, guess);
        if (!state) {
          step /= 2;
          if (search || step > 1e-6 * (most - least)
            || !(Math.abs(samples.at(-1)?.trace - 2) < 1e-3)) continue;
          [search, step] = [true, longest / 16];
          continue;
        }
        [before, last] = [last, { energy: to, ...chart(state) }];
        const [a, , , d] = pseudorigid.tangent(k, g, ...state, period);
        const { radius, centre, height } = geometry.section(k, g, to);
        const places =
          orbitFrom(k, g, state, period).map(chart).map(({ x, y }) => [(x - centre) / radius, y / height]);
        samples.push({ energy: to, trace: a + d, places });
        step = Math.min(longest, 1.5 * step);
      }
      return samples;
    });
    return [...sides[0].reverse(), ...sides[1]];

    function solved(to, guess) {
      const { radius } = geometry.section(k, g, to);
      const [x, y, across, up] = pseudorigid.newton(k, g, to, guess.x, guess.y, period, 8);
      const apart = (one, other) => Math.hypot(one.x - other.x, one.y - other.y) / radius;
      const state = Math.hypot(across, up) < 1e-9 * radius
        && apart({ x, y }, guess) < 0.02 && geometry.chartState(k, g, to, x, y);
      const again = state && orbitFrom(k, g, state, period).slice(1)
        .some((point) => apart(chart(point), { x, y }) < 1e-6);
      return again ? null : state; // an orbit that closes earlier has another period
    }

    function found(to, guess) {
      const { radius } = geometry.section(k, g, to);
      const all =
        periodicOrbits(k, g, to, period).flatMap((orbit) => orbit.points.map((point) => point.slice(0, 3)));
      const distances = all.map((point) => Math.hypot(chart(point).x - guess.x, chart(point).y - guess.y));
      const nearest = distances.indexOf(Math.min(...distances));
      return distances[nearest] < 0.1 * radius ? all[nearest] : null;
    }
  }

  return { Follower, family, periodicOrbits, nearestOrbit, traceBranch, jumpCurve };
})();
