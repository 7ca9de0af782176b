#include "pictures.h"
#include "report/page.h"

#include <nlohmann/json.hpp>

#include <string>

// The page's slider for inversion by hand.

namespace lab05 {
namespace {

constexpr std::string_view html = R"(<figure class="inverse">
<figcaption>Inversion by hand<span>u chooses a height; the curve of all samples, which is the CDF,
says which x belongs to it. The shaded area under the density is u.</span></figcaption>
<p><label>Density <select id="inverse-which"></select></label>
<label>u <input id="inverse-u" type="range" min="0" max="200" value="70" step="1"></label>
<output id="inverse-out"></output></p>
<svg id="inverse-svg" viewBox="-26 -10 500 470" role="img" aria-labelledby="inverse-out"></svg>
</figure>
<style>
.inverse { max-width: 44rem; margin: 1.5rem 0; }
.inverse p { display: flex; flex-wrap: wrap; gap: 0.5rem 1.5rem; margin: 0.8rem 0; align-items: center; }
.inverse select, .inverse input { font: inherit; vertical-align: middle; }
.inverse input { width: min(16rem, 60vw); }
.inverse output { min-width: 13rem; font-variant-numeric: tabular-nums; }
.inverse svg { display: block; width: 100%; height: auto; }
.inverse .axis { stroke: var(--soft); stroke-width: 1.5; fill: none; }
.inverse .line { stroke: var(--series-1); stroke-width: 3; fill: none; }
.inverse .area { fill: var(--series-2); fill-opacity: 0.35; }
.inverse .way { stroke: var(--series-2); stroke-width: 2.5; fill: none; stroke-dasharray: 6 5; }
.inverse .end { fill: var(--series-2); }
.inverse text { fill: var(--soft); font-size: 13px; }
</style>
)";

constexpr std::string_view script = R"js(
const which = document.getElementById('inverse-which');
const slider = document.getElementById('inverse-u');
const out = document.getElementById('inverse-out');
const svg = document.getElementById('inverse-svg');
const W = 440, H = 200, GAP = 240, STEPS = 200;
for (const curve of curves) which.add(new Option(curve.name));

const text = (x, y, words, anchor = 'start') =>
  `<text x="${x}" y="${y}" text-anchor="${anchor}">${words}</text>`;

function draw() {
  const curve = curves[which.selectedIndex];
  const step = Number(slider.value), u = Math.min(step, STEPS - 0.5) / STEPS;
  const first = curve.pdf[0][0], last = curve.pdf[curve.pdf.length - 1][0];
  const top = Math.max(...curve.pdf.map(p => p[1]));
  const px = x => (W * (x - first) / (last - first)).toFixed(1);
  const py = y => (H * (1 - y / top)).toFixed(1);
  const cy = v => (GAP + H * (1 - v)).toFixed(1);
  const shown = curve.x.map((x, i) => [x, Math.min(i, STEPS - 0.5) / STEPS])
                       .filter(p => Number.isFinite(p[0]) && p[0] <= last);
  const x = curve.x[Math.min(step, curve.x.length - 1)];
  const end = Number.isFinite(x) ? Math.min(Math.max(x, first), last) : last;
  const below = curve.pdf.filter(p => p[0] <= end);
  const edge = below.length ? below[below.length - 1][1] : 0;
  svg.innerHTML =
    `<path class="area" d="M${px(first)} ${H}` + below.map(p => `L${px(p[0])} ${py(p[1])}`).join('') +
    `L${px(end)} ${py(edge)}L${px(end)} ${H}z"/>` +
    `<path class="line" d="M` + curve.pdf.map(p => `${px(p[0])} ${py(p[1])}`).join('L') + `"/>` +
    `<path class="axis" d="M0 0V${H}H${W}M0 ${GAP}V${GAP + H}H${W}"/>` +
    `<path class="line" d="M` + shown.map(p => `${px(p[0])} ${cy(p[1])}`).join('L') + `"/>` +
    `<path class="way" d="M0 ${cy(u)}H${px(end)}V${H}"/>` +
    `<path class="way" d="M${px(end)} ${cy(u)}V${GAP + H}"/>` +
    `<circle class="end" cx="${px(end)}" cy="${cy(u)}" r="6"/>` +
    text(6, 14, 'density') + text(6, GAP + 14, 'u') + text(W, GAP + H + 18, 'x', 'end') +
    text(0, GAP + H + 18, first.toPrecision(2)) + text(W - 14, GAP + H + 18, last.toPrecision(2), 'end');
  out.textContent = `u = ${u.toFixed(4)}  →  x = ${Number.isFinite(x) ? x.toFixed(4) : x}`;
}
which.addEventListener('change', draw);
slider.addEventListener('input', draw);
draw();
)js";

}  // namespace

std::string inverse_html() {
  return std::string(html);
}

std::string inverse_script(const nlohmann::json& curves) {
  return "(() => {\nconst curves = " + carlo::json_for_html(curves) + ";" + std::string(script) +
         "})();";
}

}  // namespace lab05
