// Opens reports in a real browser and uses them: node browser_test.mjs CHROMIUM FOLDER [--update]
//
// FOLDER holds the reports that report_test.py has made. The pictures are compared with those in reference/, each
// pixel averaged with its neighbours and with a tolerance, so that another version's anti-aliasing does not matter;
// --update replaces them, to be looked at before they are committed.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { PNG } from "pngjs";
import { chromium } from "playwright-core";

const [program, folder, flag] = process.argv.slice(2);
const reference = new URL("reference/", import.meta.url).pathname;

const browser = await chromium.launch({
  executablePath: program,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-lcd-text"],
});

async function open(name, options = {}) {
  const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: "light", offline: true, ...options })).newPage();
  const complaints = [];
  page.on("console", (message) => { if (["error", "warning"].includes(message.type()) && !/GPU stall|swiftshader/i.test(message.text())) complaints.push(message.text()); });
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("request", (request) => { if (!/^(file|data|blob):/.test(request.url())) complaints.push("asks for " + request.url()); });
  await page.goto(pathToFileURL(`${folder}/${name}.html`).href);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "yes", null, { timeout: 60000 });
  return { page, complaints };
}

const frame = (page) => page.evaluate(() => window.page.player.number);
const painted = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

// Averages over blocks of 8 x 8 pixels.
function blocks({ width, height, data }) {
  const size = 8, w = Math.floor(width / size), h = Math.floor(height / size), means = new Float64Array(3 * w * h);
  for (let y = 0; y < h * size; ++y)
    for (let x = 0; x < w * size; ++x)
      for (let c = 0; c < 3; ++c) means[3 * (Math.floor(y / size) * w + Math.floor(x / size)) + c] += data[4 * (y * width + x) + c] / size ** 2;
  return means;
}

async function compare(page, name) {
  await painted(page);
  const bytes = await page.locator("#stage").screenshot(), file = `${reference}${name}.png`;
  writeFileSync(`${folder}/${name}.png`, bytes);
  if (flag === "--update") { mkdirSync(reference, { recursive: true }); writeFileSync(file, bytes); return; }
  assert(existsSync(file), `${file} is missing`);
  const now = PNG.sync.read(bytes), then = PNG.sync.read(readFileSync(file));
  assert.deepEqual([now.width, now.height], [then.width, then.height], name);
  const a = blocks(now), b = blocks(then);
  let differing = 0;
  for (let i = 0; i < a.length; ++i) differing += Math.abs(a[i] - b[i]) > 24;
  assert(differing < a.length / 50, `${name}: ${differing} of ${a.length} blocks differ, see ${folder}/${name}.png`);
}

