/*
 * The section: a disk in (x, y), or the half ellipsoid of Figure 2, on canvases: the ground with its
 * axes, the section in colour, the impacts of orbits, lines over them, and cursors. Impacts are counted
 * pixel by pixel, in a density image. For a file all are drawn anew: at another `ratio` of pixels, or by
 * an `svg` pen.
 */
const SNAP = 4; // pixels from the symmetry line within which a start lies on it
const ABOVE = { azimuth: 270, elevation: 90 };
const LAYERS = ["ground", "map", "points", "lines", "cursors"];
const SEEN = 5000; // impacts of an orbit among which the pointer looks
const SOLID = 65535; // hits of a pixel that is drawn in full

class SectionView {
  constructor(box, read, { ratio = null, svg = null, light = null } = {}) {
    this.box = box;
    this.read = read; // returns {state, orbits, overlays, cursor} of the page
    this.given = ratio;
    this.svg = svg;
    this.light = light; // an element with the light theme's colours, for a file
    this.layers = (svg ? [] : LAYERS).map((name) => {
      const canvas = document.createElement("canvas");
      canvas.className = name;
      box.append(canvas);
      return canvas;
    });
    const pens = this.layers.map((canvas) => canvas.getContext("2d"));
    [this.ground, this.map, this.points, this.lines, this.cursors] = svg ? LAYERS.map(() => svg) : pens;
    this.cross = null; // the keyboard's pointer on the screen
    this.fan = null; // [p, p] of the fan that is being drawn
    this.corners = null; // of the box that is being drawn, on the screen
    this.touched = null; // the orbit under the pointer
    this.resize();
  }

  resize() {
    const { width, height } = this.box.getBoundingClientRect();
    this.width = Math.max(50, Math.round(width));
    this.height = Math.max(50, Math.round(height));
    this.ratio = this.given ?? Math.min(3, window.devicePixelRatio || 1);
    for (const canvas of this.layers) {
      canvas.width = Math.round(this.width * this.ratio);
      canvas.height = Math.round(this.height * this.ratio);
    }
    for (const pen of [this.ground, this.map, this.lines, this.cursors]) {
      pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    }
    if (!this.svg) {
      this.image = this.points.createImageData(this.points.canvas.width, this.points.canvas.height);
      this.pixels = new Uint32Array(this.image.data.buffer);
      this.inks = new Uint32Array(this.pixels.length); // the colour of the last impact on each pixel
      this.hits = new Uint16Array(this.pixels.length); // impacts on it
    }
    this.look();
  }

  /** Take over the colours and the view, and draw everything. */
  look() {
    this.colours = readColours(this.light ?? document.documentElement);
    this.project();
    this.drawGround();
    this.drawMap();
    this.drawPoints();
    this.drawLines();
    this.drawCursors();
  }

  /** Prepare the numbers of `place` and `screen` from the state. */
  project() {
    const { state } = this.read();
    const { k, g, energy, view } = state;
    this.section = geometry.section(k, g, energy);
    const { centre, radius, height } = this.section;
    Object.assign(this, { k, centre, radius, sectionHeight: height, kind: view.kind });
    const disk = view.kind === "disk";
    // Seen from above, along the axis of udot, the half ellipsoid is the plane (x, xdot) of Figure 6.
    this.framed = disk || (view.elevation === ABOVE.elevation && view.azimuth === ABOVE.azimuth);
    const margin =
      this.framed ? { left: !disk ? 62 : view.half > 0.02 ? 52 : 66, top: 10, right: 10, bottom: 40 } : null;
    this.frame = margin ?? { left: 6, top: 6, right: 6, bottom: 6 };
    this.wide = this.width - this.frame.left - this.frame.right;
    this.tall = this.height - this.frame.top - this.frame.bottom;
    this.middle = [this.frame.left + this.wide / 2, this.frame.top + this.tall / 2];
    this.scale = Math.min(this.wide, this.tall) / 2 / view.half; // pixels in a section radius
    if (disk) {
      this.origin = [centre + view.x * radius, view.y * height];
      return;
    }
    const degree = Math.PI / 180;
    const [sa, ca] = [Math.sin(view.azimuth * degree), Math.cos(view.azimuth * degree)];
    const [se, ce] = [Math.sin(view.elevation * degree), Math.cos(view.elevation * degree)];
    this.across = [-sa, ca, 0];
    this.up = [-se * ca, -se * sa, ce];
    this.eye = [ce * ca, ce * sa, se];
    this.eyeSquare = k * this.eye[0] ** 2 + this.eye[1] ** 2 + k * this.eye[2] ** 2;
    // The surface turns around a point within it, so that it is in the middle as the paper shows it.
    const w = (0.2 * radius) / Math.sqrt(1 + k);
    const pivot = [0, k * w, w];
    const along = (axis) => axis[0] * pivot[0] + axis[1] * pivot[1] + axis[2] * pivot[2];
    this.origin = [along(this.across) + view.x * radius, along(this.up) + view.y * radius];
  }

