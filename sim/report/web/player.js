// Draws the mesh at a frame with WebGL2. Positions and faces are textures; vertex shaders fetch from them.
"use strict";

const TANGLE = 0, SHADOW = 1, BEFORE = 2, AFTER = 3;
// Okabe and Ito's colours, which the colour-blind can tell apart; labels light, so that marks stand out.
const MARKS = { replaced: [0.902, 0.624, 0], inverted: [0.835, 0.369, 0], fresh: [0, 0.62, 0.451] };
const LABELS = [[0.88, 0.91, 0.95], [0.84, 0.91, 0.85], [0.9, 0.86, 0.94], [0.97, 0.93, 0.8], [0.82, 0.92, 0.94], [0.95, 0.87, 0.85]];
const TEXTURE_WIDTH = 2048;

const COMMON = `#version 300 es
precision highp float; precision highp int; precision highp isampler2D; precision highp sampler2D;
uniform sampler2D points; uniform isampler2D faces; uniform vec4 view;
ivec2 place(int i) { return ivec2(i % ${TEXTURE_WIDTH}, i / ${TEXTURE_WIDTH}); }
vec2 at(int v) { return texelFetch(points, place(v), 0).xy; }
vec4 onScreen(vec2 p) { return vec4((p - view.xy) * view.zw, 0, 1); }
`;

const FILL = COMMON + `
uniform int colouring; uniform vec3 labelColours[6]; uniform vec3 plain, replaced, only; uniform float strength; uniform bool isDark;
flat out vec4 colour;
float angle(vec2 a, vec2 b) { return acos(clamp(dot(normalize(a), normalize(b)), -1.0, 1.0)); }
// Cividis, from its ends and middle: as seen by those who cannot tell red from green.
vec3 scale(float t) {
  return t < 0.5 ? mix(vec3(0.0, 0.135, 0.304), vec3(0.486, 0.482, 0.471), 2.0 * t) : mix(vec3(0.486, 0.482, 0.471), vec3(0.996, 0.91, 0.215), 2.0 * t - 1.0);
}
void main() {
  ivec4 t = texelFetch(faces, place(gl_VertexID / 3), 0);
  vec2 a = at(t.x), b = at(t.y), c = at(t.z);
  int k = gl_VertexID % 3;
  gl_Position = onScreen(k == 0 ? a : k == 1 ? b : c);
  int label = t.w >> 2;
  bool isMarked = (t.w & 1) == 1;
  colour = vec4(plain, 1);
  if (colouring == 1) colour.rgb = labelColours[label % 6] * (isDark ? 0.42 : 1.0);
  if (colouring == 2) {
    float least = min(angle(b - a, c - a), min(angle(c - b, a - b), angle(a - c, b - c)));
    colour.rgb = scale(least / 1.0472);
  }
  if (colouring == 0 && isMarked) colour.rgb = replaced;
  if (colouring == 4) colour = vec4(only, (t.w & 2) == 2 ? strength : 0.34);
}`;
const FILL_PIXEL = `#version 300 es
precision highp float; flat in vec4 colour; out vec4 pixel; void main() { pixel = vec4(colour.rgb * colour.a, colour.a); }`;

const LINES = COMMON + `
void main() {
  ivec4 t = texelFetch(faces, place(gl_VertexID / 6), 0);
  int k = gl_VertexID % 6;
  int corner = (k + 1) / 2 % 3;
  gl_Position = onScreen(at(corner == 0 ? t.x : corner == 1 ? t.y : t.z));
}`;
const LINES_PIXEL = `#version 300 es
precision highp float; uniform vec4 ink; out vec4 pixel; void main() { pixel = vec4(ink.rgb * ink.a, ink.a); }`;

