"use strict";
/*
 * The page as a whole: it holds the state, has the workers compute what the state asks for, and
 * draws it. controls.js turns what a person does into calls of these methods.
 */
const BATCH_TIME = 60; // ms that the worker computes before the page draws again

class Explorer {
  constructor(data) {
    this.data = data;
    this.state = freshState();
    this.orbits = [];
    this.periodic = new Map(); // periodic orbits by period, at the present ball and energy
    this.branchLines = [];
    this.jumpLines = [];
    this.jumpLength = null;
    this.follower = new Computer();
    this.searcher = new Computer();
    this.generation = 0;
    this.batch = 12000; // impacts of all orbits in an answer of the worker
    this.playing = false;
    this.calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.section = new SectionView(element("section"), () => this.scene());
    this.time = new TimeView(element("ball"), element("curves"), () => this);
    this.motion = null;
    this.controls = new Controls(this);
  }

  /** What the section view draws. */
  scene() {
    const marks = this.state.periods.flatMap((period) =>
      (this.periodic.get(period) ?? []).map(({ points, type }) => ({
        points,
        colour: type === "elliptic" ? "regular" : "ink",
        shape: { elliptic: "dot", hyperbolic: "cross", "inverse hyperbolic": "square" }[type],
      })),
    );
    const lines = [...this.branchLines, ...this.jumpLines];
    const now = this.time ? this.time.now() : null;
    return { state: this.state, orbits: this.orbits, overlays: { lines, marks }, cursor: now?.state };
  }

  // ---------------------------------------------------------------- states

  /** Show a state: from the address, a preset, or a change of the ball. */
  show(state) {
    this.state = state;
    this.orbits = [];
    for (const spec of state.orbits) this.orbits.push(this.newOrbit(spec));
    this.restart(false);
    this.controls.refresh();
  }

  newOrbit(spec) {
    const hue = spec.sea ? 0 : this.orbits.filter((orbit) => !orbit.sea).length;
    return new Orbit(spec, hue, () => this.state.colour);
  }

  /** Compute everything anew for the present ball and energy; fast, or so that one can watch. */
  restart(fast) {
    this.generation += 1;
    this.follower.restart();
    this.follower.ask("reset", {});
    if (this.asking) this.running = this.asking = false; // that reply will not come
    this.searcher.restart();
    this.periodic.clear();
    this.branchLines = [];
    this.jumpLines = [];
    this.jumpLength = null;
    this.controls.noteBranches("");
    for (const orbit of this.orbits) {
      orbit.clear();
      if (fast || this.calm) orbit.pace = 2000;
      this.open(orbit);
    }
    this.fresh = true; // the old picture stays until there are new impacts
    if (!this.orbits.length) this.look();
    this.chooseMotion();
    this.search();
    this.run();
    this.saveSoon();
  }

  open(orbit) {
    const { k, g, energy } = this.state;
    orbit.start = geometry.stateAt(k, g, energy, orbit.p, orbit.q);
    if (!orbit.start) return;
    const state = orbit.back ? pseudorigid.reverse(k, ...orbit.start) : orbit.start;
    this.follower.ask("open", { key: orbit.key, k, g, energy, state });
  }

  /** Draw the section and the time view anew. */
  look() {
    this.fresh = false;
    this.section.look();
    this.time.draw();
    this.drawChart();
  }

  // ---------------------------------------------------------------- orbits

  /** Start orbits at places [p, q]; the last one is shown in time. */
  startOrbits(places, impacts = this.state.impacts, back = this.state.back) {
    const room = MOST_ORBITS - this.orbits.length;
    if (room <= 0) {
      this.controls.hint(`There are ${MOST_ORBITS} orbits: remove some, or clear them.`);
      return;
    }
    for (const [p, q] of places.slice(0, room)) {
      const orbit = this.newOrbit({ p, q, impacts, back, sea: false });
      this.orbits.push(orbit);
      if (this.calm) orbit.pace = 2000;
      this.open(orbit);
    }
    this.changedOrbits();
    this.choose(this.orbits.length - 1, true);
    this.run();
  }

  changedOrbits() {
    this.state.orbits = this.orbits.map(({ p, q, impacts, back, sea }) => ({ p, q, impacts, back, sea }));
    this.controls.listOrbits();
    this.saveSoon();
  }