  /** Where a state is on the screen: [across, down], or null where the surface hides it. */
  screen(x, v, w) {
    const { origin, middle, k } = this;
    if (this.kind === "disk") {
      return [
        middle[0] + ((x - origin[0]) / this.radius) * this.scale,
        middle[1] - ((v - k * w - origin[1]) / this.sectionHeight) * this.scale,
      ];
    }
    const dx = x - this.centre;
    const [e0, e1, e2] = this.eye;
    const facing = k * dx * e0 + v * e1 + k * w * e2;
    if (facing < -1e-9 * this.radius) {
      const t = (-2 * facing) / this.eyeSquare;
      if (v + t * e1 + w + t * e2 >= 0) return null;
    }
    return this.flat(dx, v, w);
  }

  flat(dx, v, w) {
    const { across, up, origin, middle, radius, scale } = this;
    return [
      middle[0] + ((across[0] * dx + across[1] * v - origin[0]) / radius) * scale,
      middle[1] - ((up[0] * dx + up[1] * v + up[2] * w - origin[1]) / radius) * scale,
    ];
  }

  /** The place [p, q] under a point of the screen, on the symmetry line if near; null if none. */
  place(left, top) {
    const place = this.placeOf(left, top);
    return place && this.distanceFromLine(left, top, place[0]) <= SNAP ? [place[0], 0] : place;
  }

  placeOf(left, top) {
    const across = (left - this.middle[0]) / this.scale;
    const up = (this.middle[1] - top) / this.scale;
    let p;
    let q;
    if (this.kind === "disk") {
      p = (this.origin[0] - this.centre) / this.radius + across;
      q = this.origin[1] / this.sectionHeight + up;
    } else {
      const hit = this.surfacePoint(across * this.radius + this.origin[0], up * this.radius + this.origin[1]);
      if (!hit) return null;
      p = hit[0] / this.radius;
      q = (hit[1] - this.k * hit[2]) / this.sectionHeight;
    }
    return p * p + q * q < 1 ? [p, q] : null;
  }

  /** The nearest point of the half ellipsoid at a position of the screen, from its centre. */
  surfacePoint(a, b) {
    const { k, radius, eye, across, up } = this;
    const base = [0, 1, 2].map((i) => a * across[i] + b * up[i]);
    const half = k * base[0] * eye[0] + base[1] * eye[1] + k * base[2] * eye[2];
    const rest = k * base[0] ** 2 + base[1] ** 2 + k * base[2] ** 2 - k * radius * radius;
    const root = half * half - this.eyeSquare * rest;
    if (!(root >= 0)) return null;
    for (const sign of [1, -1]) {
      const t = (-half + sign * Math.sqrt(root)) / this.eyeSquare;
      const point = base.map((value, i) => value + t * eye[i]);
      if (point[1] + point[2] >= 0) return point;
    }
    return null;
  }

  /** Distance in pixels of a point of the screen from the symmetry line's part near p. */
  distanceFromLine(left, top, p) {
    let least = Infinity;
    const reach = this.kind === "disk" ? [0] : [-4, -3, -2, -1, 0, 1, 2, 3, 4];
    for (const step of reach) {
      const f = p + (step * 3) / this.scale;
      if (!(Math.abs(f) < 1)) continue;
      const at = this.screen(...this.lineState(f));
      if (at) least = Math.min(least, Math.hypot(at[0] - left, at[1] - top));
    }
    if (this.kind === "disk") {
      least = Math.abs(this.middle[1] + (this.origin[1] / this.sectionHeight) * this.scale - top);
    }
    return least;
  }

  /** The state on y = 0 at a fraction, for drawing. */
  lineState(p) {
    const w = this.radius * Math.sqrt(Math.max(0, (1 - p) * (1 + p)) / (1 + this.k));
    return [this.centre + p * this.radius, this.k * w, w];
  }

  inside([left, top]) {
    const { frame } = this;
    return left >= frame.left && left <= this.width - frame.right &&
      top >= frame.top && top <= this.height - frame.bottom;
  }

  drawGround() {
    const { ground, colours } = this;
    ground.clearRect(0, 0, this.width, this.height);
    ground.fillStyle = colours.surface;
    ground.font = colours.font;
    if (this.kind === "disk") this.drawDisk();
    else this.drawHalfEllipsoid();
    if (!this.framed) {
      this.drawBox();
      return;
    }
    const { frame, origin, centre, radius, scale, wide, tall } = this;
    ground.strokeStyle = colours.line;
    ground.strokeRect(frame.left, frame.top, wide, tall);
    const disk = this.kind === "disk";
    this.drawAxis(0, "x", wide, disk ? origin[0] : centre + origin[0], radius / scale);
    this.drawAxis(1, disk ? "y = ẋ − k u̇" : "ẋ⁻", tall,
      origin[1], (disk ? this.sectionHeight : radius) / scale);
  }

