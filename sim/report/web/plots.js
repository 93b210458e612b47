// Plots over time with uPlot. A click goes to the step.
"use strict";

// Okabe and Ito, in an order that also differs in lightness.
const HUES = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#8c7a00"];
const colourOf = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const short = (value) => (value == null ? "–" : Number(value.toPrecision(4)).toString());
const SYNC = "time";

class Plots {
  constructor(place, goTo) {
    this.place = place;
    this.goTo = goTo;
    this.list = [];
    this.now = null;  // the time the player is at
    new ResizeObserver(() => this.resize()).observe(place);
  }

  width(holder) { return Math.max(240, holder.clientWidth); }
  resize() { for (const plot of this.list) plot.setSize({ width: this.width(plot.root.parentElement), height: 176 }); }
  clear() { for (const plot of this.list) plot.destroy(); this.list = []; this.place.replaceChildren(); }

  axis(extra = {}) {
    const line = { stroke: colourOf("--rule"), width: 1 };
    return { stroke: colourOf("--ink"), grid: line, ticks: line, size: 58, ...extra };
  }

  // lines: [{ label, values, fill, shown }]; `shown` for the legend where `values` are sums.
  // categories: names of x = 0, 1, ..., where x is no number.
  add(title, x, lines, { log = false, xLabel = null, xLog = false, sync = true, categories = null } = {}) {
    const holder = document.createElement("div");
    holder.className = "plot";
    this.place.append(holder);
    const series = lines.map(({ label, fill, shown }, i) => ({
      label, stroke: HUES[i % HUES.length], width: fill ? 1 : 1.8, fill: fill ? HUES[i % HUES.length] + "cc" : undefined,
      points: { show: x.length < 60, size: categories ? 8 : 5 }, spanGaps: false, paths: categories ? () => null : undefined,
      value: (plot, value, index, at) => (at == null ? "–" : short(shown ? shown[at] : value)),
    }));
    // A logarithm has no place for 0: such points are left out.
    const cleaned = (values) => (log ? values.map((v) => (v > 0 ? v : null)) : values);
    const positive = log && lines.some((line) => line.values.some((v) => v > 0));
    const named = categories && { splits: () => x, values: () => categories };
    const options = {
      title, width: this.width(holder), height: 176,
      cursor: { sync: sync ? { key: SYNC } : undefined, drag: { x: true, y: false } },
      scales: { x: { time: false, distr: xLog ? 3 : 1, range: categories ? [-0.5, x.length - 0.5] : undefined }, y: { distr: positive ? 3 : 1 } },
      axes: [this.axis({ size: 34, label: xLabel ?? undefined, labelSize: xLabel ? 16 : 0, ...named }), this.axis()],
      series: [{ label: xLabel ?? "time", value: (plot, value) => (categories ? categories[value] ?? "–" : short(value)) }, ...series],
      hooks: { draw: [(plot) => this.mark(plot, sync)] },
    };
    const plot = new uPlot(options, [x, ...lines.map((line) => cleaned(line.values))], holder);
    if (sync) this.watchClicks(plot);
    this.list.push(plot);
  }

  watchClicks(plot) {
    let down = null;
    plot.over.addEventListener("mousedown", (e) => { down = e.offsetX; });
    plot.over.addEventListener("mouseup", (e) => { if (down != null && Math.abs(e.offsetX - down) < 4) this.goTo(plot.posToVal(e.offsetX, "x")); down = null; });
  }

  mark(plot, isTimed) {
    if (!isTimed || this.now == null) return;
    const x = plot.valToPos(this.now, "x", true), { ctx, bbox } = plot;
    if (!(x >= bbox.left && x <= bbox.left + bbox.width)) return;
    ctx.save();
    ctx.strokeStyle = colourOf("--ink");
    ctx.lineWidth = 1.5 * (window.devicePixelRatio || 1);
    ctx.setLineDash([5, 4]);
    ctx.beginPath(); ctx.moveTo(x, bbox.top); ctx.lineTo(x, bbox.top + bbox.height); ctx.stroke();
    ctx.restore();
  }

  moveTo(time) { this.now = time; for (const plot of this.list) plot.redraw(false, false); }

  // The biggest sum is drawn first, the others over it.
  addStacked(title, x, parts) {
    let below = x.map(() => 0);
    const lines = parts.map(({ label, values }) => ({ label, shown: values, fill: true, values: (below = below.map((sum, i) => sum + values[i])) }));
    this.add(title, x, lines.reverse());
  }
}

