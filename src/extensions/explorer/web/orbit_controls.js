/* The list of orbits, and where the next ones start. */
const FAN = 12; // orbits of a fan that is shot by dragging

class OrbitControls extends OfPage {
  constructor(page) {
    super(page);
    this.listen();
  }

  listen() {
    const { page } = this;
    on("run-on", "click", () => page.runOn());
    on("clear", "click", () => {
      page.clear();
      page.controls.hint("Start an orbit anywhere on the section.");
    });
    for (const type of ["input", "change"]) {
      on("impacts", type, () => {
        const value = readCount(element("impacts").value);
        const allowed = Number.isInteger(value) && value >= 1 && value <= MOST_IMPACTS;
        const most = COUNT.format(MOST_IMPACTS);
        const typed = element("impacts").value.trim() || "nothing";
        const error = `impacts = ${typed} is not allowed: a whole number from 1 to ${most}`;
        complain("impacts", allowed ? "" : error, "impacts");
        if (type === "input") return;
        if (allowed) this.state.impacts = value;
        else keep("impacts", this.state.impacts);
        page.saveSoon();
      });
    }
    on("back", "change", () => {
      this.state.back = element("back").checked;
      page.saveSoon();
    });
    on("start-form", "submit", (event) => {
      event.preventDefault();
      this.startTyped();
    });
    on("fan-form", "submit", (event) => {
      event.preventDefault();
      this.fanTyped();
    });
  }

  list() {
    const list = element("orbits");
    const { page } = this;
    const { orbits } = page;
    list.replaceChildren();
    this.rows = orbits.map((orbit, index) => {
      const radio = node("input", { type: "radio", name: "chosen", id: `orbit-${orbit.key}` });
      radio.addEventListener("change", () => page.choose(index));
      const swatch = node("span", { className: "swatch" });
      const name = node("span");
      const facts = node("div", { className: "facts" });
      const label =
        node("label", { htmlFor: radio.id }, node("div", {}, node("div", {}, swatch, name), facts));
      const buttons = node(
        "div",
        { className: "bar" },
        button("+", `Follow orbit ${index + 1} twice as long`, () => page.extend(orbit)),
        button("×", `Remove orbit ${index + 1}`, () => page.remove(orbit)),
      );
      list.append(node("li", {}, radio, label, buttons));
      return { orbit, index, radio, swatch, name, facts };
    });
    if (!orbits.length) list.append(node("li", { className: "nothing", textContent: "None yet." }));
    this.updateFacts();
    this.markChosen();
    this.sceneKinds();
  }

  updateFacts() {
    element("run-on").textContent = this.page.orbits.some((orbit) => orbit.endless) ? "Stop" : "Continue";
    const { colours } = this.page.section;
    for (const { orbit, index, swatch, name, facts } of this.rows ?? []) {
      swatch.style.backgroundColor = orbit.colour(colours);
      let verdict = orbit.facts?.verdict || "…";
      if (orbit.refused) verdict = `stops: ${orbit.refused}`;
      name.textContent = `${index + 1}. ${verdict}${orbit.back ? ", backwards" : ""}`;
      const count = `${COUNT.format(orbit.count)} impacts`;
      const exponent = orbit.facts ? shortNumber(orbit.facts.exponent, 4) : "–";
      facts.textContent =
        `${count} · exponent ${exponent} · rotation ${orbit.rotationText} · start ${orbit.startText}`;
    }
  }

  markChosen() {
    for (const { radio, index } of this.rows ?? []) {
      radio.checked = index === this.state.chosen;
      if (radio.checked) radio.parentElement.scrollIntoView({ block: "nearest" });
    }
    this.sceneKinds();
  }

  sceneKinds() {
    const kinds = sceneKinds(this.state, this.page.orbits);
    const select = element("scene-kind");
    const now = [...select.options].map(({ value }) => value);
    if (String(now) === String(kinds)) return;
    select.replaceChildren(...kinds.map((kind) => option(kind, kind)));
    element("copy-scene").disabled = !kinds.length;
  }

  /** Say what the orbit is that was started last. */
  completed() {
    this.sceneKinds();
    const mine = this.watched;
    if (!["regular", "chaotic"].includes(mine?.facts?.verdict)) return;
    this.watched = null;
    const seen = { regular: "regular: it stays on closed curves, an island",
      chaotic: "chaotic: it wanders over the sea" };
    this.hint(`This orbit is ${seen[mine.facts.verdict]}.`);
  }

  startTyped() {
    const { k, g, energy } = this.state;
    const [x, y] = ["start-x", "start-y"].map((id) => readNumber(element(id).value));
    const { centre, radius } = geometry.section(k, g, energy);
    const [p, q] = geometry.placeAt(k, g, energy, x, y);
    let error = "";
    if (Number.isNaN(x) || Number.isNaN(y)) error = "x and y of a start are numbers";
    else if (!(p * p + q * q < 1)) {
      const [low, high] = [centre - radius, centre + radius].map((value) => shortNumber(value, 4));
      const point = `x = ${shortNumber(x)}, y = ${shortNumber(y)}`;
      error = `${point} lies outside the section: on y = 0, x runs from ${low} to ${high}`;
    }
    complain("start", error, "start-x", "start-y");
    if (!error) this.begin([[p, q]], [x, y]);
  }

  fanTyped() {
    const [from, to] = ["fan-from", "fan-to"].map((id) => readNumber(element(id).value));
    const count = readCount(element("fan-count").value);
    let error = "";
    if (!(Math.abs(from) < 1 && Math.abs(to) < 1)) error = "the ends of a row of orbits lie between −1 and 1";
    else if (!(Number.isInteger(count) && count >= 2 && count <= MOST_ORBITS)) {
      error = `a row has 2 to ${MOST_ORBITS} orbits`;
    }
    complain("fan", error, "fan-from", "fan-to", "fan-count");
    if (!error) this.shoot(from, to, count);
  }

  /** Start orbits of one's own. */
  begin(places, xy = null) {
    this.page.startOrbits(places, xy);
    if (places.length > 1) return;
    this.watched = this.page.orbits.at(-1);
    this.hint("An orbit has started there, and its ball bounces.");
  }

  shoot(from, to, count = FAN) {
    this.begin(fan(from, to, count, 0).map(({ p }) => [p, 0]));
    this.hint(`A row of ${count} orbits starts. The chart of rotation numbers shows them side by side.`);
  }
}