  /** Draw which colours mean which rotation numbers, exponents or verdicts. */
  drawScale() {
    const { lines, colours } = this;
    const { scale } = this.read();
    if (!scale) return;
    const small = this.width < 450; // a phone
    const { unit } = colours;
    const step = unit * (small ? 1 : 2); // pixels of one of 80 colours
    const line = 18 * unit;
    lines.font = colours.font;
    if (!scale.range) {
      const side = 13 * unit;
      const swatch = (name) => (left, middle) => {
        lines.fillStyle = colours[name];
        lines.fillRect(left, middle - side / 2, side, side);
        lines.strokeStyle = colours.muted;
        lines.strokeRect(left, middle - side / 2, side, side);
      };
      const rows = ["regular", "chaotic", "undecided"].map((name) => [name, swatch(name)]);
      this.drawRows([...rows, ...scale.notes.map((note) => [note, null])], true);
      return;
    }
    lines.fillStyle = colours.page;
    const [left, top] = [this.width - this.frame.right - 80 * step - 16, this.frame.top + 8];
    lines.fillRect(left - 8, top - 5, 80 * step + 18, 3 * line);
    for (let i = 0; i < 80; i++) {
      lines.fillStyle = mixed(colours.ramp, i / 79);
      lines.fillRect(left + step * i, top + line, step + 0.5, 9 * unit);
    }
    const title = small ? scale.name.split(",")[0] : scale.name;
    write(lines, title, left + 80 * step, top, colours.ink, "right");
    write(lines, shortNumber(scale.range[0], 3), left, top + line + 12 * unit, colours.muted);
    write(lines, shortNumber(scale.range[1], 3), left + 80 * step,
      top + line + 12 * unit, colours.muted, "right");
  }

  /** Draw what branches, curves and marks mean, those that are there, at the left bottom. */
  drawLegend() {
    const { lines, colours, frame } = this;
    const { overlays } = this.read();
    const names = { stable: "stable branch", unstable: "unstable branch",
      symmetry: "the map jumps", jump: "its inverse jumps" };
    const shapes = { dot: "elliptic", cross: "hyperbolic", square: "inverse hyperbolic" };
    const drawn = (name) => overlays.lines.find(({ colour }) => colour === name);
    const stroke = (name) => (left, middle) => {
      lines.fillStyle = colours[name];
      lines.fillRect(left, middle - 1, 18 * colours.unit, 2.5);
    };
    const rows = Object.keys(names).filter(drawn).map((name) => [names[name], stroke(name)]);
    for (const [shape, name] of Object.entries(shapes)) {
      const one = this.marks.find((mark) => mark.shape === shape);
      const sign = (left, middle) => this.mark(lines, [left + 9, middle], colours[one.colour], shape);
      if (one) rows.push([name, sign]);
    }
    if (rows.length) this.drawRows(rows, false);
  }

  /** Draw rows of a legend, [text, a function that draws its sign at a point, or null], in a corner. */
  drawRows(rows, right) {
    const { lines, colours, frame } = this;
    const tall = (this.width < 450 ? 15 : 18) * colours.unit;
    const room = 26 * colours.unit;
    const wide =
      room + 7 * colours.unit * Math.max(...rows.map(([text, sign]) => text.length - (sign ? 0 : 3)));
    const left = right ? this.width - frame.right - wide - 8 : frame.left + 8;
    const top = right ? frame.top + 6 : this.height - frame.bottom - 6 - tall * rows.length;
    lines.font = this.width < 450 ? `${11 * colours.unit}px ${colours.family}` : colours.font;
    lines.fillStyle = colours.page;
    lines.fillRect(left - 4, top - 3, wide + 8, tall * rows.length + 6);
    rows.forEach(([text, sign], i) => {
      const middle = top + tall * (i + 0.5);
      sign?.(left, middle);
      write(lines, text, sign ? left + room : left, middle,
        sign ? colours.ink : colours.muted, "left", "middle");
    });
  }

  drawDisk() {
    const { ground, frame, middle, scale, wide, tall } = this;
    ground.save();
    this.clip(ground);
    const across = middle[0] - ((this.origin[0] - this.centre) / this.radius) * scale;
    const down = middle[1] + (this.origin[1] / this.sectionHeight) * scale;
    ground.beginPath();
    if (scale < 1e5) {
      ground.arc(across, down, scale, 0, 2 * Math.PI);
      ground.fill();
    } else if (this.place(...middle)) {
      ground.rect(frame.left, frame.top, wide, tall); // far inside the rim
      ground.fill();
    }
    ground.restore();
  }

