// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/page_style.h"

namespace ehm::tuner_design::report {

const char* const page_style = R"css(
:root {
  --paper: #ffffff; --panel: #f5f6f8; --ink: #1b1f24; --soft: #59636e; --rule: #d5dae0; --grid: #e3e7eb;
  --c1: #0072b2; --c2: #d55e00; --c3: #00875f; --c4: #a2467f; --c5: #9a7400; --c6: #4a525c;
  --positive: #0067a8; --negative: #c65300; --on-strong: #ffffff; --link: #005a8c;
}
@media screen and (prefers-color-scheme: dark) {
  :root {
    --paper: #14171a; --panel: #1d2125; --ink: #e6e9ec; --soft: #a0a9b2; --rule: #3a4148; --grid: #2b3137;
    --c1: #4fa9e2; --c2: #f28a45; --c3: #35c397; --c4: #d98fbe; --c5: #dcb23c; --c6: #b4bcc5;
    --positive: #4ba6e0; --negative: #f08a48; --on-strong: #0c0e10; --link: #7cc0ee;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; scroll-behavior: smooth; }
body {
  margin: 0 auto; padding: 2.5rem 1.5rem 3rem; max-width: 52rem; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "Liberation Sans", Arial, sans-serif;
  overflow-wrap: anywhere;
}
header { border-bottom: 2px solid var(--ink); padding-bottom: 1rem; }
.kicker { margin: 0; color: var(--soft); font-size: 0.8rem; letter-spacing: 0.09em; text-transform: uppercase; }
h1 { margin: 0.25rem 0 0.4rem; font-size: 1.7rem; line-height: 1.2; text-wrap: balance; }
.subtitle { margin: 0; color: var(--soft); }
h2 { margin: 3rem 0 0.6rem; padding-bottom: 0.25rem; border-bottom: 1px solid var(--rule); font-size: 1.25rem; }
p { margin: 0.6rem 0; max-width: 44rem; }
a { color: var(--link); }
nav ol { display: flex; flex-wrap: wrap; gap: 0.15rem 1.2rem; margin: 0.9rem 0 0; padding: 0; list-style: none; }
nav li { font-size: 0.88rem; }
main { counter-reset: figure; }
#summary p:first-of-type { font-size: 1.1rem; line-height: 1.5; }
dl.key { display: grid; grid-template-columns: repeat(auto-fit, minmax(9.5rem, 1fr)); gap: 0.7rem; margin: 1.3rem 0; }
dl.key div { padding: 0.7rem 0.85rem; background: var(--panel); border-left: 3px solid var(--c1); }
dl.key dt { color: var(--soft); font-size: 0.8rem; line-height: 1.3; }
dl.key dd { margin: 0.2rem 0 0; font-size: 1.45rem; font-weight: 600; white-space: nowrap;
  font-variant-numeric: tabular-nums; }
dl.key .unit { font-size: 0.85rem; font-weight: 400; color: var(--soft); }
figure { margin: 1.8rem 0; }
figcaption { margin-bottom: 0.7rem; color: var(--soft); font-size: 0.92rem; max-width: 44rem; }
figcaption strong { display: block; color: var(--ink); font-size: 1rem; }
figcaption strong::before { counter-increment: figure; content: "Figure " counter(figure) ". "; }
a.csv { font-size: 0.78rem; padding: 0 0.4rem; border: 1px solid var(--rule); border-radius: 3px;
  text-decoration: none; white-space: nowrap; }
a.csv:hover, a.csv:focus { border-color: var(--link); }
.below { margin: 0.35rem 0 0; text-align: right; max-width: none; }
.table { margin: 1.6rem 0; }
figure .scroll { margin-top: 1rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 0.88rem; line-height: 1.35; overflow-wrap: normal; }
caption { caption-side: top; position: sticky; left: 0; max-width: calc(100vw - 1.5rem); padding-bottom: 0.5rem;
  text-align: left; color: var(--soft); font-size: 0.92rem; }
th, td { padding: 0.28rem 0.6rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--grid);
  unicode-bidi: isolate; }
thead th { vertical-align: bottom; border-bottom: 1px solid var(--ink); font-weight: 600; }
tbody th { font-weight: 400; min-width: 8.5rem; max-width: 20rem; overflow-wrap: anywhere; }
th:first-child, td:first-child { padding-left: 0; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
thead .number { white-space: normal; }
th .unit { color: var(--soft); font-weight: 400; white-space: nowrap; }
tr.total > * { border-top: 1px solid var(--soft); border-bottom: 0; font-weight: 600; }
tr.total + tr.total > * { border-top: 0; }
ul.legend { display: flex; flex-wrap: wrap; gap: 0.2rem 1.2rem; margin: 0 0 0.4rem; padding: 0; list-style: none;
  font-size: 0.85rem; }
ul.legend svg { display: inline-block; margin-right: 0.45rem; vertical-align: -1px; }
svg { display: block; max-width: 100%; height: auto; overflow: hidden;
  font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "Liberation Sans", Arial, sans-serif; }
svg text { fill: var(--ink); unicode-bidi: isolate; }
.narrow { display: none; }
.narrow svg { width: 100%; max-width: 30rem; }
.panels { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 20rem), 1fr)); gap: 1.1rem 1.4rem; }
.panels svg { width: 100%; }
.label { font-size: 12px; } .axis { font-size: 12px; } .heading { font-size: 12.5px; font-weight: 600; }
svg .tick { font-size: 11px; fill: var(--soft); } .value { font-size: 11px; font-variant-numeric: tabular-nums; }
svg .axis { fill: var(--soft); }
.cell-number { font-size: 10.5px; font-variant-numeric: tabular-nums; }
svg .cell-number.strong { fill: var(--on-strong); }
.grid { stroke: var(--grid); stroke-width: 1; } .grid.minor { stroke-opacity: 0.55; }
.frame { stroke: var(--soft); stroke-width: 1; }
.cell { stroke: var(--rule); stroke-width: 0.6; }
.defect { fill: var(--ink); }
.positive { fill: var(--positive); } .negative { fill: var(--negative); }
.fill1 { fill: var(--c1); } .fill2 { fill: var(--c2); } .fill3 { fill: var(--c3); }
.fill4 { fill: var(--c4); } .fill5 { fill: var(--c5); } .fill6 { fill: var(--c6); }
.stroke1 { stroke: var(--c1); } .stroke2 { stroke: var(--c2); } .stroke3 { stroke: var(--c3); }
.stroke4 { stroke: var(--c4); } .stroke5 { stroke: var(--c5); } .stroke6 { stroke: var(--c6); }
.stroke1, .stroke2, .stroke3, .stroke4, .stroke5, .stroke6 { fill: none; stroke-width: 2.2; }
.thin { stroke-width: 1.1; stroke-opacity: 0.75; } .dashed { stroke-dasharray: 6 4; }
.hollow1, .hollow2, .hollow3, .hollow4, .hollow5, .hollow6 { fill: var(--paper); stroke-width: 1.8; }
.hollow1 { stroke: var(--c1); } .hollow2 { stroke: var(--c2); } .hollow3 { stroke: var(--c3); }
.hollow4 { stroke: var(--c4); } .hollow5 { stroke: var(--c5); } .hollow6 { stroke: var(--c6); }
footer { margin-top: 3rem; padding-top: 0.8rem; border-top: 1px solid var(--rule); color: var(--soft);
  font-size: 0.82rem; }
