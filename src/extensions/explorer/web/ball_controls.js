/* The fields and sliders of k, g and E. */
class BallControls extends OfPage {
  constructor(page) {
    super(page);
    this.editing = false; // whether a drag goes on, which is undone at once
    this.listen();
  }

  listen() {
    for (const name of ["k", "g", "E"]) {
      on(name, "input", () => this.applyBall(name, 250)); // more digits may follow
      on(`${name}-slide`, "input", () => {
        element(name).value = String(this.slid(name));
        this.applyBall(name, 0);
      });
      for (const id of [name, `${name}-slide`]) on(id, "change", () => this.leave(name));
    }
  }

  /** Set the fields from the state. */
  show() {
    for (const [name, value] of Object.entries(this.ball)) {
      element(name).value = String(value);
      this.validate(name);
    }
    this.slides();
    this.editing = false;
  }

  get ball() { return { k: this.state.k, g: this.state.g, E: this.state.energy }; }

  /** Set the sliders, whose ends are those of the range at the other two values. */
  slides() {
    const { ball } = this;
    const { k, g, E } = ball;
    const [low, high] = rangeOf("E", ball);
    for (const name of ["k", "g", "E"]) {
      const slide = element(`${name}-slide`);
      const shares = [...rangeOf(name, ball), ball[name]].map((value) => this.share(name, value));
      [slide.min, slide.max, slide.value] = shares;
      slide.setAttribute("aria-valuetext", String(ball[name]));
    }
    const first = geometry.firstJump(k, g);
    const share = this.share("E", first);
    element("mark").hidden = !(share < 1);
    element("mark").style.left = `calc(8px + ${share} * (100% - 16px) - 1px)`;
    const show = (value) => shortNumber(value, 4);
    element("bounds").textContent =
      `${inside(low, 1)} < E < ${inside(high, -1)}, eq. (31). E/g² = ${show(E / (g * g))}. ` +
      `Mark: the map jumps above E_g = g²(1 + k/2) = ${show(first)}.`;
  }

  /** Where a value is on its slider, which resolves small ones more finely. */
  share(name, value) {
    const { k } = this.state;
    const [low, high] = name === "E" ? rangeOf("E", this.ball) : [0, name === "g" ? k : 1];
    return Math.sqrt((value - low) / (high - low));
  }

  /** A slider's value with as many digits as it can mean, inside the range. */
  slid(name) {
    const { k } = this.state;
    const [low, high] = rangeOf(name, this.ball);
    const share = Number(element(`${name}-slide`).value) ** 2;
    const value = name === "E" ? low + share * (high - low) : name === "g" ? share * k : share;
    const room = (high - low) / 500;
    const step = 10 ** Math.floor(Math.log10(room));
    const inside = Math.min(high - room, Math.max(low + room, value));
    return Number((Math.round(inside / step) * step).toPrecision(12));
  }

  /** Say what is wrong with a field of the ball, and return whether nothing is. */
  validate(name) {
    const error = parameterError(name, element(name).value, this.ball);
    complain(name, error, name);
    return !error;
  }

  /** Take over a field's value soon if it is allowed. */
  applyBall(name, delay) {
    clearTimeout(this.ballWaits);
    if (this.validate(name)) this.ballWaits = setTimeout(() => this.takeField(name), delay);
  }

  takeField(name) { this.takeBall({ ...this.ball, [name]: readNumber(element(name).value) }); }

  /** A field is left: take over its value, or return to the present one and say why. */
  leave(name) {
    if (this.validate(name)) this.takeField(name);
    else keep(name, this.ball[name]);
    this.editing = false;
  }

  /** Take over k, g and E; the starts keep their places. What one drag does is undone at once. */
  takeBall({ k, g, E }) {
    clearTimeout(this.ballWaits);
    const { page, state } = this;
    if (k === state.k && g === state.g && E === state.energy) return;
    if (!this.editing) page.mark();
    this.editing = true;
    Object.assign(state, { k, g, energy: E });
    for (const name of ["k", "g", "E"]) complain(name, "", name);
    for (const orbit of page.orbits) orbit.xy = null;
    this.slides();
    page.controls.atlas.draw();
    page.restart(true);
    page.ownOrbits();
  }

  showSweep() {
    element("play-energy").textContent = this.page.sweeping ? "Stop E" : "Play E";
    if (!this.page.sweeping) this.editing = false; // the whole film is one entry of the history
  }

  /** Go to a k and E/g^2; g becomes smaller where eq. (31) needs it, which changes the scale only. */
  goTo(k, ratio) {
    const largest = (Math.sqrt(1 + 2 * ratio * k) - 1) / (2 * ratio);
    const { g: present } = this.state;
    const g = present < largest ? present : Number((0.9 * largest).toPrecision(2));
    this.editing = false;
    this.takeBall({ k, g, E: Number((ratio * g * g).toPrecision(6)) });
    this.page.controls.refresh();
    const note = g === present ? "" : ` g became ${g}, which changes the scale only.`;
    this.hint(`k = ${k}, E/g² = ${ratio}: the starts have kept their places.${note}`);
  }
}