  /** Draw an axis of the frame, around a value at its centre; a pixel is `unit` long. */
  drawAxis(index, name, length, centre, unit) {
    const { ground, colours, frame, middle } = this;
    const { offsets, labels, base } = ticksAround(centre, length * unit, length / (index ? 60 : 90));
    const bottom = this.height - frame.bottom;
    offsets.forEach((offset, i) => {
      const at = index ? middle[1] - offset / unit : middle[0] + offset / unit;
      if (index) write(ground, labels[i], frame.left - 7, at, colours.muted, "right", "middle");
      else write(ground, labels[i], at, bottom + 6, colours.muted, "center");
      ground.fillStyle = colours.line;
      if (index) ground.fillRect(frame.left - 4, at, 4, 1);
      else ground.fillRect(at, bottom, 1, 4);
    });
    const title = base ? `${name} − (${base})` : name;
    if (index) write(ground, title, frame.left + 8, frame.top + 8, colours.ink);
    else write(ground, title, this.width - frame.right - 8, bottom - 6, colours.ink, "right", "bottom");
  }

  drawHalfEllipsoid() {
    const { ground, colours, radius, k } = this;
    ground.save();
    this.clip(ground);
    ground.beginPath();
    if (this.scale > 1e4) {
      if (this.place(...this.middle)) ground.fillRect(0, 0, this.width, this.height);
    } else {
      // One sees what is inside its rim, and inside its outline against the eye.
      const [e0, e1, e2] = this.eye;
      const turns = Array.from({ length: 720 }, (_, i) => (i * Math.PI) / 360);
      const rim = turns.map((a) => {
        const w = (-Math.sin(a) * this.sectionHeight) / (1 + k);
        return this.flat(Math.cos(a) * radius, -w, w);
      });
      // On the unit sphere, (dx, v / sqrt(k), w) / radius, the outline is at right angles to this.
      const pole = [k * e0, Math.sqrt(k) * e1, k * e2];
      const level = Math.hypot(pole[0], pole[1]);
      const side = [-pole[1] / level, pole[0] / level, 0];
      const size = Math.hypot(...pole);
      const top = [(-pole[0] * pole[2]) / level / size, (-pole[1] * pole[2]) / level / size, level / size];
      const outline = turns
        .map((a) => side.map((value, i) => radius * (Math.cos(a) * value + Math.sin(a) * top[i])))
        .map(([dx, v, w]) => [dx, v * Math.sqrt(k), w])
        .filter(([, v, w]) => v + w >= 0);
      for (const corners of [rim, outline.map((point) => this.flat(...point))]) {
        ground.fillStyle = colours.surface;
        ground.beginPath();
        corners.forEach((corner) => ground.lineTo(...corner));
        ground.fill();
      }
    }
    ground.restore();
  }

  /** Draw axes with numbers at edges of a box around the half ellipsoid, or around its part in the middle. */
  drawBox() {
    const { ground, colours, radius, k } = this;
    const low = -radius * Math.sqrt(k / (1 + k));
    // a part is half as tall as the view
    const size = (radius * Math.min(this.width, this.height)) / 4 / this.scale;
    const point = size < radius / 3 && this.surfacePoint(...this.origin);
    const whole = [[-radius, radius], [low, radius * Math.sqrt(k)], [low, radius]];
    const ranges = point ? point.map((value) => [value - size, value + size]) : whole;
    const middle = this.flat(...ranges.map(([a, b]) => 0.5 * (a + b)));
    const put = (text, [left, top], colour) => {
      const half = 3 + 3.6 * text.length;
      if (Math.abs(left - 0.5 * this.width) > 0.5 * this.width + 30) return; // out of sight
      write(ground, text, Math.min(this.width - half, Math.max(half, left)), top, colour, "center", "middle");
    };
    ["x", "ẋ⁻", "u̇⁻"].forEach((name, axis) => {
      const others = [0, 1, 2].filter((i) => i !== axis);
      const at = (value, corner) =>
        this.flat(...ranges.map((range, i) => (i === axis ? value : range[corner[others.indexOf(i)]])));
      const [from, to] = ranges[axis];
      const half = 0.5 * (from + to);
      // The edge furthest from the middle: downwards for x and xdot, to the left for udot.
      const reach = (corner) => (axis === 2 ? -at(half, corner)[0] : at(half, corner)[1]);
      const edge = [[0, 0], [0, 1], [1, 0], [1, 1]].reduce((a, b) => (reach(b) > reach(a) + 1e-6 ? b : a));
      const ends = [at(from, edge), at(to, edge)];
      const length = Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
      if (length < 40) return; // seen along it
      let out = [-(ends[1][1] - ends[0][1]) / length, (ends[1][0] - ends[0][0]) / length];
      const [left, top] = at(half, edge);
      if (out[0] * (left - middle[0]) + out[1] * (top - middle[1]) < 0) out = out.map((value) => -value);
      strokePath(ground, colours.muted, 1, () => ends.forEach((end) => ground.lineTo(...end)));
      const { offsets, labels, base } =
        ticksAround(half + (axis ? 0 : this.centre), to - from, Math.max(length / 44, 4));
      const beside = ([a, b], away) => [a + away * out[0], b + away * out[1]];
      offsets.forEach((offset, i) => {
        const tick = at(half + offset, edge);
        strokePath(ground, colours.muted, 1,
          () => [tick, beside(tick, 5)].forEach((end) => ground.lineTo(...end)));
        put(labels[i], beside(tick, 13 + 3.6 * labels[i].length * Math.abs(out[0])), colours.muted);
      });
      const title = base ? `${name} − (${base})` : name;
      const letters = Math.max(...labels.map((label) => label.length)) + 0.5 * title.length;
      const place = axis === 2 ? [ends[1][0], Math.min(ends[0][1], ends[1][1]) - 16]
        : beside([left, top], 26 + 7 * letters * Math.abs(out[0]));
      put(title, place, colours.ink);
    });
    ground.lineWidth = 1;
  }