  remove(orbit) {
    const at = this.orbits.indexOf(orbit);
    this.orbits.splice(at, 1);
    this.follower.ask("close", { keys: [orbit.key] });
    if (this.state.chosen >= at) this.state.chosen = Math.max(this.state.chosen - 1, -1);
    if (this.state.chosen < 0 && this.orbits.length) this.state.chosen = 0;
    this.chooseMotion();
    this.changedOrbits();
    this.look();
  }

  clear() {
    this.follower.ask("close", { keys: this.orbits.map((orbit) => orbit.key) });
    this.orbits = [];
    Object.assign(this.state, { chosen: -1, motion: null, preset: "" });
    this.pause();
    this.chooseMotion();
    this.changedOrbits();
    this.controls.refresh();
    this.look();
  }

  /** Follow an orbit over as many impacts again. */
  extend(orbit) {
    orbit.impacts = Math.min(MOST_IMPACTS, 2 * orbit.impacts);
    this.changedOrbits();
    this.run();
  }

  /** Ask for impacts of all orbits that are not complete, frame by frame. */
  run() {
    if (this.running) return;
    this.running = true;
    requestAnimationFrame(() => this.ask());
  }

  async ask() {
    const waiting = this.orbits.filter((orbit) => !orbit.done);
    if (!waiting.length) {
      this.running = false;
      return;
    }
    const { generation } = this;
    const most = Math.max(60, Math.floor(this.batch / waiting.length));
    const wanted = waiting.map((orbit) => {
      const count = Math.min(Math.round(orbit.pace), most, orbit.impacts - orbit.count);
      orbit.pace = Math.min(1.18 * orbit.pace + 1, most);
      return [orbit.key, count];
    });
    this.asking = true;
    const begin = performance.now();
    const pieces = await this.follower.ask("advance", { orbits: wanted });
    const slow = performance.now() - begin > BATCH_TIME;
    this.batch = Math.min(Math.max((slow ? 0.7 : 1.2) * this.batch, 2000), MOST_IMPACTS);
    this.asking = false;
    this.reply(generation, pieces);
  }

  reply(generation, pieces) {
    this.running = false;
    if (generation !== this.generation) {
      this.run();
      return;
    }
    let whole = this.fresh;
    for (const piece of pieces) {
      const orbit = this.orbits.find(({ key }) => key === piece.key);
      if (!orbit) continue;
      const from = orbit.count;
      const before = [orbit.isSea(), orbit.facts?.verdict];
      orbit.append(piece, this.state.k);
      const after = [orbit.isSea(), orbit.facts?.verdict];
      if (String(before) !== String(after)) whole ||= from > 0;
      if (!whole) this.section.plot(orbit, from);
    }
    if (whole) this.look();
    else this.section.showPoints();
    this.controls.updateFacts();
    if (!this.orbits.some((orbit) => !orbit.done)) this.controls.completed();
    this.drawChartSoon();
    if (!this.playing) {
      this.time.draw();
      this.controls.moment();
    }
    this.section.drawCursors();
    this.run();
  }

  // ---------------------------------------------------------------- what takes longer

  /** Have periodic orbits, branches and the jump curve computed that the state asks for. */
  async search() {
    const { generation } = this;
    const { k, g, energy } = this.state;
    const specs = this.state.branches;
    const periods = new Set([...this.state.periods, ...specs.map((spec) => spec.period)]);
    if (this.state.motion) periods.add(this.state.motion.period);
    try {
      for (const period of [...periods].sort((a, b) => a - b)) {
        if (this.periodic.has(period)) continue;
        this.controls.notePeriodic(`Searching for orbits of period ${period} …`);
        const found = await this.searcher.ask("periodic", { k, g, energy, period });
        if (generation !== this.generation) return;
        this.periodic.set(period, found);
        if (this.state.motion?.period === period) this.chooseMotion();
        this.section.drawLines();
      }
      this.controls.listPeriodic();
      await this.traceBranches(generation);
      if (this.state.jump && generation === this.generation && !this.jumpLines.length) {
        const curve = await this.searcher.ask("jump", { k, g, energy });
        if (generation === this.generation && this.state.jump) this.showJump(curve);
      }
    } catch (error) {
      if (generation === this.generation) this.controls.noteBranches(error.message);
    }
  }

