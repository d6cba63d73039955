/* The ball in time: play, steps, the second ball. */
class TimeControls extends OfPage {
  constructor(page) {
    super(page);
    this.listen();
    this.listenToCurves();
  }

  listen() {
    const { page } = this;
    on("play", "click", () => (page.playing ? page.pause() : page.play()));
    on("back-impact", "click", () => page.stepImpact(-1));
    on("next-impact", "click", () => page.stepImpact(1));
    on("speed", "change", () => page.saveSoon());
    on("span", "change", () => {
      this.state.span = Number(element("span").value);
      page.time.reset();
      page.setTime(this.state.time);
    });
    on("chart", "click", ({ offsetX, offsetY }) => {
      if (this.state.chart === "families") page.families.openAt(offsetX, offsetY);
    });
    for (const id of ["twin", "apart"]) on(id, "change", () => this.pair(id));
  }

  listenToCurves() {
    const { page } = this;
    const curves = element("curves");
    const seek = (event) => {
      const { left, top } = curves.getBoundingClientRect();
      const { plot } = this.page.time;
      if (!plot) return;
      this.page.pause();
      const [time] = plot.valuesAt(event.clientX - left, event.clientY - top);
      const [first, last] = plot.across;
      this.page.setTime(Math.min(Math.max(time, first), last - 1e-9 * (last - first)));
    };
    curves.addEventListener("pointerdown", (event) => {
      curves.setPointerCapture(event.pointerId);
      seek(event);
    });
    curves.addEventListener("pointermove", (event) => {
      if (curves.hasPointerCapture(event.pointerId)) seek(event);
    });
    element("curves").addEventListener("keydown", (event) => {
      const { time, span } = this.state;
      if (event.key === "ArrowLeft") page.setTime(time - span / 100);
      else if (event.key === "ArrowRight") page.setTime(time + span / 100);
      else if (event.key === "PageUp") page.stepImpact(1);
      else if (event.key === "PageDown") page.stepImpact(-1);
      else if (event.key === "Home") page.setTime(Math.max(page.time.window()[0], page.motion?.ends[0] ?? 0));
      else if (event.key === " ") element("play").click();
      else return;
      event.preventDefault();
    });
  }

  /** Set the fields from the state. */
  show() {
    const { span } = this.state;
    if (![...element("span").options].some(({ value }) => Number(value) === span)) {
      element("span").append(option(span, `${span} / ω`));
    }
    element("span").value = String(span);
  }

  /** Take over whether there is a second ball, and its distance. */
  pair(id) {
    const distance = readNumber(element("apart").value);
    const allowed = distance > 0 && distance < 1;
    complain("apart", allowed ? ""
      : `distance = ${element("apart").value.trim() || "nothing"} is not allowed: above 0, below 1`, "apart");
    if (allowed && (id === "twin" || this.state.twin))
      this.page.setTwin(element("twin").checked ? distance : 0);
    else if (!allowed) element("twin").checked = this.state.twin > 0;
  }

  showPlaying() { element("play").textContent = this.page.playing ? "Pause" : "Play"; }

  /** Say where the motion is. */
  moment() {
    const { motion, time } = this.page;
    const now = time?.now();
    const curves = element("curves");
    for (const id of ["play", "back-impact", "next-impact"]) element(id).disabled = !motion;
    if (!now) {
      element("moment").textContent =
        this.state.motion ? "Searching for the periodic orbit …" : "Start an orbit, or choose one.";
      return;
    }
    const [x, v, w] = now.state.map((value) => value.toFixed(4).replace("-", "−"));
    const count = motion.count === Infinity ? "" : ` of ${COUNT.format(motion.count)}`;
    const impact = COUNT.format(motion.impact(now.index)).replace("-", "−");
    const when = this.state.time.toFixed(2).replace("-", "−");
    element("moment").textContent = `t = ${when} after impact ${impact}${count}, at (${x}, ${v}, ${w})`;
    const [first, last] = time.window();
    const at = this.state.time.toFixed(2);
    Object.assign(curves,
      { ariaValueMin: first, ariaValueMax: last, ariaValueNow: at, ariaValueText: `t = ${at}` });
  }
}
