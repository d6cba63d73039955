/* From play to record: a block for config.yaml, orbits as CSV, the view as PNG and SVG, the link. */

/** A number as YAML reads it back to the last bit: an exponent needs a point before it. */
function yamlNumber(value) {
  const text = String(value);
  return /^-?\d+e/.test(text) ? text.replace("e", ".0e") : text;
}

/** The kinds of scene that show what is on the page: the first one shows most of it. */
function sceneKinds(state, orbits) {
  const forward = orbits.some((orbit) => !orbit.back && !orbit.refused);
  const saddle = state.branches.find((branch) => branch.nth === 0 && branch.period);
  const kinds = {
    closeup: saddle && state.view.half < 0.2,
    tangle: saddle && forward,
    jumps: state.jump && forward,
    portrait: forward,
    motion: state.motion?.period && state.motion.nth === 0,
    exponents: forward,
  };
  return Object.keys(kinds).filter((kind) => kinds[kind]);
}

/** The block of a scene, and a note about what of the picture it leaves out. */
function sceneBlock(kind, { state, orbits, periodic, section }) {
  const { k, g, energy, view } = state;
  const number = yamlNumber;
  const lines = [`ball: {k: ${number(k)}, g: ${number(g)}}`, `energy: ${number(energy)}`];
  const notes = [];
  const shown = orbits.filter((orbit) => !orbit.back && !orbit.refused);
  if (kind !== "motion" && kind !== "closeup") {
    const starts = shown.map((orbit) => {
      if (orbit.q === 0 && !orbit.xy) return number(orbit.p);
      const { x, y } = geometry.pointAt(k, g, energy, orbit.p, orbit.q);
      const point = orbit.xy ?? [x, y];
      return `{x: ${number(point[0])}, y: ${number(point[1])}}`;
    });
    const impacts = shown.map((orbit) => orbit.impacts);
    lines.push(...flowList("starts", starts), ...flowList("impacts", impacts));
    if (shown.length < orbits.length)
      notes.push("A scene has no backward orbits and none that stop early: they are left out.");
  }
  if (kind === "portrait" || kind === "tangle") {
    const { elevation, azimuth } = view;
    lines.push(`view: {elevation: ${number(elevation)}, azimuth: ${number(azimuth)}}`);
    if (view.kind === "disk" || view.half !== HOME.surface[2]) {
      notes.push("The pipeline draws the whole half ellipsoid; the points are the same.");
    }
  }
  if (kind === "exponents") {
    lines.push(`records: ${Math.max(2, Math.min(400, ...shown.map((orbit) => orbit.impacts)))}`);
  }
  if (kind === "jumps") {
    const other = Number((1.25 * geometry.firstJump(k, g)).toPrecision(3)); // where the curve is small
    const energies = other < geometry.energyBounds(k, g)[1] ? [other] : [energy];
    lines.push(...flowList("energies", energies.map(number)), "sides: 4000");
  }
  if (kind === "motion") {
    const { period, type } = state.motion;
    lines.push(`period: ${period}`, `type: ${type}`, `duration: ${number(state.span)}`);
  }
  if (kind === "tangle" || kind === "closeup") {
    const { period, type } = state.branches.find((branch) => branch.nth === 0 && branch.period);
    const same = state.branches.filter((b) => b.period === period && b.type === type && b.nth === 0);
    const lengths = { outer: 0, inner: 0 };
    for (const { side, length } of same) {
      for (const name of side === "both" ? ["outer", "inner"] : [side]) {
        lengths[name] = Math.max(lengths[name], length);
      }
    }
    const sides = Object.entries(lengths).filter(([, length]) => length);
    lines.push(`period: ${period}`, `type: ${type}`, "resolution: {distance: 0.01, bend: 10}");
    if (kind === "tangle") {
      const parts = sides.map(([side, length]) => `${side}: {length: ${number(length)}}`);
      lines.push(`branches: {${parts.join(", ")}}`);
    } else {
      lines.push(...windowLines(state, periodic, section, period, type));
      lines.push(`length: ${number(Math.max(...sides.map(([, length]) => length)))}`);
    }
    if (same.length < state.branches.length || same.some((b) => b.saddle >= 0 || b.kind !== "both")) {
      notes.push("A scene has both kinds of branch, at all points of one orbit.");
    }
  }
  const name = `explored_${pseudorigid.sha256(new TextEncoder().encode(kind + lines.join())).slice(0, 6)}`;
  const body = [`picture: ${kind}`, ...lines].map((line) => `    ${line}`);
  return { name, text: `  ${name}:\n${body.join("\n")}\n`, note: notes.join(" ") };
}

/** A list in lines of at most 96 characters. */
function flowList(name, items) {
  const lines = [];
  let line = `${name}: [`;
  items.forEach((item, i) => {
    const piece = `${item}${i + 1 < items.length ? "," : "]"}`;
    if (line.length + piece.length > 90) {
      lines.push(line);
      line = `  ${piece}`;
    } else line += (line.endsWith("[") ? "" : " ") + piece;
  });
  return [...lines, line];
}

