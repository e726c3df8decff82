#pragma once
// Style and script of the page over a cohort; its data goes between the two as JSON.

#include <string_view>

namespace voxelcore
{

inline constexpr std::string_view kCohortPageHead = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>VoxelCore: a cohort</title>
<style>
:root { color-scheme: light; --line: #d8dce2; --soft: #5c6673; --bad: #b3261e; --mark: #fff1c2; }
body { font: 14px/1.4 system-ui, "DejaVu Sans", sans-serif; margin: 0; color: #1b2028; background: #fff; }
header { padding: 14px 20px 10px; border-bottom: 1px solid var(--line); position: sticky; top: 0; left: 0;
  background: #fff; z-index: 2; }
h1 { font-size: 18px; margin: 0 0 6px; }
#filter { font: inherit; padding: 5px 8px; width: 22em; max-width: 60vw; border: 1px solid #9aa3af;
  border-radius: 4px; }
#status, label { color: var(--soft); margin-left: 12px; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th { position: sticky; top: var(--top, 76px); background: #f3f5f8; text-align: left; font-weight: 600;
  vertical-align: bottom; border-bottom: 1px solid var(--line); padding: 0; }
th button { all: unset; cursor: pointer; padding: 5px 8px; line-height: 1.2; display: block; }
th button:focus-visible { outline: 2px solid #3d6fd1; outline-offset: -2px; }
td { padding: 4px 8px; border-bottom: 1px solid #e8ebef; vertical-align: middle; }
td.n { text-align: right; white-space: nowrap; }
td.o { background: var(--mark); font-weight: 600; }
td.o::after { content: attr(data-way); color: #8a5a00; }
tr.failed td { background: #fdecea; }
tr.more td.id:nth-child(2) { color: #a3acb8; }
td.reason { color: var(--bad); overflow-wrap: anywhere; }
td.id { overflow-wrap: anywhere; min-width: 11em; max-width: 22em; }
td.w { color: var(--soft); font-size: 12px; }
td.w div { overflow: hidden; min-width: 18em; max-width: 30em; display: -webkit-box; -webkit-box-orient: vertical;
  -webkit-line-clamp: 4; }
div.h { width: 120px; height: 36px; display: flex; align-items: flex-end; border-bottom: 1px solid #9aa3af; }
div.h i { background: #6b8fc9; border-right: 1px solid #fff; box-sizing: border-box; }
td.files { min-width: 15em; line-height: 1.2; }
img { width: 64px; height: 64px; display: block; }
.pass { color: #14713a; } .bad { color: var(--bad); font-weight: 600; }
a { color: #1f56b5; margin-right: 6px; font-size: 12px; }
</style>
</head>
<body>
<header>
<h1>VoxelCore: a cohort</h1>
<input id="filter" type="search" placeholder="Filter: words of id, label, reason, warning" aria-label="Filter">
<label><input id="marked" type="checkbox"> outliers only</label>
<span id="status" role="status"></span>
</header>
<table><thead><tr id="heads"></tr></thead><tbody id="rows"></tbody></table>
<noscript>This page needs JavaScript; the same numbers are in labels.csv and cases.csv.</noscript>
<script id="data" type="application/json">)html";

inline constexpr std::string_view kCohortPageTail = R"html(</script>
<script>
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const byId = name => document.getElementById(name);
const N = data.columns.length;
// One entry per row: a label of a case, or a case that failed.
const all = [];
data.cases.forEach((c, order) => {
  if (!c.done) all.push({ c, order, failed: true, text: [c.id, c.reason].join(" ").toLowerCase() });
  c.labels.forEach(l => all.push({ c, l, order, failed: false,
    text: [c.id, l.name, l.label, c.warnings.join(" "),
      l.certificate === null ? "" : l.certificate ? "passed" : "failed"].join(" ")
      .toLowerCase() }));
});
const H = all.some(r => !r.failed && r.l.histogram) ? 1 : 0;
const heads = ["", "id", "label", ...data.columns, ...(H ? ["histogram"] : []), "certificate", "outliers", "warnings",
  "files"];
// All histograms have one scale of thickness, so that rows can be compared.
const widest = {};
all.filter(r => !r.failed && r.l.histogram).forEach(r => {
  const h = r.l.histogram;
  widest[h.unit] = Math.max(widest[h.unit] || 0, h.width * h.counts.length);
});
function histogram(td, h) {
  const sum = h.counts.reduce((a, b) => a + b, 0), most = Math.max(...h.counts);
  const picture = document.createElement("div");
  picture.className = "h"; picture.setAttribute("role", "img");
  const text = "scale 0 to " + number(widest[h.unit]) + " " + h.unit + "; " + h.counts.map((c, i) =>
    number(i * h.width) + " to " + number((i + 1) * h.width) + ": " + (100 * c / sum).toFixed(1) + " %").join(", ");
  picture.setAttribute("aria-label", text); td.title = text;
  h.counts.forEach(c => {
    const bar = document.createElement("i");
    bar.style.width = 100 * h.width / widest[h.unit] + "%"; bar.style.height = 100 * c / most + "%";
    picture.append(bar);
  });
  td.append(picture);
}
const valueOf = (row, k) => {
  if (k === 1) return row.c.id;
  if (row.failed) return null;
  if (k === 2) return row.l.name;
  if (k < 3 + N) return row.l.values[k - 3];
  if (k === 3 + N + H) return row.l.certificate === null ? null : row.l.certificate ? 1 : 0;
  if (k === 4 + N + H) return Object.keys(row.l.outliers).length;
  if (k === 5 + N + H) return row.c.warnings.length;
  return null;
};
const natural = new Intl.Collator(undefined, { numeric: true });
const compare = (a, b) =>
  typeof a === "number" && typeof b === "number" ? a - b : natural.compare(String(a), String(b));
let key = 1, down = false, shown = [], painted = 0;
const CHUNK = 150;
const number = v => v === null ? "" : Number.isInteger(v) ? String(v) : Number(v.toPrecision(5)).toString();
const cell = (tr, text, cls) => {
  const td = tr.insertCell(); td.textContent = text; if (cls) td.className = cls; return td;
};
const link = (td, name, file) => {
  const a = document.createElement("a"); a.textContent = name; a.href = encodeURI(file); td.append(a, " ");
};
// Rows of one case that stand together show its picture, warnings and files once.
function paintRow(row, goesOn) {
  const tr = document.createElement("tr");
  const picture = tr.insertCell();
  const c = row.c;
  if (goesOn) tr.className = "more";
  if (c.thumbnail && !goesOn) {
    const img = document.createElement("img");
    img.loading = "lazy"; img.alt = ""; img.src = c.folder + "/" + encodeURIComponent(c.thumbnail);
    if (c.view) {
      const a = document.createElement("a");
      a.href = c.folder + "/" + encodeURIComponent(c.view); a.title = "in 3-D"; img.alt = "in 3-D";
      a.append(img); picture.append(a);
    } else picture.append(img);
  }
  cell(tr, c.id, "id");
  if (row.failed) {
    tr.className = "failed";
    const td = cell(tr, c.reason, "reason");
    td.colSpan = heads.length - 2;
    return tr;
  }
  const l = row.l;
  cell(tr, l.name === "label-" + l.label ? String(l.label) : l.label === 0 ? l.name : l.name + " (" + l.label + ")",
    "id");
  l.values.forEach((v, k) => {
    const way = l.outliers[k];
    const td = cell(tr, number(v), way ? "n o" : "n");
    if (v !== null) td.title = String(v);
    if (way) td.dataset.way = way > 0 ? " ▲" : " ▼";
  });
  if (H) {
    const td = cell(tr, "");
    if (l.histogram) histogram(td, l.histogram);
  }
  if (l.certificate === null) cell(tr, "");
  else cell(tr, l.certificate ? "passed" : "FAILED", l.certificate ? "pass" : "bad");
  const count = Object.keys(l.outliers).length;
  cell(tr, count ? String(count) : "", "n");
  const warnings = cell(tr, "", "w");
  if (c.warnings.length && !goesOn) {
    const div = document.createElement("div"); // four lines of it; all of it under the pointer
    warnings.title = div.textContent = c.warnings.join(" ");
    warnings.append(div);
  }
  const files = cell(tr, "", "files");
  if (goesOn) return tr;
  if (c.view) link(files, "3-D view", c.folder + "/" + c.view);
  c.files.forEach(f => link(files, f[0], c.folder + "/" + f[1]));
  return tr;
}
function more() {
  const part = document.createDocumentFragment();
  shown.slice(painted, painted + CHUNK).forEach((row, i) =>
    part.append(paintRow(row, painted + i > 0 && shown[painted + i - 1].c === row.c)));
  painted = Math.min(shown.length, painted + CHUNK);
  byId("rows").append(part);
}
function fill() {
  const words = byId("filter").value.toLowerCase().split(/\s+/).filter(w => w);
  const marked = byId("marked").checked;
  shown = all.filter(r => words.every(w => r.text.includes(w)) &&
    (!marked || (!r.failed && Object.keys(r.l.outliers).length)));
  shown.sort((a, b) => {
    if (a.failed !== b.failed) return a.failed ? -1 : 1;
    const x = valueOf(a, key), y = valueOf(b, key);
    if (x === null || y === null) return x === y ? a.order - b.order : x === null ? 1 : -1;
    return (down ? -1 : 1) * compare(x, y) || a.order - b.order;
  });
  byId("rows").textContent = "";
  painted = 0;
  more();
  const failed = data.cases.filter(c => !c.done).length;
  byId("status").textContent =
    shown.length + " of " + all.length + " rows; " + data.cases.length + " cases, " + failed + " failed";
  document.querySelectorAll("#heads th").forEach((th, k) => {
    th.setAttribute("aria-sort", k === key ? (down ? "descending" : "ascending") : "none");
    const b = th.firstChild;
    b.textContent = heads[k] + (k === key ? (down ? " ▼" : " ▲") : "");
  });
}
heads.forEach((name, k) => {
  const th = document.createElement("th"), b = document.createElement("button");
  b.textContent = name;
  if (name && name !== "files" && name !== "histogram")
    b.onclick = () => { down = key === k ? !down : k > 2; key = k; fill(); };
  th.append(b); byId("heads").append(th);
});
byId("filter").oninput = fill;
byId("marked").onchange = fill;
addEventListener("scroll", () => {
  if (painted < shown.length && innerHeight + scrollY > document.body.scrollHeight - 1500) more();
});
document.documentElement.style.setProperty("--top", document.querySelector("header").offsetHeight + "px");
fill();
document.body.dataset.ready = Math.round(performance.now());
</script>
</body>
</html>
)html";

} // namespace voxelcore
