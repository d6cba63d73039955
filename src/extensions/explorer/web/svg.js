/* A pen with what the section's drawing uses of a canvas's, which writes SVG. */
class SvgPen {
  constructor() {
    this.parts = [];
    this.open = [0]; // groups since each `save`
    this.clips = 0;
    this.path = "";
    Object.assign(this, { lineWidth: 1, dash: "", font: "", textAlign: "left", textBaseline: "top" });
  }

  setTransform() {}
  clearRect() {}
  beginPath() { this.path = ""; }
  moveTo(left, top) { this.path += `M${this.number(left)} ${this.number(top)}`; }
  lineTo(left, top) { this.path += `${this.path ? "L" : "M"}${this.number(left)} ${this.number(top)}`; }

  rect(left, top, width, height) {
    const [x, y, w, h] = [left, top, width, height].map(this.number);
    this.path += `M${x} ${y}h${w}v${h}h${-w}z`;
  }

  /** A full circle. */
  arc(left, top, radius) {
    const [x, y, r] = [left - radius, top, radius].map(this.number);
    this.path += `M${x} ${y}a${r} ${r} 0 1 1 ${2 * r} 0a${r} ${r} 0 1 1 ${-2 * r} 0z`;
  }

  fill() { if (this.path) this.parts.push(`<path d="${this.path}" fill="${this.fillStyle}"/>`); }

  stroke() {
    if (!this.path) return;
    const line = `stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}" stroke-linejoin="bevel"`;
    const dash = this.dash && ` stroke-dasharray="${this.dash}"`;
    this.parts.push(`<path d="${this.path}" fill="none" ${line}${dash}/>`);
  }

  fillRect(...box) { this.fill(this.beginPath(), this.rect(...box)); }
  strokeRect(...box) { this.stroke(this.beginPath(), this.rect(...box)); }
  setLineDash(lengths) { this.dash = lengths.join(" "); }
  save() { this.open.push(0); }

  clip() {
    this.clips += 1;
    const name = `c${this.clips}`;
    this.parts.push(`<clipPath id="${name}"><path d="${this.path}"/></clipPath>`,
      `<g clip-path="url(#${name})">`);
    this.open[this.open.length - 1] += 1;
  }

  restore() { this.parts.push("</g>".repeat(this.open.pop())); }

  fillText(text, left, top) {
    const anchor = { left: "start", center: "middle", right: "end" }[this.textAlign];
    const size = Number.parseFloat(this.font);
    const down = { top: 0.8, middle: 0.35, bottom: -0.2 }[this.textBaseline] * size;
    const place = `x="${this.number(left)}" y="${this.number(top + down)}" text-anchor="${anchor}"`;
    const family = this.font.includes("mono") ? "monospace" : "sans-serif";
    const font = `font-size="${size}" font-family="${family}" fill="${this.fillStyle}"`;
    this.parts.push(`<text ${place} ${font}>${escaped(text)}</text>`);
  }

  drawImage(canvas, left, top, width, height) {
    const place = `x="${left}" y="${top}" width="${width}" height="${height}"`;
    this.parts.push(`<image ${place} href="${canvas.toDataURL()}"/>`);
  }

  /** Dots at places [left, top, left, top, ...]. */
  dots(places, size, colour) {
    let path = "";
    for (let i = 0; i < places.length; i += 2)
      path += `M${this.number(places[i])} ${this.number(places[i + 1])}h0`;
    this.parts.push(`<path d="${path}" stroke="${colour}" stroke-width="${size}" stroke-linecap="round"/>`);
  }

  number(value) { return Math.round(100 * value) / 100; }

  /** The file, with a text about it. */
  file(width, height, about) {
    const size = `width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"`;
    const head = `<svg xmlns="http://www.w3.org/2000/svg" ${size}>`;
    return [head, `<metadata>${escaped(about)}</metadata>`, ...this.parts, "</svg>\n"].join("\n");
  }
}

function escaped(text) { return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;"); }
