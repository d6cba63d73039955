"use strict";
/* Buttons, fields, pointers and keys: what a person does becomes calls of the Explorer's methods. */
const NEAR_LINE = { mouse: 8, pen: 12, touch: 18 }; // pixels from y = 0 where a drag shoots a fan
const CLICK = 6; // pixels that a pointer may move in a click
const FAN = 12; // orbits of a fan that is shot by dragging
const DOUBLE = 400; // ms within which a second click at the same place is not another start

class Controls {
  constructor(page) {
    this.page = page;
    this.box = element("section");
    this.fill();
    this.listen();
    this.pointers();
    this.keys();
    this.atlas = new AtlasView(page, (k, ratio) => this.goTo(k, ratio));
    this.theme(window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  }

  get state() {
    return this.page.state;
  }

  // ---------------------------------------------------------------- the page's lists and fields

  fill() {
    const option = (value, text) => node("option", { value, textContent: text });
    const own = option("", "My own");
    element("preset").append(own, ...this.menu(option));
    element("span").append(...[8, 16, 30, 60, 120].map((span) => option(span, `${span} / ω`)));
    for (let period = 1; period <= 12; period++) element("period").append(option(period, period));
    element("period").append(option("all", "1 to 12"));
    element("period").value = "6";
    element("near-period").append(option(0, `any to ${MOST_PERIOD}`));
    for (let period = 1; period <= MOST_PERIOD; period++) element("near-period").append(option(period, period));
    for (const field of document.querySelectorAll("input")) field.autocomplete = "off";
    const { version, citation } = this.page.data;
    element("version").textContent = version;
    element("cite").textContent = `To cite this page: ${citation.software} To cite the paper: ${citation.paper}`;
    for (const [id, link] of Object.entries(citation.links)) Object.assign(element(id), { href: link, hidden: false });
    this.option = option;
  }

  /** The pictures of the paper, its claims and proofs; `variants` has those that have others. */
  menu(option) {
    const { presets, scenes } = this.page.data;
    const own = Object.keys(scenes).filter((name) => !name.includes("/"));
    const names = [...new Set([...presets.map(({ name }) => name), ...own])];
    return names.filter((name) => scenes[name]).map((name) => option(name, presets.find((one) => one.name === name)?.title ?? name));
  }

  /** The names of a scene in the variants that have it, that of the paper first. */
  variants(scene) {
    return Object.keys(this.page.data.scenes).filter((name) => name === scene || name.endsWith(`/${scene}`));
  }

  /** Say under the picture what there is to see; a change of the picture makes it one's own. */
  words() {
    const { preset, k, g, energy } = this.state;
    element("preset").value = preset.split("/").at(-1);
    const names = preset ? this.variants(element("preset").value) : [];
    element("variant").replaceChildren(...names.map((name) => this.option(name, name.includes("/") ? name.split("/")[0] : "the paper")));
    element("variant").value = preset;
    element("variant-label").hidden = names.length < 2;
    const values = `k = ${shortNumber(k)}, g = ${shortNumber(g)}, E = ${shortNumber(energy)}`;
    const [variant, scene] = preset.split("/");
    const { presets } = this.page.data;
    const title = presets.find(({ name }) => name === (scene ?? preset))?.title.split(":")[0] ?? scene;
    let text = presets.find(({ name }) => name === preset)?.see;
    const how = "Orbits on closed curves or small islands are regular, those that scatter are chaotic.";
    if (scene) text = `${title} of the variant ${variant}, at ${values}. ${how}`;
    else text ??= `A picture of your own, at ${values}. ${how}`;
    setText("see", text);
  }

  /** Set all fields from the state. */
  refresh() {
    const { state } = this;
    for (const [name, value] of Object.entries(this.ball)) {
      element(name).value = String(value);
      this.validate(name);
    }
    this.slides();
    this.words();
    this.showTour();
    if (![...element("span").options].some(({ value }) => Number(value) === state.span)) {
      element("span").append(this.option(state.span, `${state.span} / ω`));
    }
    element("span").value = String(state.span);
    element("map").value = state.map;
    element("impacts").value = String(state.impacts);
    element("back").checked = state.back;
    element("jump").checked = state.jump;
    this.editing = false;
    this.showBranches();
    this.press();
    this.listOrbits();
    this.listPeriodic();
    this.noteJump();
    this.moment();
    this.atlas.draw();
  }

  /** Show which buttons of each group are chosen. */
  press() {
    const { state } = this;
    const pressed = {
      "as-surface": state.view.kind === "surface",
      "as-disk": state.view.kind === "disk",
      ...Object.fromEntries(COLOURS.map((colour) => [`by-${colour}`, state.colour === colour])),
      "chart-exponent": state.chart === "exponent",
      "chart-rotation": state.chart === "rotation",
      "chart-distance": state.chart === "distance",
      "chart-families": state.chart === "families",
    };
    element("twin").checked = state.twin > 0;
    if (state.twin) element("apart").value = String(state.twin);
    for (const [id, on] of Object.entries(pressed)) element(id).setAttribute("aria-pressed", on);
  }

  /** Say something that holds until the next change. */
  hint(text) {
    element("hint").textContent = text;
  }

  welcome() {
    const touch = window.matchMedia("(pointer: coarse)").matches;
    const { state } = this;
    if (state.motion) this.hint("Press Play to watch the ball, or step from impact to impact.");
    else this.hint(`${touch ? "Tap" : "Click"} anywhere on the surface: an orbit starts there, and its ball bounces.`);
  }

  /** Say what the orbit is that was started last. */
  completed() {
    this.sceneKinds();
    const mine = this.watched;
    if (!["regular", "chaotic"].includes(mine?.facts?.verdict)) return;
    this.watched = null;
    const seen = { regular: "regular: it stays on closed curves, an island", chaotic: "chaotic: it wanders over the sea" };
    this.hint(`This orbit is ${seen[mine.facts.verdict]}.`);
  }

  listOrbits() {
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
      const label = node("label", { htmlFor: radio.id }, node("div", {}, node("div", {}, swatch, name), facts));
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
      let verdict = orbit.facts?.verdict || (orbit.done ? "too short for a verdict" : "…");
      if (orbit.refused) verdict = `stops: ${orbit.refused}`;
      name.textContent = `${index + 1}. ${verdict}${orbit.back ? ", backwards" : ""}`;
      const count = `${COUNT.format(orbit.count)} impacts`;
      const exponent = orbit.facts ? shortNumber(orbit.facts.exponent, 4) : "–";
      facts.textContent = `${count} · exponent ${exponent} · rotation ${orbit.rotationText} · start ${orbit.startText}`;
    }
  }

