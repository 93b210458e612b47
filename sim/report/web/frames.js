// The embedded data: what the two blocks hold, and the mesh at any frame. Layout: sim/report/frame_encoder.h.
"use strict";

async function embedded(id) {
  const text = document.getElementById(id).textContent.trim();
  if (!text) return null;
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

class ByteReader {
  constructor(bytes, at = 0) { this.bytes = bytes; this.at = at; }
  byte() { return this.bytes[this.at++]; }
  count() {  // seven bits a byte, low ones first
    let value = 0, scale = 1, byte;
    do { byte = this.bytes[this.at++]; value += (byte & 127) * scale; scale *= 128; } while (byte > 127);
    return value;
  }
  signed() { const n = this.count(); return n % 2 ? -(n + 1) / 2 : n / 2; }
}

const HELD = 1, EXTRAPOLATED = 2;  // 0: key frame

class Frames {
  constructor(info, bytes) {
    this.info = info;
    this.nFaces = info.slots;
    this.faces = new Int32Array(3 * info.slots);
    this.labels = new Int32Array(info.slots);
    this.x = new Int32Array(2 * info.vertices);
    this.earlier = new Int32Array(2 * info.vertices);
    this.bytes = bytes;
    this.at = -1;       // frame that x and earlier are of
    this.facesAt = 0;   // frame that faces are of; after its step
    const reader = new ByteReader(bytes);
    this.readStart(reader);
    const faces = this.faces.slice();
    this.list = info.frames.map(() => this.readFrame(reader, faces));
    this.spacing = Math.sqrt(1 / Math.max(1, info.vertices));
  }

  readStart(reader) {
    let corner = 0, label = 0;
    for (let i = 0; i < 3 * this.info.faces; ++i) this.faces[i] = corner += reader.signed();
    for (let f = 0; f < this.info.faces; ++f) this.labels[f] = label += reader.signed();
  }

  // Where the positions are; the changes with what they replace, so that they work both ways.
  readFrame(reader, faces) {
    const frame = { mode: reader.byte(), positions: reader.at, silent: null, patches: [], regions: [] };
    for (let i = 0; i < 2 * this.info.vertices; ++i) while (reader.bytes[reader.at++] > 127);
    frame.silent = this.readChanges(reader, faces);
    for (let n = reader.count(); n > 0; --n) {
      const regions = [];
      for (let k = reader.count(); k > 0; --k) regions.push(reader.count());
      frame.patches.push({ regions, changes: this.readChanges(reader, faces) });
    }
    for (let n = reader.count(); n > 0; --n) {
      const [seed, size, inverted, components, explored] = [0, 0, 0, 0, 0].map(() => reader.count());
      frame.regions.push({ seed: seed - 1, size, inverted, components, explored });
    }
    return frame;
  }

  // Seven numbers a face: which, corners before, corners after.
  readChanges(reader, faces) {
    const n = reader.count(), changes = new Int32Array(7 * n);
    for (let i = 0, face = 0; i < n; ++i) {
      face += reader.signed();
      changes[7 * i] = face;
      for (let k = 0; k < 3; ++k) {
        changes[7 * i + 1 + k] = faces[3 * face + k];
        changes[7 * i + 4 + k] = faces[3 * face + k] += reader.signed();
      }
    }
    return changes;
  }

  seek(number) {
    this.seekFaces(number);
    let first = number;
    while (first > 0 && this.list[first].mode > 0) --first;
    if (this.at <= number && this.at >= first) first = this.at + 1;
    for (let n = first; n <= number; ++n) this.readPositions(n);
  }

  readPositions(number) {
    const { mode, positions } = this.list[number], reader = new ByteReader(this.bytes, positions), { x, earlier } = this;
    if (mode === 0) {
      let px = 0, py = 0;
      for (let i = 0; i < x.length; i += 2) { x[i] = px += reader.signed(); x[i + 1] = py += reader.signed(); }
    } else {
      const factor = mode === EXTRAPOLATED ? 1 : 0;
      for (let i = 0; i < x.length; ++i) {
        const now = x[i];
        x[i] += factor * (now - earlier[i]) + reader.signed();
        earlier[i] = now;
      }
    }
    if (mode === 0) earlier.set(x);
    this.at = number;
  }

  seekFaces(number) {
    while (this.facesAt < number) this.forEachChange(++this.facesAt, (c, i) => this.faces.set(c.subarray(i + 4, i + 7), 3 * c[i]));
    while (this.facesAt > number) this.forEachChange(this.facesAt--, (c, i) => this.faces.set(c.subarray(i + 1, i + 4), 3 * c[i]), true);
  }

  forEachChange(number, visit, isBack = false) {
    const frame = this.list[number], all = [frame.silent, ...frame.patches.map((p) => p.changes)];
    if (isBack) all.reverse();
    for (const changes of all) {
      if (isBack) for (let i = changes.length - 7; i >= 0; i -= 7) visit(changes, i);
      else for (let i = 0; i < changes.length; i += 7) visit(changes, i);
    }
  }

  // User's coordinates.
  coordinates(vertex) {
    const { box } = this.info;
    return [box[0] + this.x[2 * vertex] * box[2], box[1] + this.x[2 * vertex + 1] * box[2]];
  }

  area(a, b, c) {  // twice, in steps of the grid
    const x = this.x;
    return (x[2 * b] - x[2 * a]) * (x[2 * c + 1] - x[2 * a + 1]) - (x[2 * b + 1] - x[2 * a + 1]) * (x[2 * c] - x[2 * a]);
  }
}
