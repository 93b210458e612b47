// Ties player, plots and keys together.
"use strict";

const $ = (id) => document.getElementById(id);

const isRepair = (patch) => patch.regions.length > 0;  // and no flips alone

class Page {
  constructor(data, frames) {
    this.data = data;
    $("title").textContent = document.title = data.title;
    $("facts").textContent = data.facts;
    $("scenario").textContent = data.scenario;
    $("scenario").parentElement.hidden = !data.scenario;
    this.notes = [...data.notes];
    this.frames = frames;
    this.setTheme(matchMedia("(prefers-color-scheme: dark)").matches);
    $("player").hidden = !frames;
    if (frames) this.startPlayer();
    document.querySelector("main").className = frames ? "" : "single";
    $("notes").textContent = this.notes.join("\n");
    this.startPlots();
    this.listen();
    if (!this.player) return;
    this.goTo(this.firstToSee());
    this.player.fitToChanges();
  }

  startPlayer() {
    try {
      this.player = new Player($("mesh"), this.frames);
    } catch (error) {
      this.notes.push(error.message);
      $("player").hidden = true;
      return;
    }
    this.player.isDark = this.isDark;
    this.player.hovered = (x, y) => { $("hover").textContent = x == null ? "" : this.describe(this.player.pick(x, y)); };
    $("scrub").max = this.frames.list.length - 1;
    $("views").hidden = !this.frames.list.some((f) => f.patches.some(isRepair));
    $("largest").hidden = $("views").hidden;
    this.showStage();
  }

  // So that there is something to look at: the first tangle, or else the most flips.
  firstToSee() {
    const { list } = this.frames, first = list.findIndex((f) => f.patches.some(isRepair));
    return first < 0 ? list.reduce((best, f, i) => (f.patches.length > list[best].patches.length ? i : best), 0) : first;
  }

  startPlots() {
    this.plots?.clear();
    this.benchPlots?.clear();
    this.plots ??= new Plots($("plots"), (time) => this.goToTime(time));
    $("bench").hidden = !this.data.bench;
    this.benchPlots ??= new Plots($("bench-plots"), () => {});
    if (this.data.steps?.time.length) addRunPlots(this.plots, this.data);
    if (this.data.bench) { addBenchPlots(this.benchPlots, this.data.bench); $("bench-table").replaceChildren(benchTable(this.data.bench)); }
    if (this.player) this.plots.moveTo(this.time());
  }

  time() { return this.frames.info.frames[this.player.number].time; }

  goToTime(time) {
    if (!this.player) return;
    let best = 0;
    this.frames.info.frames.forEach((frame, i, all) => { if (Math.abs(frame.time - time) < Math.abs(all[best].time - time)) best = i; });
    this.goTo(best);
  }

  goTo(number) {
    if (!this.player) return;
    const { info, list } = this.frames, n = Math.min(list.length - 1, Math.max(0, number)), frame = info.frames[n];
    this.player.show(n);
    $("scrub").value = n;
    $("now").textContent = `step ${frame.step}, time ${short(frame.time)}${info.from === "patches" ? ": " + this.tellChanges(list[n], frame.step) : ""}`;
    this.plots?.moveTo(frame.time);
  }

  tellChanges({ patches, regions }, step) {
    const repaired = patches.filter(isRepair), faces = repaired.reduce((sum, p) => sum + p.changes.length / 7, 0);
    const n = regions.length || repaired.length, { steps } = this.data, row = steps ? steps.step.lastIndexOf(step) : -1;
    const parts = [[faces, `${faces} replaced in ${n} region${n === 1 ? "" : "s"}`]];
    for (const [values, word] of [[steps?.quality_flips, "flip"], [steps?.quality_moves, "move"]])
      if (values?.[row]) parts.push([values[row], `${values[row]} ${word}${values[row] === 1 ? "" : "s"}`]);
    const told = parts.filter(([count]) => count > 0);
    return (told.length ? told : parts).map(([, text]) => text).join(", ");
  }

  play(isOn = !this.timer) {
    clearInterval(this.timer);
    this.timer = null;
    if (isOn && this.player) {
      if (this.player.number === this.frames.list.length - 1) this.goTo(0);
      this.timer = setInterval(() => {
        this.goTo(this.player.number + 1);
        if (this.player.number === this.frames.list.length - 1) this.play(false);
      }, 1000 / Number($("speed").value));
    }
    $("play").textContent = this.timer ? "❚❚ pause" : "▶ play";
  }

  setStage(stage) { if (!this.player || $("views").hidden) return; this.player.stage = stage; this.player.arrangeFaces(); this.player.draw(); this.showStage(); }

