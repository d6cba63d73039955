// The interface `pseudorigid` of the page and of its worker: loops over the translated kernel.
//
// Lengths are in R, times in 1/omega, energies in m omega^2 R^2. A state (x, xdot, udot) is taken
// just before an impact. Where a coordinate is not finite, all results are NaN, as in Python. Bad
// arguments throw a RangeError whose message is one line for the user.
globalThis.pseudorigid = (() => {
  "use strict";
  const out = kernel.$out;

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

  // Return the coefficients of the impact law, as the kernel wants them.
  function coefficientsOf(k) {
    kernel.impact_coefficients(k);
    return [out[0], out[1]];
  }

  // Return the state, all NaN where one coordinate is not finite.
  function checkedState(x, xdot, udot) {
    if (!(Number.isFinite(x) && Number.isFinite(xdot) && Number.isFinite(udot))) {
      return [NaN, NaN, NaN];
    }
    if (xdot < -udot) {
      throw new RangeError("a state just before an impact has xdot + udot >= 0, eq. (22)");
    }
    return [x, xdot, udot];
  }

  // Advance a state by `impacts`. Entry i of each array belongs to impact i: the state just before
  // it, and the time of the flight that ends there.
  function history(k, g, x, xdot, udot, impacts) {
    checkBall(k, g);
    checkImpacts(impacts);
    [x, xdot, udot] = checkedState(x, xdot, udot);
    const [high, low] = coefficientsOf(k);
    const orbit = emptyOrbit(impacts);
    const { x: xs, xdot: xdots, udot: udots, tau: taus } = orbit;
    for (let i = 0; i < impacts; i += 1) {
      kernel.step(x, xdot, udot, k, g, high, low);
      x = out[0];
      xdot = out[1];
      udot = out[2];
      xs[i] = x;
      xdots[i] = xdot;
      udots[i] = udot;
      taus[i] = out[3];
    }
    return orbit;
  }

  function emptyOrbit(impacts) {
    const names = ["x", "xdot", "udot", "tau"];
    return Object.fromEntries(names.map(name => [name, new Float64Array(impacts)]));
  }

  // Advance a state by `impacts`, and write the last state and flight time to `result` (4).
  function iterate(k, g, x, xdot, udot, impacts, result) {
    if (k !== lastK) [lastK, lastCoefficients] = [k, coefficientsOf(k)];
    const high = lastCoefficients[0], low = lastCoefficients[1];
    for (let i = 0; i < impacts; i += 1) {
      kernel.step(x, xdot, udot, k, g, high, low);
      x = out[0];
      xdot = out[1];
      udot = out[2];
    }
    result[0] = x;
    result[1] = xdot;
    result[2] = udot;
    result[3] = out[3];
  }
  let lastK = NaN, lastCoefficients = [];

  // Return the state and flight time of the next impact.
  function step(k, g, x, xdot, udot) {
    checkBall(k, g);
    const [high, low] = coefficientsOf(k);
    kernel.step(...checkedState(x, xdot, udot), k, g, high, low);
    return [out[0], out[1], out[2], out[3]];
  }

  // Return the image of a state under the reversor R. Backwards orbits are R history(R start).
  function reverse(k, x, xdot, udot) {
    const [high, low] = coefficientsOf(k);
    kernel.reflect(...checkedState(x, xdot, udot), k, high, low);
    return [out[0], out[1], out[2]];
  }

  function checkEnergy(k, g, energy) {
    const square = kernel.radius_squared(k, g, energy);
    if (!(square >= 0 && square < Infinity)) {
      const lowest = -g * g / (2 * k);
      refuse("energy", energy, `finite, at least ${Number(lowest.toPrecision(6))}`);
    }
  }

  // Return the state on y = 0 at a fraction of the section's radius, from -1 to 1.
  function start(k, g, energy, fraction) {
    checkBall(k, g);
    checkEnergy(k, g, energy);
    if (!(Math.abs(fraction) <= 1)) {
      throw new RangeError("a start is a fraction of the section's radius, from -1 to 1");
    }
    kernel.start(k, g, energy, fraction);
    return [out[0], out[1], out[2]];
  }

  // Return the state at a point of the chart (x, y = xdot - k udot).
  function stateXY(k, g, energy, x, y) {
    checkBall(k, g);
    if (!(kernel.contact_speed_squared(k, g, energy, x, y) >= 0)) {
      const reason = "the point is outside the section";
      throw new RangeError(`no state with this x, y and energy: ${reason}`);
    }
    kernel.chart_state(k, g, energy, x, y);
    return [out[0], out[1], out[2]];
  }

  // An orbit that goes on where it ended, with its largest Lyapunov exponent so far. `advance` is
  // slower than `history`, because it carries four tangent vectors along.
  class Follower {
    constructor(k, g, x, xdot, udot) {
      checkBall(k, g);
      [this.k, this.g] = [k, g];
      this.coefficients = coefficientsOf(k);
      this.impacts = 0;
      this.state = checkedState(x, xdot, udot);
      // Three tangent vectors, products of their lengths, sums of logarithms.
      this.frame = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0);
      // A tangent vector of the energy surface, and the logarithm by which it was divided.
      this.vector = [0, k * this.state[2], -this.state[1]];
      this.grown = 0;
    }

    // Advance by some impacts, and return them as `history` does. `size` is the logarithm of the
    // length |.|_1 of the vector that begins as (0, k udot, -xdot), after each impact.
    advance(impacts) {
      checkImpacts(impacts);
      const { k, g, frame: f } = this;
      const [high, low] = this.coefficients;
      const orbit = emptyOrbit(impacts), size = new Float64Array(impacts);
      let [x, xdot, udot] = this.state, [dx, dv, dw] = this.vector;
      for (let i = 0; i < impacts; i += 1) {
        kernel.step_with_flight(x, xdot, udot, k, g, high, low);
        x = out[0];
        xdot = out[1];
        udot = out[2];
        orbit.x[i] = x;
        orbit.xdot[i] = xdot;
        orbit.udot[i] = udot;
        orbit.tau[i] = out[3];
        const sine = out[4], cosine = out[5], tauX = out[6], tauS = out[7], tauC = out[8];
        kernel.tangent(dx, dv, dw, k, g, high, low, x, udot, sine, cosine, tauX, tauS, tauC);
        dx = out[0];
        dv = out[1];
        dw = out[2];
        const length = Math.abs(dx) + Math.abs(dv) + Math.abs(dw);
        size[i] = this.grown + Math.log(length);
        if (!(length > 1e-50 && length < 1e50)) {
          this.grown += Math.log(length);
          dx /= length;
          dv /= length;
          dw /= length;
        }
        kernel.push_frame(
          f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8], f[9], f[10], f[11], f[12], f[13],
          f[14], k, g, high, low, x, udot, sine, cosine, tauX, tauS, tauC,
        );
        for (let j = 0; j < 15; j += 1) f[j] = out[j];
      }
      this.state = [x, xdot, udot];
      this.vector = [dx, dv, dw];
      this.impacts += impacts;
      return { ...orbit, size };
    }

    // Return the exponent of the first vector over all impacts so far, in nats an impact.
    exponent() {
      kernel.with_logarithms(...this.frame.subarray(12), ...this.frame.subarray(9, 12));
      return out[0] / this.impacts;
    }
  }

  // Start an orbit that `advance` continues.
  function follow(k, g, x, xdot, udot) {
    return new Follower(k, g, x, xdot, udot);
  }

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
    [x, xdot, udot] = checkedState(x, xdot, udot);
    const [high, low] = coefficientsOf(k);
    // Derivatives of s = xdot + udot at fixed energy, and of the state, by x and by y.
    const s = xdot + udot, y = xdot - k * udot;
    const slopes = [(1 + k) * (g - k * x) / (k * s), -y / (k * s)];
    const columns = [0, 1].map(unit => [
      1 - unit, (k * slopes[unit] + unit) / (1 + k), (slopes[unit] - unit) / (1 + k),
    ]);
    for (let i = 0; i < impacts; i += 1) {
      kernel.step_with_flight(x, xdot, udot, k, g, high, low);
      [x, xdot, udot] = out;
      const flight = out.slice(4, 9);
      for (const column of columns) {
        kernel.tangent(...column, k, g, high, low, x, udot, ...flight);
        column.splice(0, 3, out[0], out[1], out[2]);
      }
    }
    const [one, other] = columns;
    return [one[0], other[0], one[1] - k * one[2], other[1] - k * other[2]];
  }

  // Return the bytes of doubles, little-endian, every NaN the same.
  function bytesOf(doubles) {
    const bytes = new Uint8Array(8 * doubles.length);
    const view = new DataView(bytes.buffer);
    for (let i = 0; i < doubles.length; i += 1) {
      if (Number.isNaN(doubles[i])) {
        view.setUint32(8 * i + 4, 0x7ff80000, true);
      } else {
        view.setFloat64(8 * i, doubles[i], true);
      }
    }
    return bytes;
  }

  // FIPS 180-4. crypto.subtle is absent from pages without a server in some browsers.
  const rounds = (() => {
    const constants = [], roots = [];
    for (let n = 2; constants.length < 64; n += 1) {
      let prime = true;
      for (let d = 2; d * d <= n; d += 1) if (n % d === 0) prime = false;
      if (prime) {
        constants.push(fraction(n, 3n));
        if (roots.length < 8) roots.push(fraction(n, 2n));
      }
    }
    return { constants: Uint32Array.from(constants), initial: Uint32Array.from(roots) };

    // Return the first 32 bits of the fraction of a root of n, by bisection on whole numbers.
    function fraction(n, degree) {
      const target = BigInt(n) << (32n * degree);
      let low = 0n, high = 1n << 40n;
      while (high - low > 1n) {
        const middle = (low + high) >> 1n;
        if (middle ** degree <= target) low = middle; else high = middle;
      }
      return Number(low & 0xffffffffn);
    }
  })();

  // Return the SHA-256 of bytes in hexadecimal.
  function sha256(bytes) {
    const padded = new Uint8Array(((bytes.length + 72) >> 6) << 6);
    padded.set(bytes);
    padded[bytes.length] = 0x80;
    const view = new DataView(padded.buffer);
    view.setUint32(padded.length - 8, Math.floor(bytes.length / 0x20000000));
    view.setUint32(padded.length - 4, (bytes.length << 3) >>> 0);
    const words = new Uint32Array(64), hash = rounds.initial.slice();
    const turned = (a, n) => (a >>> n) | (a << (32 - n));
    for (let block = 0; block < padded.length; block += 64) {
      for (let i = 0; i < 16; i += 1) words[i] = view.getUint32(block + 4 * i);
      for (let i = 16; i < 64; i += 1) {
        const a = words[i - 15], b = words[i - 2];
        const low = turned(a, 7) ^ turned(a, 18) ^ (a >>> 3);
        const high = turned(b, 17) ^ turned(b, 19) ^ (b >>> 10);
        words[i] = words[i - 16] + low + words[i - 7] + high;
      }
      let [a, b, c, d, e, f, g, h] = hash;
      for (let i = 0; i < 64; i += 1) {
        const sum = turned(e, 6) ^ turned(e, 11) ^ turned(e, 25);
        const one = (h + sum + ((e & f) ^ (~e & g)) + rounds.constants[i] + words[i]) | 0;
        const other = (turned(a, 2) ^ turned(a, 13) ^ turned(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
        [h, g, f, e, d, c, b, a] = [g, f, e, (d + one) | 0, c, b, a, (one + other) | 0];
      }
      [a, b, c, d, e, f, g, h].forEach((value, i) => { hash[i] += value; });
    }
    return Array.from(hash, word => word.toString(16).padStart(8, "0")).join("");
  }

  // Compute the orbits of a figure, and compare their SHA-256 with those of the committed dataset.
  //
  // `figure` is an entry of the page's data `check`. Returns the number of impacts and the first
  // difference, null if there is none: its variable, orbit and impact, both counted from 1, of the
  // first value of the first block of values that differs.
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
    let first = total, variable = null;
    for (const name in joined) {
      const bytes = bytesOf(joined[name]), expected = figure.variables[name];
      if (sha256(bytes) === expected.sha256) continue;
      const blocks = expected.blocks.split(" ");
      const size = 8 * figure.block;
      let at = blocks.findIndex((hash, i) => {
        return !sha256(bytes.subarray(i * size, (i + 1) * size)).startsWith(hash);
      });
      at = Math.max(at, 0) * figure.block;
      if (variable === null || at < first) [first, variable] = [at, name];
    }
    if (variable === null) return { impacts: total, difference: null };
    let orbit = 0;
    while (first >= figure.impacts[orbit]) {
      first -= figure.impacts[orbit];
      orbit += 1;
    }
    return { impacts: total, difference: { variable, orbit: orbit + 1, impact: first + 1 } };
  }

  return {
    history, start, exponent, stateXY, step, iterate, reverse, tangent, follow, sha256, bytesOf, checkFigure,
  };
})();
