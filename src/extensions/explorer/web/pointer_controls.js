/* Pointers and keys on the section. */
const NEAR_LINE = { mouse: 8, pen: 12, touch: 18 }; // pixels from y = 0 where a drag shoots a fan
const CLICK = 6; // pixels that a pointer may move in a click
const DOUBLE = 400; // ms within which a second click at the same place is not another start

class PointerControls extends OfPage {
  constructor(page, view) {
    super(page);
    this.view = view;
    this.box = element("section");
    this.pointers();
    this.keys();
  }

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
      const pan = event.shiftKey || event.button === 1;
      gesture = { kind: "click", from: point, fan: place, pan, boxes };
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
      "wheel",
      (event) => {
        event.preventDefault();
        const lines = event.deltaMode === 1 ? 30 : 1;
        const amount = Math.max(-240, Math.min(240, event.deltaY * lines));
        this.hovered = at(event);
        this.view.zoom(Math.exp(0.0022 * amount), this.hovered);
      },
      { passive: false },
    );
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
    const verdict = orbit.facts?.verdict || "no verdict yet";
    const turns = orbit.facts?.rotation ?? NaN;
    const rotation = Number.isNaN(turns) ? "" : `, rotation number ${shortNumber(turns, 4)}`;
    return `${number ? `orbit ${number}` : "an orbit"}: ${verdict}${rotation}`;
  }

  /** Say anew what is under the pointer, after the view has moved. */
  describeAgain() { if (this.hovered) element("where").textContent = this.describe(this.hovered); }

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
    const step = [point[0] - before[0], point[1] - before[1]];
    if (!this.page.section.framed && !gesture.pan) this.view.turn(...step);
    else this.view.pan(...step);
  }

  pinch(down, moved, point) {
    const ids = [...down.keys()].slice(0, 2);
    if (!ids.includes(moved)) return;
    const before = ids.map((id) => down.get(id));
    const after = ids.map((id) => (id === moved ? point : down.get(id)));
    const gap = ([a, b]) => Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1]));
    const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    const [from, to] = [middle(before), middle(after)];
    this.view.pan(to[0] - from[0], to[1] - from[1]);
    this.view.zoom(gap(before) / gap(after), to);
  }

  finish(gesture, point, cancelled) {
    const { section } = this.page;
    section.fan = section.corners = null;
    section.drawCursors();
    if (!gesture || cancelled) return;
    if (gesture.kind === "box") this.view.zoomBox(gesture.from, point);
    if (gesture.kind === "fan" && gesture.to !== undefined)
      this.page.controls.orbits.shoot(gesture.fan, gesture.to);
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
    else if (place) this.page.controls.orbits.begin([place]);
    else this.hint("That point lies outside the section: start inside its edge, where impacts graze.");
  }

  /** Look for the periodic orbit nearest to a place. */
  pick(place) {
    this.view.toggle("pick", false);
    const length = readNumber(element("branch-length").value);
    const allowed = length > 0 && length <= 20;
    this.page.findNear(place, Number(element("near-period").value), allowed ? length : 1.5);
  }

  keys() {
    const { box, page, view } = this;
    const cross = () => page.section.cross;
    const arrow = (x, y) => (shift) => (shift ? view.nudge(x, -y) : this.moveCross(x, y));
    const acts = {
      ArrowLeft: arrow(-1, 0), ArrowRight: arrow(1, 0), ArrowUp: arrow(0, -1), ArrowDown: arrow(0, 1),
      Enter: () => (cross() ? this.startAt(cross()) : this.moveCross(0, 0)),
      "+": () => view.zoom(0.7), "=": () => view.zoom(0.7), "-": () => view.zoom(1 / 0.7),
      0: () => view.whole(), f: () => this.markFan(), b: () => this.markBox(),
      " ": () => element("play").click(), Escape: () => this.hideCross(),
    };
    box.addEventListener("keydown", (event) => {
      const { key } = event;
      const act = acts[key.length === 1 ? key.toLowerCase().replace("−", "-") : key];
      if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
      act(event.shiftKey);
      event.preventDefault();
    });
    box.addEventListener("blur", () => this.hideCross());
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
    if (this.corner) this.view.zoomBox(this.corner, at);
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
    this.page.controls.orbits.shoot(this.fanFrom, place[0]);
    this.fanFrom = null;
  }
}
