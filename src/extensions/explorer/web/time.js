/*
 * The motion in time: a sequence of flights, eq. (26), the ball that flies, touches and flattens, and
 * the curves of Figures 3 and 4. x points downwards from where the undeformed ball touches the floor.
 */

/** The flights along the kept part of an orbit from t = 0; backwards in time for a backward orbit. */
class OrbitMotion {
  constructor(orbit) {
    this.orbit = orbit;
    this.times = [0]; // when impacts happen, counted away from the start
  }

  get count() {
    const { orbit, times } = this;
    for (let i = times.length - 1; i < orbit.kept; i++) times.push(times[i] + orbit.tau[i]);
    return orbit.kept;
  }

  get ends() {
    const last = this.times[this.count];
    return this.orbit.back ? [-last, 0] : [0, last];
  }

  /** Flight j in the order of time: when it begins, how long it lasts, and the state before. */
  flight(j) {
    const { count } = this;
    const { back } = this.orbit;
    const i = back ? count - 1 - j : j;
    const begin = back ? -this.times[i + 1] : this.times[i];
    return { begin, tau: this.orbit.tau[i], state: this.orbit.stateAt(back ? i + 1 : i) };
  }

  indexAt(t) {
    const { count } = this;
    let low = 0;
    let high = Math.max(0, count - 1);
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.flight(middle).begin <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** The number of impacts from the start to that before flight j. */
  impact(j) { return this.orbit.back ? j - this.count : j; }
}

/** The flights along a periodic orbit, whose own points are repeated without an end. */
class PeriodicMotion {
  constructor(orbit) {
    this.orbit = orbit;
    this.points = orbit.points;
    this.period = orbit.period;
    this.begins = [0];
    for (const point of this.points) this.begins.push(this.begins.at(-1) + point[3]);
    this.total = this.begins.at(-1);
  }

  get ends() { return [-Infinity, Infinity]; }
  get count() { return Infinity; }

  flight(j) {
    const turn = Math.floor(j / this.period);
    const i = j - turn * this.period;
    const [x, v, w, tau] = this.points[i];
    return { begin: turn * this.total + this.begins[i], tau, state: [x, v, w] };
  }

  indexAt(t) {
    const turn = Math.floor(t / this.total);
    const i = this.begins.findLastIndex((begin) => turn * this.total + begin <= t);
    return turn * this.period + Math.min(i, this.period - 1);
  }

  impact(j) { return j; }
}

/** Position and strain at a time after the impact at a state. */
function flown(k, g, [x, v, w], t) {
  const [b, c] = pseudorigid.afterImpact(k, v, w);
  return { x: x + t * (b + 0.5 * g * t), u: c * Math.sin(t) - x * Math.cos(t) };
}

class TimeView {
  constructor(ball, curves, read) {
    this.ball = ball;
    this.curves = curves;
    this.read = read; // returns {state, motion, twin}
    this.extent = [Infinity, -Infinity];
  }

  /** Forget the range of the curves, because another motion is shown. */
  reset() { this.extent = [Infinity, -Infinity]; }

  /** The part of time that is shown. */
  window() {
    const { state } = this.read();
    const first = Math.floor(state.time / state.span) * state.span;
    return [first, first + state.span];
  }

  draw() {
    const { state, motion } = this.read();
    const colours = readColours();
    this.drawCurves(state, motion, colours);
    this.drawBalls(colours);
  }

  /** Where a ball is: {x, u, index, state}; null without a motion. */
  now(motion = this.read().motion) {
    const { state } = this.read();
    if (!motion || !motion.count) return null;
    const index = motion.indexAt(state.time);
    const { begin, tau, state: before } = motion.flight(index);
    const t = Math.min(Math.max(0, state.time - begin), tau);
    return { ...flown(state.k, state.g, before, t), index, state: before };
  }

