#pragma once
/// The style of report.html, light or dark as the reader's system says.

#include <string_view>

namespace septet::logging {

inline constexpr std::string_view report_style = R"css(
:root { --paper: #fbfaf7; --ink: #20242b; --soft: #6b7280; --rule: #dcd9d1; --line: #17628f; --band: #e6eef2; --bar: #8fb5ca;
  --strong: #17628f; --mark: #c2571a; --card: #ffffff;
  --v0: #3b3f9e; --v1: #2f76b5; --v2: #1b9a8c; --v3: #62a32c; --v4: #d39b00; --v5: #e0661b; --v6: #b3173f; }
@media (prefers-color-scheme: dark) { :root { --paper: #16191d; --ink: #e4e4e0; --soft: #98a0aa; --rule: #353a41; --line: #6fb9e2;
  --band: #20303a; --bar: #3f6a83; --strong: #6fb9e2; --mark: #f08a4b; --card: #1c2026;
  --v0: #8189ea; --v1: #58a6e6; --v2: #3fc4b0; --v3: #98cc58; --v4: #f0c63c; --v5: #f5914d; --v6: #ff6b85; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 1020px; margin: 0 auto; padding: 36px 28px 60px; }
h1 { font-size: 27px; line-height: 1.2; margin: 0 0 4px; letter-spacing: -0.01em; }
h2 { font-size: 17px; margin: 38px 0 10px; }
h3 { font-size: 15px; margin: 28px 0 8px; }
p { max-width: 74ch; margin: 8px 0; }
.soft { color: var(--soft); }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(140px, 1fr)); gap: 12px; margin: 24px 0 8px; }
.tile { background: var(--card); border: 1px solid var(--rule); border-radius: 8px; padding: 11px 14px; }
.tile b { display: block; font-size: 22px; font-weight: 600; letter-spacing: -0.01em; font-variant-numeric: tabular-nums; }
.tile b small { font-size: 14px; font-weight: 400; color: var(--soft); }
.tile span { color: var(--soft); font-size: 13px; }
figure { margin: 22px 0; background: var(--card); border: 1px solid var(--rule); border-radius: 8px; padding: 14px 14px 8px; }
figcaption { font-size: 13.5px; color: var(--soft); padding: 4px 8px 6px; max-width: 92ch; }
svg { width: 100%; height: auto; display: block; }
svg text { font-size: 12px; fill: var(--soft); font-variant-numeric: tabular-nums; }
svg .title { font-size: 14px; font-weight: 600; fill: var(--ink); }
svg .unit, svg .y-tick { text-anchor: end; }
svg .x-tick, svg .x-label { text-anchor: middle; }
svg .grid { stroke: var(--rule); stroke-width: 1; fill: none; }
svg .axis { stroke: var(--soft); stroke-width: 1; fill: none; }
svg .line { stroke: var(--line); stroke-width: 1.6; fill: none; stroke-linejoin: round; }
svg .s1 { stroke: var(--mark); }
svg .dashed { stroke-dasharray: 7 4; }
svg .band { fill: var(--band); }
svg .bar { fill: var(--bar); }
svg .bar.strong { fill: var(--strong); }
svg .mark { stroke: var(--mark); stroke-width: 1.2; stroke-dasharray: 3 3; fill: none; }
svg .level { fill: var(--mark); }
svg .event { stroke: var(--strong); stroke-width: 1.6; }
svg .touch { stroke: transparent; stroke-width: 9; }
svg .route { stroke-width: 4; fill: none; stroke-linejoin: round; stroke-linecap: round; }
svg .v0 { stroke: var(--v0); } svg .v1 { stroke: var(--v1); } svg .v2 { stroke: var(--v2); } svg .v3 { stroke: var(--v3); }
svg .v4 { stroke: var(--v4); } svg .v5 { stroke: var(--v5); } svg .v6 { stroke: var(--v6); }
svg .moment { fill: var(--card); stroke: var(--ink); stroke-width: 1.2; }
svg .moment.told { fill: var(--mark); }
svg .way-end { fill: var(--ink); }
img { max-width: 100%; height: auto; display: block; }
a { color: var(--line); }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(280px, 1fr)); gap: 12px; }
.pictures figure { margin: 0; }
svg .mark-label { fill: var(--mark); text-anchor: middle; font-weight: 600; }
table { border-collapse: collapse; width: 100%; font-size: 14px; }
th { text-align: left; font-weight: 600; border-bottom: 2px solid var(--rule); padding: 6px 12px 6px 0; }
td { border-bottom: 1px solid var(--rule); padding: 7px 12px 7px 0; vertical-align: top; }
td.value { white-space: nowrap; font-variant-numeric: tabular-nums; font-weight: 600; }
td.name { white-space: nowrap; }
.warning { border-left: 3px solid var(--mark); padding-left: 12px; }
@media print { body { background: white; } figure, .tile { break-inside: avoid; } }
@media (max-width: 700px) { main { padding: 18px 14px 40px; } table { display: block; overflow-x: auto; } figure { padding: 8px 6px; } }
)css";

}  // namespace septet::logging