  markChosen() {
    const list = element("orbits");
    for (const { radio, index } of this.rows ?? []) {
      radio.checked = index === this.state.chosen;
      if (!radio.checked) continue;
      const { offsetTop, offsetHeight } = radio.parentElement;
      const top = offsetTop - list.offsetTop;
      list.scrollTop = Math.min(top, Math.max(list.scrollTop, top + offsetHeight - list.clientHeight));
    }
    this.sceneKinds();
  }

  sceneKinds() {
    const kinds = sceneKinds(this.state, this.page.orbits);
    const select = element("scene-kind");
    const now = [...select.options].map(({ value }) => value);
    if (String(now) === String(kinds)) return;
    select.replaceChildren(...kinds.map((kind) => this.option(kind, kind)));
    element("copy-scene").disabled = !kinds.length;
  }

  // ---------------------------------------------------------------- k, g and E

  get ball() {
    const { k, g, energy } = this.state;
    return { k, g, E: energy };
  }

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
      `E lies between ${show(low)} and ${show(high)}, eq. (31). Mark: E_g = g²(1 + k/2) = ${show(first)}, above which the map jumps. E/g² = ${show(E / (g * g))}.`;
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

  takeField(name) {
    this.takeBall({ ...this.ball, [name]: readNumber(element(name).value) });
  }

  /** A field is left: take over its value, or return to the present one and say why. */
  leave(name) {
    if (this.validate(name)) this.takeField(name);
    else this.keep(name, this.ball[name]);
    this.editing = false;
  }

  /** Let a field show the value that stays, after a refusal. */
  keep(name, value) {
    element(name).value = String(value);
    element(name).setAttribute("aria-invalid", "false");
    setText(`${name}-error`, `${element(`${name}-error`).textContent}. It stays ${value}.`);
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
    this.atlas.draw();
    page.restart(true);
    page.changedOrbits();
  }

  // ---------------------------------------------------------------- listeners

