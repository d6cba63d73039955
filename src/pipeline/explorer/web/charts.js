"use strict";
/* Plain charts: axes with ticks, lines, dots and a key. */

/** A canvas fitted to its place on the page and cleared: {context, width, height} in CSS pixels. */
function fitted(canvas) {
  const { width, height } = canvas.getBoundingClientRect();
  const ratio = Math.min(3, window.devicePixelRatio || 1);
  const size = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
  if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

class Plot {
  constructor(context, { width, height, frame, colours, across, up }) {
    Object.assign(this, { context, frame, colours, across, up });
    this.size = [width - frame.left - frame.right, height - frame.top - frame.bottom];
    context.font = `13px ${colours.font}`;
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
    const { context, colours, frame, size } = this;
    context.lineWidth = 1;
    const bottom = frame.top + size[1];
    [this.across, this.up].forEach(([low, high], index) => {
      const middle = 0.5 * (low + high);
      const { offsets, labels } = ticksAround(middle, high - low, size[index] / (index ? 34 : 70));
      offsets.forEach((offset, i) => {
        const [left, top] = this.at(index ? [this.across[0], middle + offset] : [middle + offset, this.up[0]]);
        context.strokeStyle = colours.line;
        context.beginPath();
        context.moveTo(left, top);
        if (index) context.lineTo(left + size[0], top);
        else context.lineTo(left, frame.top);
        context.stroke();
        context.fillStyle = colours.muted;
        context.textAlign = index ? "right" : "center";
        context.textBaseline = index ? "middle" : "top";
        context.fillText(labels[i], index ? left - 6 : left, index ? top : bottom + 5);
      });
    });
    context.fillStyle = colours.ink;
    context.textAlign = "right";
    context.textBaseline = "bottom";
    context.fillText(nameAcross, frame.left + size[0], bottom + frame.bottom);
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillText(nameUp, 4, 3);
  }

  clipped(draw) {
    const { context, frame, size } = this;
    context.save();
    context.beginPath();
    context.rect(frame.left, frame.top, size[0], size[1]);
    context.clip();
    draw(context);
    context.restore();
  }

  line(points, colour, width = 1.5) {
    this.clipped((context) => {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.lineJoin = "round";
      context.beginPath();
      points.forEach((point, i) => (i ? context.lineTo(...this.at(point)) : context.moveTo(...this.at(point))));
      context.stroke();
    });
  }

  dot(point, colour, radius = 3) {
    const { context, frame, size } = this;
    const [left, top] = this.at(point);
    if (left < frame.left - 1 || left > frame.left + size[0] + 1) return;
    context.fillStyle = colour;
    context.beginPath();
    context.arc(left, top, radius, 0, 2 * Math.PI);
    context.fill();
  }

  vertical(value, colour) {
    this.clipped((context) => {
      const [left] = this.at([value, 0]);
      context.strokeStyle = colour;
      context.lineWidth = 1.5;
      context.beginPath();
      context.moveTo(left, 0);
      context.lineTo(left, 1e5);
      context.stroke();
    });
  }

  key(entries) {
    const { context, colours, frame, size } = this;
    let left = frame.left + size[0];
    context.textAlign = "right";
    context.textBaseline = "top";
    for (const [name, colour] of [...entries].reverse()) {
      context.fillStyle = colours.ink;
      context.fillText(name, left, 4);
      left -= context.measureText(name).width + 8;
      context.fillStyle = colour;
      context.fillRect(left - 14, 10, 14, 3);
      left -= 24;
    }
  }
}

/** Exponents so far against the number of impacts, as in Figure 7. */
function drawExponents(canvas, orbits, cursor) {
  const { context, width, height } = fitted(canvas);
  const colours = readColours();
  const shown = orbits.filter((orbit) => orbit.history.length > 1);
  const values = shown.flatMap((orbit) => orbit.history.map(([, exponent]) => exponent)).filter(Number.isFinite);
  const most = Math.max(100, ...shown.map((orbit) => orbit.count));
  const top = Math.min(1, Math.max(0.1, ...values));
  const plot = new Plot(context, {
    width, height, colours, across: [0, most], up: [-0.06 * top, 1.08 * top],
    frame: { left: 50, top: 24, right: 12, bottom: 36 },
  });
  plot.axes("number of impacts", "largest exponent so far");
  for (const orbit of shown) plot.line(orbit.history, orbit.colour(colours));
  if (cursor >= 0 && shown.length) plot.vertical(cursor, colours.focus);
}

/** Rotation numbers against the starts along y = 0, as in the picture `rotation`. */
function drawRotations(canvas, orbits) {
  const { context, width, height } = fitted(canvas);
  const colours = readColours();
  const shown = orbits.filter((orbit) => orbit.facts && orbit.q === 0 && Number.isFinite(orbit.facts.rotation));
  const starts = shown.map((orbit) => orbit.p);
  const values = shown.map((orbit) => orbit.facts.rotation);
  const range = (list, least) => {
    const low = Math.min(...list);
    const high = Math.max(...list);
    const room = Math.max(0.08 * (high - low), least);
    return list.length ? [low - room, high + room] : [0, 1];
  };
  const plot = new Plot(context, {
    width, height, colours, across: range(starts, 0.01), up: range(values, 1e-4),
    frame: { left: 58, top: 24, right: 12, bottom: 36 },
  });
  plot.axes("start along y = 0, section radii", "rotation number");
  shown.forEach((orbit, i) => plot.dot([starts[i], values[i]], orbit.colour(colours), 3.5));
}
