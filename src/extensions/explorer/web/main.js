/*
 * The page as a whole: it holds the state, has the workers compute what the state asks for, and
 * draws it. controls.js turns what a person does into calls of these methods.
 */
const BATCH_TIME = 60; // ms that the worker computes before the page draws again
const HUES = 7; // of the style sheet
const SWEEP = 240; // energies from the least to the largest
const FRAME = 40; // ms that each of them is shown at least
const GROWTH_STEP = 0.02; // of a branch in a frame
const SLOW = 200; // impacts asked for at once, up to which one can watch

class Explorer {
  constructor(data) {
    this.data = data;
    this.state = freshState();
    this.orbits = [];
    this.periodic = new Map(); // periodic orbits by period, at the present ball and energy
    this.found = new Map(); // and those near places, by `writeNear`
    this.forgetLines();
    this.follower = new Computer();
    this.searcher = new Computer();
    this.pool = new Pool();
    this.colouring = new Colouring(this);
    this.filling = new Filling(this);
    this.families = new Families(this);
    this.generation = 0;
    this.round = 0; // of `run`, which a change of the ball ends
    this.at = window.history.state?.at ?? 0; // the place in the browser's history
    this.playing = false;
    this.calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.section = new SectionView(element("section"), () => this.scene());
    this.time = new TimeView(element("ball"), element("curves"), () => this);
    this.motion = null;
    this.twin = new Twin(this);
    this.controls = new Controls(this);
  }

  /** What the section view draws. */
  scene() {
    const marks = this.shownPeriodic().map(({ orbit, one }) => ({
      orbit,
      one,
      colour: orbit.type === "elliptic" ? "elliptic" : "hyperbolic",
      shape: { elliptic: "dot", hyperbolic: "cross", "inverse hyperbolic": "square" }[orbit.type],
    }));
    const lines = [...this.branchLines, ...this.jumpLines];
    const asks = this.state.lesson && !this.state.revealed; // which start is which
    const starts = this.orbits.flatMap(({ start }, i) => (asks && start ? [[String(i + 1), start]] : []));
    const motions = this.twin ? [this.motion, this.twin.motion] : [];
    const cursors = motions.map((one) => one && this.time.now(one)?.state).filter(Boolean);
    const map = this.colouring.window ? this.colouring : null;
    const filling = this.filling.orbits;
    return {
      state: this.state, orbits: this.orbits, filling, map,
        scale: this.scale(), overlays: { lines, marks, starts }, cursors,
    };
  }

  /** The periodic orbits on the section, each with what names it in the state. */
  shownPeriodic() {
    const near = this.state.near.map((spec, nth) =>
      ({ orbit: this.found.get(writeNear(spec)), one: { period: 0, type: "near", nth } }));
    const symmetric = this.state.periods.flatMap((period) => {
      const seen = {};
      return (this.periodic.get(period) ?? []).map((orbit) => {
        const nth = (seen[orbit.type] = (seen[orbit.type] ?? -1) + 1);
        return { orbit, one: { period, type: orbit.type, nth } };
      });
    });
    return [...near, ...symmetric].filter(({ orbit }) => orbit);
  }

  /** What colours mean: {name, range}, or {notes} for verdicts; null if there is nothing to say. */
  scale() {
    const names = { rotation: "rotation number", exponent: "exponent" };
    const { window, by, range } = this.colouring;
    if (window && by === "verdict") return { notes: shortFormNotes(this.state) };
    if (window) return { name: `${names[by]}, 200 impacts`, range };
    const { colour } = this.state;
    if (!["rotation", "exponent"].includes(colour)) return null;
    const found = this.range();
    return Number.isFinite(found[0])
      ? { name: colour === "exponent" ? "exponent so far" : names[colour], range: found } : null;
  }

  /** The range of what colours the orbits, the rotation number or the exponent. */
  range() {
    const values = [...this.orbits, ...this.filling.orbits].map((orbit) => orbit.facts?.[this.state.colour]);
    const [low, high] = [Math.min, Math.max].map((end) => end(...values.filter(Number.isFinite)));
    return low < high ? [low, high] : [low, low + 1e-9];
  }

