#include "conformance/report.h"

namespace sheen::conformance {

const char* const report_style = R"css(
:root { --ink: #1c1f24; --soft: #5d6673; --line: #dfe3e8; --paper: #fff; --ground: #f4f5f7; --pass: #1e7f4f; --approximation: #9a6700;
  --fail: #c0262d; --unsupported: #6b7280; --crash: #8b1a9c; --timeout: #8b4a1a; --invalid: #4b4bbd; }
@media (prefers-color-scheme: dark) { :root { --ink: #e7e9ec; --soft: #9aa3af; --line: #333a44; --paper: #1c2026; --ground: #14171b; --pass: #4cc38a;
  --approximation: #e2b93b; --fail: #ff6b6b; --unsupported: #9aa3af; --crash: #d68be0; --timeout: #e0a06b; --invalid: #9a9aff; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
header, main { max-width: 1180px; margin: 0 auto; padding: 20px; }
h1 { font-size: 26px; margin: 0 0 2px; }
header p { margin: 0; color: var(--soft); }
dl.facts { display: grid; grid-template-columns: repeat(auto-fit, minmax(230px, 1fr)); gap: 8px 24px; margin: 16px 0; }
dl.facts div { border-left: 3px solid var(--line); padding-left: 10px; }
dt { color: var(--soft); font-size: 12px; text-transform: uppercase; letter-spacing: .04em; }
dd { margin: 0; overflow-wrap: anywhere; }
.bar { display: flex; height: 10px; border-radius: 5px; overflow: hidden; background: var(--line); }
.bar i { display: block; }
nav { display: flex; flex-wrap: wrap; gap: 8px; padding: 14px 0; position: sticky; top: 0; background: var(--ground); z-index: 1; }
nav button, nav input { font: inherit; color: inherit; border: 1px solid var(--line); background: var(--paper); border-radius: 16px; padding: 3px 14px; }
nav button { cursor: pointer; }
nav button[aria-pressed=true] { border-color: currentColor; font-weight: 600; }
nav input { flex: 1; min-width: 180px; }
article { background: var(--paper); border: 1px solid var(--line); border-left: 5px solid var(--status); border-radius: 6px; margin-bottom: 12px;
  padding: 12px 16px; display: grid; grid-template-columns: auto 1fr; gap: 6px 22px; }
article[hidden] { display: none; }
.pictures { display: flex; flex-wrap: wrap; align-content: start; gap: 8px; max-width: 544px; }
figure { margin: 0; }
figure img, figure .none { width: 128px; height: 128px; background: #000; border-radius: 3px; display: block; image-rendering: pixelated; position: relative; }
figure .none { color: #888; font-size: 12px; display: grid; place-items: center; }
.frame { position: relative; display: inline-block; }
.frame b { position: absolute; width: 13px; height: 13px; margin: -7px 0 0 -7px; border: 1.5px solid #fff; border-radius: 50%; box-shadow: 0 0 0 1px #000; }
figcaption { font-size: 12px; color: var(--soft); text-align: center; }
h2 { font: 600 15px/1.4 ui-monospace, "DejaVu Sans Mono", monospace; margin: 0; overflow-wrap: anywhere; }
.badge { color: var(--status); font: 600 12px system-ui, sans-serif; text-transform: uppercase; letter-spacing: .05em; margin-right: 8px; }
.law { margin: 4px 0; color: var(--soft); }
.message { margin: 4px 0; overflow-wrap: anywhere; white-space: pre-wrap; }
.figures { display: flex; flex-wrap: wrap; gap: 2px 20px; font-size: 13px; color: var(--soft); margin: 4px 0; }
.figures b { color: var(--ink); font-weight: 600; font-variant-numeric: tabular-nums; }
details { font-size: 13px; grid-column: 2; }
summary { cursor: pointer; color: var(--soft); }
table { border-collapse: collapse; margin: 6px 14px 6px 0; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 1px 10px 1px 0; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; }
th { color: var(--soft); font-weight: 500; }
code { font: 12px ui-monospace, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
.plots { width: 100%; flex: none; display: block; }
.plots rect { fill: var(--ground); stroke: var(--line); }
.plots polyline { fill: none; stroke-width: 1.5; }
.plots .bound { stroke: var(--fail); }
.plots .error { stroke: var(--pass); }
.plots text { fill: var(--soft); font-size: 11px; }
article.function { grid-template-columns: 1fr; }
article.function .pictures { max-width: none; flex-wrap: nowrap; }
article.function figure { flex: none; }
article.function figure:has(svg) { flex: 1; min-width: 0; }
article.function figure:has(svg) figcaption { text-align: left; padding-left: 40px; }
article.function details { grid-column: 1; }
.wide { overflow-x: auto; }
table.formulation { background: var(--paper); width: 100%; }
table.formulation td, table.formulation th { padding: 5px 12px 5px 0; vertical-align: middle; }
table.formulation th[colspan] { text-align: center; }
table.formulation td:first-child { padding-left: 12px; }
table.formulation img { width: 84px; height: 84px; margin: 0 auto; }
table.formulation figcaption { font-size: 11px; }
@media (max-width: 760px) { article { grid-template-columns: 1fr; } details { grid-column: 1; } }
)css";

const char* const report_script = R"js(
const cards = [...document.querySelectorAll('[data-name]')], buttons = [...document.querySelectorAll('nav button')], box = document.querySelector('nav input');
let status = 'all';
function show() {
  const words = box.value.toLowerCase().split(/\s+/).filter(Boolean);
  for (const card of cards) {
    card.hidden = !((status === 'all' || card.dataset.status.split(' ').includes(status)) && words.every(word => card.dataset.name.includes(word)));
  }
  for (const button of buttons) button.setAttribute('aria-pressed', button.dataset.status === status);
}
for (const button of buttons) button.addEventListener('click', () => { status = button.dataset.status; show(); });
box.addEventListener('input', show);
show();
)js";

}  // namespace sheen::conformance
