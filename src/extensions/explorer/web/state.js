"use strict";
/*
 * The state of the page: everything that decides what is on it. It fits into the address.
 *
 * Starts are places (p, q) on the section, see geometry.js. One that was given by its numbers has them
 * in `xy`, which the state of the ball there is computed from. The view's centre is a place too, or
 * on the half ellipsoid a position on the screen in section radii; `half` is half the view's size.
 */
const MOST_ORBITS = 64;
const MOST_IMPACTS = 10000000; // of an orbit, unless it runs on
const MOST_FOLLOWED = 2000000000;
const COLOURS = ["orbit", "verdict", "rotation", "exponent"];
const MAPS = ["none", "exponent", "rotation", "verdict"]; // what colours the pixels of the section
const PANELS = ["time", "chart", "orbits", "periodic", "atlas", "export", "help"];
const HOME = { disk: [0, 0, 1.12], surface: [0, 0, 1.12] };

function freshState() {
  return {
    k: 0.2,
    g: 0.04,
    energy: 0.01,
    view: { ...HOME_VIEW },
    colour: "orbit",
    map: "none",
    fill: false, // whether the window is filled with orbits, as it is after a zoom
    orbits: [], // {p, q, xy, impacts, back, sea}
    chosen: -1, // the orbit that the time view shows, unless `motion` is given
    motion: null, // {period, type, nth}: the periodic orbit that the time view shows
    // {p, q, period (0: any)}: places whose nearest periodic orbits are {period: 0, type: "near", nth}
    near: [],
    periods: [], // periods of the periodic orbits on the section
    branches: [], // {period, type, nth, saddle (-1: all), kind, side, length}
    jump: false,
    chart: "exponent",
    time: 0,
    span: 16, // of the time view
    twin: 0, // distance at which a second ball starts, 0 for none
    back: false, // direction and impacts of the next orbit
    impacts: 3000,
    preset: "",
    panel: "time", // the one that is open
    tour: 0, // the step of the tour, 0 for none
    lesson: 0, // the question, 0 for none
    revealed: false, // whether its answer is shown
  };
}

/** The open range of k, g or E at the other two values; k may also be 1. */
function rangeOf(name, { k, g, E }) {
  if (name === "k") return [Math.max(g, 2 * (E + g)), E < 0 ? Math.min(1, (g * g) / (-2 * E)) : 1];
  if (name === "g") return [Math.sqrt(Math.max(0, -2 * k * E)), Math.min(k, 0.5 * k - E)];
  return geometry.energyBounds(k, g);
}

/** What is wrong with a value of k, g or E beside the other two, in a line; empty if it is allowed. */
function parameterError(name, text, ball) {
  const value = readNumber(text);
  const refused = `${name} = ${String(text).trim() || "nothing"} is not allowed`;
  if (Number.isNaN(value)) return `${refused}: a number`;
  if (name === "k" && !(value > 0 && value <= 1))
    return `${refused}: above 0, at most 1 (a sphere has at most 1/3)`;
  if (name === "g" && !(value > 0 && value < ball.k))
    return `${refused}: above 0, below k = ${shortNumber(ball.k, 4)}`;
  const [low, high] = rangeOf(name, ball).map((end, i) => inside(end, i ? -1 : 1));
  if (ballAllowed({ ...ball, [name]: value })) return "";
  if (name === "E") return `${refused}: above −g²/2k = ${low}, below k/2 − g = ${high}, eq. (31)`;
  const others = ["k", "g", "E"].filter((other) => other !== name)
    .map((other) => `${other} = ${shortNumber(ball[other], 4)}`);
  const below = name === "k" && high === "1" ? "at most" : "below";
  return `${refused}: above ${low}, ${below} ${high} at ${others.join(" and ")}, eq. (31)`;
}

/** Compared as decimals, like Python: as doubles, 0.2/2 - 0.04 exceeds 0.06. */
function ballAllowed({ k, g, E }) {
  if (!(k > 0 && k <= 1 && g > 0 && g < k && Number.isFinite(E))) return false;
  const [exactK, exactG, exactE] = [k, g, E].map(asDecimal);
  return 2n * exactK * exactE + exactG * exactG > 0n && 2n * (exactE + exactG) < exactK;
}

/** The shortest decimal of a number, in units of 1e-400. */
function asDecimal(value) {
  const [digits, power] = value.toExponential().split("e");
  const [whole, part = ""] = digits.split(".");
  return BigInt(whole + part) * 10n ** BigInt(Number(power) - part.length + 400);
}

/** A number or a fraction that was typed, with a comma or a real minus sign too; NaN if it is none. */
function readNumber(text) {
  const plain = String(text).trim().replaceAll("−", "-").replaceAll(",", ".");
  const match = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)(?:\s*\/\s*(\d+\.?\d*|\.\d+))?$/i.exec(plain);
  const value = match ? Number(match[1]) / Number(match[2] ?? 1) : NaN;
  return Number.isFinite(value) ? value : NaN;
}

