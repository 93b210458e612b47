// Puts the page together: npm ci && node build.mjs [OUT]. What it writes, report.html, is committed, and the program
// has it inside; the program fills in the two data blocks.
import { readFileSync, writeFileSync } from "node:fs";

const here = new URL("./", import.meta.url);
const read = (name) => readFileSync(new URL(name, here), "utf8").trim();

const uplot = "node_modules/uplot/";
const parts = {
  style: read(uplot + "dist/uPlot.min.css") + "\n" + read("style.css"),
  library: `/*! ${read(uplot + "LICENSE")} */\n` + read(uplot + "dist/uPlot.iife.min.js"),
  script: ["frames.js", "player.js", "plots.js", "page.js"].map(read).join("\n\n"),
};
// A function, so that $ in the parts stays what it is.
const page = read("page.html").replace(/<!--(\w+)-->/g, (all, name) => parts[name] ?? all);
writeFileSync(process.argv[2] ?? new URL("report.html", here), page + "\n");
