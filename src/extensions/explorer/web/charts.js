/* Plain charts: axes with ticks, lines, dots and a key. */

/** A canvas fitted to its place on the page and cleared: {pen, width, height} in CSS pixels. */
function fitted(canvas) {
  const { width, height } = canvas.getBoundingClientRect();
  const ratio = Math.min(3, window.devicePixelRatio || 1);
  const size = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
  if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
}

/** Write a text at a point. */
function write(pen, text, left, top, colour, align = "left", baseline = "top") {
  pen.fillStyle = colour;
  pen.textAlign = align;
  pen.textBaseline = baseline;
  pen.fillText(text, left, top);
}

/** Draw what `trace` adds to a path. */
function strokePath(pen, colour, width, trace) {
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.beginPath();
  trace(pen);
  pen.stroke();
}

/** Draw a ring on a wider one, so that it is seen on any ground. */
function drawRing(pen, [left, top], radius, ground, colour) {
  for (const [ink, width] of [[ground, 5], [colour, 2.5]]) {
    strokePath(pen, ink, width, () => pen.arc(left, top, radius, 0, 2 * Math.PI));
  }
}

class Plot {
  constructor(pen, { width, height, frame, colours, across, up, logarithmic = false, decades = false }) {
    Object.assign(this, { pen, colours, across, up, logarithmic: [logarithmic, decades] }); // across, up
    const { unit } = colours; // of large type, and a small chart has its title on the axis
    frame = Object.fromEntries(Object.entries(frame).map(([side, space]) => [side, space * unit]));
    this.frame = height < 140 * unit ? { ...frame, bottom: 20 * unit } : frame;
    frame = this.frame;
    this.size = [width - frame.left - frame.right, height - frame.top - frame.bottom];
    pen.font = colours.font;
  }

  /** A plot on the whole of a canvas, which is cleared. */
  static on(canvas, { right = 26, ...shown }) {
    const { pen, width, height } = fitted(canvas);
    const frame = { left: 58, top: 24, right, bottom: 36 };
    return new Plot(pen, { width, height, frame, colours: readColours(), ...shown });
  }

  at([a, b]) {
    const { frame, across, up, size } = this;
    return [
      frame.left + ((a - across[0]) / (across[1] - across[0])) * size[0],
      frame.top + size[1] - ((b - up[0]) / (up[1] - up[0])) * size[1],
    ];
  }

  /** The values at a point of the screen. */
  valuesAt(left, top) {
    const { frame, across, up, size } = this;
    return [
      across[0] + ((left - frame.left) / size[0]) * (across[1] - across[0]),
      up[0] + ((frame.top + size[1] - top) / size[1]) * (up[1] - up[0]),
    ];
  }

  axes(nameAcross, nameUp) {
    const { pen, colours, frame, size } = this;
    const bottom = frame.top + size[1];
    [this.across, this.up].forEach(([low, high], index) => {
      const middle = 0.5 * (low + high);
      const room = size[index] / this.colours.unit;
      const ticks = this.logarithmic[index]
        ? decadesAround(low, high, room / (index ? 20 : 45))
        : ticksAround(middle, high - low, room / (index ? 34 : 70));
      const { offsets, labels } = ticks;
      offsets.forEach((offset, i) => {
        const [left, top] =
          this.at(index ? [this.across[0], middle + offset] : [middle + offset, this.up[0]]);
        strokePath(pen, colours.line, 1, () => {
          pen.moveTo(left, top);
          if (index) pen.lineTo(left + size[0], top);
          else pen.lineTo(left, frame.top);
        });
        if (index) write(pen, labels[i], left - 6, top, colours.muted, "right", "middle");
        else write(pen, labels[i], left, bottom + 5, colours.muted, "center");
      });
    });
    const inside = frame.bottom < 30 * colours.unit;
    const below = inside ? bottom - 2 : bottom + frame.bottom;
    write(pen, nameAcross, frame.left + size[0], below, colours.ink, "right", "bottom");
    if (!inside) write(pen, nameUp, 4, 3, colours.ink); // else the list of charts is there
  }

  clipped(draw) {
    const { pen, frame, size } = this;
    pen.save();
    pen.beginPath();
    pen.rect(frame.left, frame.top, size[0], size[1]);
    pen.clip();
    draw(pen);
    pen.restore();
  }