/** A count that was typed, also with commas between thousands; NaN if it is none. */
function readCount(text) {
  const plain = String(text).trim().replace(/^\d{1,3}(,\d{3})+$/, (count) => count.replaceAll(",", ""));
  return /[.,]/.test(plain) ? NaN : readNumber(plain);
}

/** A number with so many significant digits, with a proper minus sign. */
function shortNumber(value, digits = 6) {
  if (!Number.isFinite(value)) return "–";
  return String(Number(value.toPrecision(digits))).replaceAll("-", "−");
}

/** The end of an open range in four digits, rounded inwards; sign is 1 for a lower end, else -1. */
function inside(end, sign) {
  const step = 10 ** (Math.floor(Math.log10(Math.abs(end) || 1)) - 3);
  const rounded = Math.round(end / step);
  return shortNumber((rounded + (sign * (rounded - end / step) < -1e-9 ? sign : 0)) * step, 4);
}

const COUNT = new Intl.NumberFormat("en");

function writeAddress(state) {
  const { view } = state;
  const fields = new Map([
    ["k", state.k], ["g", state.g], ["E", state.energy],
    ["view", [view.kind, view.azimuth, view.elevation, view.x, view.y, view.half].join(",")],
    ["colour", state.colour],
    ["map", state.map === "none" ? "" : state.map],
    ["fill", state.fill ? 1 : ""],
    ["orbits", state.orbits.map(writeOrbit).join(";")],
    ["chosen", state.chosen],
    ["motion", state.motion ? writeMotion(state.motion) : ""],
    ["periods", state.periods.join(",")],
    ["near", state.near.map(writeNear).join(";")],
    ["branches", state.branches.map(writeBranch).join(";")],
    ["jump", state.jump ? 1 : ""],
    ["chart", state.chart],
    ["t", state.time], ["span", state.span],
    ["twin", state.twin || ""],
    ["next", `${state.impacts}${state.back ? "<" : ""}`],
    ["preset", state.preset],
    ["panel", state.panel === "time" ? "" : state.panel],
    ["tour", state.tour || ""], ["lesson", state.lesson || ""],
    ["revealed", state.revealed ? 1 : ""],
  ]);
  const parts = [...fields].filter(([, value]) => value !== "");
  return "#" + parts.map((part) => part.join("=")).join("&");
}

function writeOrbit({ p, q, xy, impacts, back, sea }) {
  const place = xy ? `@${xy.join(":")}` : q === 0 ? p : `${p}:${q}`;
  return `${place}*${impacts}${back ? "<" : ""}${sea ? "!" : ""}`;
}

function writeNear({ p, q, period }) { return `${p}:${q}*${period}`; }

const KIND_LETTERS = { near: "n", elliptic: "e", hyperbolic: "h", "inverse hyperbolic": "i" };
const LETTER_KINDS = Object.fromEntries(Object.entries(KIND_LETTERS).map(([a, b]) => [b, a]));

function writeMotion({ period, type, nth }) { return `${period}${KIND_LETTERS[type]}${nth}`; }

function writeBranch(branch) {
  const { saddle, kind, side, length } = branch;
  return [writeMotion(branch), saddle, kind, side, length].join(",");
}