  listen() {
    const { page } = this;
    const on = (id, type, act) => element(id).addEventListener(type, act);
    for (const id of ["preset", "variant"]) {
      on(id, "change", () => element(id).value && this.turnTo(presetState(element(id).value, page.data.scenes)));
    }
    const step = (to) => (to > page.data.tour.length ? this.endTour() : this.turnTo(tourState(to, page.data.tour)));
    on("tour-start", "click", () => step(1));
    on("tour-back", "click", () => step(this.state.tour - 1));
    on("tour-next", "click", () => step(this.state.tour + 1));
    on("tour-end", "click", () => this.endTour());
    on("theme", "click", () => this.theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
    on("as-surface", "click", () => this.shape("surface"));
    on("as-disk", "click", () => this.shape("disk"));
    for (const colour of COLOURS) on(`by-${colour}`, "click", () => this.changed({ colour }));
    for (const chart of ["exponent", "rotation", "distance", "families"]) on(`chart-${chart}`, "click", () => this.changed({ chart }));
    on("map", "change", () => this.changed({ map: element("map").value }));
    on("play-energy", "click", () => (page.sweeping ? page.stopSweep() : page.sweepEnergy()));
    on("home", "click", () => this.whole());
    on("closer", "click", () => this.zoom(0.6));
    on("further", "click", () => this.zoom(1 / 0.6));
    for (const [id, across, up] of [["left", -1, 0], ["right", 1, 0], ["up", 0, 1], ["down", 0, -1]]) {
      on(id, "click", () => this.nudge(across, up));
    }
    for (const name of ["k", "g", "E"]) {
      on(name, "input", () => this.applyBall(name, 250)); // more digits may follow
      on(`${name}-slide`, "input", () => {
        element(name).value = String(this.slid(name));
        this.applyBall(name, 0);
      });
      for (const id of [name, `${name}-slide`]) on(id, "change", () => this.leave(name));
    }
    on("undo", "click", () => page.undo());
    document.addEventListener("keydown", (event) => {
      const { key, target } = event;
      const writes = target.matches("textarea, input:not([type])"); // fields undo what is typed
      if (!(event.ctrlKey || event.metaKey) || event.altKey || writes) return;
      const further = key === "y" || (event.shiftKey && key.toLowerCase() === "z");
      if (further) window.history.forward();
      else if (key === "z") page.undo();
      else return;
      event.preventDefault();
    });
    document.addEventListener("toggle", () => page.saveSoon(), true);
    on("speed", "change", () => page.saveSoon());
    on("finger", "click", () => {
      const turns = this.box.classList.toggle("turns");
      element("finger").setAttribute("aria-pressed", turns);
    });
    on("box", "click", () => this.toggle("box", !this.box.classList.contains("box")));
    on("pick", "click", () => this.toggle("pick", !this.box.classList.contains("pick")));
    on("run-on", "click", () => page.runOn());
    on("clear", "click", () => {
      page.clear();
      this.hint("Start an orbit anywhere on the section.");
    });
    for (const type of ["input", "change"]) {
      on("impacts", type, () => {
        const value = readCount(element("impacts").value);
        const allowed = Number.isInteger(value) && value >= 1 && value <= MOST_IMPACTS;
        const most = COUNT.format(MOST_IMPACTS);
        const error = `impacts = ${element("impacts").value.trim() || "nothing"} is not allowed: a whole number from 1 to ${most}`;
        complain("impacts", allowed ? "" : error, "impacts");
        if (type === "input") return;
        if (allowed) this.state.impacts = value;
        else this.keep("impacts", this.state.impacts);
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
    on("play", "click", () => (page.playing ? page.pause() : page.play()));
    on("back-impact", "click", () => page.stepImpact(-1));
    on("next-impact", "click", () => page.stepImpact(1));
    on("span", "change", () => {
      this.state.span = Number(element("span").value);
      page.time.reset();
      page.setTime(this.state.time);
    });
    on("chart", "click", ({ offsetX, offsetY }) => this.state.chart === "families" && page.families.openAt(offsetX, offsetY));
    window.addEventListener("beforeprint", () => this.theme("light", (this.printed = document.documentElement.dataset.theme)));
    window.addEventListener("afterprint", () => this.theme(this.printed));
    for (const id of ["twin", "apart"]) on(id, "change", () => this.pair(id));
    on("large", "click", () => element("stage").requestFullscreen().catch(() => this.hint("This browser does not allow the full screen.")));
    this.listenToPeriodic(on);
    this.listenToRecord(on);
    on("check", "click", () => this.check());
    const sizes = new ResizeObserver(() => {
      page.section?.resize();
      page.time?.draw();
      page.drawChart();
      this.atlas.draw();
    });
    for (const box of [this.box, element("stage")]) sizes.observe(box);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", ({ matches }) => this.theme(matches ? "dark" : "light"));
    element("atlas-panel").addEventListener("toggle", () => this.atlas.draw());
  }

  /** Show another state of the page. */
  turnTo(state) {
    this.page.pause();
    this.page.stopSweep();
    this.page.mark();
    this.page.show(state);
  }

  endTour() {
    this.page.mark();
    this.state.tour = 0;
    this.showTour();
    this.page.saveSoon();
  }

  showTour() {
    const { tour } = this.state;
    element("tour").hidden = !tour;
    if (!tour) return;
    const { length, [tour - 1]: { title, text } } = this.page.data.tour;
    setText("tour-title", `${tour} of ${length}. ${title}`);
    setText("tour-text", text);
    element("tour-back").disabled = tour === 1;
    element("tour-next").textContent = tour < length ? "Next" : "Finish";
  }

  /** Say whether the next drag draws a box, or the next click looks for a periodic orbit. */
  toggle(name, on) {
    this.box.classList.toggle(name, on);
    element(name).setAttribute("aria-pressed", on);
    if (!on) this.welcome();
    else if (name === "pick") this.hint("Click or tap the section: the periodic orbit nearest to that point is found.");
    else this.hint("Drag a box on the section: it fills the view then.");
  }

  /** Draw after a change of how things are shown. */
  changed(choice = {}) {
    Object.assign(this.state, choice);
    this.press();
    this.page.look();
    this.page.families.update();
    this.listFamilies();
    this.updateFacts();
    this.page.saveSoon();
  }

  /** The ends of each family, which open the section there. */
  listFamilies() {
    const { families } = this.page;
    const rows = families.shown.map((family) => {
      const ends = [family.samples[0], family.samples.at(-1)].map((sample) =>
        button(`E = ${shortNumber(sample.energy, 5)}`, `E = ${shortNumber(sample.energy, 5)}: open the end of this family`, () => families.open(family, sample)));
      return node("li", {}, `Period ${family.period}: from `, ends[0], " to ", ends[1]);
    });
    if (!rows.length) rows.push(node("li", { textContent: "Find periodic orbits: the diagram follows them over the energy." }));
    element("families").replaceChildren(...(this.state.chart === "families" ? rows : []));
  }

  theme(name) {
    document.documentElement.dataset.theme = name;
    element("theme").textContent = name === "dark" ? "Light" : "Dark";
    if (!this.page.controls) return;
    this.page.look();
    this.updateFacts();
    this.atlas.draw();
    this.page.saveSoon();
  }

  /** What a reload restores besides the address. */
  kept() {
    const open = [...document.querySelectorAll("details[open]")].map(({ id }) => id);
    return { theme: document.documentElement.dataset.theme, open, speed: element("speed").value };
  }

  restore(kept) {
    if (!kept?.theme) return;
    this.theme(kept.theme);
    element("speed").value = kept.speed;
    for (const id of kept.open) element(id).open = true;
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
      error = `x = ${shortNumber(x)}, y = ${shortNumber(y)} lies outside the section: on y = 0, x runs from ${low} to ${high}`;
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

  // ---------------------------------------------------------------- the view

  shape(kind) {
    const { view } = this.state;
    const { section } = this.page;
    if (view.kind === kind && (kind === "disk" || !section.framed)) return;
    const place = section.place(...section.middle);
    const magnified = view.half < HOME[view.kind][2] - 0.1;
    view.kind = kind;
    if (section.framed) Object.assign(view, { azimuth: HOME_VIEW.azimuth, elevation: HOME_VIEW.elevation });
    if (!magnified || !place) [view.x, view.y, view.half] = HOME[kind];
    else if (kind === "disk") [view.x, view.y] = place;
    else {
      [view.x, view.y] = [0, 0];
      section.project();
      const { k, g, energy } = this.state;
      const at = section.screen(...geometry.stateAt(k, g, energy, { p: place[0], q: place[1] }));
      if (at) {
        view.x = (at[0] - section.middle[0]) / section.scale;
        view.y = (section.middle[1] - at[1]) / section.scale;
      } else [view.x, view.y, view.half] = HOME[kind];
    }
    this.changed();
    this.page.viewChanged();
  }

  whole() {
    const { view } = this.state;
    [view.x, view.y, view.half] = HOME[view.kind];
    this.zoomed();
  }

  /** Zoom by a factor about a point of the screen, which stays where it is. */
  zoom(factor, at = this.page.section.cross ?? this.page.section.middle) {
    const { view } = this.state;
    const { section } = this.page;
    section.project(); // several events may come in a frame
    const half = Math.min(4, Math.max(2e-15, view.half * factor));
    const across = (at[0] - section.middle[0]) / section.scale;
    const up = (section.middle[1] - at[1]) / section.scale;
    view.x += across * (1 - half / view.half);
    view.y += up * (1 - half / view.half);
    view.half = half;
    this.zoomed();
  }

  /** Draw after a zoom, and fill what is in sight. */
  zoomed() {
    const { view } = this.state;
    this.state.fill = view.half < HOME[view.kind][2] - 0.1;
    this.moved();
  }

  /** Say what fills the window. */
  filled() {
    const { orbits, rare } = this.page.filling;
    if (!orbits.length) return;
    const regular = COUNT.format(orbits.filter((orbit) => !orbit.isSea()).length);
    const began = `${COUNT.format(orbits.length)} orbits began in this window, ${regular} of them regular`;
    setText("map-note", rare ? `${began}. They return to it too rarely to draw curves.` : `The window is full: ${began}.`);
  }


  /** Let a box of the screen, given by two corners, fill the view. */
  zoomBox([a, b], [c, d]) {
    const { view } = this.state;
    const { section } = this.page;
    section.project();
    const { frame, middle, scale, width, height } = section;
    const wide = Math.abs(c - a) / (width - frame.left - frame.right);
    const share = Math.max(wide, Math.abs(d - b) / (height - frame.top - frame.bottom));
    this.toggle("box", false);
    if (share < 0.01) return;
    view.x += (0.5 * (a + c) - middle[0]) / scale;
    view.y -= (0.5 * (b + d) - middle[1]) / scale;
    view.half = Math.max(2e-15, view.half * share);
    this.zoomed();
  }

  pan(across, down) {
    const { view } = this.state;
    const { section } = this.page;
    section.project();
    view.x -= across / section.scale;
    view.y += down / section.scale;
    this.moved();
  }

  turn(across, down) {
    const { view } = this.state;
    const tenth = (value) => Math.round(10 * value) / 10;
    view.azimuth = tenth((((view.azimuth - 0.35 * across) % 360) + 360) % 360);
    view.elevation = tenth(Math.min(89.9, Math.max(0.1, view.elevation + 0.35 * down)));
    this.moved();
  }

  nudge(across, up) {
    if (this.state.view.kind === "surface" && this.state.view.half > HOME.surface[2] - 0.1) this.turn(30 * across, -30 * up);
    else this.pan(-60 * across, 60 * up);
  }

  /** Draw in the next frame after the view has moved. */
  moved() {
    if (this.drawing) return;
    this.drawing = requestAnimationFrame(() => {
      this.drawing = null;
      this.page.section.look();
      if (this.hovered) element("where").textContent = this.describe(this.hovered);
      this.page.viewChanged();
    });
  }

  // ---------------------------------------------------------------- pointers

  pointers() {
    const { box } = this;
    const down = new Map();
    let gesture = null;
    const at = (event) => {
      const { left, top } = box.getBoundingClientRect();
      return [event.clientX - left, event.clientY - top];
    };
    box.addEventListener("pointerdown", (event) => {
      if (event.button > 1) return;
      const point = at(event);
      if (document.activeElement !== box) document.activeElement.blur(); // fields take or refuse first
      down.set(event.pointerId, point);
      box.setPointerCapture(event.pointerId);
      if (down.size === 2) {
        this.page.section.fan = this.page.section.corners = null;
        gesture = { kind: "pinch" };
        return;
      }
      if (down.size > 2) return;
      const place = this.onLine(point, event.pointerType);
      const shifted = event.shiftKey && event.button === 0 && this.state.view.kind === "disk";
      const boxes = shifted || box.classList.contains("box");
      const scrolls = event.pointerType === "touch" && !boxes && !box.classList.contains("turns");
      const pan = event.shiftKey || event.button === 1;
      gesture = { kind: "click", from: point, fan: place, scrolls, pan, boxes };
      this.hideCross();
    });
    box.addEventListener("pointermove", (event) => {
      const point = at(event);
      if (!down.has(event.pointerId)) {
        this.hover(point, event.pointerType);
        return;
      }
      const before = down.get(event.pointerId);
      if (gesture?.kind === "pinch") this.pinch(down, event.pointerId, point);
      else if (gesture) this.drag(gesture, before, point);
      down.set(event.pointerId, point);
    });
    const lift = (event) => {
      if (!down.delete(event.pointerId) || down.size) return;
      const done = gesture;
      gesture = null;
      this.finish(done, at(event), event.type === "pointercancel");
    };
    box.addEventListener("pointerup", lift);
    box.addEventListener("pointercancel", lift);
    box.addEventListener("pointerleave", () => {
      this.hover(null);
      element("where").textContent = "";
    });
    box.addEventListener(
      "touchmove",
      (event) => {
        if (event.touches.length > 1 && event.cancelable) event.preventDefault(); // no scrolling
      },
      { passive: false },
    );
    box.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const lines = event.deltaMode === 1 ? 30 : 1;
        const amount = Math.max(-240, Math.min(240, event.deltaY * lines));
        this.hovered = at(event);
        this.zoom(Math.exp(0.0022 * amount), this.hovered);
      },
      { passive: false },
    );
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
  }

  /** The place on y = 0 where a drag would shoot a fan; null if it would move the view. */
  onLine(point, type) {
    const { section } = this.page;
    const place = section.place(...point);
    if (!place) return null;
    const near = section.distanceFromLine(...point, place[0]) <= (NEAR_LINE[type] ?? 8);
    return near ? place[0] : null;
  }

  hover(point, type) {
    this.hovered = point;
    this.hovering ??= requestAnimationFrame(() => {
      this.hovering = null;
      const { section } = this.page;
      const mark = this.hovered && section.markAt(this.hovered);
      section.touched = mark || !this.hovered ? null : section.orbitAt(this.hovered);
      section.drawCursors();
      if (!this.hovered) return;
      const named = mark ? orbitWords(mark.orbit) : this.name(section.touched);
      element("where").textContent = `${this.describe(this.hovered)}${named && ` · ${named}`}`;
    });
    this.box.classList.toggle("on-line", point !== null && this.onLine(point, type) !== null);
  }

  /** What an orbit under the pointer is. */
  name(orbit) {
    if (!orbit) return "";
    const number = this.page.orbits.indexOf(orbit) + 1;
    return `${number ? `orbit ${number}` : "an orbit"}: ${orbit.facts?.verdict || "no verdict yet"}, rotation number ${shortNumber(orbit.facts?.rotation ?? NaN, 4)}`;
  }

  describe(point) {
    const place = this.page.section.place(...point);
    if (!place) return "outside the section";
    const { k, g, energy, view } = this.state;
    const { x, y } = geometry.pointAt(k, g, energy, ...place);
    const digits = Math.min(17, 5 + Math.max(0, Math.ceil(-Math.log10(view.half))));
    return `x = ${shortNumber(x, digits)}, y = ${shortNumber(y, digits)}`;
  }

  drag(gesture, before, point) {
    if (gesture.kind === "click") {
      if (Math.hypot(point[0] - gesture.from[0], point[1] - gesture.from[1]) < CLICK) return;
      gesture.kind = gesture.fan !== null && !gesture.pan ? "fan" : "move";
      if (gesture.scrolls) gesture.kind = "scroll";
      if (gesture.boxes) gesture.kind = "box";
      before = gesture.from;
    }
    if (gesture.kind === "fan") {
      const place = this.page.section.place(...point);
      if (!place) return;
      gesture.to = place[0];
      this.page.section.fan = [gesture.fan, gesture.to];
      this.page.section.drawCursors();
      return;
    }
    if (gesture.kind === "box") {
      this.page.section.corners = [gesture.from, point];
      this.page.section.drawCursors();
      return;
    }
    if (gesture.kind === "scroll") return;
    const step = [point[0] - before[0], point[1] - before[1]];
    if (!this.page.section.framed && !gesture.pan) this.turn(...step);
    else this.pan(...step);
  }

  pinch(down, moved, point) {
    const ids = [...down.keys()].slice(0, 2);
    if (!ids.includes(moved)) return;
    const before = ids.map((id) => down.get(id));
    const after = ids.map((id) => (id === moved ? point : down.get(id)));
    const gap = ([a, b]) => Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1]));
    const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    const [from, to] = [middle(before), middle(after)];
    this.pan(to[0] - from[0], to[1] - from[1]);
    this.zoom(gap(before) / gap(after), to);
  }