  /** Show a state: from the address, or a preset. Orbits that were on the page before stay. */
  show(state) {
    const same = ["k", "g", "energy"].every((name) => state[name] === this.state[name]);
    const before = new Map(same ? this.orbits.map((orbit) => [writeOrbit(orbit), orbit]) : []);
    this.state = state;
    this.orbits = state.orbits.map((spec) => {
      const kept = before.get(writeOrbit(spec));
      before.delete(writeOrbit(spec));
      return kept ?? new Orbit(spec, this);
    });
    if (same) {
      this.follower.ask("close", { keys: [...before.values()].map(({ key }) => key) });
      for (const orbit of this.orbits) if (!orbit.start) this.open(orbit);
      this.lookAgain();
    } else this.restart(false);
    this.controls.refresh();
  }

  /** Draw everything anew, and search for what the state asks for, at the same ball and energy. */
  lookAgain() {
    this.searcher.restart();
    this.tracing = (this.tracing ?? 0) + 1;
    this.forgetLines();
    assignHues(this.orbits, HUES);
    this.chooseMotion();
    this.look();
    this.search();
    this.run();
    this.saveSoon();
  }

  forgetLines() {
    Object.assign(this, { branchLines: [], jumpLines: [], jumpLength: null });
    setText("branch-note", "");
  }

  /** Compute everything anew for the present ball and energy; fast, or so that one can watch. */
  restart(fast) {
    this.generation += 1;
    this.follower.ask("reset", {});
    this.round += 1; // what was asked for is not drawn
    this.searcher.restart();
    this.periodic.clear();
    this.found.clear();
    this.forgetLines();
    for (const orbit of this.orbits) {
      orbit.clear();
      this.open(orbit);
      if (fast) orbit.pace = 2000;
    }
    this.fresh = true; // the old picture stays until there are new impacts
    this.section.project();
    this.colouring.update();
    if (!this.orbits.length) this.section.drawGround();
    this.section.drawLines();
    this.filling.update();
    this.chooseMotion(); // which draws the impacts, and the section in colour follows
    clearTimeout(this.searchWaits); // a drag ends before periodic orbits are searched for
    this.searchWaits = setTimeout(() => this.search(), fast ? 150 : 0);
    this.run();
    this.saveSoon();
  }

  open(orbit) {
    const { k, g, energy } = this.state;
    orbit.start = geometry.stateAt(k, g, energy, orbit);
    if (this.calm) orbit.pace = 2000;
    if (!orbit.start) return;
    const state = orbit.back ? pseudorigid.reverse(k, ...orbit.start) : orbit.start;
    this.follower.ask("open", { key: orbit.key, k, g, energy, state });
  }

  /** Draw the section and the time view anew. */
  look() {
    this.fresh = false;
    this.colouring.update();
    this.section.look();
    this.filling.update();
    this.replaySoon();
    this.time.draw();
    this.drawChart();
  }

  /** Draw the impacts that are not kept again, once the picture has been drawn anew. */
  replaySoon() {
    clearTimeout(this.replayWaits);
    this.replays = (this.replays ?? 0) + 1;
    this.replayWaits = setTimeout(() => this.replay(), 150);
  }

  /** Draw the impacts that are not kept, on the page or in a picture for a file. */
  async replay(section = this.section) {
    const { replays } = this;
    for (const orbit of this.orbits) {
      await this.eachPiece(orbit, orbit.kept, (piece) => {
        section.plot(orbit, piece, 0, piece.x.length);
        section.showPoints();
      }, () => section !== this.section || replays === this.replays);
    }
  }

  /** Call `act` with pieces of an orbit's impacts, from one on; later ones are computed again. */
  async eachPiece(orbit, from, act, wanted = () => true) {
    const { k, g } = this.state;
    const end = orbit.count;
    const kept = (name) => [name, orbit[name].subarray(from, orbit.kept)];
    if (from < orbit.kept) act(Object.fromEntries(["x", "xdot", "udot", "tau"].map(kept)), from);
    let state = orbit.last;
    for (let done = orbit.kept; done < end; ) {
      const impacts = Math.min(100000, end - done);
      const piece = await this.pool.ask("replay", { k, g, state, impacts }, wanted);
      if (!piece) return;
      state = ["x", "xdot", "udot"].map((name) => piece[name].at(-1));
      orbit.mirror(piece);
      act(piece, done);
      done += impacts;
    }
  }

