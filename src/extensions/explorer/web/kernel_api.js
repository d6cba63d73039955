// The interface `pseudorigid` of the page and of its worker: calls of the compiled kernel.
//
// KERNEL is the WebAssembly module, in base64. Lengths are in R, times in 1/omega, energies in
// m omega^2 R^2. A state (x, xdot, udot) is taken just before an impact. Where a coordinate is not
// finite, all results are NaN, as in Python. Bad arguments throw a RangeError whose message is one
// line for the user.
globalThis.pseudorigid = (() => {
  "use strict";
  const CHUNK = 8192; // impacts in a call that writes rows
  const LANES = 264; // orbits that advance together, as in kernel/lanes.py
  // Addresses in the module's memory: its stack ends where the results of numba's functions begin.
  const RESULT = 65536;
  const EXCEPTION = RESULT + 8 * 4;
  const ORBIT = EXCEPTION + 8;
  const ROWS = ORBIT + 8 * 24;
  const LANE_ROWS = ROWS + 8 * 5 * CHUNK;
  const LANE_KEPT = [0, 1, 2, 3, ...Array.from({ length: 11 }, (_, i) => 33 + i)]; // rows, in CROWD's order
  const CROWD = ["x", "xdot", "udot", "tau", "a", "b", "c", "length",
    "sum", "p", "q", "turned", "weighted", "whole", "grown"];
  const ORDER = LANE_ROWS + 8 * 44 * LANES;
  const PAGE = 65536; // bytes of a page of memory
  const memory = new WebAssembly.Memory({ initial: Math.ceil((ORDER + 8 * LANES) / PAGE) });
  const doubles = new Float64Array(memory.buffer);
  const at = (address, count) => doubles.subarray(address / 8, address / 8 + count);
  const result = at(RESULT, 4), followed = at(ORBIT, 24);
  const module = new WebAssembly.Module(Uint8Array.from(atob(KERNEL), c => c.charCodeAt(0)));
  const stack = new WebAssembly.Global({ value: "i32", mutable: true }, RESULT);
  const imports = { env: { __linear_memory: memory, __stack_pointer: stack } };
  const kernel = new WebAssembly.Instance(module, imports).exports;

  // Call a function of the kernel, and return the first `count` doubles of its result. Numba passes
  // the places of the result and of an exception first.
  function call(name, count, ...args) {
    const failed = kernel[name](RESULT, EXCEPTION, ...args);
    if (failed) throw new Error("the kernel found no impact");
    return [...result.subarray(0, count)];
  }

  function refuse(name, value, allowed) {
    throw new RangeError(`${name} = ${value} is not allowed: ${allowed}`);
  }

  function checkBall(k, g) {
    if (!(k > 0 && k <= 1)) refuse("k", k, "0 < k <= 1");
    if (!(g > 0 && g < Infinity)) refuse("g", g, "g > 0, finite");
  }

  function checkImpacts(impacts) {
    if (!(Number.isSafeInteger(impacts) && impacts >= 1)) {
      refuse("impacts", impacts, "a whole number, at least 1 and below 2^53");
    }
  }

  // Return a state, all NaN where one coordinate is not finite.
  function checkState(x, xdot, udot) {
    const finite = Number.isFinite(x) && Number.isFinite(xdot) && Number.isFinite(udot);
    if (finite && xdot < -udot) {
      throw new RangeError("a state just before an impact has xdot + udot >= 0, eq. (22)");
    }
    return finite ? [x, xdot, udot] : [NaN, NaN, NaN];
  }

  // What Python's `orbit` says of a flight that ends in NaN.
  const TOO_LONG = "a flight lasts 2^20/omega or longer: take a larger g or a lower energy";

  // Copy rows of the kernel to arrays, from their entry `first` on.
  function copyRows(arrays, first, count) {
    arrays.forEach((array, i) => array.set(at(ROWS + 8 * i * count, count), first));
  }

  // Advance a state by `impacts`. Entry i of each array belongs to impact i: the state just before
  // it, and the time of the flight that ends there.
  function history(k, g, x, xdot, udot, impacts) {
    checkBall(k, g);
    checkImpacts(impacts);
    let state = checkState(x, xdot, udot);
    const orbit = emptyOrbit(impacts);
    for (let done = 0; done < impacts; done += CHUNK) {
      const count = Math.min(CHUNK, impacts - done);
      state = call("history", 3, ...state, k, g, count, ROWS);
      copyRows(Object.values(orbit), done, count);
    }
    return orbit;
  }

  function emptyOrbit(impacts) {
    return Object.fromEntries(["x", "xdot", "udot", "tau"].map(name => [name, new Float64Array(impacts)]));
  }

  // Advance a state by `impacts`, and return the last state and flight time.
  function iterate(k, g, x, xdot, udot, impacts) {
    let state = [x, xdot, udot];
    for (let done = 0; done < impacts; done += CHUNK) {
      const [a, b, c] = state;
      state = call("history", 4, a, b, c, k, g, Math.min(CHUNK, impacts - done), ROWS);
    }
    return state;
  }

  // Advance many states in place, {x, xdot, udot, tau} of arrays, with the bits of `iterate`.
  function iterateMany(k, g, states, impacts) {
    const arrays = [states.x, states.xdot, states.udot, states.tau];
    for (let first = 0; first < states.x.length; first += LANES) {
      const count = Math.min(LANES, states.x.length - first);
      const rows = arrays.map((_, i) => at(LANE_ROWS + 8 * i * LANES, count));
      rows.forEach((row, i) => row.set(arrays[i].subarray(first, first + count)));
      call("history_in_lanes", 0, LANE_ROWS, ORDER, count, k, g, impacts);
      rows.forEach((row, i) => arrays[i].set(row, first));
    }
  }

  // Return orbits of {x, xdot, udot}, arrays, that `followMany` follows with a tangent vector each.
  function crowd(k, { x, xdot, udot }, centre) {
    const orbits = Object.fromEntries(CROWD.map(name => [name, new Float64Array(x.length)]));
    Object.entries({ x, xdot, udot }).forEach(([name, values]) => orbits[name].set(values));
    for (const name of ["a", "length"]) orbits[name].fill(1);
    orbits.whole.fill(Infinity);
    const round = 1 / Math.sqrt(k * (1 + k)); // the section is a disk in (x, round * y)
    for (let i = 0; i < x.length; i += 1) {
      orbits.p[i] = x[i] - centre;
      orbits.q[i] = round * (xdot[i] - k * udot[i]);
    }
    return orbits;
  }

  // Follow a crowd in place over impacts `from` to `to`; `grown` then has the sum of the logarithm of
  // the vector's length over these. Turns around (centre, 0) have the weights of `span` impacts.
  function followMany(k, g, orbits, { centre, expected, from, to, span }) {
    const arrays = CROWD.map(name => orbits[name]);
    for (let first = 0; first < orbits.x.length; first += LANES) {
      const count = Math.min(LANES, orbits.x.length - first);
      const rows = LANE_KEPT.map(i => at(LANE_ROWS + 8 * i * LANES, count));
      rows.forEach((row, i) => row.set(arrays[i].subarray(first, first + count)));
      call("follow_in_lanes", 0, LANE_ROWS, ORDER, count, k, g, centre, expected, from, to, span);
      rows.forEach((row, i) => arrays[i].set(row, first));
    }
  }

  // Return the exponents of a crowd after some impacts, with the bits of `exponent`.
  function exponents({ sum, length }, impacts) {
    return sum.map((value, i) => (value + call("elementary", 3, length[i])[2]) / impacts);
  }

  // Return the state and flight time of the next impact.
  function step(k, g, x, xdot, udot) {
    checkBall(k, g);
    return call("history", 4, ...checkState(x, xdot, udot), k, g, 1, ROWS);
  }

  // Return the image of a state under the reversor R. Backwards orbits are R history(R start).
  function reverse(k, x, xdot, udot) {
    return call("reflect", 3, ...checkState(x, xdot, udot), k, ...coefficients(k));
  }

  // Return the velocities just after an impact, eq. (25).
  function afterImpact(k, xdot, udot) { return call("rebound", 2, xdot, udot, k, ...coefficients(k)); }

  function coefficients(k) { return call("impact_coefficients", 2, k); }

  // Return the state on y = 0 at a fraction of the section's radius, from -1 to 1.
  function start(k, g, energy, fraction) {
    checkBall(k, g);
    if (!(Math.abs(fraction) <= 1)) {
      throw new RangeError("a start is a fraction of the section's radius, from -1 to 1");
    }
    const state = call("start", 3, k, g, energy, fraction);
    if (!Number.isFinite(state[0])) {
      const lowest = -g * g / (2 * k);
      refuse("energy", energy, `finite, at least ${Number(lowest.toPrecision(6))}`);
    }
    return state;
  }

  // Return the state at a point of the chart (x, y = xdot - k udot).
  function stateXY(k, g, energy, x, y) {
    checkBall(k, g);
    const state = call("chart_state", 3, k, g, energy, x, y);
    if (Number.isNaN(state[2])) {
      const reason = "the point is outside the section";
      throw new RangeError(`no state with this x, y and energy: ${reason}`);
    }
    return state;
  }

  // An orbit that continues where it ended, with its largest Lyapunov exponent so far. `advance` is
  // slower than `history`, because it carries four tangent vectors along.
  class Follower {
    constructor(k, g, x, xdot, udot) {
      checkBall(k, g);
      [x, xdot, udot] = checkState(x, xdot, udot);
      [this.k, this.g, this.impacts] = [k, g, 0];
      // What `follow` of the kernel carries: the state, a tangent vector of the energy surface, the
      // frame's three, products of their lengths, sums of logarithms, and times and further sums.
      this.orbit = new Float64Array(24);
      this.orbit.set([x, xdot, udot, 0, k * udot, -xdot, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]);
    }

    // Advance by some impacts, and return them as `history` does. `size` is the logarithm of the
    // length |.|_1 of the vector that begins as (0, k udot, -xdot), after each impact.
    advance(impacts) {
      checkImpacts(impacts);
      const orbit = { ...emptyOrbit(impacts), size: new Float64Array(impacts) };
      followed.set(this.orbit);
      for (let done = 0; done < impacts; done += CHUNK) {
        const count = Math.min(CHUNK, impacts - done);
        call("follow", 0, ORBIT, this.k, this.g, count, ROWS);
        copyRows(Object.values(orbit), done, count);
      }
      this.orbit.set(followed);
      this.impacts += impacts;
      return orbit;
    }

    // Return the exponent of the first vector over all impacts so far, in nats an impact.
    exponent() { return this.orbit[23] / this.impacts; }
  }

  // Start an orbit that `advance` continues.
  function follow(k, g, x, xdot, udot) { return new Follower(k, g, x, xdot, udot); }

  // Return the exponent that lyapunov_spectrum(..., records=1) has at index 0.
  function exponent(k, g, x, xdot, udot, impacts) {
    checkImpacts(impacts);
    const follower = follow(k, g, x, xdot, udot);
    for (let left = impacts; left > 0; left -= 10000) follower.advance(Math.min(left, 10000));
    return follower.exponent();
  }

  // Return the derivative of the iterated map in the chart (x, y), row by row: determinant 1.
  function tangent(k, g, x, xdot, udot, impacts) {
    checkBall(k, g);
    checkImpacts(impacts);
    return call("chart_tangent", 4, ...checkState(x, xdot, udot), k, g, impacts);
  }

  // Return the point that Newton steps towards P^n z = z reach from (x, y), and x and y of the last step.
  function newton(k, g, energy, x, y, period, steps) {
    return call("newton", 4, x, y, k, g, energy, period, steps);
  }

  // Return the bytes of doubles, little-endian, every NaN the same.
  function bytesOf(values) {
    const bytes = new Uint8Array(8 * values.length);
    const view = new DataView(bytes.buffer);
    for (let i = 0; i < values.length; i += 1) {
      if (Number.isNaN(values[i])) {
        view.setUint32(8 * i + 4, 0x7ff80000, true);
      } else {
        view.setFloat64(8 * i, values[i], true);
      }
    }
    return bytes;
  }

  // Constants of FIPS 180-4. crypto.subtle is absent from pages without a server in some browsers.
  const words = text => Uint32Array.from(text.trim().split(/\s+/), word => parseInt(word, 16));
  const INITIAL = words("6a09e667 bb67ae85 3c6ef372 a54ff53a 510e527f 9b05688c 1f83d9ab 5be0cd19");
  const ROUNDS = words(`
    428a2f98 71374491 b5c0fbcf e9b5dba5 3956c25b 59f111f1 923f82a4 ab1c5ed5
    d807aa98 12835b01 243185be 550c7dc3 72be5d74 80deb1fe 9bdc06a7 c19bf174
    e49b69c1 efbe4786 0fc19dc6 240ca1cc 2de92c6f 4a7484aa 5cb0a9dc 76f988da
    983e5152 a831c66d b00327c8 bf597fc7 c6e00bf3 d5a79147 06ca6351 14292967
    27b70a85 2e1b2138 4d2c6dfc 53380d13 650a7354 766a0abb 81c2c92e 92722c85
    a2bfe8a1 a81a664b c24b8b70 c76c51a3 d192e819 d6990624 f40e3585 106aa070
    19a4c116 1e376c08 2748774c 34b0bcb5 391c0cb3 4ed8aa4a 5b9cca4f 682e6ff3
    748f82ee 78a5636f 84c87814 8cc70208 90befffa a4506ceb bef9a3f7 c67178f2`);

  // Return the SHA-256 of bytes in hexadecimal.
  function sha256(bytes) {
    const padded = new Uint8Array(((bytes.length + 72) >> 6) << 6);
    padded.set(bytes);
    padded[bytes.length] = 0x80;
    const view = new DataView(padded.buffer);
    view.setUint32(padded.length - 8, Math.floor(bytes.length / 0x20000000));
    view.setUint32(padded.length - 4, (bytes.length << 3) >>> 0);
    const schedule = new Uint32Array(64), hash = INITIAL.slice();
    const turned = (a, n) => (a >>> n) | (a << (32 - n));
    for (let block = 0; block < padded.length; block += 64) {
      for (let i = 0; i < 16; i += 1) schedule[i] = view.getUint32(block + 4 * i);
      for (let i = 16; i < 64; i += 1) {
        const a = schedule[i - 15], b = schedule[i - 2];
        const low = turned(a, 7) ^ turned(a, 18) ^ (a >>> 3);
        const high = turned(b, 17) ^ turned(b, 19) ^ (b >>> 10);
        schedule[i] = schedule[i - 16] + low + schedule[i - 7] + high;
      }
      let [a, b, c, d, e, f, g, h] = hash;
      for (let i = 0; i < 64; i += 1) {
        const sum = turned(e, 6) ^ turned(e, 11) ^ turned(e, 25);
        const one = (h + sum + ((e & f) ^ (~e & g)) + ROUNDS[i] + schedule[i]) | 0;
        const other = (turned(a, 2) ^ turned(a, 13) ^ turned(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
        [h, g, f, e, d, c, b, a] = [g, f, e, (d + one) | 0, c, b, a, (one + other) | 0];
      }
      [a, b, c, d, e, f, g, h].forEach((value, i) => { hash[i] += value; });
    }
    return Array.from(hash, word => word.toString(16).padStart(8, "0")).join("");
  }

  // Compute the orbits of a figure, and compare their SHA-256 with those of the committed dataset.
  //
  // `figure` is an entry of the page's data `check`. Returns the number of impacts and the names of the
  // variables that differ.
  function checkFigure(figure) {
    const total = figure.impacts.reduce((sum, impacts) => sum + impacts, 0);
    const joined = emptyOrbit(total);
    let done = 0;
    figure.starts.forEach((fraction, i) => {
      const state = start(figure.k, figure.g, figure.energy, fraction);
      const orbit = history(figure.k, figure.g, ...state, figure.impacts[i]);
      for (const name in joined) joined[name].set(orbit[name], done);
      done += figure.impacts[i];
    });
    const { variables } = figure;
    const different = Object.keys(joined).filter((n) => sha256(bytesOf(joined[n])) !== variables[n]);
    return { impacts: total, different };
  }

  return {
    history, start, exponent, stateXY, step, iterate, iterateMany, crowd,
      followMany, exponents, reverse, afterImpact, tangent, newton, follow,
    sha256, bytesOf, checkFigure, TOO_LONG,
  };
})();