  finish(gesture, point, cancelled) {
    const { section } = this.page;
    section.fan = section.corners = null;
    section.drawCursors();
    if (!gesture || cancelled) return;
    if (gesture.kind === "box") this.zoomBox(gesture.from, point);
    if (gesture.kind === "fan" && gesture.to !== undefined) this.shoot(gesture.fan, gesture.to);
    if (gesture.kind !== "click") return;
    const { at = [Infinity, 0], when = 0 } = this.clicked ?? {};
    const now = performance.now();
    const again = now - when < DOUBLE && Math.hypot(at[0] - point[0], at[1] - point[1]) < CLICK;
    this.clicked = { at: point, when: now };
    if (!again) this.startAt(gesture.from);
  }

  startAt(point) {
    const place = this.page.section.place(...point);
    const mark = this.page.section.markAt(point);
    if (place && this.box.classList.contains("pick")) this.pick(place);
    else if (mark) this.page.explain(mark.one, mark.orbit);
    else if (place) this.begin([place]);
    else this.hint("That point lies outside the section: start inside its edge, where impacts graze.");
  }

  /** Look for the periodic orbit nearest to a place. */
  pick(place) {
    this.toggle("pick", false);
    const length = readNumber(element("branch-length").value);
    const allowed = length > 0 && length <= 20;
    this.page.findNear(place, Number(element("near-period").value), allowed ? length : 1.5);
  }

