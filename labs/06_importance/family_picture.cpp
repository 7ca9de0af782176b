#include "pictures.h"

// The page's slider along the family of densities (n + 1) x^n.

namespace lab06 {

std::string family_html() {
  return R"html(<figure class="family">
<figcaption>Move p towards f, and past it<span>f = 5x⁴ is fixed; p is (n + 1)xⁿ. The strokes below
the axis are where 60 evenly spread u land. Watch f/p at the left end.</span></figcaption>
<p><label for="family-n">n of p</label>
<input id="family-n" type="range" min="0" max="16" value="2" step="0.25">
<output id="family-out" for="family-n"></output></p>
<p class="key"><span><b style="background: var(--series-1)"></b>f</span>
<span><b style="background: var(--series-2)"></b>p</span>
<span><b style="background: var(--series-3)"></b>f/p</span></p>
<svg id="family-svg" viewBox="-26 -10 500 320" role="img" aria-labelledby="family-out"></svg>
</figure>
<style>
.family { max-width: 44rem; margin: 1.5rem 0; }
.family p { display: flex; flex-wrap: wrap; gap: 0.4rem 1rem; margin: 0.7rem 0;
            align-items: center; }
.family input { width: min(16rem, 60vw); font: inherit; }
.family output { font-variant-numeric: tabular-nums; }
.family svg { display: block; width: 100%; height: auto; }
.family .key { color: var(--soft); font-size: 0.85rem; }
.family .key b { display: inline-block; width: 1.2em; height: 0.2em; margin: 0 0.4em 0.25em 0; }
</style>
)html";
}

std::string family_script() {
  return R"js((() => {
const slider = document.getElementById('family-n');
const out = document.getElementById('family-out');
const svg = document.getElementById('family-svg');
const W = 440, H = 250, TOP = 6, K = 4;
const px = x => (W * x).toFixed(1);
const py = y => (H * (1 - y / TOP)).toFixed(1);
const curve = (colour, f) => {
  let d = '', down = false;
  for (let i = 0; i <= 220; ++i) {
    const x = (i + 0.5) / 221, y = f(x);
    if (y <= 1.04 * TOP) d += (down ? 'L' : 'M') + px(x) + ' ' + py(y);
    down = y <= 1.04 * TOP;
  }
  return `<path class="line" style="stroke: var(--series-${colour})" d="${d}"/>`;
};
const label = (x, y, words, anchor = 'start') =>
  `<text x="${x}" y="${y}" text-anchor="${anchor}">${words}</text>`;
function draw() {
  const n = Number(slider.value);
  const f = x => (K + 1) * Math.pow(x, K), p = x => (n + 1) * Math.pow(x, n);
  let marks = '';
  for (let i = 0; i < 60; ++i) marks += `M${px(Math.pow((i + 0.5) / 60, 1 / (n + 1)))} ${H}v14`;
  svg.innerHTML = curve(1, f) + curve(2, p) + curve(3, x => f(x) / p(x)) +
    `<path class="axis" d="M0 0V${H}H${W}"/><path class="marks" d="${marks}"/>` +
    label(0, H + 32, '0') + label(W, H + 32, '1', 'end') + label(-8, 12, String(TOP), 'end');
  const finite = n < 2 * K + 1;
  const variance = (K + 1) * (K + 1) / ((n + 1) * (2 * K - n + 1)) - 1;
  out.textContent = `n = ${n.toFixed(2)}: variance of one sample ` +
    (finite ? variance.toFixed(4) : 'infinite') +
    (n > K ? `, tail index ${((n + 1) / (n - K)).toFixed(2)}` : '');
}
slider.addEventListener('input', draw);
draw();
})();)js";
}

}  // namespace lab06