@media screen and (max-width: 719px) {
  body { padding: 1.3rem 0.75rem 2rem; }
  h1 { font-size: 1.4rem; } h2 { margin-top: 2.2rem; }
  tbody th { min-width: 7rem; }
  .wide { display: none; } .narrow { display: block; }
  dl.key { grid-template-columns: repeat(auto-fit, minmax(8.2rem, 1fr)); }
  dl.key dd { font-size: 1.2rem; }
}
@media print {
  @page { margin: 15mm 14mm; }
  body { max-width: none; padding: 0; font-size: 10pt; line-height: 1.4; }
  h1 { font-size: 17pt; } h2 { margin-top: 1.6rem; break-after: avoid; }
  #summary p:first-of-type { font-size: 10.5pt; }
  nav, a.csv, .below { display: none; }
  .scroll { overflow: visible; }
  caption { position: static; max-width: none; }
  table { font-size: 8.5pt; }
  tr, .wide, .panels > div, dl.key, ul.legend, figcaption, p { break-inside: avoid; }
  figcaption, ul.legend, caption { break-after: avoid; }
  figure { margin: 1.1rem 0; }
  .panels { grid-template-columns: repeat(2, 1fr); gap: 0.6rem 1.2rem; }
  svg, dl.key div { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";

}  // namespace ehm::tuner_design::report