const tests = {
  async "a run opens without complaint and shows what its steps replaced"() {
    const { page, complaints } = await open("rotor");
    assert((await frame(page)) > 0, "starts at a step that replaced something");
    assert.match(await page.textContent("#now"), /^step \d+, time [\d.]+: [1-9]\d* replaced in [1-9]\d* regions$/);
    assert.match(await page.textContent("#facts"), /^600 vertices, \d+ triangles, 12 steps/);
    assert.equal(await page.locator("#plots .plot").count(), 5);
    await page.evaluate(() => window.page.goTo(6));
    for (const key of ["1", "2", "3", "4"]) {
      await page.keyboard.press(key);
      await compare(page, `rotor_${key}`);
    }
    await page.keyboard.press("z");
    await compare(page, "rotor_largest");
    await page.keyboard.press("f");
    await page.selectOption("#colour", "2");
    await compare(page, "rotor_quality");
    await page.selectOption("#colour", "1");
    await page.keyboard.press("t");
    await compare(page, "rotor_dark");
    writeFileSync(`${folder}/whole_dark.png`, await page.screenshot());
    await page.keyboard.press("t");
    writeFileSync(`${folder}/whole_light.png`, await page.screenshot());
    assert.deepEqual(complaints, []);
  },

  async "a run of bodies that tangles nowhere shows angles, what was done for them, and times"() {
    const { page, complaints } = await open("body");
    assert.deepEqual(await page.locator("#plots .u-title").allTextContents(), ["smallest angle, degrees", "moved and flipped for quality", "time of a step, ms"]);
    assert.match(await page.textContent("#plots .told"), /^No step has turned a triangle over/);
    assert.match(await page.textContent("#now"), /^step \d+, time [\d.]+: [1-9]\d* flips?(, [1-9]\d* moves?)?$/);
    assert.equal(await page.locator("#views").isVisible(), false);
    const phases = await page.locator("#plots .plot").last().locator(".u-legend th").allTextContents();
    for (const phase of ["interior", "quality", "detect", "move"]) assert(phases.some((text) => text.includes(phase)), phase);
    assert.deepEqual(complaints, []);
  },

  async "every frame is the mesh that the run has written, upright and whole"() {
    const { page } = await open("rotor");
    const areas = await page.evaluate(() => {
      const { frames } = window.page, sums = [];
      for (const n of [...frames.list.keys(), 3, 11, 0, 7]) {  // on, back, and about
        frames.seek(n);
        let sum = 0, least = Infinity;
        for (let f = 0; f < frames.nFaces; ++f) {
          const area = frames.area(...frames.faces.subarray(3 * f, 3 * f + 3));
          sum += area; least = Math.min(least, area);
        }
        sums.push([sum / 2 / frames.info.grid ** 2, least]);
      }
      return sums;
    });
    assert.equal(areas.length, 13 + 4);
    for (const [sum, least] of areas) {
      assert(Math.abs(sum - 1) < 1e-3, `area ${sum}`);
      assert(least > -2000, `an inverted triangle, ${least}`);  // slivers may be turned by rounding, by little
    }
  },

  async "the player advances, pauses, and follows slider, keys and plots"() {
    const { page, complaints } = await open("rotor");
    await page.evaluate(() => window.page.goTo(0));
    await page.selectOption("#speed", "60");
    await page.click("#play");
    await page.waitForFunction(() => window.page.player.number === 12);
    assert.match(await page.textContent("#play"), /play/);
    await page.focus("#stage");
    await page.keyboard.press("Home");
    assert.equal(await frame(page), 0);
    await page.keyboard.press("ArrowRight");
    assert.equal(await frame(page), 1);
    await page.keyboard.press("Space");
    await page.keyboard.press("Space");
    assert.match(await page.textContent("#play"), /play/);
    await page.locator("#scrub").fill("5");
    assert.equal(await frame(page), 5);
    const box = await page.locator("#plots .u-over").first().boundingBox();
    await page.mouse.click(box.x + box.width * 0.995, box.y + box.height / 2);
    assert.equal(await frame(page), 12);
    await page.mouse.click(box.x + 1, box.y + box.height / 2);
    assert((await frame(page)) <= 1);
    assert.deepEqual(complaints, []);
  },

  async "pointing tells triangle, region and vertex; the wheel zooms to the pointer"() {
    const { page, complaints } = await open("rotor");
    await page.evaluate(() => window.page.goTo(6));
    await page.keyboard.press("z");
    const box = await page.locator("#mesh").boundingBox(), at = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(...at);
    const told = await page.textContent("#hover");
    assert.match(told, /^triangle \d+: vertices \d+, \d+, \d+; label 0\narea [\d.e-]+, smallest angle [\d.]+°/);
    const unit = () => page.evaluate(([x, y]) => { const p = window.page.player; const b = p.canvas.getBoundingClientRect(); return [...p.unit(x - b.left, y - b.top), p.zoom]; }, [at[0] + 90, at[1] - 70]);
    const before = await unit();
    await page.mouse.move(at[0] + 90, at[1] - 70);
    await page.mouse.wheel(0, -400);
    await page.waitForFunction((zoom) => window.page.player.zoom > 1.5 * zoom, before[2]);
    const after = await unit();
    assert(Math.abs(before[0] - after[0]) < 1e-3 && Math.abs(before[1] - after[1]) < 1e-3, "the point under the pointer stays");
    await page.mouse.down(); await page.mouse.move(at[0], at[1]); await page.mouse.up();
    assert(Math.abs((await unit())[0] - after[0]) > 1e-3, "dragging pans");
    assert.deepEqual(complaints, []);
  },

  async "opens where a run has replaced anything, if that is but a part of the mesh"() {
    const { page } = await open("rotor");
    const zooms = await page.evaluate(() => {
      const { player, frames } = window.page, shown = [player.zoom], kept = frames.list[6].patches[0];
      player.fit(); shown.push(player.zoom);
      for (const frame of frames.list) frame.patches = [];
      player.fitToChanges(); shown.push(player.zoom);
      frames.list[6].patches = [kept];
      player.fitToChanges(); shown.push(player.zoom);
      return shown;
    });
    assert.equal(zooms[0], zooms[1], "of the rotor all is shown");
    assert.equal(zooms[1], zooms[2], "nothing replaced");
    assert(zooms[3] > 1.8 * zooms[2]);
  },

  async "runs without steps, with one, with ten thousand, without meshes; benchmarks"() {
    for (const [name, wanted] of [["none", /No step has been made/], ["one", null], ["old", null], ["many", /The plots show one of every 2 steps/], ["no_meshes", /No meshes to play/], ["series", /Only the meshes written/], ["thinned", /The player has \d+ of \d+ frames/]]) {
      const { page, complaints } = await open(name);
      if (wanted) assert.match(await page.textContent("#notes"), wanted, name);
      assert.equal(await page.locator("#player").isVisible(), !["no_meshes", "many"].includes(name), name);
      assert.equal(await page.locator("#plots .plot").count(), { none: 0, one: 2, many: 4 }[name] ?? 5, name);
      assert.deepEqual(complaints, [], name);
      await page.context().close();
    }
    const { page, complaints } = await open("bench");
    assert.equal(await page.locator("#bench-plots .plot").count(), 4);
    assert.equal(await page.locator("#bench-table tr").count(), 3);
    writeFileSync(`${folder}/whole_bench.png`, await page.screenshot({ fullPage: true }));
    const sweep = await open("sweep");
    assert.equal(await sweep.page.locator("#bench-plots .plot").count(), 4);
    assert.deepEqual(await sweep.page.evaluate(() => window.page.benchPlots.list[0].data[0]), [0.01, 0.02, 0.04]);
    assert.equal(await sweep.page.locator("#bench-table tr").count(), 1 + 3 * 2);
    const lists = await open("lists");
    assert.deepEqual(await lists.page.evaluate(() => { const plot = window.page.benchPlots.list[0]; return [plot.data[0], plot.axes[0]._values]; }), [[0, 1], ["none", "delaunay"]]);
    writeFileSync(`${folder}/whole_lists.png`, await lists.page.screenshot({ fullPage: true }));
    writeFileSync(`${folder}/whole_sweep.png`, await sweep.page.screenshot({ fullPage: true }));
    assert.deepEqual([...lists.complaints, ...sweep.complaints], []);
    const narrow = await open("rotor", { viewport: { width: 480, height: 800 }, colorScheme: "dark" });
    assert(await narrow.page.evaluate(() => document.documentElement.classList.contains("dark") && document.documentElement.scrollWidth <= 480), "fits a narrow window, dark where that is wanted");
    assert.deepEqual([...complaints, ...narrow.complaints], []);
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test();
    console.log(`ok: ${name}`);
  } catch (error) {
    console.log(`FAILED: ${name}\n${error.stack}`);
    ++failed;
  }
}
await browser.close();
process.exit(failed ? 1 : 0);