class Player {
  constructor(canvas, frames) {
    this.canvas = canvas;
    this.frames = frames;
    this.gl = canvas.getContext("webgl2", { antialias: true, premultipliedAlpha: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("this browser has no WebGL2, the mesh cannot be shown");
    this.fill = this.program(FILL, FILL_PIXEL);
    this.lines = this.program(LINES, LINES_PIXEL);
    this.points = this.texture();
    this.all = this.texture();
    this.some = this.texture();
    this.number = 0;
    this.colouring = 0;
    this.stage = AFTER;
    this.hasEdges = true;
    this.isDark = false;
    this.listen();
    this.show(0);
    this.fit();
  }

  program(vertex, pixel) {
    const gl = this.gl, program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, pixel]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  texture() {
    const gl = this.gl, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    return texture;
  }

  // `array` holds `width` numbers an item; padded to whole rows.
  upload(texture, array, width, internal, format, type) {
    const gl = this.gl, rows = Math.max(1, Math.ceil(array.length / width / TEXTURE_WIDTH));
    const padded = new array.constructor(rows * TEXTURE_WIDTH * width);
    padded.set(array);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, TEXTURE_WIDTH, rows, 0, format, type, padded);
  }

  uploadFaces(texture, array) { const gl = this.gl; this.upload(texture, array, 4, gl.RGBA32I, gl.RGBA_INTEGER, gl.INT); }

  // Goes to a frame: mesh after its step, what the step replaced, and the regions these belong to.
  show(number) {
    const frames = this.frames, gl = this.gl, { info } = frames;
    this.number = number;
    frames.seek(number);
    const scale = 1 / info.grid, points = new Float32Array(2 * info.vertices);
    for (let i = 0; i < points.length; ++i) points[i] = frames.x[i] * scale;
    this.upload(this.points, points, 2, gl.RG32F, gl.RG, gl.FLOAT);
    this.arrangeFaces();
    this.draw();
  }

  // The faces drawn as the mesh, and those drawn over it: [a, b, c, label * 4 + is inverted * 2 + is marked].
  arrangeFaces() {
    const frames = this.frames, frame = frames.list[this.number], isBefore = this.stage !== AFTER;
    const mesh = new Int32Array(4 * frames.nFaces), over = [];
    this.regionOf = new Int32Array(frames.nFaces).fill(-1);
    this.shown = new Int32Array(frames.faces);
    const marked = new Uint8Array(frames.nFaces);
    frame.patches.forEach(({ regions, changes }) => {
      for (let i = 0; i < changes.length; i += 7) {
        const face = changes[i];
        this.regionOf[face] = regions.length ? regions[0] : -1;
        marked[face] = 1;
        const corners = changes.subarray(isBefore ? i + 1 : i + 4, isBefore ? i + 4 : i + 7);
        this.shown.set(corners, 3 * face);
        const isInverted = frames.area(...corners) < 0;
        if (this.stage === BEFORE || this.stage === AFTER || isInverted) over.push(...corners, isInverted ? 2 : 0);
      }
    });
    for (let i = 0; i < frame.silent.length; i += 7) marked[frame.silent[i]] = 1;
    for (let f = 0; f < frames.nFaces; ++f) {
      for (let k = 0; k < 3; ++k) mesh[4 * f + k] = this.shown[3 * f + k];
      mesh[4 * f + 3] = 4 * (Math.abs(frames.labels[f]) % 6) + marked[f];
    }
    this.over = Int32Array.from(over);
    this.uploadFaces(this.all, mesh);
    this.uploadFaces(this.some, this.over);
  }

  draw() {
    if (this.isDrawing) return;
    this.isDrawing = true;
    requestAnimationFrame(() => { this.isDrawing = false; this.drawNow(); });
  }

  drawNow() {
    const gl = this.gl, ratio = window.devicePixelRatio || 1, { clientWidth, clientHeight } = this.canvas;
    this.canvas.width = Math.max(1, Math.round(clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(clientHeight * ratio));
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const isOverlaid = this.stage !== AFTER;
    this.drawFill(this.all, this.frames.nFaces, isOverlaid ? 3 : this.colouring);
    if (isOverlaid && this.stage !== SHADOW) this.drawFill(this.some, this.over.length / 4, 4);
    if (this.hasEdges) this.drawLines();
    if (this.stage === SHADOW) this.drawFill(this.some, this.over.length / 4, 4);
  }

  use(program, faces) {
    const gl = this.gl;
    gl.useProgram(program);
    gl.activeTexture(gl.TEXTURE0); gl.bindTexture(gl.TEXTURE_2D, this.points);
    gl.activeTexture(gl.TEXTURE1); gl.bindTexture(gl.TEXTURE_2D, faces);
    const set = (name, kind, ...values) => gl["uniform" + kind](gl.getUniformLocation(program, name), ...values);
    set("points", "1i", 0);
    set("faces", "1i", 1);
    set("view", "4f", this.centre[0], this.centre[1], 2 * this.zoom / this.canvas.clientWidth, 2 * this.zoom / this.canvas.clientHeight);
    return set;
  }

  drawFill(faces, count, colouring) {
    const set = this.use(this.fill, faces), gl = this.gl;
    set("colouring", "1i", colouring);
    set("isDark", "1i", this.isDark ? 1 : 0);
    set("labelColours", "3fv", LABELS.flat());
    set("plain", "3fv", this.isDark ? [0.2, 0.24, 0.29] : LABELS[0]);
    set("strength", "1f", this.stage === SHADOW ? 1 : 0.62);
    set("replaced", "3fv", MARKS.replaced);
    set("only", "3fv", this.stage === BEFORE ? MARKS.replaced : MARKS.inverted);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * count);
  }

  // Fainter where edges are but a few pixels long, or the mesh would be a blot.
  drawLines() {
    const set = this.use(this.lines, this.all), gl = this.gl, length = this.frames.spacing * this.zoom;
    const alpha = Math.min(0.55, Math.max(0.05, length / 30));
    set("ink", "4f", ...(this.isDark ? [0.9, 0.94, 1] : [0.11, 0.15, 0.2]), alpha);
    gl.drawArrays(gl.LINES, 0, 6 * this.frames.nFaces);
  }

  // View: centre in units of the grid, zoom in pixels per unit.
  fit() { this.fitTo(this.boxOf((visit) => { for (const v of this.shown) visit(v); })); }

  // To where the run has replaced anything, if that is but a part of the mesh.
  fitToChanges() {
    const [x0, y0, x1, y1] = this.boxOf((visit) => {
      for (const { patches } of this.frames.list)
        for (const { changes } of patches)
          for (let i = 4; i < changes.length; i += 7)
            if (changes[i] !== changes[i + 1]) for (let k = 0; k < 3; ++k) visit(changes[i + k]);
    });
    const extent = Math.max(x1 - x0, y1 - y0), margin = 0.1 * extent;
    if (extent < 0.5) this.fitTo([x0 - margin, y0 - margin, x1 + margin, y1 + margin]);
  }

  fitTo([x0, y0, x1, y1]) {
    const { clientWidth, clientHeight } = this.canvas;
    this.centre = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.zoom = 0.92 * Math.min(clientWidth / Math.max(1e-9, x1 - x0), clientHeight / Math.max(1e-9, y1 - y0)) || 1;
    this.draw();
  }

  boxOf(forEachVertex) {
    const box = [Infinity, Infinity, -Infinity, -Infinity], { x } = this.frames, scale = 1 / this.frames.info.grid;
    forEachVertex((v) => {
      const px = x[2 * v] * scale, py = x[2 * v + 1] * scale;
      box[0] = Math.min(box[0], px); box[1] = Math.min(box[1], py);
      box[2] = Math.max(box[2], px); box[3] = Math.max(box[3], py);
    });
    return box[0] <= box[2] ? box : [0, 0, 1, 1];
  }

  zoomToLargest() {
    const patches = this.frames.list[this.number].patches.slice().sort((a, b) => b.changes.length - a.changes.length);
    if (!patches.length) return false;
    const { changes } = patches[0];
    const [x0, y0, x1, y1] = this.boxOf((visit) => { for (let i = 0; i < changes.length; i += 7) for (let k = 1; k < 7; ++k) visit(changes[i + k]); });
    const margin = 0.35 * Math.max(x1 - x0, y1 - y0);
    this.fitTo([x0 - margin, y0 - margin, x1 + margin, y1 + margin]);
    return true;
  }

  zoomBy(factor, px = this.canvas.clientWidth / 2, py = this.canvas.clientHeight / 2) {
    const under = this.unit(px, py);
    this.zoom = Math.min(1e8, Math.max(1, this.zoom * factor));
    const moved = this.unit(px, py);
    this.centre = [this.centre[0] + under[0] - moved[0], this.centre[1] + under[1] - moved[1]];
    this.draw();
  }

  unit(px, py) {
    return [this.centre[0] + (px - this.canvas.clientWidth / 2) / this.zoom, this.centre[1] - (py - this.canvas.clientHeight / 2) / this.zoom];
  }

  listen() {
    const canvas = this.canvas;
    let from = null;
    canvas.addEventListener("wheel", (e) => { e.preventDefault(); this.zoomBy(Math.exp(-e.deltaY * (e.deltaMode ? 0.05 : 0.0015)), e.offsetX, e.offsetY); }, { passive: false });
    canvas.addEventListener("pointerdown", (e) => { from = [e.offsetX, e.offsetY]; canvas.setPointerCapture(e.pointerId); });
    canvas.addEventListener("pointerup", () => { from = null; });
    canvas.addEventListener("pointermove", (e) => {
      if (!from) { this.hovered?.(e.offsetX, e.offsetY); return; }
      this.centre = [this.centre[0] - (e.offsetX - from[0]) / this.zoom, this.centre[1] + (e.offsetY - from[1]) / this.zoom];
      from = [e.offsetX, e.offsetY];
      this.draw();
    });
    canvas.addEventListener("pointerleave", () => this.hovered?.(null));
    canvas.addEventListener("dblclick", () => this.fit());
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  // What is shown at a pixel: face (or -1) and the nearest vertex within eight pixels (or -1).
  pick(px, py) {
    const [ux, uy] = this.unit(px, py), { frames, shown } = this, { x } = frames, grid = frames.info.grid, qx = ux * grid, qy = uy * grid;
    const side = (a, b) => (x[2 * b] - x[2 * a]) * (qy - x[2 * a + 1]) - (x[2 * b + 1] - x[2 * a + 1]) * (qx - x[2 * a]);
    let face = -1, vertex = -1, nearest = (8 / this.zoom * grid) ** 2;
    for (let f = 0; f < frames.nFaces; ++f) {
      const a = shown[3 * f], b = shown[3 * f + 1], c = shown[3 * f + 2];
      if (a === b) continue;
      const s = side(a, b), t = side(b, c), u = side(c, a);
      const isInside = (s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0);
      if (isInside && (face < 0 || this.regionOf[f] >= 0)) face = f;
      for (const v of isInside ? [a, b, c] : []) {
        const d = (x[2 * v] - qx) ** 2 + (x[2 * v + 1] - qy) ** 2;
        if (d < nearest) { nearest = d; vertex = v; }
      }
    }
    return { face, vertex };
  }
}
