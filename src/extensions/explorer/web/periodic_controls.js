/* Periodic orbits, their branches, and the curves where the map jumps. */
class PeriodicControls extends OfPage {
  constructor(page) {
    super(page);
    this.listen();
  }

  listen() {
    const { page } = this;
    on("find", "click", () => {
      const value = element("period").value;
      const periods = value === "all" ? Array.from({ length: 12 }, (_, i) => i + 1) : [Number(value)];
      page.mark();
      this.state.periods = [...new Set([...this.state.periods, ...periods])].sort((a, b) => a - b);
      page.search();
      page.saveSoon();
    });
    on("forget", "click", () => {
      page.mark();
      const far = (one) => one?.type !== "near";
      const { motion, branches } = this.state;
      Object.assign(this.state,
        { periods: [], near: [], branches: branches.filter(far), motion: far(motion) ? motion : null });
      page.chooseMotion();
      if (!this.state.branches.length) page.branchLines = [];
      page.searcher.restart();
      this.list();
      page.section.drawLines();
      page.saveSoon();
    });
    on("saddle", "change", () => this.listPoints());
    on("branch-form", "submit", (event) => {
      event.preventDefault();
      this.drawBranches();
    });
    on("no-branches", "click", () => {
      page.mark();
      Object.assign(this.state, { branches: [], preset: "" });
      page.controls.words();
      page.branchLines = [];
      page.searcher.restart();
      setText("branch-note", "");
      page.section.drawLines();
      page.controls.orbits.sceneKinds();
      page.saveSoon();
    });
    on("jump", "change", () => page.setJump(element("jump").checked));
  }

  noteJump() {
    const { jumpLength, state } = this.page;
    let text = "";
    if (Number.isNaN(jumpLength)) text = pseudorigid.TOO_LONG;
    else if (state.jump && jumpLength === 0) text = "The map is continuous at this energy, at most E_g.";
    else if (state.jump && jumpLength) {
      const length = shortNumber(jumpLength, 6);
      text =
        `The map jumps across a curve of length ${length} in (x, y); its inverse across the mirror image.`;
    } else if (state.jump) text = "Computing the curve …";
    setText("jump-note", text);
  }

  list() {
    const { page } = this;
    const list = element("periodic");
    list.replaceChildren();
    const saddles = [];
    let count = 0;
    for (const { orbit, one } of page.shownPeriodic()) {
      if (one.type !== "near") count += 1;
      if (orbit.type !== "elliptic") saddles.push({ ...one, points: orbit.period });
      list.append(this.periodicRow(orbit, one));
    }
    if (this.state.periods.length && this.state.periods.every((period) => page.periodic.has(period))) {
      setText("periodic-note", `${count} symmetric ${count === 1 ? "orbit" : "orbits"}.`);
    } else if (!this.state.periods.length) setText("periodic-note", "");
    const select = element("saddle");
    const chosen = select.value;
    this.saddles = saddles;
    select.replaceChildren(
      ...saddles.map(({ points, type, nth }, i) => {
        const number = nth ? `, no. ${nth + 1}` : "";
        return option(i, `period ${points}, ${type === "near" ? "near a click" : type}${number}`);
      }),
    );
    const { wanted } = this;
    const at = saddles.findIndex((one) => wanted && writeMotion(one) === writeMotion(wanted));
    if (!saddles.length) select.append(option("", "find a saddle first"));
    else if (at >= 0) select.value = at;
    else if (chosen && saddles[Number(chosen)]) select.value = chosen;
    this.listPoints();
    if (at >= 0) {
      element("saddle-point").value = wanted.saddle;
      this.wanted = null;
    }
  }

  /** Set the fields of branches to those that are drawn. */
  showBranches() {
    const [first, ...more] = this.state.branches;
    this.wanted = first;
    if (!first) return;
    const both = more.some(({ side, length }) => side !== first.side && length === first.length);
    element("branch-side").value = both ? "both" : first.side;
    element("branch-kind").value = first.kind;
    element("branch-length").value = String(first.length);
  }

  periodicRow(orbit, one) {
    const { period, type, trace, multiplier, rotation, time } = orbit;
    const shape = { elliptic: "●", hyperbolic: "✕", "inverse hyperbolic": "□" }[type];
    const more = type === "elliptic" ? `rotation ${shortNumber(rotation, 7)}`
      : `multiplier ${shortNumber(multiplier, 7)}`;
    const digits = (value, count = 7) => shortNumber(value, count);
    const residue = `trace ${digits(trace)} · residue ${digits(0.25 * (2 - trace), 6)}`;
    const facts = `x = ${digits(orbit.points[0][0])} · ${residue} · ${more} · time ${digits(time, 6)}`;
    const show = () => this.page.showPeriodic(one);
    return node(
      "li",
      {},
      node("span", { textContent: shape, ariaHidden: "true" }),
      node("div", {}, `Period ${period}, ${type}${one.type === "near" ? ", near a click" : ""}`,
        node("div", { className: "facts", textContent: facts })),
      button("In time", `In time: the ${type} orbit of period ${period}`, show),
    );
  }

  listPoints() {
    const saddle = this.saddles?.[Number(element("saddle").value)];
    const points = saddle ? Array.from({ length: saddle.points }, (_, i) => option(i, i + 1)) : [];
    element("saddle-point").replaceChildren(option(-1, "all"), ...points);
  }

  drawBranches() {
    const { page } = this;
    const chosen = element("saddle").value;
    const length = readNumber(element("branch-length").value);
    let error = "";
    if (chosen === "") error = "find periodic orbits first: a saddle is hyperbolic";
    else if (!(length > 0 && length <= 20)) {
      error = `length = ${element("branch-length").value} is not allowed: above 0, at most 20 section radii`;
    }
    complain("branch", error, "branch-length");
    if (error) return;
    const spec = {
      ...this.saddles[Number(chosen)],
      saddle: Number(element("saddle-point").value),
      kind: element("branch-kind").value,
      side: element("branch-side").value,
      length,
    };
    page.mark();
    Object.assign(this.state, { branches: [spec], preset: "" });
    page.controls.words();
    page.branchLines = [];
    page.searcher.restart();
    page.search();
    page.controls.orbits.sceneKinds();
    page.saveSoon();
  }
}
