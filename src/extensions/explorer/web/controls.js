/*
 * The page around the section: what it says, its menu and its panels. Other files have the controls
 * of one subject each: ball_controls.js, orbit_controls.js, and so on.
 */
class Controls extends OfPage {
  constructor(page) {
    super(page);
    this.fill();
    this.ball = new BallControls(page);
    this.orbits = new OrbitControls(page);
    this.view = new ViewControls(page);
    this.pointer = new PointerControls(page, this.view);
    this.time = new TimeControls(page);
    this.periodic = new PeriodicControls(page);
    this.guide = new Guide(page);
    this.listen();
    listenToRecord(page);
    this.atlas = new AtlasView(page, (k, ratio) => this.ball.goTo(k, ratio));
    this.theme(window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  }

  fill() {
    element("preset").append(option("", "My own"), ...this.menu());
    const { version, citation } = this.page.data;
    element("version").textContent = version;
    element("cite").textContent =
      `To cite this page: ${citation.software} To cite the paper: ${citation.paper}`;
    for (const [id, link] of Object.entries(citation.links)) {
      Object.assign(element(id), { href: link, hidden: false });
    }
  }

  /** The pictures of the paper, its claims and proofs; `variants` has those that have others. */
  menu() {
    const { presets, scenes } = this.page.data;
    const own = Object.keys(scenes).filter((name) => !name.includes("/"));
    const names = [...new Set([...presets.map(({ name }) => name), ...own])];
    const title = (name) => presets.find((one) => one.name === name)?.title ?? spaced(name);
    return names.filter((name) => scenes[name]).map((name) => option(name, title(name)));
  }

  /** The names of a scene in the variants that have it, that of the paper first. */
  variants(scene) {
    return Object.keys(this.page.data.scenes).filter((name) => name === scene || name.endsWith(`/${scene}`));
  }

  /** Say above the picture what there is to see; a change of the picture makes it one's own. */
  words() {
    const { preset, k, g, energy } = this.state;
    element("preset").value = preset.split("/").at(-1);
    const names = preset ? this.variants(element("preset").value) : [];
    const called = (name) => (name.includes("/") ? spaced(name.split("/")[0]) : "the paper");
    element("variant").replaceChildren(...names.map((name) => option(name, called(name))));
    element("variant").value = preset;
    element("variant-label").hidden = names.length < 2;
    const values = `k = ${shortNumber(k)}, g = ${shortNumber(g)}, E = ${shortNumber(energy)}`;
    const [variant, scene] = preset.split("/");
    const { presets } = this.page.data;
    const title = presets.find(({ name }) => name === (scene ?? preset))?.title.split(":")[0] ?? scene;
    let text = presets.find(({ name }) => name === preset)?.see;
    const how = "Orbits on closed curves or small islands are regular, those that scatter are chaotic.";
    if (scene) text = `${title} of the variant “${spaced(variant)}”, at ${values}. ${how}`;
    else text ??= `A picture of your own, at ${values}. ${how}`;
    setText("see", text);
  }

  /** Set all fields from the state. */
  refresh() {
    const { state } = this;
    this.ball.show();
    this.words();
    this.guide.show();
    this.time.show();
    element("map").value = state.map;
    element("impacts").value = String(state.impacts);
    element("back").checked = state.back;
    element("jump").checked = state.jump;
    this.periodic.showBranches();
    this.press();
    this.orbits.list();
    this.periodic.list();
    this.periodic.noteJump();
    this.time.moment();
    this.atlas.draw();
  }

  /** Show which choices of the state hold. */
  press() {
    const { state } = this;
    for (const kind of ["surface", "disk"]) {
      element(`as-${kind}`).setAttribute("aria-pressed", state.view.kind === kind);
    }
    element("colour").value = state.colour;
    element("chart-kind").value = state.chart;
    element("twin").checked = state.twin > 0;
    if (state.twin) element("apart").value = String(state.twin);
    document.querySelector("main").dataset.panel = state.panel;
    for (const name of PANELS) {
      const open = name === state.panel;
      Object.assign(element(`tab-${name}`), { ariaSelected: String(open), tabIndex: open ? 0 : -1 });
      element(`panel-${name}`).hidden = !open;
    }
  }

  /** Say what colours and fills the section, as far as it is shown. */
  status() {
    const { colouring, filling } = this.page;
    setText("map-note", [colouring.words, filling.words].filter(Boolean).join(" "));
  }

  /** Say something that holds until the next change. */
  hint(text) { element("hint").textContent = text; }

  welcome() {
    const touch = window.matchMedia("(pointer: coarse)").matches;
    const { state } = this;
    if (state.tour || state.lesson) this.hint(""); // the guide says what to do
    else if (state.motion)
      this.hint("What happens between two impacts? Press Play, or step from one to the next.");
    else this.hint(`${touch ? "Tap" : "Click"} the section: which starts draw a curve, and which scatter?`);
  }

  listen() {
    const { page } = this;
    for (const id of ["preset", "variant"]) {
      const turn = () => element(id).value && this.turnTo(presetState(element(id).value, page.data.scenes));
      on(id, "change", turn);
    }
    on("theme", "click",
      () => this.theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
    on("large", "click", () => this.type(document.documentElement.dataset.type !== "large"));
    const refused = () => this.hint("This browser does not allow the full screen.");
    on("whole-screen", "click", () => document.documentElement.requestFullscreen().catch(refused));
    on("colour", "change", () => this.changed({ colour: element("colour").value }));
    on("chart-kind", "change", () => this.changed({ chart: element("chart-kind").value }));
    on("map", "change", () => this.changed({ map: element("map").value }));
    on("play-energy", "click", () => (page.sweeping ? page.stopSweep() : page.sweepEnergy()));
    on("undo", "click", () => page.undo());
    this.listenToTabs();
    document.addEventListener("keydown", (event) => {
      const { key, target } = event;
      const menu = element("menu");
      if (key === "Escape" && menu.open) {
        menu.open = false;
        menu.firstElementChild.focus();
      }
      const writes = target.matches("textarea, input:not([type])"); // fields undo what is typed
      if (!(event.ctrlKey || event.metaKey) || event.altKey || writes) return;
      const further = key === "y" || (event.shiftKey && key.toLowerCase() === "z");
      if (further) window.history.forward();
      else if (key === "z") page.undo();
      else return;
      event.preventDefault();
    });
    for (const id of ["as-surface", "as-disk", "box", "home", "theme", "large", "whole-screen"]) {
      on(id, "click", () => (element("menu").open = false));
    }
    document.addEventListener("pointerdown", ({ target }) => {
      if (!element("menu").contains(target)) element("menu").open = false;
    });
    const printing = () => this.theme("light", (this.printed = document.documentElement.dataset.theme));
    window.addEventListener("beforeprint", printing);
    window.addEventListener("afterprint", () => this.theme(this.printed));
    const sizes = new ResizeObserver(() => {
      page.section?.resize();
      page.time?.draw();
      page.drawChart();
      this.atlas.draw();
    });
    for (const id of ["section", "ball", "panel-time", "panel-chart"]) sizes.observe(element(id));
    const dark = window.matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", ({ matches }) => this.theme(matches ? "dark" : "light"));
  }

  /** Panels are chosen by their tabs, or by arrow keys on one; a second click shows the time again. */
  listenToTabs() {
    for (const [index, name] of PANELS.entries()) {
      on(`tab-${name}`, "click", () => this.open(this.state.panel === name ? "time" : name));
      on(`tab-${name}`, "keydown", (event) => {
        const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (!step) return;
        const next = PANELS[(index + step + PANELS.length) % PANELS.length];
        this.open(next);
        element(`tab-${next}`).focus();
        event.preventDefault();
      });
    }
  }

  open(panel) {
    this.state.panel = panel;
    this.press();
    this.page.time.draw();
    this.page.drawChart();
    this.page.families.update();
    this.listFamilies();
    this.atlas.draw();
    this.orbits.markChosen();
    this.page.saveSoon();
  }

  /** Show another state of the page. */
  turnTo(state) {
    this.page.pause();
    this.page.stopSweep();
    this.page.mark();
    this.page.show(state);
    this.welcome();
  }

  /** Draw after a change of how things are shown. */
  changed(choice = {}) {
    Object.assign(this.state, choice);
    this.press();
    this.page.look();
    this.page.families.update();
    this.listFamilies();
    this.orbits.updateFacts();
    this.page.saveSoon();
  }

  /** The ends of each family, which open the section there. */
  listFamilies() {
    const { families } = this.page;
    const rows = families.shown.map((family) => {
      const ends = [family.samples[0], family.samples.at(-1)].map((sample) => {
        const text = `E = ${shortNumber(sample.energy, 5)}`;
        return button(text, `${text}: open the end of this family`, () => families.open(family, sample));
      });
      return node("li", {}, `Period ${family.period}: from `, ends[0], " to ", ends[1]);
    });
    const text = "Find periodic orbits: the diagram follows them over the energy.";
    if (!rows.length) rows.push(node("li", { textContent: text }));
    element("families").replaceChildren(...(this.state.chart === "families" ? rows : []));
  }

  theme(name) {
    document.documentElement.dataset.theme = name;
    element("theme").textContent = name === "dark" ? "Light" : "Dark";
    this.redraw();
  }

  /** Show all texts large, as for a projector, or as usual. */
  type(large) {
    document.documentElement.dataset.type = large ? "large" : "";
    element("large").setAttribute("aria-pressed", large);
    this.redraw();
  }

  redraw() {
    if (!this.page.controls) return;
    this.page.look();
    this.orbits.updateFacts();
    this.atlas.draw();
    this.page.save(); // a reload may follow at once
  }

  /** What a reload restores besides the address. */
  kept() {
    const { theme, type } = document.documentElement.dataset;
    return { theme, type, speed: element("speed").value };
  }

  restore(kept) {
    if (!kept?.theme) return;
    this.theme(kept.theme);
    this.type(kept.type === "large");
    element("speed").value = kept.speed;
  }
}

/** A name of the config as words. */
function spaced(name) {
  const words = name.replace(/[-_]/g, " ");
  return words[0].toUpperCase() + words.slice(1);
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

/** Let a field show the value that stays, after a refusal. */
function keep(name, value) {
  element(name).value = String(value);
  element(name).setAttribute("aria-invalid", "false");
  setText(`${name}-error`, `${element(`${name}-error`).textContent}. It stays ${value}.`);
}

function on(id, type, act) { element(id).addEventListener(type, act); }

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

function option(value, text) { return node("option", { value, textContent: text }); }

function button(text, label, act) {
  const properties =
    { type: "button", className: "tight", textContent: text, title: label, ariaLabel: label };
  const made = node("button", properties);
  made.addEventListener("click", act);
  return made;
}
