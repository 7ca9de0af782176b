// Figures that are pictures: renders, pictures from a lab's page, hand-made drawings.

import fs from "node:fs";
import path from "node:path";

import { UserError } from "./problems.mjs";
import { functionsSvg, plotSvg } from "./plot.mjs";
import { plots } from "./figures.mjs";
import { drawingRules } from "./theme.mjs";

export const escaped = (text) =>
  String(text)
    .replaceAll("&", "&amp;")
    .replaceAll("<", "&lt;")
    .replaceAll(">", "&gt;")
    .replaceAll('"', "&quot;");

/** Returns the figure as one line of HTML. `data`: its entry in slides/data/NN.json. */
export function figureHtml(root, figure, alt, data, runs) {
  const body = bodyOf(root, figure, alt, data, runs).replaceAll("\n", " ");
  return `<figure class="${figure.kind}" aria-label="${escaped(alt)}">${body}</figure>`;
}

function bodyOf(root, figure, alt, data, runs) {
  if (plots.includes(figure.kind)) return plotSvg(runs, figure, alt, data.series);
  if (figure.kind === "functions") return functionsSvg(runs, figure, alt);
  if (figure.kind === "drawing") return drawing(path.join(root, "slides/figures", figure.drawing));
  const tiles = figure.kind === "image" ? renders(figure, runs) : pictures(figure, runs);
  return `<div class="row">${tiles.join("")}</div>`;
}

const tile = (picture, caption) =>
  `<div class="tile">${picture}${caption ? `<div class="caption">${escaped(caption.replaceAll("'", "’"))}</div>` : ""}</div>`;

const drawing = (file) =>
  fs
    .readFileSync(file, "utf8")
    .replace(/<\?xml[^>]*>/, "")
    .replaceAll(/<!--[\s\S]*?-->/g, "")
    .trim();

function renders(figure, runs) {
  return figure.images.map(({ command, caption, crop }) => {
    const png = runs.image(command);
    const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
    const box = crop ?? [0, 0, width, height];
    // The inner frame clips what is beside the crop if the outer one is wider.
    const [x, y, w, h] = box;
    return tile(
      `<svg class="pixels" viewBox="${box.join(" ")}"><svg x="${x}" y="${y}" width="${w}" height="${h}" viewBox="${box.join(" ")}"><image width="${width}" height="${height}" ` +
        `${figure.pixelated ? 'style="image-rendering:pixelated" ' : ""}href="data:image/png;base64,${png.toString("base64")}"/></svg></svg>`,
      caption,
    );
  });
}

/** Returns the figures of a lab's page whose descriptions start with one of figure.alt. */
function pictures(figure, runs) {
  const page = runs.page(figure.command);
  const style = drawingRules(page).join(" ");
  const wanted = [figure.alt].flat();
  const letters = wanted.length > 2 ? 13 : 11.5; // three pictures side by side are small
  return wanted.map((alt, index) => {
    const picture = pictureOf(page, alt);
    if (!picture)
      throw new UserError(
        `${figure.file}: "${figure.id}": the lab's page has no picture whose description starts with "${alt}"`,
      );
    const caption = figure.captions ? figure.captions[index] : picture.caption;
    if (!picture.svg)
      return tile(
        `<img ${figure.pixelated ? 'style="image-rendering:pixelated" ' : ""}src="${picture.source}">`,
        caption,
      );
    const text = picture.svg
      .replace(/<svg /, '<svg xmlns="http://www.w3.org/2000/svg" ')
      .replace(/>/, `><style>${style} svg{font-family:'DejaVu Sans',sans-serif} .plot text{font-size:${letters}px}</style>`);
    const box = /viewBox="([^"]+)"/.exec(picture.svg)[1].split(" ");
    return tile(
      `<svg viewBox="${box.join(" ")}"><image x="${box[0]}" y="${box[1]}" width="${box[2]}" height="${box[3]}" ` +
        `${text.includes("<text") ? `data-letters="${letters}" ` : ""}href="data:image/svg+xml;base64,${Buffer.from(text).toString("base64")}"/></svg>`,
      caption,
    );
  });
}

/** Returns {svg or source, caption} of the first picture of a page whose description starts with `alt`. */
function pictureOf(page, alt) {
  return picturesOf(page).find(({ caption }) => caption.startsWith(alt)) ?? null;
}

export const descriptions = (page) => picturesOf(page).map(({ caption }) => caption);

function picturesOf(page) {
  const entities = { "&#39;": "'", "&quot;": '"', "&lt;": "<", "&gt;": ">", "&amp;": "&" };
  return [...page.matchAll(/<figure>([\s\S]*?)<\/figure>/g)]
    .map(([, inside]) => ({
      svg: /<svg[\s\S]*<\/svg>/.exec(inside)?.[0],
      source: /<img[^>]*src="([^"]*)"/.exec(inside)?.[1],
      caption: (/(?:aria-label|alt)="([^"]*)"/.exec(inside)?.[1] ?? "").replace(
        /&[#a-z0-9]+;/g,
        (entity) => entities[entity] ?? entity,
      ),
    }))
    .filter(({ svg, source, caption }) => caption && (svg || source));
}