  /** Start orbits at places [p, q], or at one point `xy`; the last one is shown in time. */
  startOrbits(places, xy = null) {
    const room = MOST_ORBITS - this.orbits.length;
    if (room <= 0) {
      this.controls.hint(`There are ${MOST_ORBITS} orbits: remove some, or clear them.`);
      return;
    }
    this.mark();
    const { impacts, back } = this.state;
    for (const [p, q] of places.slice(0, room)) {
      const orbit = new Orbit({ p, q, xy, impacts, back, sea: false }, this);
      this.orbits.push(orbit);
      this.open(orbit);
    }
    this.changedOrbits();
    this.choose(this.orbits.length - 1, true);
    this.run();
  }

  /** Take over the orbits into the state, which shows no preset any more. */
  ownOrbits() {
    this.state.preset = "";
    const kept = ({ p, q, xy, impacts, back, sea }) => ({ p, q, xy, impacts, back, sea });
    this.state.orbits = this.orbits.map(kept);
    this.controls.words();
    this.saveSoon();
  }

  changedOrbits() {
    this.ownOrbits();
    this.controls.orbits.list();
  }

  remove(orbit) {
    this.mark();
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
    this.mark();
    this.follower.ask("close", { keys: this.orbits.map((orbit) => orbit.key) });
    this.orbits = [];
    Object.assign(this.state, { chosen: -1, motion: null });
    this.pause();
    this.chooseMotion();
    this.changedOrbits();
    this.controls.refresh();
    this.look();
  }

  /** Follow an orbit over as many impacts again. */
  extend(orbit) {
    this.mark();
    orbit.impacts = Math.max(orbit.impacts, Math.min(MOST_IMPACTS, 2 * orbit.impacts));
    this.changedOrbits();
    this.run();
  }

  /** Follow the chosen orbit on until this is called again; the address has its impacts so far. */
  runOn() {
    const running = this.orbits.filter((orbit) => orbit.endless);
    for (const orbit of running) Object.assign(orbit, { endless: false, impacts: orbit.count });
    const orbit = this.orbits[this.state.chosen];
    if (!running.length) {
      if (!orbit) this.controls.hint("Choose an orbit first.");
      if (!orbit || orbit.refused || orbit.count >= MOST_FOLLOWED) return;
      this.mark();
      orbit.endless = true;
      this.controls.hint("The orbit continues until you stop it.");
    } else this.controls.welcome();
    this.changedOrbits();
    this.run();
  }

  /** Have the worker follow all orbits that are not complete, while the page draws what it has. */
  async run() {
    if (this.running === this.round) return;
    const { round } = this;
    this.running = round;
    await nextFrame();
    await this.asking; // of the round before
    let pieces = round === this.round && (await this.ask());
    while (pieces && round === this.round) {
      const added = this.append(pieces);
      const asked = this.ask();
      this.draw(added);
      await nextFrame();
      pieces = round === this.round && (await asked);
    }
    if (this.running === round) this.running = null;
    if (round === this.round && this.orbits.some((orbit) => orbit.waits)) this.run(); // begun since
  }

  /** Ask for further impacts; null if no orbit needs them. */
  ask() {
    const waiting = this.orbits.filter((orbit) => orbit.waits);
    if (!waiting.length) return null;
    const orbits = waiting.map((orbit) => {
      const end = orbit.endless ? MOST_FOLLOWED : orbit.impacts;
      const most = Math.max(0, Math.min(Math.round(orbit.pace), end - orbit.count));
      orbit.pace = Math.min((orbit.pace < SLOW ? 1.18 : 2) * orbit.pace + 1, MOST_IMPACTS);
      return [orbit.key, most];
    });
    this.asking = this.follower.ask("advance", { orbits, time: BATCH_TIME });
    return this.asking;
  }