  // ---------------------------------------------------------------- keys

  keys() {
    const { box, page } = this;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    box.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const { section } = page;
      const { key } = event;
      if (arrows[key]) {
        if (event.shiftKey) this.nudge(arrows[key][0], -arrows[key][1]);
        else this.moveCross(...arrows[key]);
      } else if (key === "Enter") {
        if (section.cross) this.startAt(section.cross);
        else this.moveCross(0, 0);
      } else if (key === "+" || key === "=") this.zoom(0.7);
      else if (key === "-" || key === "−") this.zoom(1 / 0.7);
      else if (key === "0") this.whole();
      else if (key === "f" || key === "F") this.markFan();
      else if (key === "b" || key === "B") this.markBox();
      else if (key === " ") element("play").click();
      else if (key === "Escape") this.hideCross();
      else return;
      event.preventDefault();
    });
    box.addEventListener("blur", () => this.hideCross());
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

  moveCross(across, down) {
    const { section } = this.page;
    const step = Math.min(section.width, section.height) / 40;
    const [left, top] = section.cross ?? section.middle;
    section.cross = [
      Math.min(section.width - 4, Math.max(4, left + across * step)),
      Math.min(section.height - 4, Math.max(4, top + down * step)),
    ];
    if (this.corner) section.corners = [this.corner, section.cross];
    section.drawCursors();
    const text = this.describe(section.cross);
    element("where").textContent = text;
    clearTimeout(this.speaking);
    this.speaking = setTimeout(() => (element("spoken").textContent = text), 300);
  }

  hideCross() {
    this.page.section.cross = this.page.section.corners = null;
    this.fanFrom = this.corner = null;
    this.page.section.drawCursors();
  }

  /** Take the pointer as one corner of a box; the second corner makes the box fill the view. */
  markBox() {
    const { section } = this.page;
    const at = section.cross ?? section.middle;
    if (this.corner) this.zoomBox(this.corner, at);
    else this.hint("One corner of the box is set: move the pointer and press B again.");
    this.corner = this.corner ? null : at;
    section.corners = null;
    section.drawCursors();
  }

  /** Take the pointer's x as one end of a fan on y = 0; the second end shoots it. */
  markFan() {
    const { section } = this.page;
    const place = section.place(...(section.cross ?? section.middle));
    if (!place) return;
    if (this.fanFrom === null || this.fanFrom === undefined) {
      [this.fanFrom] = place;
      this.hint("One end of the row is set: move the pointer and press F again.");
      return;
    }
    this.shoot(this.fanFrom, place[0]);
    this.fanFrom = null;
  }

  // ---------------------------------------------------------------- time

  /** Take over whether there is a second ball, and its distance. */
  pair(id) {
    const distance = readNumber(element("apart").value);
    const allowed = distance > 0 && distance < 1;
    complain("apart", allowed ? "" : `distance = ${element("apart").value.trim() || "nothing"} is not allowed: above 0, below 1`, "apart");
    if (allowed && (id === "twin" || this.state.twin)) this.page.setTwin(element("twin").checked ? distance : 0);
    else if (!allowed) element("twin").checked = this.state.twin > 0;
  }

  showSweep() {
    element("play-energy").textContent = this.page.sweeping ? "Stop E" : "Play E";
    if (!this.page.sweeping) this.editing = false; // the whole film is one entry of the history
  }

  showPlaying() {
    element("play").textContent = this.page.playing ? "Pause" : "Play";
  }

  /** Say where the motion is. */
  moment() {
    const { motion, time } = this.page;
    const now = time?.now();
    const curves = element("curves");
    for (const id of ["play", "back-impact", "next-impact"]) element(id).disabled = !motion;
    if (!now) {
      element("moment").textContent = this.state.motion ? "Searching for the periodic orbit …" : "Start an orbit, or choose one.";
      return;
    }
    const [x, v, w] = now.state.map((value) => value.toFixed(4).replace("-", "−"));
    const count = motion.count === Infinity ? "" : ` of ${COUNT.format(motion.count)}`;
    element("moment").textContent =
      `t = ${this.state.time.toFixed(2).replace("-", "−")} after impact ${COUNT.format(motion.impact(now.index)).replace("-", "−")}${count}, at x\u00a0=\u00a0${x}, ẋ⁻\u00a0=\u00a0${v}, u̇⁻\u00a0=\u00a0${w}`;
    const [first, last] = time.window();
    curves.setAttribute("aria-valuemin", first);
    curves.setAttribute("aria-valuemax", last);
    curves.setAttribute("aria-valuenow", this.state.time.toFixed(2));
    curves.setAttribute("aria-valuetext", `t = ${this.state.time.toFixed(2)}`);
  }

  // ---------------------------------------------------------------- periodic orbits

  listenToPeriodic(on) {
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
      Object.assign(this.state, { periods: [], near: [], branches: branches.filter(far), motion: far(motion) ? motion : null });
      page.chooseMotion();
      if (!this.state.branches.length) page.branchLines = [];
      page.searcher.restart();
      this.listPeriodic();
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
      this.words();
      page.branchLines = [];
      page.searcher.restart();
      setText("branch-note", "");
      page.section.drawLines();
      this.sceneKinds();
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
      text = `The map jumps across a curve of length ${shortNumber(jumpLength, 6)} in (x, y); its inverse across the mirror image.`;
    } else if (state.jump) text = "Computing the curve …";
    setText("jump-note", text);
  }

  listPeriodic() {
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
      setText("periodic-note", `${count} symmetric orbits. On the section: dots are elliptic, crosses hyperbolic, squares inverse hyperbolic.`);
    } else if (!this.state.periods.length) setText("periodic-note", "");
    const select = element("saddle");
    const chosen = select.value;
    this.saddles = saddles;
    select.replaceChildren(
      ...saddles.map(({ points, type, nth }, i) => {
        const number = nth ? `, no. ${nth + 1}` : "";
        return this.option(i, `period ${points}, ${type === "near" ? "near a click" : type}${number}`);
      }),
    );
    const { wanted } = this;
    const at = saddles.findIndex((one) => wanted && writeMotion(one) === writeMotion(wanted));
    if (!saddles.length) select.append(this.option("", "find a saddle first"));
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
    const more = type === "elliptic" ? `rotation ${shortNumber(rotation, 7)}` : `multiplier ${shortNumber(multiplier, 7)}`;
    const facts = `x = ${shortNumber(orbit.points[0][0], 7)} · trace ${shortNumber(trace, 7)} · residue ${shortNumber(0.25 * (2 - trace), 6)} · ${more} · time ${shortNumber(time, 6)}`;
    const show = () => this.page.showPeriodic(one);
    return node(
      "li",
      {},
      node("span", { textContent: shape, ariaHidden: "true" }),
      node("div", {}, `Period ${period}, ${type}${one.type === "near" ? ", near a click" : ""}`, node("div", { className: "facts", textContent: facts })),
      button("In time", `In time: the ${type} orbit of period ${period}`, show),
    );
  }

  listPoints() {
    const saddle = this.saddles?.[Number(element("saddle").value)];
    const points = saddle ? Array.from({ length: saddle.points }, (_, i) => this.option(i, i + 1)) : [];
    element("saddle-point").replaceChildren(this.option(-1, "all"), ...points);
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
    this.words();
    page.branchLines = [];
    page.searcher.restart();
    page.search();
    this.sceneKinds();
    page.saveSoon();
  }

  // ---------------------------------------------------------------- places of the atlas

  /** Go to a k and E/g^2; g becomes smaller where eq. (31) needs it, which changes the scale only. */
  goTo(k, ratio) {
    const largest = (Math.sqrt(1 + 2 * ratio * k) - 1) / (2 * ratio);
    const { g: present } = this.state;
    const g = present < largest ? present : Number((0.9 * largest).toPrecision(2));
    this.editing = false;
    this.takeBall({ k, g, E: Number((ratio * g * g).toPrecision(6)) });
    this.refresh();
    const note = g === present ? "" : ` g became ${g}, which changes the scale only.`;
    this.hint(`k = ${k}, E/g² = ${ratio}: the starts have kept their places.${note}`);
  }

  // ---------------------------------------------------------------- records

  listenToRecord(on) {
    const { page } = this;
    on("copy-scene", "click", async () => {
      const kind = element("scene-kind").value;
      const block = sceneBlock(kind, page);
      element("scene").value = block.text;
      const copied = await copyText(block.text, element("scene"));
      const first = copied ? "Copied." : "Copy the lines above.";
      setText("scene-note", `${first} Paste them under scenes: in config.yaml, and run ./reproduce ${block.name}. ${block.note}`);
    });
    for (const [id, all] of [["csv", false], ["csv-all", true]]) {
      on(id, "click", async () => {
        const orbits = (all ? page.orbits : [page.orbits[this.state.chosen]]).filter((orbit) => orbit?.count);
        if (!orbits.length) {
          setText("record-note", all ? "Start an orbit first." : "Choose an orbit first.");
          return;
        }
        const name = all ? "orbits.csv" : "orbit.csv";
        download(name, await orbitsCsv(page, orbits));
        const count = orbits.reduce((sum, orbit) => sum + orbit.count, 0);
        setText("record-note", `${name} has ${COUNT.format(count)} impacts after the start, to the last bit.`);
      });
    }
    for (const [id, ratio, name] of [["png2", 2, "section-2x.png"], ["png4", 4, "section-4x.png"], ["svg", null, "section.svg"]]) {
      on(id, "click", async () => {
        download(name, await picture(page, ratio));
        setText("record-note", `${name} has the section as it is drawn, with k, g, E and the address.`);
      });
    }
    on("link", "click", async () => {
      page.save();
      const field = element("address");
      field.value = window.location.href;
      const copied = await copyText(field.value, field);
      setText("record-note", copied ? "The link is copied." : "Copy the link above.");
    });
  }

  async check() {
    const { page } = this;
    element("check").disabled = true;
    const found = [];
    this.checker ??= new Computer(); // of its own, which no change of the picture interrupts
    try {
      for (const figure of page.data.check) {
        const name = `Figure ${figure.figure.replace("fig", "")}`;
        setText("check-note", `Computing ${name} …`);
        const result = await this.checker.ask("check", { figure });
        const count = COUNT.format(result.impacts);
        const { difference } = result;
        if (!difference) found.push(`${name}: the same bits here, in ${count} impacts.`);
        else {
          found.push(`${name}: other bits here, in ${difference.variable} of orbit ${difference.orbit}, from impact ${COUNT.format(difference.impact)} or one of the next ${figure.block} on.`);
        }
      }
    } catch (error) {
      found.push(`The check could not be done: ${error.message}.`);
    }
    setText("check-note", found.join(" "));
    element("check").disabled = false;
  }
}

/** A periodic orbit's period, type and residue. */
function orbitWords({ period, type, trace }) {
  return `period ${period}: ${type}, residue ${shortNumber(0.25 * (2 - trace), 5)}`;
}

/** Say what is wrong beside fields, or with an empty text that nothing is. */
function complain(id, error, ...fields) {
  setText(`${id}-error`, error);
  for (const field of fields) element(field).setAttribute("aria-invalid", error !== "");
}

function setText(id, text) {
  const node = element(id);
  if (node.textContent !== text) node.textContent = text;
}

/** A new element with properties and children. */
function node(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function button(text, label, act) {
  const made = node("button", { type: "button", className: "tight", textContent: text, title: label, ariaLabel: label });
  made.addEventListener("click", act);
  return made;
}
