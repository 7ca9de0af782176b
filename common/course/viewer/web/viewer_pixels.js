"use strict";
// The image viewer's (viewer.js) pixel code: how images are stored in the page, how maps of errors
// are computed, and which colours stand for which numbers.

const viewerPixels = (() => {
  // Data ----------------------------------------------------------------------------------------

  // Unpacks base64 of deflated floats, whose upper 24 bits come as three planes of bytes.
  const unpack = async (text, count) => {
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    if (bytes.length !== 3 * count) throw new Error("the image's data are damaged");
    const words = new Uint32Array(count);
    for (let i = 0; i < count; ++i) {
      words[i] = (bytes[i] << 24) | (bytes[i + count] << 16) | (bytes[i + 2 * count] << 8);
    }
    return new Float32Array(words.buffer);
  };

  // An image has three planes of numbers, R, G and B, and so has its standard error.
  const load = async (spec, size) => {
    const image = { name: spec.name };
    image.rgb = await unpack(spec.rgb, 3 * size);
    if (spec.error) image.error = await unpack(spec.error, 3 * size);
    if (spec.flip) image.flip = await unpack(spec.flip, size);
    return image;
  };

  // Maps ----------------------------------------------------------------------------------------

  const map = (size, value) => {
    const result = new Float32Array(size);
    for (let i = 0; i < size; ++i) result[i] = value(i);
    return result;
  };

  const difference = (a, r, size) => map(size, (i) =>
    (a.rgb[i] - r.rgb[i] + a.rgb[i + size] - r.rgb[i + size] +
     a.rgb[i + 2 * size] - r.rgb[i + 2 * size]) / 3);

  // The same as `compare()` in common/image/metrics.h, a pixel at a time.
  const relMse = (a, r, size) => map(size, (i) => {
    let sum = 0;
    for (let k = i; k < 3 * size; k += size) {
      sum += (a.rgb[k] - r.rgb[k]) ** 2 / (r.rgb[k] ** 2 + 0.01);
    }
    return sum / 3;
  });

  // The standard error over the mean, as in common/course/render/pixel_maps.h.
  const noise = (a, size) => map(size, (i) => {
    let variance = 0, mean = 0;
    for (let k = i; k < 3 * size; k += size) {
      variance += a.error[k] ** 2;
      mean += a.rgb[k];
    }
    return variance === 0 ? 0 : Math.sqrt(3 * variance) / mean;
  });

  // Returns a round number, 1, 2 or 5 times a power of ten, that 99 % of the map's absolute values
  // do not exceed.
  const roundRange = (values) => {
    const sizes = values.filter(Number.isFinite).map(Math.abs).sort();
    const size = Math.max(sizes[Math.floor(0.99 * (sizes.length - 1))] || 0, 1e-6);
    const power = 10 ** Math.floor(Math.log10(size));
    return power * [1, 2, 5, 10].find((step) => step * power >= size * 0.9999);
  };

  // Colours -------------------------------------------------------------------------------------

  const encode = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);

  const steps = 1 << 14;
  const encoded = Uint8ClampedArray.from({ length: steps + 1 }, (_, i) => 255 * encode(i / steps));
  const toByte = (x) => (x > 0 ? encoded[x < 1 ? (x * steps) | 0 : steps] : 0);

  // Interpolates 256 colours between anchors of linear RGB.
  const palette = (anchors) => {
    const colours = new Uint8ClampedArray(3 * 256);
    for (let i = 0; i < 256; ++i) {
      const at = i / 255 * (anchors.length - 1);
      const low = Math.min(Math.floor(at), anchors.length - 2);
      for (let c = 0; c < 3; ++c) {
        const x = anchors[low][c] + (at - low) * (anchors[low + 1][c] - anchors[low][c]);
        colours[3 * i + c] = 255 * encode(x);
      }
    }
    return colours;
  };

  // Ordered by brightness, so readable in grey; and blue for too dark, orange for too bright.
  const sequential = palette([[0.005, 0.005, 0.04], [0.03, 0.05, 0.25], [0.25, 0.05, 0.25],
                              [0.8, 0.2, 0.05], [1, 0.85, 0.3]]);
  const diverging = palette([[0.003, 0.09, 0.4], [0.1, 0.38, 0.78], [0.85, 0.85, 0.85],
                             [0.8, 0.28, 0.02], [0.42, 0.06, 0]]);

  const gradient = (colours) => {
    const stops = [];
    for (let i = 0; i <= 32; ++i) {
      const k = 3 * Math.round(i / 32 * 255);
      stops.push(`rgb(${colours[k]} ${colours[k + 1]} ${colours[k + 2]})`);
    }
    return `linear-gradient(to right, ${stops.join(", ")})`;
  };

  // Painting ------------------------------------------------------------------------------------

  const paintImage = (image, gain, out, size) => {
    for (let i = 0; i < size; ++i) {
      out[4 * i] = toByte(gain * image.rgb[i]);
      out[4 * i + 1] = toByte(gain * image.rgb[i + size]);
      out[4 * i + 2] = toByte(gain * image.rgb[i + 2 * size]);
      out[4 * i + 3] = 255;
    }
  };

  // `place` maps a value to [0, 1]; pixels without a value are grey.
  const paintMap = (values, place, colours, out) => {
    for (let i = 0; i < values.length; ++i) {
      const t = place(values[i]);
      const k = 3 * Math.round(255 * Math.min(Math.max(t, 0), 1));
      for (let c = 0; c < 3; ++c) out[4 * i + c] = Number.isNaN(t) ? 124 : colours[k + c];
      out[4 * i + 3] = 255;
    }
  };

  // Draws the line between left and right, and a frame around one pixel.
  const drawSplit = (context, edge, height) => {
    context.fillStyle = "#000";
    context.fillRect(edge - 2, 0, 4, height);
    context.fillStyle = "#fff";
    context.fillRect(edge - 1, 0, 2, height);
    context.beginPath();
    context.arc(edge, height / 2, 9, 0, 7);
    context.fill();
    context.strokeStyle = "#000";
    context.stroke();
  };

  const drawPixel = (context, x, y, side) => {
    context.lineWidth = 1;
    for (const [colour, margin] of [["#000", 1.5], ["#fff", 0.5]]) {
      const size = side + 2 * margin;
      context.strokeStyle = colour;
      context.strokeRect(x - size / 2, y - size / 2, size, size);
    }
  };

  // Numbers for people ---------------------------------------------------------------------------

  const number = (value) => {
    if (Number.isNaN(value)) return "none";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    const size = Math.abs(value);
    const text = value === 0 || (size >= 1e-3 && size < 1e5) ? String(+value.toPrecision(4))
      : value.toExponential(2);
    return text.replace(/-/g, "−");
  };
  const percent = (value) => `${number(100 * value)} %`;
  const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

  // Modes ---------------------------------------------------------------------------------------

  // The modes of the left side. `of` returns a map's numbers, `place` maps them to [0, 1].
  const logarithmic = (low, high) => (v) =>
    v <= low ? 0 : Math.log(v / low) / Math.log(high / low);
  const modes = {
    image: { title: "Image" },
    difference: {
      title: "Difference", of: (image, reference, size) => difference(image, reference, size),
      colours: diverging, words: "Difference, left minus reference, mean of R, G, B",
    },
    relmse: {
      title: "relMSE", of: (image, reference, size) => relMse(image, reference, size),
      colours: sequential, place: logarithmic(1e-6, 1),
      words: "relMSE: (left − reference)² / (reference² + 0.01), mean of R, G, B",
      ticks: [[0, "10⁻⁶"], [1 / 3, "10⁻⁴"], [2 / 3, "0.01"], [1, "1"]],
    },
    flip: {
      title: "FLIP", of: (image) => image.flip, colours: sequential, place: (v) => v,
      words: "LDR-FLIP at exposure 0: 0 looks the same, 1 as different as can be",
      ticks: [0, 0.25, 0.5, 0.75, 1].map((t) => [t, String(t)]),
    },
    noise: {
      title: "Noise", of: (image, reference, size) => noise(image, size),
      colours: sequential, place: logarithmic(1e-3, 1),
      words: "Standard error over mean", ticks: [[0, "0.1 %"], [1 / 3, "1 %"], [2 / 3, "10 %"],
                                                 [1, "100 %"]],
    },
  };

  return { load, roundRange, gradient, paintImage, paintMap, drawSplit, drawPixel, modes, number,
           percent, clamp };
})();
