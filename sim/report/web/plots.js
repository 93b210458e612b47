// Plots over time with uPlot. A click goes to the step.
"use strict";

// Okabe and Ito, in an order that also differs in lightness; what is hard to see on the page's ground comes last.
const HUES = { light: ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#8c7a00"],
  dark: ["#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#f0e442", "#0072b2"] };
const colourOf = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const short = (value) => (value == null ? "–" : Number(value.toPrecision(4)).toString());
const SYNC = "time";

// Areas and shares would deceive without their zero.
const fromZero = (plot, min, max) => [0, max > 0 ? uPlot.rangeNum(0, max, 0.1, true)[1] : 1];

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
  // ticks: where the x axis has them, by their names; isPoints: the values between have no meaning. Where lines may
  // run over each other (isNested), the later ones are thinner.
  add(title, x, lines, { log = false, xLabel = null, xLog = false, sync = true, ticks = null, isPoints = false, isNested = false } = {}) {
    const hues = HUES[document.documentElement.classList.contains("dark") ? "dark" : "light"];
    const extra = (i) => (isNested ? 1.6 * (lines.length - 1 - i) : 0);
    const holder = document.createElement("div");
    holder.className = "plot";
    this.place.append(holder);
    const series = lines.map(({ label, fill, shown }, i) => ({
      label, stroke: hues[i % hues.length], width: fill ? 1 : 1.8 + extra(i), fill: fill ? hues[i % hues.length] + "cc" : undefined,
      points: { show: x.length < 60, size: (isPoints ? 8 : 5) + 2 * extra(i) }, spanGaps: false, paths: isPoints ? () => null : undefined,
      value: (plot, value, index, at) => (at == null ? "–" : short(shown ? shown[at] : value)),
    }));
    // A logarithm has no place for 0: such points are left out.
    const cleaned = (values) => (log ? values.map((v) => (v > 0 ? v : null)) : values);
    const positive = log && lines.some((line) => line.values.some((v) => v > 0));
    const first = x[0], last = x[x.length - 1], step = x.length > 1 ? (last - first) / (x.length - 1) / 2 : 0.5;
    const range = ticks && (() => (xLog ? [first / 1.15, last * 1.15] : [first - step, last + step]));
    const named = ticks && { splits: () => x, values: () => ticks, filter: (plot, splits) => splits };
    const options = {
      title, width: this.width(holder), height: 176,
      cursor: { sync: sync ? { key: SYNC } : undefined, drag: { x: true, y: false } },
      scales: { x: { time: false, distr: xLog ? 3 : 1, range: range ?? undefined }, y: positive ? { distr: 3 } : { range: fromZero } },
      axes: [this.axis({ size: 34, label: xLabel ?? undefined, labelSize: xLabel ? 16 : 0, ...named }), this.axis()],
      series: [{ label: xLabel ?? "time", value: (plot, value, index, at) => (at == null ? "–" : ticks ? ticks[at] : short(value)) }, ...series],
      hooks: { draw: [(plot) => this.mark(plot, sync)], setCursor: [(plot) => { if (sync && plot.cursor.idx == null) this.tellNow(plot); }] },
    };
    const plot = new uPlot(options, [x, ...lines.map((line) => cleaned(line.values))], holder);
    if (sync) this.watchClicks(plot);
    this.list.push(plot);
  }

  tell(text) { const p = document.createElement("p"); p.className = "told"; p.textContent = text; this.place.append(p); }

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

  moveTo(time) {
    this.now = time;
    for (const plot of this.list) { plot.redraw(false, false); this.tellNow(plot); }
  }

  // The player's step in the legend, while nobody points at another.
  tellNow(plot) {
    if (this.now == null || plot.cursor.idx != null) return;
    const idx = plot.valToIdx(this.now);
    if (plot.legend.idx !== idx) plot.setLegend({ idx }, false);
  }

  // The biggest sum is drawn first, the others over it.
  addStacked(title, x, parts) {
    let below = x.map(() => 0);
    const lines = parts.map(({ label, values }) => ({ label, shown: values, fill: true, values: (below = below.map((sum, i) => sum + values[i])) }));
    this.add(title, x, lines.reverse());
  }
}

const PHASES = ["move", "interior", "detect", "explore", "triangulate", "splice", "quality"];

function addRunPlots(plots, { steps, sizes }) {
  const isAny = (values) => values?.some((n) => n > 0), isTangled = isAny(steps.inverted) || isAny(steps.degenerate);
  if (isTangled) addTanglePlots(plots, steps, sizes);
  plots.add("smallest angle, degrees", steps.time, [{ label: "degrees", values: steps.min_angle_deg }]);
  if (isAny(steps.quality_moves) || isAny(steps.quality_flips)) {
    plots.add("moved and flipped for quality", steps.time, [["moves of vertices", steps.quality_moves], ["flipped edges", steps.quality_flips]]
      .filter(([, values]) => values).map(([label, values]) => ({ label, values })));
  }
  const phases = PHASES.filter((name) => isAny(steps[name + "_ms"]));
  plots.addStacked("time of a step, ms", steps.time, phases.map((name) => ({ label: name, values: steps[name + "_ms"] })));
  if (!isTangled) plots.tell("No step has turned a triangle over: nothing had to be repaired.");
}

function addTanglePlots(plots, steps, sizes) {
  const share = steps.replaced.map((n, i) => (steps.faces[i] > 0 ? (100 * n) / steps.faces[i] : null));
  plots.add("inverted and flat triangles", steps.time, [{ label: "inverted", values: steps.inverted }, { label: "flat", values: steps.degenerate }]);
  if (sizes) {
    plots.add("triangles in a region", sizes.time, [
      { label: "largest", values: sizes.max }, { label: "9 of 10 up to", values: sizes.p90 },
      { label: "median", values: sizes.median }, { label: "regions", values: sizes.count }], { log: true });
  }
  plots.add("replaced, % of the domain's triangles", steps.time, [{ label: "%", values: share }]);
}

const median = (values) => { const sorted = values.filter((v) => v != null).sort((a, b) => a - b); return sorted.length ? sorted[sorted.length >> 1] : null; };
const BENCH = [["total_ms", "time of a step, ms", true], ["share", "replaced, % of the domain's triangles", true], ["min_angle_deg", "smallest angle, degrees", false], ["inverted", "inverted triangles", false]];

// rows: columns by name, one strategy after the other. `swept`: names of the columns that a sweep has varied.
function addBenchPlots(plots, { rows, strategies, swept }) {
  rows.share = rows.replaced.map((n, i) => (rows.faces[i] > 0 ? (100 * n) / rows.faces[i] : null));
  // Without a valid mesh there is nothing to compare.
  rows.accepted.forEach((isValid, i) => { if (!isValid) rows.share[i] = rows.total_ms[i] = rows.min_angle_deg[i] = null; });
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
      plots.add(title, x, curves(x, (i) => rows.time[i], column), { log, xLabel: "time", sync: false, isNested: true });
    }
    for (const key of swept) {
      const all = axisOf((i) => rows[key][i]), isPoints = typeof all[0] === "string";
      const x = isPoints ? all.map((_, i) => i) : all, xLog = !isPoints && x[0] > 0 && x[x.length - 1] > 3 * x[0];
      const place = isPoints ? (i) => all.indexOf(rows[key][i]) : (i) => rows[key][i];
      const ticks = all.length <= 12 ? all.map((value) => (isPoints ? value : short(value))) : null;
      plots.add(`${title}, median`, x, curves(x, place, column), { log, xLog, xLabel: key, sync: false, ticks, isPoints, isNested: true });
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