/** The window of a close-up, relative to the nearest point of the orbit, in section radii. */
function windowLines({ k, g, energy }, periodic, section, period, type) {
  const { radius } = section;
  const orbit = (periodic.get(period) ?? []).find((entry) => entry.type === type);
  if (!orbit) return [];
  // The part of the section that is in sight as one in (x, xdot): its corners and sides.
  const states = [];
  for (let i = -4; i <= 4; i++) {
    for (let j = -4; j <= 4; j++) {
      const reach = section.scale * section.read().state.view.half;
      const place = section.place(section.middle[0] + (i / 4) * reach, section.middle[1] + (j / 4) * reach);
      if (place) states.push(geometry.stateAt(k, g, energy, { p: place[0], q: place[1] }));
    }
  }
  const [x, v] = [0, 1].map((i) => states.reduce((sum, state) => sum + state[i], 0) / states.length);
  const distances = orbit.points.map((point) => Math.hypot(point[0] - x, point[1] - v));
  const point = distances.indexOf(Math.min(...distances));
  const [across, up] = [0, 1].map((i) => states.map((state) => (state[i] - orbit.points[point][i]) / radius));
  const end = (value) => yamlNumber(Number(value.toPrecision(6)));
  const range = (values) => `[${end(Math.min(...values))}, ${end(Math.max(...values))}]`;
  return [`point: ${point}`, `window: {x: ${range(across)}, xdot: ${range(up)}}`];
}

/** What a file says about itself: the version, the ball and energy, and how to see it again. */
function aboutLines(page) {
  const { k, g, energy } = page.state;
  return [page.data.version, `k = ${k}, g = ${g}, E = ${energy}`, link(page)];
}

/** The page's address with its state; a page that was opened from a file has no better name. */
function link(page) {
  page.save();
  const { protocol, href, hash } = window.location;
  return protocol.startsWith("http") ? href : `explorer.html${hash}`;
}

/** Orbits as CSV, numbers to the last bit; the first row of each is its start. */
async function orbitsCsv(page, orbits) {
  const lines = aboutLines(page).map((line) => `# ${line}\n`);
  const parts = [...lines, "orbit,impact,x,xdot,udot,tau\n"];
  for (const orbit of orbits) {
    const name = page.orbits.indexOf(orbit) + 1;
    parts.push(`${name},0,${orbit.start.join(",")},\n`);
    const sign = orbit.back ? -1 : 1;
    await page.eachPiece(orbit, 0, ({ x, xdot, udot, tau }, from) => {
      const row = (_, i) => [name, sign * (from + i + 1), x[i], xdot[i], udot[i], tau[i]].join(",");
      parts.push(`${Array.from(x, row).join("\n")}\n`);
    });
  }
  return new Blob(parts, { type: "text/csv" });
}

/** The section as it is drawn, with what it shows in the margin: PNG at a ratio, or SVG. */
async function picture(page, ratio = null) {
  const { view } = page.state;
  const { width } = page.section;
  // The whole section fills a picture that is as tall as it is; a window keeps its shape.
  const whole = view.half > HOME[view.kind][2] - 0.1;
  const height = !whole ? page.section.height : view.kind === "disk" ? width - 12 : Math.round(0.8 * width);
  const about = aboutLines(page);
  const each = Math.floor((width - 20) / 6.7); // characters in a line
  const lines = about.flatMap((line) => line.match(new RegExp(`.{1,${each}}`, "g")));
  const tall = height + 15 * lines.length + 16;
  const box = { append() {}, getBoundingClientRect: () => ({ width, height }) };
  const svg = ratio ? null : new SvgPen();
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width: width * (ratio ?? 1), height: tall * (ratio ?? 1) });
  const light = node("div", { hidden: true }); // the theme of files, whatever that of the page is
  light.dataset.theme = "light";
  document.body.append(light);
  const colours = readColours(light);
  const pen = svg ?? canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.fillStyle = colours.page;
  pen.fillRect(0, 0, width, tall);
  const drawn = new SectionView(box, () => page.scene(), { ratio: ratio ?? 1, svg, light });
  light.remove();
  await page.replay(drawn);
  for (const layer of drawn.layers) pen.drawImage(layer, 0, 0, width, height);
  pen.font = "11px monospace";
  lines.forEach((line, i) => write(pen, line, 10, height + 8 + 15 * i, colours.muted));
  if (svg) return new Blob([svg.file(width, tall, about.join("\n"))], { type: "image/svg+xml" });
  return new Promise((done) => canvas.toBlob(done));
}

function download(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Copy a text; returns whether the browser let us. */
async function copyText(text, area) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    area.value = text;
    area.select();
    return document.execCommand("copy");
  }
}