  drawPoints() {
    this.inks?.fill(0);
    this.hits?.fill(0);
    [this.spread, this.visited] = [0, 0]; // impacts of the sea, and pixels that they are on
    const { orbits, filling } = this.read();
    const rank = (orbit) => (orbit.chosen ? 2 : orbit.isSea() ? 0 : 1);
    const order = [...filling, ...orbits].sort((a, b) => rank(a) - rank(b));
    for (const orbit of order) this.plot(orbit, orbit, 0, orbit.kept);
    this.showPoints();
  }

  /** Draw the density image: pixels of the sea are as dark as they have impacts beside the mean. */
  showPoints() {
    if (this.svg) return;
    const { pixels, inks, hits } = this;
    const half = 0.5 * Math.max(0, this.spread / Math.max(1, this.visited) - 1);
    const alpha = Uint8Array.from({ length: 256 }, (_, n) => 255 * Math.max(0.2, n / (n + half || 1)));
    for (let i = 0; i < pixels.length; i++) {
      const n = hits[i];
      if (n < 256) pixels[i] = (inks[i] & 0xffffff) | (n && alpha[n] << 24);
      else pixels[i] = (inks[i] & 0xffffff) | ((n === SOLID ? 255 : 255 * (n / (n + half))) << 24);
    }
    this.points.putImageData(this.image, 0, 0);
  }

  /** Add impacts of an orbit, from one to before another, to the pixels. */
  plot(orbit, states, from, to) {
    const { inks, hits, image, ratio, svg } = this;
    const colour = orbit.colour(this.colours);
    const sea = orbit.isSea();
    const size = orbit.chosen && !sea ? 3 : sea && !orbit.few ? 0.7 : 1.7;
    if (svg) {
      const places = [];
      this.eachPoint(states, from, to, 1, size, (left, top) => places.push(left, top));
      svg.dots(places, size, colour);
      return;
    }
    const width = Math.max(1, Math.round(size * ratio));
    const wide = image.width;
    const ink = packed(colour);
    this.eachPoint(states, from, to, ratio, width, (column, row) => {
      const first = Math.round(row - width / 2) * wide + Math.round(column - width / 2);
      for (let a = 0; a < width; a++) {
        for (let b = first + a * wide; b < first + a * wide + width; b++) {
          inks[b] = ink;
          if (!sea) hits[b] = SOLID;
          else if (hits[b] < SOLID - 1) {
            this.spread += 1;
            if (!hits[b]) this.visited += 1;
            hits[b] += 1;
          }
        }
      }
    });
  }

  /** Call `act` with the place of each impact that is in sight, as `screen` has it, times a ratio. */
  eachPoint({ x, xdot, udot }, from, to, ratio, size, act) {
    const { frame, k, centre, radius } = this;
    const left = frame.left * ratio + size / 2;
    const top = frame.top * ratio + size / 2;
    const right = (this.width - frame.right) * ratio - size / 2;
    const bottom = (this.height - frame.bottom) * ratio - size / 2;
    const scale = (this.scale * ratio) / radius;
    const [mx, my] = [this.middle[0] * ratio, this.middle[1] * ratio];
    const [ox, oy] = this.origin;
    if (this.kind === "disk") {
      const fy = (this.scale * ratio) / this.sectionHeight;
      for (let i = from; i < to; i++) {
        const column = mx + (x[i] - ox) * scale;
        const row = my - (xdot[i] - k * udot[i] - oy) * fy;
        if (column >= left && row >= top && column <= right && row <= bottom) act(column, row);
      }
      return;
    }
    const [[e0, e1, e2], [a0, a1], [u0, u1, u2]] = [this.eye, this.across, this.up];
    const through = (-2 * (e1 + e2)) / this.eyeSquare;
    for (let i = from; i < to; i++) {
      const dx = x[i] - centre;
      const v = xdot[i];
      const w = udot[i];
      const facing = k * dx * e0 + v * e1 + k * w * e2;
      if (facing < -1e-9 * radius && v + w + facing * through >= 0) continue;
      const column = mx + (a0 * dx + a1 * v - ox) * scale;
      const row = my - (u0 * dx + u1 * v + u2 * w - oy) * scale;
      if (column >= left && row >= top && column <= right && row <= bottom) act(column, row);
    }
  }