  /** Add impacts to the orbits; returns [orbit, its new impacts] and whether colours changed. */
  append(pieces) {
    const plots = [];
    let recoloured = false;
    const ranges = ["rotation", "exponent"].includes(this.state.colour); // which change with each orbit
    const look = (orbit) =>
      String([orbit.isSea(), orbit.settled, orbit.facts?.verdict,
        ranges && Math.floor(Math.log2(orbit.count + 1))]);
    for (const piece of pieces) {
      const orbit = this.orbits.find(({ key }) => key === piece.key);
      if (!orbit) continue;
      const before = look(orbit);
      orbit.append(piece, this.state.k);
      plots.push([orbit, piece]);
      if (orbit.refused)
        this.controls.hint(`The orbit stops after ${COUNT.format(orbit.count)} impacts: ${orbit.refused}.`);
      recoloured ||= before !== look(orbit);
      if (orbit.count > orbit.impacts) {
        orbit.impacts = orbit.count;
        orbit.endless &&= orbit.count < MOST_FOLLOWED;
        this.state.orbits[this.orbits.indexOf(orbit)].impacts = orbit.count;
        this.saveSoon();
      }
    }
    if (recoloured) assignHues(this.orbits, HUES);
    return { plots, recoloured };
  }

  draw({ plots, recoloured }) {
    const whole = !this.orbits.some((orbit) => orbit.count > orbit.kept || !orbit.done);
    if (recoloured || this.fresh || whole) this.look();
    else {
      for (const [orbit, piece] of plots) this.section.plot(orbit, piece, 0, piece.x.length);
      this.section.showPoints();
    }
    this.controls.orbits.updateFacts();
    if (!this.orbits.some((orbit) => orbit.waits)) this.controls.orbits.completed();
    this.drawChartSoon();
    if (!this.playing) {
      this.time.draw();
      this.controls.time.moment();
    }
    this.section.drawCursors();
  }

  /** Have periodic orbits, branches and the jump curve computed that the state asks for. */
  async search() {
    clearTimeout(this.searchWaits);
    const { generation } = this;
    const { k, g, energy } = this.state;
    const specs = this.state.branches;
    const periods = new Set([...this.state.periods, ...specs.map((spec) => spec.period)]);
    if (this.state.motion) periods.add(this.state.motion.period);
    periods.delete(0);
    try {
      await this.searchNear();
      if (generation !== this.generation) return;
      for (const period of [...periods].sort((a, b) => a - b)) {
        if (this.periodic.has(period)) continue;
        setText("periodic-note", `Searching for orbits of period ${period} …`);
        const found = await this.searcher.ask("periodic", { k, g, energy, period });
        if (generation !== this.generation) return;
        this.periodic.set(period, found);
        if (this.state.motion?.period === period) this.chooseMotion();
        this.section.drawLines();
      }
      this.controls.periodic.list();
      this.families.update();
      if (this.state.jump && !this.jumpLines.length) {
        const curve = await this.searcher.ask("jump", { k, g, energy });
        if (generation !== this.generation) return;
        if (this.state.jump) this.showJump(curve);
      }
      await this.traceBranches(generation);
    } catch (error) {
      if (generation === this.generation) setText("branch-note", error.message);
    }
  }

  /** Find the periodic orbits nearest to the places that the state has. */
  async searchNear() {
    const { generation } = this;
    const { k, g, energy, near } = this.state;
    for (const spec of near.filter((one) => !this.found.has(writeNear(one)))) {
      setText("periodic-note", "Searching for the nearest periodic orbit …");
      const orbit = await this.searcher.ask("near", { k, g, energy, ...spec });
      if (generation !== this.generation) return;
      this.found.set(writeNear(spec), orbit);
      if (this.state.motion?.type === "near") this.chooseMotion();
    }
    if (near.length) this.section.drawLines();
  }