const PHASES = ["move", "detect", "explore", "triangulate", "splice", "quality"];

function addRunPlots(plots, { steps, sizes }) {
  const share = steps.replaced.map((n, i) => (steps.faces[i] > 0 ? (100 * n) / steps.faces[i] : null));
  plots.add("inverted and flat triangles", steps.time, [{ label: "inverted", values: steps.inverted }, { label: "flat", values: steps.degenerate }]);
  if (sizes) {
    plots.add("triangles in a region", sizes.time, [
      { label: "largest", values: sizes.max }, { label: "9 of 10 up to", values: sizes.p90 },
      { label: "median", values: sizes.median }, { label: "regions", values: sizes.count }], { log: true });
  }
  plots.add("replaced, % of the triangles", steps.time, [{ label: "%", values: share }]);
  plots.add("smallest angle, degrees", steps.time, [{ label: "degrees", values: steps.min_angle_deg }]);
  plots.addStacked("time of a step, ms", steps.time, PHASES.map((name) => ({ label: name, values: steps[name + "_ms"] })));
}

const median = (values) => { const sorted = values.filter((v) => v != null).sort((a, b) => a - b); return sorted.length ? sorted[sorted.length >> 1] : null; };
const BENCH = [["total_ms", "time of a step, ms", true], ["share", "replaced, % of the triangles", true], ["min_angle_deg", "smallest angle, degrees", false], ["inverted", "inverted triangles", false]];

// rows: columns by name, one strategy after the other. `swept`: names of the columns that a sweep has varied.
function addBenchPlots(plots, { rows, strategies, swept }) {
  rows.share = rows.replaced.map((n, i) => (rows.faces[i] > 0 ? (100 * n) / rows.faces[i] : null));
  const curves = (x, of, column) => strategies.map((name) => {
    const found = new Map();
    rows.strategy.forEach((s, i) => { if (s === name) found.has(of(i)) ? found.get(of(i)).push(rows[column][i]) : found.set(of(i), [rows[column][i]]); });
    return { label: name, values: x.map((value) => median(found.get(value) ?? [])) };
  });
  const axisOf = (of) => {  // numbers in order, names as they come
    const all = [...new Set(rows.strategy.map((_, i) => of(i)))];
    return typeof all[0] === "string" ? all : all.sort((a, b) => a - b);
  };
  for (const [column, title, log] of BENCH) {
    if (swept.length === 0) {
      const x = axisOf((i) => rows.time[i]);
      plots.add(title, x, curves(x, (i) => rows.time[i], column), { log, xLabel: "time", sync: false });
    }
    for (const key of swept) {
      const all = axisOf((i) => rows[key][i]), categories = typeof all[0] === "string" ? all : null;
      const x = categories ? all.map((_, i) => i) : all, isLog = !categories && x[0] > 0 && x[x.length - 1] > 3 * x[0];
      const place = categories ? (i) => all.indexOf(rows[key][i]) : (i) => rows[key][i];
      plots.add(`${title}, median`, x, curves(x, place, column), { log, xLog: isLog, xLabel: key, sync: false, categories });
    }
  }
}

// One row a strategy, and a value of what is swept.
function benchTable({ rows, strategies, swept }) {
  const table = document.createElement("table");
  const add = (cells, kind) => { const row = table.insertRow(); for (const cell of cells) { const c = document.createElement(kind); c.textContent = cell; row.append(c); } };
  add(["strategy", ...swept, "steps", "median ms", "replaced %", "worst angle", "without valid mesh"], "th");
  const cases = [...new Map(rows.strategy.map((_, i) => [JSON.stringify(swept.map((key) => rows[key][i])), swept.map((key) => rows[key][i])])).values()];
  for (const values of cases) {
    for (const name of strategies) {
      const isOf = (i) => rows.strategy[i] === name && swept.every((key, k) => rows[key][i] === values[k]);
      const of = (column) => rows[column].filter((_, i) => isOf(i));
      const angles = of("min_angle_deg").filter((v) => v != null);
      add([name, ...values, of("step").length, short(median(of("total_ms"))), short(median(of("share"))), short(angles.reduce((a, b) => Math.min(a, b), 180)), of("accepted").filter((v) => v === 0).length], "td");
    }
  }
  return table;
}