  /** The part of the section in sight, as ranges of p and q; null if there is none. */
  window() {
    const { left, top } = this.frame;
    const clamped = (values) => values.map((value) => Math.min(1, Math.max(-1, value)));
    if (this.kind === "disk") {
      const [p, q] = [(this.origin[0] - this.centre) / this.radius, this.origin[1] / this.sectionHeight];
      const [across, up] = [this.wide, this.tall].map((length) => length / 2 / this.scale);
      const found = { p: clamped([p - across, p + across]), q: clamped([q - up, q + up]) };
      return found.p[0] < found.p[1] && found.q[0] < found.q[1] ? found : null;
    }
    const range = { p: [Infinity, -Infinity], q: [Infinity, -Infinity] };
    for (let i = 0; i <= 60; i++) {
      for (let j = 0; j <= 60; j++) {
        const place = this.placeOf(left + (this.wide * i) / 60, top + (this.tall * j) / 60);
        if (!place) continue;
        ["p", "q"].forEach((name, n) => {
          range[name] = [Math.min(range[name][0], place[n]), Math.max(range[name][1], place[n])];
        });
      }
    }
    if (!(range.p[0] < range.p[1] && range.q[0] < range.q[1])) return null;
    for (const [name, [low, high]] of Object.entries(range)) {
      const room = (high - low) / 12; // beyond the points that were tried
      range[name] = clamped([low - room, high + room]);
    }
    return range;
  }

  /** Where in a window each pixel of the map is: shares across and up, NaN outside the section. */
  shares({ p, q }) {
    const { state } = this.read();
    const key = JSON.stringify([state.view, state.k, this.width, this.height, p, q]);
    if (this.sharesOf === key) return this.sharesTable;
    const step = 1 / Math.min(2, this.ratio);
    const [wide, tall] = [Math.floor(this.width / step), Math.floor(this.height / step)];
    const table = new Float32Array(2 * wide * tall).fill(NaN);
    for (let row = 0; row < tall; row++) {
      for (let column = 0; column < wide; column++) {
        const [left, top] = [(column + 0.5) * step, (row + 0.5) * step];
        if (!this.inside([left, top])) continue;
        const place = this.placeOf(left, top);
        if (!place) continue;
        table[2 * (row * wide + column)] = (place[0] - p[0]) / (p[1] - p[0]);
        table[2 * (row * wide + column) + 1] = (place[1] - q[0]) / (q[1] - q[0]);
      }
    }
    Object.assign(this, { sharesOf: key, sharesTable: { table, wide, tall, cells: new Map() } });
    return this.sharesTable;
  }

  /** The cell of a grid under each pixel of the map; beyond the last one outside the section. */
  cellsOf(window, size) {
    const { table, wide, tall, cells } = this.shares(window);
    if (cells.has(size)) return cells.get(size);
    const found = Uint32Array.from({ length: wide * tall }, (_, i) => {
      const [across, up] = [table[2 * i], table[2 * i + 1]];
      if (!(across >= 0 && across < 1 && up >= 0 && up < 1)) return size * size;
      return Math.floor(up * size) * size + Math.floor(across * size);
    });
    cells.set(size, found);
    return found;
  }

  /** Draw the section in colour, if it is. */
  drawMap() {
    const { map } = this.read();
    this.map.clearRect(0, 0, this.width, this.height);
    if (!map?.window) return;
    const { wide, tall } = this.shares(map.window);
    const image = new ImageData(wide, tall);
    const pixels = new Uint32Array(image.data.buffer);
    for (const { size, inks } of map.layers(this.colours)) {
      const cells = this.cellsOf(map.window, size);
      for (let i = 0; i < pixels.length; i++) if (pixels[i] === 0) pixels[i] = inks[cells[i]];
    }
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [wide, tall];
    canvas.getContext("2d").putImageData(image, 0, 0);
    this.map.drawImage(canvas, 0, 0, this.width, this.height);
  }