  /** Show the periodic orbit nearest to a place, of a period or (0) of any, with a saddle's branches. */
  async findNear([p, q], period, length) {
    this.mark();
    const { state } = this;
    const spec = { p, q, period };
    const nth = state.near.push(spec) - 1;
    this.searcher.restart(); // which may still trace branches
    this.saveSoon();
    await this.searchNear();
    const orbit = this.found.get(writeNear(spec));
    if (this.state !== state || orbit === undefined) return;
    const one = { period: 0, type: "near", nth };
    if (!orbit) state.near = state.near.filter((other) => other !== spec);
    else Object.assign(state, { motion: one, time: 0, chosen: -1, preset: "" });
    if (orbit && orbit.type !== "elliptic") {
      state.branches = [{ ...one, saddle: 0, kind: "both", side: "both", length }];
      this.branchLines = [];
    }
    this.chooseMotion();
    this.controls.refresh();
    const none = `No periodic orbit of period ${period || `up to ${MOST_PERIOD}`} was found near that point.`;
    this.controls.hint(orbit ? `The nearest orbit has ${orbitWords(orbit)}.` : none);
    this.search();
    this.saveSoon();
  }

  /** Say what a periodic orbit is and show it in time; the branches of a saddle grow. */
  explain(one, orbit) {
    this.mark();
    this.state.preset = "";
    if (orbit.type !== "elliptic") {
      this.state.branches = [{ ...one, saddle: -1, kind: "both", side: "both", length: 1.5 }];
      this.branchLines = [];
      this.searcher.restart();
      this.search();
    }
    this.showPeriodic(one);
    this.controls.refresh();
    this.controls.hint(`This orbit has ${orbitWords(orbit)}.`);
  }

  /** Let branches grow on the screen from their saddles. */
  grow() {
    const young = this.branchLines.filter((line) => line.share < 1);
    for (const line of young) line.share = Math.min(1, line.share + GROWTH_STEP);
    this.section.drawLines();
    if (young.length) requestAnimationFrame(() => this.grow());
    else this.growing = false;
  }

  async traceBranches(generation) {
    const { k, g, energy, view } = this.state;
    const specs = this.state.branches;
    if (!specs.length) return;
    const key = JSON.stringify([generation, view, specs]);
    if (this.traced === key && this.branchLines.length) return;
    const round = (this.tracing = (this.tracing ?? 0) + 1);
    this.section.project();
    const place = view.half < 0.5 && this.section.place(...this.section.middle);
    this.window = place ? { ...geometry.pointAt(k, g, energy, ...place), half: 1.5 * view.half } : null;
    const lines = [];
    const ended = [];
    for (const spec of specs) {
      const orbit = this.periodicOrbit(spec);
      if (!orbit || orbit.type === "elliptic") {
        setText("branch-note", `There is no ${spec.type} orbit of period ${spec.period} here.`);
        continue;
      }
      const saddles = spec.saddle < 0 ? orbit.points.keys() : [spec.saddle % orbit.period];
      const sides = spec.side === "both" ? ["inner", "outer"] : [spec.side];
      const kinds = spec.kind === "both" ? [true, false] : [spec.kind === "stable"];
      for (const saddle of saddles) {
        for (const side of sides) {
          for (const stable of kinds) {
            const details = { saddle, side, stable, length: spec.length, window: this.window };
            setText("branch-note", `Tracing branches: ${lines.length} done …`);
            const line =
              await this.searcher.ask("branch", { k, g, energy, points: orbit.points, spec: details });
            if (generation !== this.generation || round !== this.tracing) return;
            if (line.ended !== null) ended.push(line.ended);
            const again = lines.length < this.branchLines.length; // finer, in the place of one that is there
            lines.push({ line, colour: stable ? "stable" : "unstable",
              width: 1.3, share: again || this.calm ? 1 : 0 });
            if (!again) this.branchLines = [...lines];
            if (!this.growing) this.grow(this.growing = true);
          }
        }
      }
    }
    this.branchLines = lines;
    this.traced = key;
    this.section.drawLines();
    if (!lines.length) return;
    const points = lines.reduce((sum, { line }) => sum + line.x.length, 0);
    const early = ended.length ? ` Rounding errors end ${ended.length} of them early.` : "";
    setText("branch-note", `${lines.length} branches of ${COUNT.format(points)} points.${early}`);
  }

  periodicOrbit({ period, type, nth }) {
    if (type === "near") return this.found.get(writeNear(this.state.near[nth] ?? {}));
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
    this.controls.periodic.noteJump();
    this.section.drawLines();
  }

