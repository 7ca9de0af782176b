"use strict";
// Image viewers: two images under a split slider, or one and a map of its errors, with exposure,
// zoom and the numbers of a pixel. Used by pointer, touch and keyboard.

(() => {
  const { load, roundRange, gradient, paintImage, paintMap, drawSplit, drawPixel, modes, number,
          percent, clamp } = viewerPixels;

  class Viewer {
    constructor(figure, spec, images, index) {
      Object.assign(this, { figure, spec, images, size: spec.width * spec.height });
      this.find = (selector) => figure.querySelector(selector);
      this.reference = spec.reference >= 0 ? images[spec.reference] : null;
      this.canvas = this.find("canvas");
      this.state = this.initial();
      this.maps = new Map();
      this.layers = [0, 1].map(() => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [spec.width, spec.height];
        const context = canvas.getContext("2d");
        return { canvas, context, pixels: context.createImageData(spec.width, spec.height) };
      });
      this.makeControls(index);
      this.listen();
      new ResizeObserver(() => this.draw()).observe(this.canvas);
      this.update();
      figure.dataset.ready = "true";
    }

    initial() {
      const right = this.reference ? this.spec.reference : this.images.length > 1 ? 1 : 0;
      const left = right === 0 && this.images.length > 1 ? 1 : 0;
      return { left, right, mode: "image", split: 0.5, stops: 0, zoom: 1,
               x: this.spec.width / 2, y: this.spec.height / 2, pixel: null };
    }

    // Returns the maps that the left image has.
    modesOf(image) {
      const compared = this.reference && image !== this.reference;
      return Object.keys(modes).filter((mode) =>
        mode === "image" || (mode === "noise" ? image.error : compared) &&
        (mode !== "flip" || image.flip));
    }

    mapOf(image, mode) {
      const key = `${mode} ${image.name}`;
      if (!this.maps.has(key)) {
        const values = modes[mode].of(image, this.reference, this.size);
        this.maps.set(key, { values, range: roundRange(values) });
      }
      return this.maps.get(key);
    }

    // Returns the colours of the current map: where a value is on the scale, and the scale's
    // numbers.
    scale(map) {
      const mode = modes[this.state.mode];
      if (mode.place) return { place: mode.place, ticks: mode.ticks };
      const range = map.range * 2 ** -this.state.stops;
      return {
        place: (v) => 0.5 + 0.5 * v / range,
        ticks: [-1, -0.5, 0, 0.5, 1].map((t) => [(t + 1) / 2, number(t * range)]),
      };
    }

    // Controls --------------------------------------------------------------------------------

    makeControls(index) {
      const { width, height } = this.spec;
      this.find(".viewer-stage").style.aspectRatio = `${width} / ${height}`;
      this.find(".viewer-stage").style.maxWidth = `min(100%, ${80 * width / height}vh)`;
      for (const side of ["left", "right"]) {
        const select = this.find(`.viewer-${side}`);
        this.images.forEach((image, i) => select.append(new Option(image.name, String(i))));
        select.addEventListener("change", () => this.set({ [side]: Number(select.value) }));
        select.parentElement.hidden = this.images.length < 2;
      }
      for (const [key, mode] of Object.entries(modes)) {
        const label = document.createElement("label");
        const radio = Object.assign(document.createElement("input"),
                                    { type: "radio", name: `viewer-mode-${index}`, value: key });
        const words = document.createElement("span");
        words.textContent = mode.title;
        label.append(radio, words);
        radio.addEventListener("change", () => this.set({ mode: key }));
        this.find(".viewer-modes").append(label);
      }
      const slide = (name, change) => {
        const input = this.find(`.viewer-${name}`);
        input.addEventListener("input", () => this.set(change(Number(input.value))));
      };
      slide("split", (value) => ({ split: value / 100 }));
      slide("exposure", (value) => ({ stops: value }));
      this.find("[data-zoom=in]").addEventListener("click", () => this.zoomBy(1.5));
      this.find("[data-zoom=out]").addEventListener("click", () => this.zoomBy(1 / 1.5));
      this.find("[data-zoom=fit]").addEventListener("click", () => this.set({ zoom: 1 }));
      this.find("[data-zoom=reset]").addEventListener("click", () => this.set(this.initial()));
    }

    set(change) {
      Object.assign(this.state, change);
      this.update();
    }

    update() {
      const s = this.state, left = this.images[s.left];
      const possible = this.modesOf(left);
      if (!possible.includes(s.mode)) s.mode = "image";
      s.zoom = clamp(s.zoom, 1, Math.max(1, this.spec.width / 6));
      const half = 0.5 / s.zoom;
      s.x = clamp(s.x, half * this.spec.width, (1 - half) * this.spec.width);
      s.y = clamp(s.y, half * this.spec.height, (1 - half) * this.spec.height);
      this.single = s.mode === "image" && s.left === s.right;
      for (const radio of this.figure.querySelectorAll(".viewer-modes input")) {
        radio.checked = radio.value === s.mode;
        radio.parentElement.hidden = !possible.includes(radio.value);
      }
      this.find("fieldset").hidden = possible.length < 2;
      this.find(".viewer-left").value = s.left;
      this.find(".viewer-right").value = s.right;
      this.showSlider("split", 100 * s.split, `${Math.round(100 * s.split)} %`, this.single);
      const sign = s.stops > 0 ? "+" : s.stops < 0 ? "−" : "";
      this.showSlider("exposure", s.stops, `${sign}${Math.abs(s.stops)} stops`, false);
      this.paint();
      this.draw();
      this.readOut();
    }

    showSlider(name, value, words, hidden) {
      const input = this.find(`.viewer-${name}`);
      input.value = value;
      input.setAttribute("aria-valuetext", words);
      input.parentElement.querySelector("output").textContent = words;
      input.parentElement.hidden = hidden;
    }

    // Drawing -----------------------------------------------------------------------------------

    // Fills the two layers if their content has changed.
    paint() {
      const s = this.state, mode = modes[s.mode], left = this.images[s.left];
      const shown = [s.left, s.right, s.mode, s.stops].join(" ");
      if (this.shown === shown) return;
      this.shown = shown;
      const gain = 2 ** s.stops;
      const legend = this.find(".viewer-legend");
      legend.hidden = !mode.of;
      if (mode.of) {
        const map = this.mapOf(left, s.mode), { place, ticks } = this.scale(map);
        paintMap(map.values, place, mode.colours, this.layers[0].pixels.data);
        legend.querySelector("p").textContent = mode.words;
        legend.querySelector(".viewer-scale").style.background = gradient(mode.colours);
        legend.querySelector(".viewer-ticks").replaceChildren(...ticks.map(([at, words]) => {
          const tick = document.createElement("span");
          tick.style.left = `${100 * at}%`;
          tick.textContent = words;
          return tick;
        }));
      } else {
        paintImage(left, gain, this.layers[0].pixels.data, this.size);
      }
      paintImage(this.images[s.right], gain, this.layers[1].pixels.data, this.size);
      this.layers.forEach((layer) => layer.context.putImageData(layer.pixels, 0, 0));
      const names = [mode.of ? `${left.name}: ${mode.title}` : left.name,
                     this.images[s.right].name];
      ["left", "right"].forEach((side, i) => {
        const chip = this.find(`.viewer-name-${side}`);
        chip.textContent = names[i];
        chip.hidden = i === 1 && this.single;
      });
      this.canvas.setAttribute("aria-label", (this.single ? names[0]
        : `${names[0]} on the left of the split, ${names[1]} on the right`) +
        ". Arrow keys choose a pixel, plus and minus zoom.");
    }

    // Returns where image coordinates (0, 0) are on the canvas, and the size of a pixel; in CSS
    // pixels.
    view() {
      const s = this.state, width = this.canvas.clientWidth, height = this.canvas.clientHeight;
      const scale = s.zoom * width / this.spec.width;
      return { width, height, scale, x: width / 2 - scale * s.x, y: height / 2 - scale * s.y };
    }

    draw() {
      const s = this.state, view = this.view(), ratio = window.devicePixelRatio || 1;
      if (view.width === 0) return;
      this.canvas.width = Math.round(ratio * view.width);
      this.canvas.height = Math.round(ratio * view.height);
      const context = this.canvas.getContext("2d");
      context.scale(ratio, ratio);
      context.imageSmoothingEnabled = view.scale < 1;
      const edge = this.single ? view.width : s.split * view.width;
      [[0, 0, edge], [1, edge, view.width]].forEach(([layer, from, to]) => {
        context.save();
        context.beginPath();
        context.rect(from, 0, to - from, view.height);
        context.clip();
        context.drawImage(this.layers[layer].canvas, view.x, view.y,
                          view.scale * this.spec.width, view.scale * this.spec.height);
        context.restore();
      });
      if (!this.single) drawSplit(context, edge, view.height);
      if (s.pixel) {
        drawPixel(context, view.x + view.scale * (s.pixel[0] + 0.5),
                  view.y + view.scale * (s.pixel[1] + 0.5), Math.max(view.scale, 5));
      }
      const size = 100 * view.scale * ratio;
      this.find(".viewer-zoom").textContent = `${number(+size.toPrecision(3))} %`;
      // A finger scrolls the page unless the image is zoomed.
      this.canvas.style.touchAction = s.zoom > 1 ? "none" : "pan-y";
    }

    // The numbers of a pixel --------------------------------------------------------------------

    rows(i) {
      const s = this.state, at = (values) => [0, 1, 2].map((c) => values[i + c * this.size]);
      const left = this.images[s.left], rows = [];
      for (const image of new Set([left, this.images[s.right], this.reference])) {
        if (image) rows.push([image.name, ...at(image.rgb).map(number)]);
      }
      if (left.error) rows.push(["± 1 std. error", ...at(left.error).map(number)]);
      if (this.reference && left !== this.reference) {
        const a = at(left.rgb), r = at(this.reference.rgb);
        rows.push(["difference", ...a.map((x, c) => number(x - r[c]))]);
      }
      return rows;
    }

    summary(i) {
      const left = this.images[this.state.left];
      return this.modesOf(left).filter((m) => m !== "image" && m !== "difference").map((m) => {
        const value = this.mapOf(left, m).values[i];
        return m === "noise" ? `noise ${percent(value)}` : `${modes[m].title} ${number(value)}`;
      }).join(", ");
    }

    readOut(aloud = false) {
      const pixel = this.state.pixel, words = this.find(".viewer-readout p");
      this.find(".viewer-readout table").hidden = !pixel;
      if (!pixel) {
        words.textContent = "Point at a pixel, or choose one with the arrow keys, for its numbers.";
        return;
      }
      const i = pixel[1] * this.spec.width + pixel[0];
      const summary = this.summary(i), rows = this.rows(i);
      words.textContent = `x ${pixel[0]}, y ${pixel[1]}${summary ? `: ${summary}` : ""}`;
      this.find(".viewer-readout tbody").replaceChildren(...rows.map((cells) => {
        const row = document.createElement("tr");
        row.append(...cells.map((text, c) => {
          const cell = document.createElement(c === 0 ? "th" : "td");
          if (c === 0) cell.scope = "row";
          cell.textContent = text;
          return cell;
        }));
        return row;
      }));
      if (aloud) {
        this.find(".viewer-spoken").textContent =
          `${words.textContent}. ${rows.map((row) => row.join(" ")).join("; ")}`;
      }
    }

    // Moving ------------------------------------------------------------------------------------

    // Zooms so that the place (x, y) of the canvas, by default its middle, stays fixed.
    zoomBy(factor, x, y) {
      const view = this.view(), s = this.state;
      const cx = x ?? view.width / 2, cy = y ?? view.height / 2;
      const zoom = clamp(s.zoom * factor, 1, Math.max(1, this.spec.width / 6));
      const shift = 1 / view.scale - s.zoom / (zoom * view.scale);
      this.set({ zoom, x: s.x + (cx - view.width / 2) * shift,
                 y: s.y + (cy - view.height / 2) * shift });
    }

    pan(dx, dy) {
      const { scale } = this.view();
      this.set({ x: this.state.x - dx / scale, y: this.state.y - dy / scale });
    }

    pixelAt(x, y) {
      const view = this.view();
      const px = Math.floor((x - view.x) / view.scale), py = Math.floor((y - view.y) / view.scale);
      const inside = px >= 0 && py >= 0 && px < this.spec.width && py < this.spec.height;
      return inside ? [px, py] : null;
    }

    step(dx, dy) {
      const s = this.state, { width, height } = this.spec;
      const from = s.pixel ?? [Math.floor(s.x) - dx, Math.floor(s.y) - dy];
      const [px, py] = s.pixel = [clamp(from[0] + dx, 0, width - 1),
                                  clamp(from[1] + dy, 0, height - 1)];
      // Keeps it in sight, with a tenth of the view around it.
      const reach = 0.4 / s.zoom;
      this.set({ x: clamp(s.x, px + 0.5 - reach * width, px + 0.5 + reach * width),
                 y: clamp(s.y, py + 0.5 - reach * height, py + 0.5 + reach * height) });
      this.readOut(true);
    }

    key(event) {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const s = this.state, far = event.shiftKey ? 10 : 1;
      const possible = this.modesOf(this.images[s.left]);
      const next = possible[(possible.indexOf(s.mode) + 1) % possible.length];
      const actions = {
        ArrowLeft: () => this.step(-far, 0), ArrowRight: () => this.step(far, 0),
        ArrowUp: () => this.step(0, -far), ArrowDown: () => this.step(0, far),
        "+": () => this.zoomAtPixel(1.5), "=": () => this.zoomAtPixel(1.5),
        "-": () => this.zoomAtPixel(1 / 1.5), 0: () => this.set({ zoom: 1 }),
        "[": () => this.set({ split: clamp(s.split - 0.05, 0, 1) }),
        "]": () => this.set({ split: clamp(s.split + 0.05, 0, 1) }),
        ",": () => this.set({ stops: clamp(s.stops - 0.5, -10, 10) }),
        ".": () => this.set({ stops: clamp(s.stops + 0.5, -10, 10) }),
        m: () => this.set({ mode: next }), Escape: () => this.set({ pixel: null }),
      };
      if (!(event.key in actions)) return;
      event.preventDefault();
      actions[event.key]();
    }

    zoomAtPixel(factor) {
      const view = this.view(), pixel = this.state.pixel;
      if (!pixel) return this.zoomBy(factor);
      return this.zoomBy(factor, view.x + view.scale * (pixel[0] + 0.5),
                         view.y + view.scale * (pixel[1] + 0.5));
    }

    // One pointer moves the image or the split; two zoom.
    listen() {
      const canvas = this.canvas, down = new Map();
      let onSplit = false;
      const place = (event) => {
        const box = canvas.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
      };
      const spread = () => {
        const [a, b] = [...down.values()];
        return { x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2,
                 d: Math.hypot(a[0] - b[0], a[1] - b[1]) };
      };
      canvas.addEventListener("keydown", (event) => this.key(event));
      canvas.addEventListener("pointerdown", (event) => {
        down.set(event.pointerId, place(event));
        canvas.setPointerCapture(event.pointerId);
        const edge = this.state.split * canvas.clientWidth;
        onSplit = down.size === 1 && !this.single && Math.abs(place(event)[0] - edge) < 14;
        this.state.pixel = this.pixelAt(...place(event));
        this.update();
      });
      canvas.addEventListener("pointermove", (event) => {
        const [x, y] = place(event), before = down.get(event.pointerId);
        if (!before) {
          if (event.pointerType !== "touch") this.hover(x, y);
          return;
        }
        const old = down.size === 2 ? spread() : null;
        down.set(event.pointerId, [x, y]);
        if (old) {
          const now = spread();
          this.zoomBy(now.d / Math.max(old.d, 1), now.x, now.y);
          this.pan(now.x - old.x, now.y - old.y);
        } else if (onSplit) {
          this.set({ split: clamp(x / canvas.clientWidth, 0, 1) });
        } else {
          this.pan(x - before[0], y - before[1]);
        }
      });
      for (const end of ["pointerup", "pointercancel"]) {
        canvas.addEventListener(end, (event) => down.delete(event.pointerId));
      }
      canvas.addEventListener("wheel", (event) => {
        if (document.activeElement !== canvas && !event.ctrlKey) return;
        event.preventDefault();
        this.zoomBy(2 ** (-event.deltaY / 240), ...place(event));
      }, { passive: false });
    }

    hover(x, y) {
      this.state.pixel = this.pixelAt(x, y);
      this.draw();
      this.readOut();
    }
  }

  const start = async (figure, index) => {
    const body = figure.querySelector(".viewer-body");
    try {
      const spec = JSON.parse(figure.querySelector("script").textContent);
      const size = spec.width * spec.height;
      const images = await Promise.all(spec.images.map((image) => load(image, size)));
      body.append(document.getElementById("viewer-template").content.cloneNode(true));
      figure.viewer = new Viewer(figure, spec, images, index);
    } catch (error) {
      body.textContent = `The images cannot be shown: ${error.message}.`;
    }
  };
  document.querySelectorAll(".viewer").forEach(start);
})();