  async traceBranches(generation) {
    const { k, g, energy, view } = this.state;
    const specs = this.state.branches;
    if (!specs.length) return;
    const round = (this.tracing = (this.tracing ?? 0) + 1);
    this.window = null;
    if (view.kind === "disk" && view.half < 0.5) {
      const { x, y } = geometry.pointAt(k, g, energy, view.x, view.y);
      this.window = { x, y, half: 1.5 * view.half };
    }
    const lines = [];
    const ended = [];
    for (const spec of specs) {
      const orbit = this.periodicOrbit(spec);
      if (!orbit || orbit.type === "elliptic") {
        this.controls.noteBranches(`There is no ${spec.type} orbit of period ${spec.period} here.`);
        continue;
      }
      const saddles = spec.saddle < 0 ? orbit.points.keys() : [spec.saddle % spec.period];
      const sides = spec.side === "both" ? ["inner", "outer"] : [spec.side];
      const kinds = spec.kind === "both" ? [true, false] : [spec.kind === "stable"];
      for (const saddle of saddles) {
        for (const side of sides) {
          for (const stable of kinds) {
            const details = { saddle, side, stable, length: spec.length, window: this.window };
            this.controls.noteBranches(`Tracing branches: ${lines.length} done …`);
            const line = await this.searcher.ask("branch", { k, g, energy, points: orbit.points, spec: details });
            if (generation !== this.generation || round !== this.tracing) return;
            if (line.ended !== null) ended.push(line.ended);
            lines.push({ line, colour: stable ? "stable" : "unstable", width: 1.3 });
            if (lines.length > this.branchLines.length) this.branchLines = [...lines];
            this.section.drawLines();
          }
        }
      }
    }
    this.branchLines = lines;
    this.section.drawLines();
    if (!lines.length) return;
    const points = lines.reduce((sum, { line }) => sum + line.x.length, 0);
    const early = ended.length ? ` Rounding errors end ${ended.length} of them early.` : "";
    this.controls.noteBranches(`${lines.length} branches of ${COUNT.format(points)} points.${early}`);
  }

  periodicOrbit({ period, type, nth }) {
    return (this.periodic.get(period) ?? []).filter((orbit) => orbit.type === type)[nth];
  }

  showJump(curve) {
    const { k, g, energy } = this.state;
    const lift = (sign) => {
      const rows = Array.from(curve.x, (x, i) => {
        const state = Number.isNaN(x) ? null : geometry.chartState(k, g, energy, x, sign * curve.y[i]);
        return state ?? [NaN, NaN, NaN];
      });
      const [x, xdot, udot] = [0, 1, 2].map((i) => rows.map((row) => row[i]));
      return { x, xdot, udot };
    };
    this.jumpLength = curve.length;
    this.jumpLines = [
      { line: lift(1), colour: "symmetry", width: 2 },
      { line: lift(-1), colour: "jump", width: 2.5 },
    ];
    this.controls.noteJump();
    this.section.drawLines();
  }

  setJump(on) {
    this.state.jump = on;
    this.jumpLines = [];
    this.jumpLength = null;
    this.controls.noteJump();
    this.section.drawLines();
    this.search();
    this.saveSoon();
  }

  /** Trace branches anew, finer, where the view has magnified them. */
  viewChanged() {
    clearTimeout(this.finer);
    this.finer = setTimeout(() => {
      const { view } = this.state;
      const { window } = this;
      if (!this.state.branches.length || view.kind !== "disk") return;
      if (view.half > 0.5 && !window) return;
      if (window && 1.5 * view.half > 0.6 * window.half && view.half < window.half) {
        const { x, y } = geometry.pointAt(this.state.k, this.state.g, this.state.energy, view.x, view.y);
        const { radius } = this.section;
        if (Math.hypot(x - window.x, y - window.y) < 0.3 * window.half * radius) return;
      }
      this.searcher.restart();
      this.search();
    }, 500);
    this.saveSoon();
  }

  // ---------------------------------------------------------------- the ball in time