  drawLines() {
    const { lines, colours, centre, radius, k } = this;
    const { overlays } = this.read();
    lines.clearRect(0, 0, this.width, this.height);
    lines.save();
    this.clip(lines);
    const ring = Array.from({ length: 361 }, (_, i) => (i * Math.PI) / 180);
    const y = ring.map((a) => this.sectionHeight * Math.sin(a));
    const rim = {
      x: ring.map((a) => centre + radius * Math.cos(a)),
      xdot: y.map((value) => value / (1 + k)),
      udot: y.map((value) => -value / (1 + k)),
    };
    if (this.scale < 1e5) this.stroke(lines, rim, colours.rim, 1.5);
    const states =
      Array.from({ length: 201 }, (_, i) => this.lineState(Math.sin(((i - 100) * Math.PI) / 200)));
    const [lx, lv, lw] = [0, 1, 2].map((i) => states.map((state) => state[i]));
    lines.setLineDash([5, 4]);
    this.stroke(lines, { x: lx, xdot: lv, udot: lw }, colours.symmetry, 1);
    lines.setLineDash([]);
    for (const { line, colour, width, share = 1 } of overlays.lines) {
      this.stroke(lines, line, colours[colour], width, Math.ceil(share * line.x.length));
    }
    this.marks = []; // those that are drawn: no two in one place
    for (const mark of overlays.marks) {
      const places =
        mark.orbit.points.map(([x, v, w]) => this.screen(x, v, w)).filter((at) => at && this.inside(at));
      const free = places.filter((at) => !this.markAt(at));
      for (const at of free) this.mark(lines, at, colours[mark.colour], mark.shape);
      const label = free.find(([left, top]) =>
        !this.marks.some(({ at }) => Math.hypot(at[0] - left - 8, at[1] - top + 8) < 16));
      this.marks.push(...free.map((at) => ({ ...mark, at })));
      lines.font = colours.font;
      if (label) write(lines, mark.orbit.period, label[0] + 7, label[1] - 16, colours.ink);
    }
    for (const [text, state] of overlays.starts) this.label(lines, text, this.screen(...state));
    lines.restore();
    this.drawScale();
    this.drawLegend();
  }

  clip(pen) {
    pen.beginPath();
    pen.rect(this.frame.left, this.frame.top, this.wide, this.tall);
    pen.clip();
  }

  /** The mark of a periodic orbit at a point of the screen. */
  markAt([left, top]) { return this.marks?.find(({ at }) => Math.hypot(at[0] - left, at[1] - top) < 9); }

  /** The orbit with an impact near a point of the screen, a regular one rather than the sea. */
  orbitAt([left, top]) {
    const { orbits, filling } = this.read();
    const near = (orbit) => {
      let least = 6;
      const measure = (a, b) => (least = Math.min(least, Math.hypot(a - left, b - top)));
      this.eachPoint(orbit, 0, Math.min(orbit.kept, SEEN), 1, 1, measure);
      return least;
    };
    const found = [...orbits, ...filling].map((orbit) => [orbit, near(orbit) + (orbit.isSea() ? 4 : 0)]);
    const [best] = found.sort((a, b) => a[1] - b[1]);
    return best && best[1] < 6 ? best[0] : null;
  }

  stroke(pen, { x, xdot, udot }, colour, width, count = x.length) {
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.lineJoin = "bevel";
    pen.beginPath();
    let down = false;
    let before = null;
    const far = 20 * (this.width + this.height);
    for (let i = 0; i < count; i++) {
      const at = Number.isNaN(x[i]) ? null : this.screen(x[i], xdot[i], udot[i]);
      // Far outside, a canvas would lose digits of what it draws.
      const drawn = at && Math.abs(at[0]) < far && Math.abs(at[1]) < far;
      if (drawn && down) pen.lineTo(...at);
      else if (drawn) {
        if (before) {
          pen.moveTo(...cut(at, before, far));
          pen.lineTo(...at);
        } else pen.moveTo(...at);
      } else if (down && at) pen.lineTo(...cut(before, at, far));
      down = Boolean(drawn);
      before = at;
    }
    pen.stroke();
    pen.lineWidth = 1;
  }

  mark(pen, at, colour, shape) {
    if (!at || !this.inside(at)) return;
    const [left, top] = at;
    pen.beginPath();
    if (shape === "square") pen.rect(left - 4, top - 4, 8, 8);
    else if (shape === "cross") {
      pen.moveTo(left - 5, top - 5);
      pen.lineTo(left + 5, top + 5);
      pen.moveTo(left + 5, top - 5);
      pen.lineTo(left - 5, top + 5);
    } else pen.arc(left, top, 4.5, 0, 2 * Math.PI);
    pen.strokeStyle = this.colours.page;
    pen.lineWidth = 3.5;
    pen.stroke();
    pen.strokeStyle = colour;
    pen.fillStyle = colour;
    pen.lineWidth = 2;
    if (shape === "dot") pen.fill();
    pen.stroke();
    pen.lineWidth = 1;
  }

  /** Draw a number in a ring at a start. */
  label(pen, text, at) {
    if (!at) return;
    pen.fillStyle = this.colours.page;
    strokePath(pen, this.colours.ink, 1.5, () => pen.arc(...at, 10 * this.colours.unit, 0, 2 * Math.PI));
    pen.fill();
    write(pen, text, ...at, this.colours.ink, "center", "middle");
  }