  drawCurves(state, motion, colours) {
    const [from, to] = this.window();
    const impacts = [];
    const curvesOf = (motion) => {
      const lines = { height: [], strain: [] };
      if (!motion?.count) return lines;
      let j = motion.indexAt(Math.max(from, motion.ends[0]));
      for (; j < motion.count; j++) {
        const { begin, tau, state: before } = motion.flight(j);
        if (begin > to) break;
        if (begin >= from && motion === this.read().motion) impacts.push([begin, -before[0]]);
        const samples = Math.max(3, Math.min(60, Math.ceil(tau * 20)));
        for (let i = 0; i <= samples; i++) {
          const t = (tau * i) / samples;
          if (begin + t < from || begin + t > to) continue;
          const { x, u } = flown(state.k, state.g, before, t);
          lines.height.push([begin + t, -x]);
          lines.strain.push([begin + t, u]);
          this.extent[0] = Math.min(this.extent[0], -x, u);
          this.extent[1] = Math.max(this.extent[1], -x, u);
        }
        if (impacts.length > 4000) break;
      }
      return lines;
    };
    const lines = curvesOf(motion);
    const other = curvesOf(this.read().twin.motion);
    if (!this.curves.offsetWidth) return; // another panel is open
    let [low, high] = this.extent;
    if (!(low < high)) [low, high] = [-0.5, 0.3];
    const room = 0.06 * (high - low);
    const plot = Plot.on(this.curves, { across: [from, to], up: [low - room, high + room], right: 10 });
    plot.axes("t", "");
    plot.line(lines.height, colours.hues[0], 1.8);
    plot.line(lines.strain, colours.hues[1], 1.8);
    plot.line(other.height, colours.hues[2], 1.2);
    for (const point of impacts) plot.dot(point, colours.ink, impacts.length > 100 ? 1.5 : 3);
    plot.key([["height −x", colours.hues[0]], ["strain u", colours.hues[1]]]);
    const now = this.now();
    if (now) {
      plot.vertical(state.time, colours.focus);
      plot.dot([state.time, -now.x], colours.hues[0], 4.5);
      plot.dot([state.time, now.u], colours.hues[1], 4.5);
    }
    this.plot = plot;
  }

  /** Draw the ball, and beside it the second one if there is one. */
  drawBalls(colours) {
    const { pen, width, height } = fitted(this.ball);
    const { motion, twin } = this.read();
    const motions = twin.motion ? [motion, twin.motion] : [motion];
    const top = Math.max(0.4, Math.min(6, this.extent[1] > 0 ? this.extent[1] : 0));
    const wide = width / motions.length;
    const scale = Math.min((height - 34) / (2.25 + top), (wide - 12) / 2.1); // pixels in R
    const floor = height - 26;
    strokePath(pen, colours.ink, 2, () => {
      pen.moveTo(4, floor);
      pen.lineTo(width - 4, floor);
    });
    pen.font = colours.font;
    motions.forEach((one, i) => this.drawBall(pen, this.now(one),
      { middle: (i + 0.5) * wide, floor, scale, colours, hue: colours.hues[2 * i] }));
  }

  drawBall(pen, now, { middle: across, floor, scale, colours, hue }) {
    const strain = now && now.u.toFixed(3).replace("-", "−");
    const text = !now ? "no orbit" : across < 50 || this.read().twin.motion ? strain : `u = ${strain}`;
    write(pen, text, across, floor + 6, colours.muted, "center");
    if (!now) return;
    const middle = floor - scale * (1 - now.x);
    const half = scale * Math.max(0.02, 1 + now.u);
    pen.save();
    const outline = (high) => pen.ellipse(across, middle, scale, high, 0, 0, 2 * Math.PI);
    strokePath(pen, hue, 2, () => outline(half));
    pen.fillStyle = hue;
    pen.globalAlpha = 0.22;
    pen.fill();
    pen.clip();
    // Lines of latitude, which come closer as the ball flattens.
    pen.globalAlpha = 0.6;
    strokePath(pen, hue, 1, () => {
      for (const share of [-0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75]) {
        pen.moveTo(across - scale, middle + half * share);
        pen.lineTo(across + scale, middle + half * share);
      }
    });
    pen.restore();
    // The undeformed ball above the floor, for comparison, and the centre.
    pen.save();
    pen.beginPath();
    pen.rect(across - scale - 2, 0, 2 * scale + 4, floor);
    pen.clip();
    pen.setLineDash([3, 4]);
    strokePath(pen, colours.muted, 1, () => outline(scale));
    pen.restore();
    pen.fillStyle = colours.ink;
    pen.fillRect(across - 2, middle - 2, 4, 4);
  }
}
