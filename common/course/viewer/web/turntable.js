"use strict";
// Draws the clouds of points in the page's "turntable" JSON block so that they can be turned.

(() => {
  const { clouds, wires } = JSON.parse(document.getElementById("turntable-data").textContent);
  const canvas = document.getElementById("turntable");
  const note = document.getElementById("turntable-note");
  const buttons = [...document.querySelectorAll("[data-cloud]")];
  const along = document.getElementById("turntable-along");
  let cloud = clouds[0], turn;

  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                           a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => { const l = Math.hypot(...a); return a.map((x) => x / l); };
  const product = (a, b) => a.map((row) => [0, 1, 2].map((j) =>
    row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]));
  const rotation = (axis, angle) => {
    const c = Math.cos(angle), s = Math.sin(angle);
    return axis === "y" ? [[c, 0, s], [0, 1, 0], [-s, 0, c]] : [[1, 0, 0], [0, c, -s], [0, s, c]];
  };

  // Rows: the screen's right, up and towards the reader.
  const start = () => { turn = product(rotation("x", 0.45), rotation("y", -0.6)); };
  const lookAlong = () => {
    const x = unit(cloud.normal);
    const other = Math.abs(x[1]) < 0.8 ? [0, 1, 0] : [1, 0, 0];
    const z = unit(cross(x, other));
    turn = [x, cross(z, x), z];
  };

  const draw = () => {
    const ratio = window.devicePixelRatio || 1;
    const { width, height } = canvas.getBoundingClientRect();
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const g = canvas.getContext("2d");
    g.scale(ratio, ratio);
    const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    const size = Math.min(width, height) / 1.8;
    const place = (p) => {
      const q = p.map((x) => x - 0.5);
      const [x, y, z] = turn.map((r) => r[0] * q[0] + r[1] * q[1] + r[2] * q[2]);
      return [width / 2 + size * x, height / 2 - size * y, z];
    };
    const trace = (lines, stroke, thickness) => {
      g.strokeStyle = stroke;
      g.lineWidth = thickness;
      g.beginPath();
      for (const line of lines) {
        line.map(place).forEach((p, i) => (i ? g.lineTo(p[0], p[1]) : g.moveTo(p[0], p[1])));
      }
      g.stroke();
    };
    trace(wires, colour("--soft"), 1);
    g.fillStyle = colour("--series-1");
    for (let i = 0; i < cloud.points.length; i += 3) {
      const [x, y, z] = place([cloud.points[i] / 4096, cloud.points[i + 1] / 4096,
                               cloud.points[i + 2] / 4096]);
      g.globalAlpha = 0.6 + 0.4 * z;
      g.fillRect(x - 1, y - 1, 2, 2);
    }
    g.globalAlpha = 1;
    trace(cloud.lines, colour("--series-2"), 2.5);
  };

  const choose = (index) => {
    cloud = clouds[index];
    buttons.forEach((b, i) => b.setAttribute("aria-pressed", i === index));
    note.textContent = cloud.note;
    along.hidden = !cloud.normal.some((x) => x !== 0);
    draw();
  };
  const by = (dx, dy) => {
    turn = product(product(rotation("x", dy), rotation("y", dx)), turn);
    draw();
  };

  buttons.forEach((b, i) => b.addEventListener("click", () => choose(i)));
  along.addEventListener("click", () => { lookAlong(); draw(); });
  document.getElementById("turntable-back").addEventListener("click", () => { start(); draw(); });
  canvas.addEventListener("pointerdown", (e) => canvas.setPointerCapture(e.pointerId));
  canvas.addEventListener("pointermove", (e) => {
    if (canvas.hasPointerCapture(e.pointerId)) by(e.movementX / 150, e.movementY / 150);
  });
  canvas.addEventListener("keydown", (e) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
    if (!step) return;
    e.preventDefault();
    by(step[0] * 0.05, step[1] * 0.05);
  });
  new ResizeObserver(draw).observe(canvas);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  start();
  choose(0);
})();