  drawCursors() {
    const { cursors, colours } = this;
    const { cursors: moments } = this.read();
    cursors.clearRect(0, 0, this.width, this.height);
    cursors.save();
    this.clip(cursors);
    if (this.touched) {
      cursors.fillStyle = colours.focus;
      const dot = (left, top) => cursors.fillRect(left - 1, top - 1, 2.5, 2.5);
      this.eachPoint(this.touched, 0, Math.min(this.touched.kept, SEEN), 1, 2, dot);
    }
    for (const state of moments) { // where the balls in time are
      const now = this.screen(...state);
      if (now) drawRing(cursors, now, 8, colours.page, colours.ink);
    }
    if (this.fan) {
      const [from, to] = this.fan;
      const states = Array.from({ length: 41 }, (_, i) => this.lineState(from + ((to - from) * i) / 40));
      const [x, xdot, udot] = [0, 1, 2].map((i) => states.map((state) => state[i]));
      this.stroke(cursors, { x, xdot, udot }, colours.focus, 4);
    }
    if (this.corners) {
      const [[a, b], [c, d]] = this.corners;
      cursors.strokeStyle = colours.focus;
      cursors.strokeRect(Math.min(a, c), Math.min(b, d), Math.abs(c - a), Math.abs(d - b));
    }
    if (this.cross) {
      const [left, top] = this.cross;
      for (const [colour, width] of [[colours.page, 4], [colours.focus, 1.5]]) {
        strokePath(cursors, colour, width, () => {
          cursors.moveTo(left - 14, top);
          cursors.lineTo(left + 14, top);
          cursors.moveTo(left, top - 14);
          cursors.lineTo(left, top + 14);
        });
      }
    }
    cursors.restore();
  }
}

/** The point of a segment from `near` towards `away` at the edge of a square of half size `far`. */
function cut(near, away, far) {
  let share = 1;
  for (const i of [0, 1]) {
    const step = away[i] - near[i];
    if (step > 0) share = Math.min(share, (far - near[i]) / step);
    else if (step < 0) share = Math.min(share, (-far - near[i]) / step);
  }
  return [near[0] + share * (away[0] - near[0]), near[1] + share * (away[1] - near[1])];
}

/** The colours of the style sheet in an element. */
function readColours(node = document.documentElement) {
  const style = getComputedStyle(node);
  const names = "page panel surface ink muted line rim symmetry stable unstable jump focus sea elliptic";
  const verdicts = "hyperbolic regular chaotic undecided regular-orbit chaotic-orbit";
  const colours = Object.fromEntries(`${names} ${verdicts}`.split(" ")
    .map((n) => [n, style.getPropertyValue(`--${n}`).trim()]));
  colours.hues = [0, 1, 2, 3, 4, 5, 6].map((i) => style.getPropertyValue(`--hue${i}`).trim());
  colours.ramp = style.getPropertyValue("--ramp").trim().split(" ");
  colours.family = getComputedStyle(document.body).fontFamily;
  colours.unit = Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
  colours.font = `${Math.round(13 * colours.unit)}px ${colours.family}`;
  return colours;
}

/** A colour at a share, from 0 to 1, of the way along colours #rrggbb in equal steps. */
function mixed(stops, share) {
  const at = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const index = Math.min(stops.length - 2, Math.floor(at));
  const part = (stop, i) => parseInt(stop.slice(i, i + 2), 16);
  const bytes = [1, 3, 5].map((i) => {
    const [low, high] = [part(stops[index], i), part(stops[index + 1], i)];
    return Math.round(low + (at - index) * (high - low)).toString(16).padStart(2, "0");
  });
  return `#${bytes.join("")}`;
}

/** A colour #rrggbb as a pixel of a canvas (little endian, as all browsers' machines are). */
function packed(colour) {
  const value = parseInt(colour.slice(1), 16);
  return (0xff000000 | ((value & 0xff) << 16) | (value & 0xff00) | (value >> 16)) >>> 0;
}

/**
 * Ticks within a span around a centre, as offsets from it, about `count` of them. Labels are values,
 * or beyond seven digits differences from `base`, a text.
 */
function ticksAround(centre, span, count) {
  const rough = span / Math.max(2, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => size >= rough);
  const digits = Math.ceil(Math.log10((Math.abs(centre) + span) / step)) + 1;
  const zero = digits > 7 ? 0 : centre;
  const first = Math.ceil((zero - span / 2) / step);
  const offsets = [];
  const labels = [];
  for (let n = first; n * step <= zero + span / 2; n++) {
    offsets.push(n * step - zero);
    labels.push(shortNumber(n * step, Math.min(12, Math.max(3, digits))));
  }
  return { offsets, labels, base: digits > 7 ? shortNumber(centre, 17) : "" };
}