/** The state in an address; throws an error of one line if it has none. The ball of a scene is allowed. */
function readAddress(text, scenes = {}) {
  const state = freshState();
  const fail = (name, value, allowed) => {
    throw new Error(`the address has ${name} = ${value.slice(0, 40)}: ${allowed}`);
  };
  const number = (name, value, allowed = "a number is needed", test = Number.isFinite) => {
    const read = readNumber(value);
    if (!test(read)) fail(name, value, allowed);
    return read;
  };
  const whole = (low, high) => (value) => Number.isInteger(value) && value >= low && value <= high;
  const motion = (name, value) => {
    const match = /^(\d+)([ehi])(\d+)$|^(0)(n)(\d+)$/.exec(value)?.filter((part) => part !== undefined);
    if (!match || !whole(match[2] === "n" ? 0 : 1, 12)(Number(match[1])))
      fail(name, value, "a periodic orbit, like 6e0");
    return { period: Number(match[1]), type: LETTER_KINDS[match[2]], nth: Number(match[3]) };
  };
  const one = (name, value, words) => {
    if (!words.includes(value)) fail(name, value, `one of ${words.join(", ")}`);
    return value;
  };
  const readers = {
    k: (value) => (state.k = number("k", value)),
    g: (value) => (state.g = number("g", value)),
    E: (value) => (state.energy = number("E", value)),
    view(value) {
      const [kind, ...rest] = value.split(",");
      one("view", kind, ["disk", "surface"]);
      if (rest.length !== 5) fail("view", value, "a kind and five numbers");
      const [azimuth, elevation, x, y, half] = rest.map((part) => number("view", part));
      if (!(half > 0)) fail("view", value, "a size above 0");
      state.view = { kind, azimuth, elevation, x, y, half };
    },
    colour: (value) => (state.colour = one("colour", value, COLOURS)),
    map: (value) => (state.map = one("map", value, MAPS)),
    fill: (value) => (state.fill = value === "1"),
    orbits(value) {
      state.leftOut = Math.max(0, value.split(";").length - MOST_ORBITS);
      state.orbits = value.split(";").slice(0, MOST_ORBITS).map((part) => {
        const match = /^(@?)([^:*]+)(?::([^*]+))?\*(\d+)(<?)(!?)$/.exec(part);
        if (!match) fail("orbits", part, "a start like 0.5*3000, 0.1:0.2*3000 or @x:y*3000 is needed");
        const at = [number("a start", match[2]), match[3] ? number("a start", match[3]) : 0];
        const impacts = number("impacts", match[4], `1 to ${MOST_FOLLOWED}`, whole(1, MOST_FOLLOWED));
        return { part, at, typed: match[1] !== "", impacts, back: match[5] !== "", sea: match[6] !== "" };
      });
    },
    chosen: (value) => (state.chosen = number("chosen", value, "an index", whole(-1, MOST_ORBITS))),
    motion: (value) => (state.motion = motion("motion", value)),
    periods(value) {
      const read = (part) => number("periods", part, "1 to 12", whole(1, 12));
      state.periods = [...new Set(value.split(",").map(read))];
    },
    near(value) {
      state.near = value.split(";").map((part) => {
        const [p, q, period] = part.split(/[:*]/).map((text) => number("near", text));
        if (!(p * p + q * q < 1 && whole(0, MOST_PERIOD)(period)))
          fail("near", part, "a place and a period, like 0.1:0.2*6");
        return { p, q, period };
      });
    },
    branches(value) {
      state.branches = value.split(";").map((part) => {
        const [orbit, saddle, kind, side, length] = part.split(",");
        return {
          ...motion("branches", orbit ?? ""),
          saddle: number("branches", saddle ?? "", "a saddle's index", whole(-1, MOST_PERIOD - 1)),
          kind: one("branches", kind ?? "", ["stable", "unstable", "both"]),
          side: one("branches", side ?? "", ["outer", "inner", "both"]),
          length: number("branches", length ?? "", "a length up to 20", (v) => v > 0 && v <= 20),
        };
      });
    },
    jump: (value) => (state.jump = value === "1"),
    chart: (value) => (state.chart = one("chart", value, ["exponent", "rotation", "distance", "families"])),
    t: (value) => (state.time = number("t", value)),
    span: (value) => (state.span = number("span", value, "a time above 0", (v) => v > 0 && v <= 1000)),
    twin: (value) =>
      (state.twin = number("twin", value, "a distance above 0, below 1", (v) => v > 0 && v < 1)),
    next(value) {
      state.back = value.endsWith("<");
      const count = value.replace("<", "");
      state.impacts = number("next", count, `1 to ${MOST_IMPACTS}`, whole(1, MOST_IMPACTS));
    },
    preset: (value) => (state.preset = value),
    panel: (value) => (state.panel = one("panel", value, PANELS)),
    tour: (value) => (state.tour = number("tour", value, "a step from 1 to 6", whole(1, 6))),
    lesson: (value) => (state.lesson = number("lesson", value, "a question from 1 to 5", whole(1, 5))),
    revealed: (value) => (state.revealed = value === "1"),
  };
  state.panel = null;
  for (const part of decodeURIComponent(text).replace(/^#/, "").split("&")) {
    const at = part.indexOf("=");
    const name = part.slice(0, at);
    if (at > 0 && Object.hasOwn(readers, name)) readers[name](part.slice(at + 1));
    else if (at > 0) fail(name, part.slice(at + 1), "no such field");
    else throw new Error(`the address has ${part.slice(0, 40)}: a scene's name or k=0.2 and so on is needed`);
  }
  state.panel ??= state.chart === "exponent" ? "time" : "chart"; // older addresses have no panel
  const { k, g, energy: E } = state;
  const wrong = !(k > 0 && k <= 1) ? "k" : !(g > 0 && g < k) ? "g" : "E";
  const error = parameterError(wrong, String({ k, g, E }[wrong]), { k, g, E });
  const own = (scene) => scene.ball.k === k && scene.ball.g === g && scene.energy === E;
  if (error && !Object.values(scenes).some(own)) throw new Error(`the address has ${error}`);
  state.orbits = state.orbits.map(({ part, at, typed, ...rest }) => {
    const [p, q] = typed ? geometry.placeAt(state.k, state.g, state.energy, ...at) : at;
    if (!(p * p + q * q < 1)) fail("a start", part, "it lies outside the section");
    return { p, q, xy: typed ? at : null, ...rest };
  });
  if (state.chosen >= state.orbits.length) state.chosen = state.orbits.length - 1;
  return state;
}

/** What controls a part of the page's state. */
class OfPage {
  constructor(page) { this.page = page; }
  get state() { return this.page.state; }
  hint(text) { this.page.controls.hint(text); }
}