  line(points, colour, width = 1.5) {
    this.clipped((pen) => {
      pen.lineJoin = "round";
      strokePath(pen, colour, width, () => points.forEach((point) => pen.lineTo(...this.at(point))));
    });
  }

  dot(point, colour, radius = 3) {
    const { pen, frame, size } = this;
    const [left, top] = this.at(point);
    if (left < frame.left - 1 || left > frame.left + size[0] + 1) return;
    pen.fillStyle = colour;
    pen.beginPath();
    pen.arc(left, top, radius, 0, 2 * Math.PI);
    pen.fill();
  }

  vertical(value, colour) { this.line(this.up.map((end) => [value, end]), colour); }

  key(entries) {
    const { pen, colours, frame, size } = this;
    let left = frame.left + size[0];
    for (const [name, colour] of [...entries].reverse()) {
      const wide = pen.measureText(name).width;
      if (left - wide < 110) return; // no room beside the name of the axis
      write(pen, name, left, 4, colours.ink, "right");
      left -= wide + 8;
      pen.fillStyle = colour;
      pen.fillRect(left - 14, 10, 14, 3);
      left -= 24;
    }
  }
}

/** Ticks at powers of ten between two logarithms, and at 2 and 5 times them where there are few. */
function decadesAround(low, high, most) {
  const ticks = [];
  const every = Math.ceil((high - low) / Math.max(2, most));
  for (let n = every * Math.floor(low / every); n <= high; n += every) {
    for (const factor of high - low < 2.5 ? [1, 2, 5] : [1]) ticks.push(factor * 10 ** n);
  }
  const shown = ticks.filter((value) => Math.log10(value) >= low && Math.log10(value) <= high);
  const offsets = shown.map((value) => Math.log10(value) - 0.5 * (low + high));
  return { offsets, labels: shown.map((value) =>
    (value < 0.001 ? value.toExponential(0).replaceAll("-", "−") : COUNT.format(value))) };
}

/** Exponents so far against the logarithm of the number of impacts; Figure 7 has the number. */
function drawExponents(canvas, orbits, cursor) {
  const shown = orbits.filter((orbit) => orbit.history.length > 1);
  const late = (orbit) => orbit.history.filter(([impacts]) => impacts >= 10);
  const values =
    shown.flatMap((orbit) => late(orbit).map(([, exponent]) => exponent)).filter(Number.isFinite);
  const most = Math.max(1000, ...shown.map((orbit) => orbit.count));
  const top = Math.min(1, Math.max(0.1, ...values));
  const plot =
    Plot.on(canvas, { across: [1, Math.log10(most)], up: [-0.06 * top, 1.08 * top], logarithmic: true });
  plot.axes("number of impacts", "largest exponent so far");
  for (const orbit of shown.sort((a, b) => b.isSea() - a.isSea())) {
    const line = late(orbit).map(([impacts, exponent]) => [Math.log10(impacts), exponent]);
    plot.line(line, orbit.colour(plot.colours), orbit.chosen ? 3 : 1.5);
  }
  if (cursor > 0 && shown.length) plot.vertical(Math.log10(cursor), plot.colours.focus);
}

/** Rotation numbers against the starts along y = 0, as in the picture `rotation`. */
function drawRotations(canvas, orbits) {
  const shown =
    orbits.filter((orbit) => orbit.facts && orbit.q === 0 && Number.isFinite(orbit.facts.rotation));
  const starts = shown.map((orbit) => orbit.p);
  const values = shown.map((orbit) => orbit.facts.rotation);
  const range = (list, least) => {
    const low = Math.min(...list);
    const high = Math.max(...list);
    const room = Math.max(0.08 * (high - low), least);
    return list.length ? [low - room, high + room] : [0, 1];
  };
  const plot = Plot.on(canvas, { across: range(starts, 0.01), up: range(values, 1e-4) });
  plot.axes("start along y = 0, section radii", "rotation number");
  shown.forEach((orbit, i) =>
    plot.dot([starts[i], values[i]], orbit.colour(plot.colours), orbit.chosen ? 6 : 3.5));
}
