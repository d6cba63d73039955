/* How the section is seen: its shape, turn, place and size. */
class ViewControls extends OfPage {
  constructor(page) {
    super(page);
    this.box = element("section");
    this.listen();
  }

  listen() {
    on("as-surface", "click", () => this.shape("surface"));
    on("as-disk", "click", () => this.shape("disk"));
    on("home", "click", () => this.whole());
    on("closer", "click", () => this.zoom(0.6));
    on("further", "click", () => this.zoom(1 / 0.6));
    for (const [id, across, up] of [["left", -1, 0], ["right", 1, 0], ["up", 0, 1], ["down", 0, -1]]) {
      on(id, "click", () => this.nudge(across, up));
    }
    for (const name of ["box", "pick"]) {
      on(name, "click", () => this.toggle(name, !this.box.classList.contains(name)));
    }
  }

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
    this.page.controls.changed();
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
    if (this.state.view.kind === "surface" && this.state.view.half > HOME.surface[2] - 0.1)
      this.turn(30 * across, -30 * up);
    else this.pan(-60 * across, 60 * up);
  }

  /** Draw in the next frame after the view has moved. */
  moved() {
    if (this.drawing) return;
    this.drawing = requestAnimationFrame(() => {
      this.drawing = null;
      this.page.section.look();
      this.page.controls.pointer.describeAgain();
      this.page.viewChanged();
    });
  }

  /** Say whether the next drag draws a box, or the next click looks for a periodic orbit. */
  toggle(name, on) {
    this.box.classList.toggle(name, on);
    element(name).setAttribute("aria-pressed", on);
    if (!on) this.page.controls.welcome();
    else if (name === "pick")
      this.hint("Click or tap the section: the periodic orbit nearest to that point is found.");
    else this.hint("Drag a box on the section: it fills the view then.");
  }
}
