/*
 * The atlas as a map: the share of regular motion over k and E/g^2. Beside it is a small section of
 * the place under the pointer. A click, or arrow keys and Enter, go there.
 */
const PEEK = { orbits: 24, impacts: 250 };
class AtlasView {
  constructor(page, goTo) {
    this.page = page; // its state has the present place
    this.aim = null; // [log10 of E/g^2, k]: the keyboard's pointer
    const { atlas } = page.data;
    element("tab-atlas").hidden = !atlas; // there is none without the sweeps
    if (!atlas) return;
    this.atlas = { ...atlas, bytes: Uint8Array.from(atob(atlas.regular), (letter) => letter.charCodeAt(0)) };
    this.canvas = element("atlas");
    this.listen(([logarithm, k]) => {
      goTo(...[k, 10 ** logarithm].map((value) => Number(value.toPrecision(3))));
    });
  }

  listen(goTo) {
    const { canvas } = this;
    const at = (event) => {
      const { left, top } = canvas.getBoundingClientRect();
      return this.plot.valuesAt(event.clientX - left, event.clientY - top);
    };
    const logs = this.atlas.energy.map(Math.log10);
    const clamp = (list, value) => Math.min(list.at(-1), Math.max(list[0], value));
    const within = ([logarithm, k]) => [clamp(logs, logarithm), clamp(this.atlas.k, k)];
    canvas.addEventListener("click", (event) => goTo(within(at(event))));
    canvas.addEventListener("pointermove", (event) => this.tell(within(at(event))));
    canvas.addEventListener("pointerleave", () => this.tell());
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    canvas.addEventListener("keydown", (event) => {
      const [across, up] = arrows[event.key] ?? [0, 0];
      const [logarithm, k] = this.aim ?? this.here();
      this.aim = within([logarithm + 0.05 * across, k + 0.01 * up]);
      if (arrows[event.key]) {
        this.draw();
      } else if (event.key === "Enter") {
        goTo(this.aim);
        this.aim = null;
      } else return;
      event.preventDefault();
    });
    canvas.addEventListener("blur", () => {
      this.aim = null;
      this.draw();
    });
  }

  /** The present place, [log10 of E/g^2, k]; the logarithm is -Infinity for E <= 0. */
  here() {
    const { k, g, energy } = this.page.state;
    return [Math.log10(Math.max(0, energy / (g * g))), k];
  }

  draw() {
    if (!this.atlas || element("panel-atlas").hidden) return;
    const { pen, width, height } = fitted(this.canvas);
    const colours = readColours();
    const { k, energy, bytes, steps } = this.atlas;
    const logs = energy.map(Math.log10);
    const frame = { left: 48, top: 24, right: 12, bottom: 38 };
    const plot =
      new Plot(pen, { width, height, frame, colours, across: [logs[0], logs.at(-1)], up: [k[0], k.at(-1)] });
    const image = new OffscreenCanvas(energy.length, k.length);
    const paper = image.getContext("2d");
    const cells = paper.createImageData(energy.length, k.length);
    const pixels = new Uint32Array(cells.data.buffer);
    for (let i = 0; i < k.length; i++) {
      for (let j = 0; j < energy.length; j++) {
        const byte = bytes[i * energy.length + j];
        pixels[(k.length - 1 - i) * energy.length + j] = packed(shade(byte > steps ? NaN : byte / steps));
      }
    }
    paper.putImageData(cells, 0, 0);
    const [left, top] = plot.at([logs[0], k.at(-1)]);
    pen.drawImage(image, left, top, ...plot.size);
    for (const value of [0.05, 0.1, 0.15, 0.2, 0.25, 0.3]) {
      write(pen, value, left - 6, plot.at([logs[0], value])[1], colours.muted, "right", "middle");
    }
    for (const value of [0.1, 0.3, 1, 3, 10, 30]) {
      write(pen, value, plot.at([Math.log10(value), k[0]])[0],
        top + plot.size[1] + 5, colours.muted, "center");
    }
    write(pen, "k", 4, 3, colours.ink);
    write(pen, "E/g²", width - frame.right, height - 2, colours.ink, "right", "bottom");
    write(pen, "dark: chaotic · light: regular", width - frame.right, 4, colours.ink, "right");
    const here = this.here();
    if (here[0] > -Infinity) drawRing(pen, plot.at(here), 7, "#000000", "#ffffff");
    if (this.aim) drawRing(pen, plot.at(this.aim), 7, "#000000", "#ff7fc0");
    this.plot = plot;
    this.tell(this.aim ?? this.shown);
  }

  /** Say what is at a point, and show its section; without one, that of the present place. */
  tell(point) {
    this.shown = point;
    this.peeking ??= requestAnimationFrame(() => {
      this.peeking = null;
      const { k, g, energy } = this.page.state;
      if (this.shown) this.peek(this.shown[1], 10 ** this.shown[0]);
      else this.peek(k, energy / (g * g));
    });
    if (!point) {
      setText("atlas-note", "");
      return;
    }
    const { k, energy, bytes, steps } = this.atlas;
    const nearest = (list, value) => {
      const distances = list.map((entry) => Math.abs(entry - value));
      return distances.indexOf(Math.min(...distances));
    };
    const byte = bytes[nearest(k, point[1]) * energy.length + nearest(energy.map(Math.log10), point[0])];
    const share = byte > steps ? "unknown" : `${Math.round((100 * byte) / steps)} %`;
    setText("atlas-note",
      `k = ${shortNumber(point[1], 3)}, E/g² = ${shortNumber(10 ** point[0], 3)}: regular share ${share}`);
  }

  /** Draw a few short orbits of a ball as points of the disk; g changes the scale only. */
  peek(k, ratio) {
    const { pen, width, height } = fitted(element("peek"));
    const colours = readColours();
    const size = 0.5 * Math.min(width, height) - 3;
    const middle = [0.5 * width, 0.5 * height];
    strokePath(pen, colours.rim, 1.5, () => pen.arc(...middle, size, 0, 2 * Math.PI));
    const { centre, radius, height: tall } = geometry.section(k, 1, ratio);
    pen.fillStyle = colours.ink;
    for (let i = 0; i < PEEK.orbits; i++) {
      const start = pseudorigid.start(k, 1, ratio, (2 * i + 1) / PEEK.orbits - 1);
      const { x, xdot, udot } = pseudorigid.history(k, 1, ...start, PEEK.impacts);
      for (let j = 0; j < PEEK.impacts; j++) {
        const across = (x[j] - centre) / radius;
        const up = (xdot[j] - k * udot[j]) / tall;
        pen.fillRect(middle[0] + size * across - 0.5, middle[1] - size * up - 0.5, 1, 1);
      }
    }
  }
}

/** A share of regular motion as a colour of more_figures/atlas/plane.png; grey where unknown. */
function shade(share) {
  if (Number.isNaN(share)) return "#e0e0e0";
  const viridis = "#440154 #472d7b #3b528b #2c728e #21918c #28ae80 #5ec962 #addc30 #fde725".split(" ");
  return mixed(viridis, share);
}