  setJump(on) {
    this.mark();
    this.state.jump = on;
    Object.assign(this, { jumpLines: [], jumpLength: null });
    this.controls.periodic.noteJump();
    this.section.drawLines();
    this.search();
    this.saveSoon();
  }

  /** Trace branches anew, finer, where the view has magnified them. */
  viewChanged() {
    this.colouring.update(120);
    this.filling.update();
    this.replaySoon();
    clearTimeout(this.finer);
    this.finer = setTimeout(() => {
      const { view } = this.state;
      const { window } = this;
      if (!this.state.branches.length || (view.half > 0.5 && !window)) return;
      const place = this.section.place(...this.section.middle);
      if (place && window && 1.5 * view.half > 0.6 * window.half && view.half < window.half) {
        const { x, y } = geometry.pointAt(this.state.k, this.state.g, this.state.energy, ...place);
        const { radius } = this.section;
        if (Math.hypot(x - window.x, y - window.y) < 0.3 * window.half * radius) return;
      }
      this.searcher.restart();
      this.search();
    }, 500);
    this.saveSoon();
  }

  /** Raise E from the least energy, or from where it is, to the bound of eq. (31). */
  async sweepEnergy() {
    const { k, g } = this.state;
    const [low, high] = geometry.energyBounds(k, g);
    const steps = Array.from({ length: SWEEP },
      (_, i) => Number((low + ((i + 1) / (SWEEP + 1)) ** 2 * (high - low)).toPrecision(6)));
    if (this.state.energy >= steps.at(-1)) this.controls.ball.takeBall({ k, g, E: steps[0] });
    this.sweeping = true;
    this.controls.ball.showSweep();
    for (const E of steps.filter((value) => value > this.state.energy)) {
      const begin = performance.now();
      this.controls.ball.takeBall({ k, g, E });
      element("E").value = String(E);
      const shown = () =>
        (this.state.map === "none" ? this.orbits.every((orbit) => orbit.done) : this.colouring.energy === E);
      while (this.sweeping && !(shown() && performance.now() - begin > FRAME)) {
        if (performance.now() - begin > 2000) break;
        await nextFrame();
      }
      if (!this.sweeping || this.state.energy !== E || this.state.k !== k || this.state.g !== g) break;
    }
    this.stopSweep();
  }

  stopSweep() {
    this.sweeping = false;
    this.controls.ball.showSweep();
  }

  choose(index, play = false) {
    Object.assign(this.state, { chosen: index, motion: null, time: 0 });
    this.chooseMotion();
    this.controls.orbits.markChosen();
    if (play && !this.calm) this.play();
    this.saveSoon();
  }

  chooseMotion() {
    const { state } = this;
    const periodic = state.motion && this.periodicOrbit(state.motion);
    const orbit = this.orbits[state.chosen];
    if (periodic) this.motion = new PeriodicMotion(periodic);
    else this.motion = !state.motion && orbit?.start ? new OrbitMotion(orbit) : null;
    this.twin.update();
    this.time.reset();
    this.time.draw();
    this.section.drawPoints();
    this.section.drawCursors();
    this.controls.time.moment();
    this.controls.orbits.updateFacts();
    this.controls.orbits.markChosen();
    this.drawChartSoon();
  }

  /** Let a second ball start at a distance, or with 0 none. */
  setTwin(distance) {
    this.mark();
    Object.assign(this.state, { twin: distance, chart: distance ? "distance" : "exponent", panel: "chart" });
    this.chooseMotion();
    this.controls.press();
    this.saveSoon();
  }

  showPeriodic(one) {
    Object.assign(this.state, { motion: one, time: 0, chosen: -1 });
    this.chooseMotion();
    this.saveSoon();
  }

  setTime(time) {
    const [first, last] = this.motion?.ends ?? [0, 0];
    this.state.time = Math.min(Math.max(time, first), last);
    this.time.draw();
    this.section.drawCursors();
    this.controls.time.moment();
    this.drawChartSoon();
    this.saveSoon();
  }