  showStage() {
    for (const button of $("views").children) button.setAttribute("aria-pressed", Number(button.dataset.view) === this.player.stage);
    const { stage, colouring } = this.player, entries = [];
    const add = (colour, text) => entries.push(`<i style="background:${colour}"></i>${text}`);
    if (stage === TANGLE) add("#d55e00", "inverted triangles, before the repair");
    if (stage === SHADOW) add("#d55e00", "their shadow alone");
    if (stage === BEFORE) add("#e69f00", "triangles that go (R*), drawn over each other");
    if (stage === AFTER && colouring === 0) add("#e69f00", this.frames.info.from === "patches" ? "replaced or flipped in this step" : "replaced since the last mesh written");
    if (stage === AFTER && colouring === 2) { add("#00224e", "smallest angle 0°"); add("#7c7b78", "30°"); add("#fee838", "60°"); }
    if (stage === AFTER && colouring === 1) [...new Set(this.frames.labels)].slice(0, 8).forEach((label) => add(`rgb(${LABELS[Math.abs(label) % 6].map((c) => c * (this.isDark ? 107 : 255))})`, `label ${label}`));
    $("legend").innerHTML = entries.join("");
    $("legend").hidden = entries.length === 0;
  }

  setTheme(isDark) {
    this.isDark = isDark;
    document.documentElement.classList.toggle("dark", isDark);
    if (this.player) { this.player.isDark = isDark; this.player.draw(); this.showStage(); }
    if (this.plots) this.startPlots();
  }

  setColouring(value) { if (!this.player) return; $("colour").value = value; this.player.colouring = value; this.player.stage = AFTER; this.player.arrangeFaces(); this.player.draw(); this.showStage(); }
  setEdges(isOn) { if (!this.player) return; $("edges").checked = isOn; this.player.hasEdges = isOn; this.player.draw(); }

  describe({ face, vertex }) {
    if (face < 0) return "";
    const { frames, player } = this, corners = [...player.shown.subarray(3 * face, 3 * face + 3)], region = player.regionOf[face];
    const points = corners.map((v) => frames.coordinates(v));
    const lines = [`triangle ${face}: vertices ${corners.join(", ")}; label ${frames.labels[face]}`];
    const area = ((points[1][0] - points[0][0]) * (points[2][1] - points[0][1]) - (points[1][1] - points[0][1]) * (points[2][0] - points[0][0])) / 2;
    const angles = [0, 1, 2].map((k) => {
      const [p, q, r] = [points[k], points[(k + 1) % 3], points[(k + 2) % 3]];
      return Math.abs(Math.atan2((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]), (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1])));
    });
    lines.push(`area ${short(area)}, smallest angle ${short(Math.min(...angles) * 180 / Math.PI)}°${area < 0 ? ", inverted" : ""}`);
    const known = frames.list[player.number].regions[region];
    if (region >= 0) lines.push(`region ${region}` + (known ? `: seed ${known.seed}, ${known.size} triangles, ${known.inverted} inverted in ${known.components} pieces, ${known.explored} explored` : ""));
    if (vertex >= 0) lines.push(`vertex ${vertex}: ${frames.coordinates(vertex).map((c) => Number(c.toPrecision(7))).join(", ")}`);
    return lines.join("\n");
  }

  listen() {
    $("play").onclick = () => this.play();
    $("back").onclick = () => this.goTo(this.player.number - 1);
    $("forth").onclick = () => this.goTo(this.player.number + 1);
    $("scrub").oninput = () => this.goTo(Number($("scrub").value));
    $("speed").onchange = () => { if (this.timer) this.play(true); };
    $("colour").onchange = () => this.setColouring(Number($("colour").value));
    $("edges").onchange = () => this.setEdges($("edges").checked);
    $("fit").onclick = () => this.player.fit();
    $("largest").onclick = () => this.player.zoomToLargest();
    $("theme").onclick = () => this.setTheme(!this.isDark);
    $("help").onclick = () => $("keys").showModal();
    $("close").onclick = () => $("keys").close();
    for (const button of $("views").children) button.onclick = () => this.setStage(Number(button.dataset.view));
    document.addEventListener("keydown", (e) => this.key(e));
  }

  key(e) {
    if (e.ctrlKey || e.metaKey || e.altKey || $("keys").open || e.target.matches("select")) return;
    const n = this.player?.number ?? 0, far = e.shiftKey ? 10 : 1;
    const actions = {
      " ": () => this.play(), ArrowLeft: () => this.goTo(n - far), ArrowRight: () => this.goTo(n + far), Home: () => this.goTo(0), End: () => this.goTo(Infinity),
      1: () => this.setStage(TANGLE), 2: () => this.setStage(SHADOW), 3: () => this.setStage(BEFORE), 4: () => this.setStage(AFTER),
      c: () => this.setColouring(((this.player?.colouring ?? 0) + 1) % 4), e: () => this.setEdges(!$("edges").checked),
      f: () => this.player?.fit(), z: () => this.player?.zoomToLargest(), t: () => this.setTheme(!this.isDark), "?": () => $("keys").showModal(),
      "+": () => this.player?.zoomBy(1.4), "-": () => this.player?.zoomBy(1 / 1.4),
    };
    if (!actions[e.key]) return;
    e.preventDefault();
    actions[e.key]();
  }
}

(async () => {
  const data = JSON.parse(new TextDecoder().decode(await embedded("data")));
  const bytes = data.mesh ? await embedded("frames") : null;
  window.page = new Page(data, bytes ? new Frames(data.mesh, bytes) : null);
  document.documentElement.dataset.ready = "yes";
})().catch((error) => { $("notes").textContent = "This report cannot be shown: " + error.message; console.error(error); });
