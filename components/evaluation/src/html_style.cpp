// SPDX-License-Identifier: Apache-2.0
#include "html_sections.hpp"

namespace panvo::evaluation {

// Colours of Okabe and Ito, distinguishable with any colour vision; lighter in dark mode.
std::string page_style() {
  return R"(:root {
  color-scheme: light dark;
  --page: #fbfaf7; --card: #ffffff; --ink: #1d2125; --soft: #646b73; --line: #dedbd4; --truth: #959188;
  --binocular: #d55e00; --enhanced: #0072b2; --compass: #009e73; --landmark: #e69f00; --good: #00805d; --bad: #c0262d;
  --correction: #009e73; --sigma: #0072b21f;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #14171a; --card: #1b1f23; --ink: #e9e7e2; --soft: #9aa2aa; --line: #32383e; --truth: #6b737b;
    --binocular: #ff9148; --enhanced: #58b6f2; --compass: #35c99b; --landmark: #f2b933; --good: #48d3a4; --bad: #ff7a7a;
    --correction: #35c99b; --sigma: #58b6f22b;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto,
  "Helvetica Neue", "Noto Sans", "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; }
main { max-width: 1120px; margin: 0 auto; padding: 3rem 1.25rem 5rem; }
header p.kicker { margin: 0; color: var(--soft); letter-spacing: .06em; text-transform: uppercase; font-size: .8rem; }
h1 { font-size: clamp(1.7rem, 4vw, 2.6rem); line-height: 1.15; margin: .3rem 0 .8rem; letter-spacing: -.02em; font-weight: 650;
  max-width: 26ch; }
h1 b.e { color: var(--enhanced); font-weight: inherit; } h1 b.b { color: var(--binocular); font-weight: inherit; }
h2 { font-size: 1.35rem; letter-spacing: -.01em; margin: 0 0 .3rem; }
section { margin-top: 3.5rem; }
p.lead { color: var(--soft); margin: 0 0 1.1rem; max-width: 78ch; }
.tiles { display: grid; grid-template-columns: repeat(4, 1fr); gap: .8rem; margin-top: 1.8rem; }
.tile { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: .9rem 1rem; }
.tile b { display: block; font-size: 1.6rem; line-height: 1.2; font-weight: 620; letter-spacing: -.01em; }
.tile small { color: var(--soft); font-size: .82rem; line-height: 1.35; display: block; }
figure, .card { background: var(--card); border: 1px solid var(--line); border-radius: 12px; margin: 0 0 1.1rem; padding: 1rem; }
svg { display: block; width: 100%; height: auto; }
svg text { font-family: inherit; fill: var(--ink); }
svg .tick { fill: var(--soft); font-size: 12px; } svg .small { fill: var(--soft); font-size: 11px; }
svg .grid { stroke: var(--line); stroke-width: 1; fill: none; }
.curve { fill: none; stroke-width: 2; stroke-linejoin: round; stroke-linecap: round; }
.truth { stroke: var(--truth); } .curve.truth { stroke-width: 6; }
.binocular { stroke: var(--binocular); } .enhanced { stroke: var(--enhanced); } .compass { stroke: var(--compass); }
.paper { stroke: var(--soft); stroke-dasharray: 5 4; }
.curve.sigma { stroke: var(--enhanced); stroke-dasharray: 3 4; stroke-width: 1.2; opacity: .7; }
.landmark { fill: var(--landmark); stroke: var(--card); stroke-width: 1; }
.place { fill: none; stroke: var(--soft); stroke-width: 1; }
.jump { stroke: var(--correction); stroke-width: 2; fill: none; } .jump.wrong { stroke: var(--bad); }
.corrected { fill: var(--correction); stroke: var(--card); stroke-width: 1.2; } .corrected.wrong { fill: var(--bad); }
.before { fill: var(--card); stroke: var(--correction); stroke-width: 1.6; }
.missed { fill: var(--card); stroke: var(--bad); stroke-width: 1.6; }
.mark { stroke: var(--ink); fill: none; stroke-width: 2; } .end { fill: var(--ink); stroke: none; }
.episode { fill: var(--line); opacity: .55; }
.match { stroke: #ffe14d; stroke-width: 1.1; opacity: .6; fill: none; } .match:hover { opacity: 1; stroke-width: 2.4; }
.tip { fill: #ffe14d; stroke: #222; stroke-width: .6; }
.legend { display: flex; flex-wrap: wrap; gap: .3rem 1.3rem; margin: 0 0 .7rem; font-size: .88rem; color: var(--soft); }
.legend i { display: inline-block; width: 1.5em; height: 4px; border-radius: 2px; margin-right: .5em; vertical-align: .22em; }
.legend i.dot { width: 10px; height: 10px; border-radius: 50%; vertical-align: -.05em; }
i.truth { background: var(--truth); } i.binocular { background: var(--binocular); } i.enhanced { background: var(--enhanced); }
i.compass { background: var(--compass); } i.landmark { background: var(--landmark); } i.jump { background: var(--correction); }
i.paper { background: repeating-linear-gradient(90deg, var(--soft) 0 5px, transparent 5px 8px); }
i.sigma { background: repeating-linear-gradient(90deg, var(--enhanced) 0 4px, transparent 4px 7px); }
i.missed { border: 2px solid var(--bad); } i.episode { background: var(--line); height: 10px; vertical-align: -.05em; }
.wide { overflow-x: auto; margin: 0 0 1.4rem; }
table { border-collapse: collapse; width: 100%; font-size: .88rem; }
caption { text-align: left; font-weight: 600; padding: 0 0 .5rem; }
th { color: var(--soft); font-weight: 500; font-size: .8rem; vertical-align: bottom; line-height: 1.25; }
th, td { text-align: right; padding: .38rem .55rem; border-bottom: 1px solid var(--line); white-space: nowrap; }
th.l, td.l { text-align: left; } td.l:last-child, td.why { white-space: normal; min-width: 14rem; text-align: left; }
td:first-child, th:first-child { padding-left: 0; }
.chip { display: inline-block; border-radius: 99px; padding: .05rem .6rem; font-size: .78rem; border: 1px solid currentColor;
  white-space: nowrap; }
.good { color: var(--good); } .bad { color: var(--bad); } .soft { color: var(--soft); }
.card h3 { margin: 0 0 .15rem; font-size: 1.08rem; display: flex; gap: .7rem; align-items: center; flex-wrap: wrap; }
.card p { margin: 0 0 .6rem; color: var(--soft); font-size: .92rem; } .card p b { color: var(--ink); font-weight: 600; }
.card svg { border-radius: 6px; margin-bottom: .6rem; } .card p:last-child { margin-bottom: 0; font-size: .85rem; }
.bar { height: 9px; border-radius: 2px; margin: 2px 0; min-width: 1px; } .bar.ours { background: var(--enhanced); }
.bar.theirs { background: var(--truth); } .bars { display: grid; grid-template-columns: minmax(9rem, 15rem) 1fr 9rem; gap: .55rem 1rem;
  align-items: center; font-size: .88rem; } .bars .n { text-align: right; } .bars h3 { grid-column: 1 / -1; margin: .7rem 0 0;
  font-size: .95rem; } .bars small { color: var(--soft); display: block; line-height: 1.2; }
.state-tracking { fill: var(--good); } .state-compass_only { fill: var(--landmark); } .state-lost, .state-stale { fill: var(--bad); }
.state-relocalised { fill: var(--enhanced); } .state-starting, .state-unlocated, .state-other { fill: var(--truth); }
i.state-tracking { background: var(--good); } i.state-compass_only { background: var(--landmark); } i.state-lost, i.state-stale { background: var(--bad); }
i.state-relocalised { background: var(--enhanced); }
i.state-starting, i.state-unlocated, i.state-other { background: var(--truth); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.3rem; margin: 0; font-size: .92rem; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
code { font: .9em ui-monospace, "DejaVu Sans Mono", monospace; }
@page { size: A4; margin: 12mm; }
@media print {
  :root { --page: #fff; --card: #fff; --ink: #000; --soft: #444; --line: #bbb; --truth: #bbb; --binocular: #d55e00;
    --enhanced: #0072b2; --compass: #009e73; --landmark: #e69f00; --good: #00664a; --bad: #b00; --correction: #009e73; }
  body { font-size: 9.5pt; -webkit-print-color-adjust: exact; print-color-adjust: exact; } main { padding: 0; max-width: none; }
  section { margin-top: 1.6rem; } h2, section > p.lead { break-after: avoid; } .plan svg { max-height: 17cm; }
  .tiles { grid-template-columns: repeat(4, 1fr); } figure, .card, .tile, tr { break-inside: avoid; }
  .wide { overflow: visible; } table { font-size: 7.5pt; } th { font-size: 7pt; } th, td { padding: .2rem .3rem; }
}
@media (max-width: 860px) { .tiles { grid-template-columns: 1fr 1fr; } }
@media (max-width: 640px) {
  figure { overflow-x: auto; } figure svg { min-width: 760px; } figure svg .tick, figure svg .small { font-size: 16px; }
  /* The plan is seen as a whole: the rest of it does not shrink with it. */
  .plan svg { min-width: 0; } figure.plan svg .tick, figure.plan svg .small { font-size: 38px; } .plan circle { r: 12px; }
  .plan :is(.curve, .jump, .mark, circle) { vector-effect: non-scaling-stroke; } .plan .curve.truth { stroke-width: 5; }
}
@media (max-width: 640px) { .bars { grid-template-columns: 1fr 1fr; } .bars .b { grid-column: 1 / -1; grid-row: auto; } }
)";
}

}  // namespace panvo::evaluation
