#include "board.h"

#include "report/page.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace lab02 {
namespace {

constexpr std::string_view html = R"HTML(
<div class="board-control">
<label for="board-n">Darts thrown <output id="board-text" for="board-n"></output></label>
<input id="board-n" type="range" min="0" step="1">
</div>
<div class="charts">
<figure>
<figcaption>The board<span id="board-note"></span></figcaption>
<div class="board-plot" style="aspect-ratio: 1"><canvas id="board-darts" role="img" aria-label="The unit square with the quarter disc and the darts thrown so far"></canvas></div>
</figure>
<figure>
<figcaption>The estimate on its way<span>the line is 4 hits/N, the band its 95 % interval, the dashes are π</span></figcaption>
<div class="board-plot" style="aspect-ratio: 1"><canvas id="board-way" role="img" aria-label="Estimate of π and its interval against the number of darts"></canvas></div>
</figure>
</div>
<style>
.board-control { max-width: 40rem; margin: 1.5rem 0 0; }
.board-control label { display: block; font-weight: 600; }
.board-control output { color: var(--soft); font-weight: 400; font-variant-numeric: tabular-nums; }
.board-control input { width: 100%; height: 2rem; accent-color: var(--accent); }
.board-plot { position: relative; margin: 0.8rem 0 0.4rem; }
.board-plot canvas { position: absolute; inset: 0; width: 100%; height: 100%; }
</style>
)HTML";

constexpr std::string_view script = R"JS(
(() => {
  const { points, steps } = DATA;
  const slider = document.getElementById("board-n");
  const colour = (name) =>
    getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  // With gaps from five digits on, as the tables have them.
  const grouped = (n) =>
    n < 10000 ? String(n) : String(n).replace(/\B(?=(\d{3})+$)/g, "\u2009");
  const superscript = (n) => String(n).replace(/[0-9]/g, (c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[+c]);

  // A canvas as large as its place on the screen; drawing is in CSS pixels.
  const open = (id) => {
    const canvas = document.getElementById(id);
    const { width, height } = canvas.getBoundingClientRect();
    const scale = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    const g = canvas.getContext("2d");
    g.scale(scale, scale);
    g.font = `12px ${getComputedStyle(document.body).fontFamily}`;
    g.lineWidth = 1;
    return { g, width, height };
  };

  const drawBoard = (n) => {
    const { g, width, height } = open("board-darts");
    const margin = 8, side = Math.min(width, height) - 2 * margin;
    const at = ([x, y]) => [margin + x * side, margin + (1 - y) * side];
    g.fillStyle = colour("--paper");
    g.fillRect(margin, margin, side, side);
    const shown = Math.min(n, points.length);
    const size = Math.max(1.3, Math.min(4, 40 / Math.sqrt(shown)));
    const hit = colour("--series-1"), miss = colour("--series-2");
    for (let i = 0; i < shown; ++i) {
      const [px, py] = at(points[i]);
      g.beginPath();
      if (points[i][0] ** 2 + points[i][1] ** 2 < 1) {
        g.fillStyle = hit;
        g.arc(px, py, size, 0, 2 * Math.PI);
        g.fill();
      } else {
        g.strokeStyle = miss;
        g.lineWidth = Math.max(1, size / 2);
        g.moveTo(px - size, py - size); g.lineTo(px + size, py + size);
        g.moveTo(px - size, py + size); g.lineTo(px + size, py - size);
        g.stroke();
      }
    }
    g.strokeStyle = colour("--ink");
    g.lineWidth = 1.5;
    g.strokeRect(margin, margin, side, side);
    g.beginPath();
    g.arc(margin, margin + side, side, -Math.PI / 2, 0);
    g.stroke();
    const note = shown < n ? `; drawn are the first ${grouped(shown)}` : "";
    document.getElementById("board-note").textContent = `● hits, ✖ misses${note}`;
  };

  const drawWay = (current) => {
    const { g, width, height } = open("board-way");
    const left = 34, right = 8, top = 8, bottom = 34;
    const most = steps[steps.length - 1][0];
    const low = 2.4, high = 3.9;
    const x = (n) => left + Math.log(n) / Math.log(most) * (width - left - right);
    const y = (v) => top + (high - v) / (high - low) * (height - top - bottom);
    g.fillStyle = g.strokeStyle = colour("--soft");
    g.textAlign = "center";
    for (let e = 0; 10 ** e <= most; ++e) {
      g.fillText(e < 3 ? 10 ** e : `10${superscript(e)}`, x(10 ** e), height - bottom + 16);
    }
    g.fillText("darts N", (left + width - right) / 2, height - 3);
    g.textAlign = "right";
    for (let v = 2.4; v < 3.95; v += 0.3) {
      g.fillText(v.toFixed(1), left - 6, y(v) + 4);
      g.strokeStyle = colour("--grid");
      g.beginPath(); g.moveTo(left, y(v)); g.lineTo(width - right, y(v)); g.stroke();
    }
    g.save();
    g.beginPath(); g.rect(left, top, width - left - right, height - top - bottom); g.clip();
    const banded = steps.filter((s) => s[3] !== null);
    g.beginPath();
    banded.forEach((s) => g.lineTo(x(s[0]), y(s[3])));
    [...banded].reverse().forEach((s) => g.lineTo(x(s[0]), y(s[4])));
    g.fillStyle = colour("--series-1") + "33";
    g.fill();
    g.setLineDash([6, 4]);
    g.strokeStyle = colour("--ink");
    g.beginPath(); g.moveTo(left, y(Math.PI)); g.lineTo(width, y(Math.PI)); g.stroke();
    g.setLineDash([]);
    g.strokeStyle = colour("--series-1");
    g.lineWidth = 2;
    g.beginPath();
    steps.forEach((s) => g.lineTo(x(s[0]), y(s[2])));
    g.stroke();
    const [n, , estimate] = steps[current];
    g.lineWidth = 1;
    g.strokeStyle = g.fillStyle = colour("--series-2");
    g.beginPath(); g.moveTo(x(n), top); g.lineTo(x(n), height - bottom); g.stroke();
    g.beginPath(); g.arc(x(n), y(estimate), 4, 0, 2 * Math.PI); g.fill();
    g.restore();
  };

  const show = () => {
    const step = +slider.value;
    const [n, hits, estimate, lower, upper] = steps[step];
    const digits = Math.max(2, Math.ceil(Math.log10(n) / 2) + 1);
    let text = `${grouped(n)}: ${grouped(hits)} ${hits === 1 ? "hit" : "hits"}, ` +
               `π ≈ ${estimate.toFixed(digits)}`;
    if (lower !== null) text += `, 95 %: ${lower.toFixed(digits)} … ${upper.toFixed(digits)}`;
    document.getElementById("board-text").textContent = text;
    slider.setAttribute("aria-valuetext", text);
    drawBoard(n);
    drawWay(step);
  };

  slider.max = steps.length - 1;
  slider.value = steps.findIndex((s) => s[0] >= Math.min(1000, steps[steps.length - 1][0]));
  slider.addEventListener("input", show);
  window.addEventListener("resize", show);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
  show();
})();
)JS";

}  // namespace

std::string board_html() {
  return std::string(html);
}

std::string board_script(const nlohmann::json& data) {
  constexpr std::string_view place = "DATA";
  std::string code(script);
  return code.replace(code.find(place), place.size(), carlo::json_for_html(data));
}

}  // namespace lab02