  play() {
    if (!this.motion) return;
    const [first, last] = this.motion.ends;
    if (this.state.time >= last && this.motion.count) this.state.time = first;
    this.playing = true;
    this.controls.time.showPlaying();
    let before = null;
    const frame = (now) => {
      if (!this.playing) return;
      const seconds = before === null ? 0 : Math.min(0.1, (now - before) / 1000);
      before = now;
      const end = this.motion?.ends[1] ?? 0;
      const next = this.state.time + seconds * Number(element("speed").value);
      const running = this.orbits[this.state.chosen] && !this.orbits[this.state.chosen].done;
      this.setTime(next);
      if (next > end && !running) this.pause();
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  pause() {
    this.playing = false;
    this.controls.time.showPlaying();
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

  drawChart() {
    setText("twin-note", this.twin.words);
    const { motion, state } = this;
    if (state.panel !== "chart") return;
    const shown = !state.motion && motion?.count ? motion.indexAt(state.time) : -1;
    const charts = {
      distance: (canvas) => this.twin.draw(canvas),
      families: (canvas) => this.families.draw(canvas),
      rotation: (canvas) => drawRotations(canvas, this.orbits),
      exponent: (canvas) => drawExponents(canvas, this.orbits, shown),
    };
    charts[state.chart](element("chart"));
  }

  drawChartSoon() {
    if (this.chartWaits) return;
    this.chartWaits = setTimeout(() => {
      this.chartWaits = null;
      this.drawChart();
    }, 120);
  }

  /** Begin another entry of the browser's history with the change that follows. */
  mark() {
    this.controls.welcome();
    this.save();
    this.marked = true;
  }

  saveSoon() {
    if (this.marked) {
      clearTimeout(this.saveWaits);
      this.saveWaits = setTimeout(() => this.save());
    } else this.saveWaits ??= setTimeout(() => this.save(), 400);
  }

  /** Write the state into the address, and what a reload needs besides it into the history. */
  save() {
    clearTimeout(this.saveWaits);
    this.saveWaits = null;
    const address = writeAddress(this.state);
    const further = this.marked && address !== this.saved;
    if (further) this.at += 1;
    this.marked = false;
    this.saved = address;
    const entry = { at: this.at, ...this.controls.kept() };
    window.history[further ? "pushState" : "replaceState"](entry, "", address);
    element("undo").disabled = this.at === 0;
  }

  undo() {
    this.save();
    if (this.at > 0) window.history.back();
  }
}

function element(id) { return document.getElementById(id); }
function nextFrame() { return new Promise((resolve) => requestAnimationFrame(resolve)); }

/** Begin with the address, or with Figure 2. */
function begin() {
  if (!globalThis.pseudorigid) {
    const needed = "This page needs WebAssembly with SIMD, which browsers have had since 2023.";
    document.body.textContent = `${needed} This browser does not have it, or forbids it.`;
    return;
  }
  const data = JSON.parse(element("data").textContent);
  const explorer = new Explorer(data);
  const load = (address) => {
    try {
      const name = decodeURIComponent(address.slice(1)) || "fig2"; // a scene's name is an address too
      const known = Object.hasOwn(data.scenes, name);
      const state = known ? presetState(name, data.scenes) : readAddress(address, data.scenes);
      if (!Object.hasOwn(data.scenes, state.preset)) state.preset = "";
      explorer.show(state);
      explorer.controls.welcome();
      if (!address && !explorer.calm) explorer.play();
      const left = `The last ${state.leftOut} orbits of the address are left out`;
      if (state.leftOut) explorer.controls.hint(`${left}: the page shows at most ${MOST_ORBITS}.`);
    } catch (error) {
      if (!explorer.orbits.length) explorer.show(presetState("fig2", data.scenes));
      explorer.controls.hint(error instanceof URIError ? "The address cannot be read." : `${error.message}.`);
    }
  };
  window.addEventListener("popstate", ({ state }) => {
    clearTimeout(explorer.saveWaits);
    explorer.saveWaits = null;
    explorer.marked = false;
    explorer.pause();
    explorer.at = state?.at ?? explorer.at + 1; // an address that was typed is a new entry
    load(window.location.hash);
  });
  const address = window.location.hash;
  explorer.controls.restore(window.history.state); // which saves the state before the address's
  load(address);
}

begin();