  choose(index, play = false) {
    Object.assign(this.state, { chosen: index, motion: null, time: 0 });
    this.chooseMotion();
    this.controls.markChosen();
    if (play && !this.calm) this.play();
    this.saveSoon();
  }

  chooseMotion() {
    const { state } = this;
    const periodic = state.motion && this.periodicOrbit(state.motion);
    const orbit = this.orbits[state.chosen];
    if (periodic) this.motion = new PeriodicMotion(periodic);
    else this.motion = !state.motion && orbit?.start ? new OrbitMotion(orbit) : null;
    this.time.reset();
    this.time.draw();
    this.section.drawCursors();
    this.controls.moment();
    this.controls.markChosen();
  }

  showPeriodic(period, type, nth) {
    Object.assign(this.state, { motion: { period, type, nth }, time: 0, chosen: -1 });
    this.chooseMotion();
    this.saveSoon();
  }

  setTime(time) {
    const [first, last] = this.motion?.ends ?? [0, 0];
    this.state.time = Math.min(Math.max(time, first), last);
    this.time.draw();
    this.section.drawCursors();
    this.controls.moment();
    this.drawChartSoon();
    this.saveSoon();
  }

  play() {
    if (!this.motion) return;
    const [first, last] = this.motion.ends;
    if (this.state.time >= last && this.motion.count) this.state.time = first;
    this.playing = true;
    this.controls.showPlaying();
    let before = null;
    const frame = (now) => {
      if (!this.playing) return;
      const seconds = before === null ? 0 : Math.min(0.1, (now - before) / 1000);
      before = now;
      const end = this.motion?.ends[1] ?? 0;
      const next = this.state.time + seconds * this.controls.speed();
      const running = this.orbits[this.state.chosen] && !this.orbits[this.state.chosen].done;
      this.setTime(next);
      if (next > end && !running) this.pause();
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  pause() {
    this.playing = false;
    this.controls.showPlaying();
  }

  stepImpact(step) {
    this.pause();
    if (!this.motion?.count) return;
    const index = this.motion.indexAt(this.state.time);
    const { begin, tau } = this.motion.flight(index);
    if (step > 0) this.setTime(begin + tau);
    else if (this.state.time > begin + 1e-9) this.setTime(begin);
    else if (index > 0 || this.motion.count === Infinity) this.setTime(this.motion.flight(index - 1).begin);
  }

  // ---------------------------------------------------------------- charts and the address

  drawChart() {
    if (this.state.chart === "rotation") {
      drawRotations(element("chart"), this.orbits);
      return;
    }
    const { motion, state } = this;
    const shown = !state.motion && motion?.count ? motion.indexAt(state.time) : -1;
    drawExponents(element("chart"), this.orbits, shown);
  }

  drawChartSoon() {
    if (this.chartWaits) return;
    this.chartWaits = setTimeout(() => {
      this.chartWaits = null;
      this.drawChart();
    }, 120);
  }

  saveSoon() {
    if (this.saveWaits) return;
    this.saveWaits = setTimeout(() => {
      this.saveWaits = null;
      const address = writeAddress(this.state);
      if (address !== window.location.hash) window.history.replaceState(null, "", address);
    }, 400);
  }
}

function element(id) {
  return document.getElementById(id);
}

/** Begin with the address, or with Figure 2. */
function begin() {
  if (!globalThis.pseudorigid) {
    const needed = "This page needs WebAssembly with SIMD, which browsers have had since 2023.";
    document.body.textContent = `${needed} This browser does not have it, or forbids it.`;
    return;
  }
  const data = JSON.parse(element("data").textContent);
  const explorer = new Explorer(data);
  const load = () => {
    const address = window.location.hash;
    if (address.length > 1 && address === writeAddress(explorer.state)) return;
    try {
      const name = decodeURIComponent(address.slice(1)) || "fig2"; // a scene's name is an address too
      const known = Object.hasOwn(data.scenes, name);
      explorer.show(known ? presetState(name, data.scenes) : readAddress(address));
      explorer.controls.welcome();
    } catch (error) {
      if (!explorer.orbits.length) explorer.show(presetState("fig2", data.scenes));
      explorer.controls.hint(error instanceof URIError ? "The address cannot be read." : `${error.message}.`);
    }
  };
  window.addEventListener("hashchange", load);
  load();
}

begin();
