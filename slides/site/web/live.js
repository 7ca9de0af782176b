"use strict";
// What all live experiments share: calls of the WebAssembly module, controls, plots, and the state in
// the page's address, #NAME?CONTROL=VALUE&seed=N. README.md says how to write an experiment.

const carlo = (() => {
  let module;
  const ready = carloModule().then((loaded) => { module = loaded; });
  const shown = new Map(); // experiments of this page by name

  /** Calls a function of wasm/*.cpp. Tests that define carloLog get every call. */
  function call(name, ...numbers) {
    const at = module._malloc(8 * Math.max(1, numbers.length));
    module.HEAPF64.set(numbers, at / 8);
    const count = module.ccall("site_call", "number", ["string", "number", "number"],
                               [name, at, numbers.length]);
    module._free(at);
    const results = module._site_results() / 8;
    const values = module.HEAPF64.slice(results, results + count);
    window.carloLog?.push({ name, numbers, values: Array.from(values.subarray(0, 3000)) });
    return values;
  }

  const curly = (text) => text.replaceAll("'", "’");
  const number = (x) => (Number.isFinite(x) ? x : "nan");
  const visible = (axis, x) => Number.isFinite(x) && (!axis.log || x > 0);

  /** Draws {x, y: {label, log, unit, range}, series: [{name, x, y, guide}], kind, description}. */
  function plotSvg({ x, y, series, kind = "lines", description, square = false }, width) {
    const axis = (given) => ({ label: "", unit: "number", log: false, range: [], ...given });
    const kept = series.map((one) => {
      const both = one.x.map((at, i) => [at, one.y[i]])
        .filter(([a, b]) => visible(x, a) && visible(y, b));
      return { name: curly(one.name ?? ""), x: both.map(([a]) => a), y: both.map(([, b]) => number(b)),
               guide: one.guide ?? false, ...(one.colour === undefined ? {} : { colour: one.colour }) };
    });
    if (!kept.some((one) => one.x.length)) return "";
    const height = Math.round(width * (square ? 0.9 : 0.62));
    const json = JSON.stringify({ kind, description: description ?? `${y.label} against ${x.label}`,
                                  width, height, square, x: axis(x), y: axis(y), series: kept, rows: [] });
    return module.ccall("site_plot", "string", ["string"], [json]);
  }

  const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

  /** Three digits, powers of ten set as such. */
  function digits(x, count = 3) {
    if (!Number.isFinite(x)) return Number.isNaN(x) ? "–" : x > 0 ? "∞" : "−∞";
    const size = Math.abs(x);
    if (x !== 0 && (size < 1e-3 || size >= 1e6)) {
      const [mantissa, exponent] = x.toExponential(count - 1).split("e");
      const power = String(Number(exponent)).replace("-", "−");
      return `${mantissa.replace("-", "−")}·10${[...power].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("")}`;
    }
    const text = Number.isInteger(x) ? String(x) : String(Number(x.toPrecision(count)));
    const [whole, part] = text.split(".");
    return `${whole.replace(/\B(?=(\d{3})+$)/g, whole.length > 4 ? "\u202f" : "")}${part ? `.${part}` : ""}`
      .replace("-", "−");
  }

  class Stopped extends Error {}

  /** Where an experiment shows its results. */
  class View {
    constructor(box, alive) {
      this.box = box;
      this.alive = alive;
      this.since = performance.now();
      this.plots = new Map();
    }

    /** Lets the browser draw and listen; ends this run if another has begun. */
    async pause() {
      if (performance.now() - this.since > 25) {
        await new Promise((next) => setTimeout(next));
        this.since = performance.now();
      }
      if (!this.alive()) throw new Stopped();
    }

    /** The seconds of one call, of those that change something. */
    clocked(work) {
      const start = performance.now();
      work();
      return (performance.now() - start) / 1000;
    }

    /** The call's result and its seconds: the least of some calls, since the first begin slowly. */
    timed(work) {
      let start = performance.now();
      const log = window.carloLog, result = work(), first = performance.now() - start;
      let least = first;
      window.carloLog = undefined;
      for (let batch = 0; batch < (first < 5 ? 4 : first < 60 ? 1 : 0); ++batch) {
        let calls = 0;
        start = performance.now();
        do work(); while (++calls < 500 && performance.now() - start < 2);
        least = Math.min(least, (performance.now() - start) / calls);
      }
      window.carloLog = log;
      return [result, least / 1000];
    }

    /** A figure of this title; it stays in its place from one run to the next. */
    figure(title, note) {
      let figure = [...this.box.children].find((one) => one.dataset.title === title);
      if (!figure) {
        figure = document.createElement("figure");
        figure.dataset.title = title;
        figure.innerHTML = "<figcaption></figcaption><div></div>";
        this.box.append(figure);
      }
      if (note !== undefined || !figure.firstChild.firstChild)
        figure.firstChild.innerHTML = `${escaped(curly(title))}${note ? `<span>${note}</span>` : ""}`;
      return figure.children[1];
    }

    plot(title, spec, note) {
      const place = this.figure(title, note);
      const width = Math.max(280, Math.min(460, Math.round(place.clientWidth / zoom() / 1.15)));
      place.innerHTML = plotSvg(spec, width);
    }

    table(title, head, rows, note) {
      const cells = (row, tag) => row.map((cell, i) =>
        `<${tag} class="${i ? "number" : ""}">${cell}</${tag}>`).join("");
      const place = this.figure(title, note);
      place.parentNode.classList.toggle("broad", head.length > 4);
      place.innerHTML =
        `<div class="scroll" tabindex="0"><table><thead><tr>${cells(head, "th")}</tr></thead><tbody>` +
        `${rows.map((row) => `<tr>${cells(row, "td")}</tr>`).join("")}</tbody></table></div>`;
    }

    /** A canvas of this shape, as wide as its place; `draw(g, width, height)`, letters 12 high. */
    canvas(title, { shape = 1, note, label }, draw) {
      const place = this.figure(title, note);
      if (place.firstChild?.tagName !== "CANVAS") place.replaceChildren(document.createElement("canvas"));
      const canvas = place.firstChild;
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", label ?? title);
      const scale = zoom() * (window.devicePixelRatio || 1), width = place.clientWidth / zoom(), height = Math.round(width * shape);
      canvas.width = width * scale;
      canvas.height = height * scale;
      const g = canvas.getContext("2d");
      g.scale(scale, scale);
      g.font = "12px system-ui, sans-serif";
      draw(g, width, height);
      return canvas;
    }

    /** An image of linear colours, three numbers a pixel, or one with `grey`. */
    image(title, pixels, width, { note, white = 1, grey = false } = {}) {
      const place = this.figure(title, note);
      if (place.firstChild?.tagName !== "CANVAS") place.replaceChildren(document.createElement("canvas"));
      const canvas = place.firstChild, channels = grey ? 1 : 3;
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", title);
      canvas.className = "pixels";
      canvas.width = width;
      canvas.height = pixels.length / channels / width;
      const bytes = new Uint8ClampedArray(4 * canvas.width * canvas.height);
      for (let i = 0; i < bytes.length; ++i) {
        const x = i % 4 === 3 ? 1 : pixels[channels * (i >> 2) + (grey ? 0 : i % 4)] / white;
        bytes[i] = 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.min(x, 1) ** (1 / 2.4) - 0.055) + 0.5;
        if (i % 4 === 3) bytes[i] = 255;
      }
      canvas.getContext("2d").putImageData(new ImageData(bytes, canvas.width), 0, 0);
      return canvas;
    }

    /** Points of three coordinates, to turn with the pointer or the arrow keys. */
    turntable(title, { points, lines = [], centre = [0.5, 0.5, 0.5], size = 1.8, note, shape = 1, axes }) {
      const draw = () => this.canvas(title, { shape, note, label: `${title}. Arrow keys turn it.` },
        (g, width, height) => {
          const scale = Math.min(width, height) / size;
          const at = (p) => {
            const q = p.map((x, i) => x - centre[i]);
            const [x, y, z] = turn.map((row) => row[0] * q[0] + row[1] * q[1] + row[2] * q[2]);
            return [width / 2 + scale * x, height / 2 - scale * y, z];
          };
          g.strokeStyle = colour("--soft");
          g.beginPath();
          for (const line of lines) line.map(at).forEach(([x, y], i) => (i ? g.lineTo(x, y) : g.moveTo(x, y)));
          g.stroke();
          g.fillStyle = colour("--series-1");
          for (let i = 0; i < points.length; i += 3) {
            const [x, y, z] = at([points[i], points[i + 1], points[i + 2]]);
            g.globalAlpha = Math.min(1, Math.max(0.25, 0.65 + 0.5 * z));
            g.fillRect(x - 1, y - 1, 2, 2);
          }
          g.globalAlpha = 1;
          g.fillStyle = colour("--soft");
          for (const [text, p] of axes ?? []) g.fillText(text, ...at(p).slice(0, 2));
        });
      const product = (a, b) => a.map((row) => [0, 1, 2].map((j) =>
        row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]));
      const about = (axis, angle) => {
        const c = Math.cos(angle), s = Math.sin(angle);
        return axis === "y" ? [[c, 0, s], [0, 1, 0], [-s, 0, c]] : [[1, 0, 0], [0, c, -s], [0, s, c]];
      };
      let turn = product(about("x", 0.45), about("y", -0.6));
      const canvas = draw();
      canvas.tabIndex = 0;
      canvas.className = "turn";
      const by = (dx, dy) => { turn = product(product(about("x", dy), about("y", dx)), turn); draw(); };
      canvas.onpointerdown = (e) => canvas.setPointerCapture(e.pointerId);
      canvas.onpointermove = (e) => {
        if (canvas.hasPointerCapture(e.pointerId)) by(e.movementX / 150, e.movementY / 150);
      };
      canvas.onkeydown = (e) => {
        const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
        if (!step) return;
        e.preventDefault();
        by(step[0] * 0.05, step[1] * 0.05);
      };
      return { along: (rows) => { turn = rows; draw(); } };
    }

    /** One or two sentences of what was measured. */
    say(html) { this.status.innerHTML = curly(html); }

    /**
     * Error against N and against seconds, for growing N. methods: [{name, sizes: [N], error(n, runs),
     * theory: slope, exact(n)}]; runs(n): how many runs' root mean square is taken.
     */
    async ladder({ methods, runs, ylabel = "RMS error", xlabel = "points N" }) {
      const found = methods.map(() => ({ n: [], error: [], seconds: [] }));
      const steps = methods.flatMap((method, m) => method.sizes.map((n) => [n, m]));
      const names = methods.map((method) => method.name);
      for (const [n, m] of steps.sort((a, b) => a[0] - b[0])) {
        const count = methods[m].runs?.(n) ?? runs(n);
        const [error, seconds] = this.timed(() => methods[m].error(n, count));
        found[m].n.push(n), found[m].error.push(error), found[m].seconds.push(seconds / count);
        await this.pause();
        this.drawLadder(found, names, methods, xlabel, ylabel);
      }
      return found.map(({ n, error }) => {
        const good = n.map((x, i) => [x, error[i]]).filter(([, e]) => e > 1e-13);
        // Nothing but rounding is no error of the method; null: too few points.
        if (n.length > 2 && !good.length) return undefined;
        return good.length < 3 ? null : call("slope", ...good.map(([x]) => x), ...good.map(([, e]) => e));
      });
    }

    drawLadder(found, names, methods, xlabel, ylabel) {
      const y = { label: ylabel, log: true };
      const exact = methods.flatMap((method, i) => (method.exact
        ? [{ name: method.exactName ?? "", guide: true, colour: i, x: method.sizes, y: method.sizes.map(method.exact) }] : []));
      this.plot("Error against " + xlabel, { x: { label: xlabel, log: true, unit: "count" }, y,
        series: [...found.map((one, i) => ({ name: names[i], x: one.n, y: one.error })), ...exact] });
      const times = found.map((one, i) => ({ name: names[i], x: one.seconds, y: one.error }));
      this.plot("Error against seconds", { x: { label: "seconds in this browser", log: true, unit: "seconds" }, y,
                                           series: times });
    }

    /** A table of fitted slopes beside those of theory. */
    slopes(methods, fits) {
      this.table("Slopes of log error against log N", ["", "measured ± 95 %", "theory"],
        methods.map((method, i) => [escaped(curly(method.name)),
          fits[i] ? `${digits(fits[i][0])} ± ${digits(fits[i][1], 2)}` : fits[i] === null ? "too few points" : "no error but rounding",
          method.theory === undefined ? "" : digits(method.theory)]));
    }
  }

  /** What the page's letters are over their usual 16 pixels: plots and drawings grow with them. */
  const zoom = () => parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // Controls ------------------------------------------------------------------------------------------

  /** Each control keeps a number: a range's place in `steps` or its value, a menu's index, a typed number. */
  function controlHtml(name, id, control) {
    const at = `${name}-${id}`, label = `<label for="${at}">${curly(control.label)}</label>`, value = `<output for="${at}"></output>`;
    if (control.options) {
      const options = control.options.map((text, i) => `<option value="${i}">${curly(text)}</option>`).join("");
      return `<div>${label}<select id="${at}" data-id="${id}">${options}</select></div>`;
    }
    if (control.typed) {
      return `<div>${label}<input id="${at}" data-id="${id}" type="number" required ` +
        `min="${control.min}" max="${control.max}" step="1"></div>`;
    }
    const [min, max, step] = control.steps ? [0, control.steps.length - 1, 1] : [control.min, control.max, control.step];
    return `<div>${label} ${value}<input id="${at}" data-id="${id}" type="range" min="${min}" max="${max}" step="${step}"></div>`;
  }

  const fromInput = (control, input) => (control.steps ? control.steps[input.value] : Number(input.value));
  const toInput = (control, value) => {
    if (!control.steps) return value;
    const nearest = control.steps.reduce((best, one, i) =>
      (Math.abs(one - value) < Math.abs(control.steps[best] - value) ? i : best), 0);
    return nearest;
  };

  function experiment(name, definition) {
    const article = document.getElementById(name);
    const controls = { ...definition.controls,
      seed: { label: "seed", typed: true, min: 0, max: 2 ** 53, value: 1 } };
    const expects = (definition.choices ?? []).map((text, i) =>
      `<label><input type="radio" name="${name}-expected" value="${i}"> ${curly(text)}</label>`).join("");
    article.innerHTML = `<h3>${curly(definition.title)}</h3><p>${curly(definition.intro)}</p>
<fieldset class="expect"><legend>Before you run it: ${curly(definition.question)}</legend>${expects}
${definition.asked ? '<button type="button" data-asked>Set the controls for this question</button>' : ""}</fieldset>
<form class="controls">${Object.entries(controls).map(([id, one]) => controlHtml(name, id, one)).join("")}
<div class="buttons"><button type="submit">Run</button><button type="button" data-next>Another seed</button><button type="button" data-stop hidden>Stop</button></div></form>
<p class="status" role="status"></p><div class="charts"></div>`;
    const form = article.querySelector("form"), box = article.querySelector(".charts");
    const inputs = [...form.querySelectorAll("[data-id]")];
    const stop = article.querySelector("[data-stop]");
    let run = 0, started = false;
    const ended = () => { article.dataset.state = "done"; stop.hidden = true; };

    const values = () => Object.fromEntries(inputs.map((input) =>
      [input.dataset.id, fromInput(controls[input.dataset.id], input)]));
    const show = () => inputs.forEach((input) => {
      const control = controls[input.dataset.id], value = fromInput(control, input);
      const text = (control.text ?? ((x) => digits(x)))(value) + (control.unit ? ` ${control.unit}` : "");
      if (input.type === "range") input.previousSibling.textContent = text, input.setAttribute("aria-valuetext", text);
    });
    const set = (given) => inputs.forEach((input) => {
      const control = controls[input.dataset.id], value = given[input.dataset.id];
      input.value = toInput(control, value ?? control.value);
    });
    const remember = () => history.replaceState(null, "", `#${name}?${new URLSearchParams(values())}`);

    async function start() {
      if (!form.reportValidity()) return;
      started = true;
      const mine = ++run;
      const view = new View(box, () => run === mine);
      const words = document.createElement("span");
      const expected = article.querySelector("input[type=radio]:checked");
      const status = article.querySelector(".status");
      status.replaceChildren(words);
      view.status = words;
      article.dataset.state = "running";
      stop.hidden = false;
      try {
        await ready;
        await definition.run(values(), view);
        if (run !== mine) return;
        const guess = expected ? `You expected: ${expected.parentNode.textContent.trim()}. ` : "";
        const answer = document.createElement("span");
        answer.className = "answer";
        const chosen = values(), asked = Object.entries(definition.asked ?? {}).every(([id, value]) => chosen[id] === value);
        answer.textContent = curly(`${guess}${asked ? "Answer" : "Answer to the question, which is about other settings"}: ${definition.answer}`);
        status.append(answer);
        ended();
      } catch (error) {
        if (!(error instanceof Stopped)) throw error;
      }
    }

    let waiting;
    form.addEventListener("input", () => {
      show();
      clearTimeout(waiting);
      waiting = setTimeout(() => { remember(); if (started) start(); }, 250);
    });
    form.addEventListener("submit", (event) => { event.preventDefault(); remember(); start(); });
    article.querySelector("[data-next]").addEventListener("click", () => {
      const seed = inputs.find((input) => input.dataset.id === "seed");
      seed.value = Number(seed.value) + 1;
      remember();
      start();
    });
    article.querySelector("[data-asked]")?.addEventListener("click", () => {
      set({ ...values(), ...definition.asked });
      show();
      remember();
      start();
    });
    stop.addEventListener("click", () => { ++run; ended(); });
    const restyle = () => { if (article.dataset.state === "done") start(); };
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", restyle);
    set({});
    show();
    shown.set(name, { article, take: (given) => { set(given); show(); start(); } });
  }

  /** Runs the experiment that the address names. */
  function followAddress() {
    const [name, text] = location.hash.slice(1).split("?");
    const named = text && shown.get(name);
    if (!named) return;
    named.take(Object.fromEntries([...new URLSearchParams(text)].map(([key, value]) => [key, Number(value)])));
    named.article.scrollIntoView({ behavior: "instant" });
  }
  // The page grows while experiments are set up, after the browser has gone to the address's section.
  window.addEventListener("load", () => {
    if (!location.hash.includes("?")) document.getElementById(location.hash.slice(1))?.scrollIntoView({ behavior: "instant" });
  });
  window.addEventListener("DOMContentLoaded", followAddress);
  window.addEventListener("hashchange", followAddress);

  return { call, colour, digits, escaped, experiment, ready };
})();
