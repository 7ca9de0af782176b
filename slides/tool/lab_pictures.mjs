// One small picture of each lab for README.md: figures of the lab's page, drawn by Chromium.
// "picture" in labs/NN_name/lab.json selects them: {"section": start of the heading, "figures":
// [start of the caption, ...], "alt": description, "width": of the window, "options": [of the lab,
// ...], "press": [buttons of the page, ...], "stacked": true for figures below each other}.

import { spawnSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

import { UserError } from "./problems.mjs";

const most = 40_000; // bytes
const wide = 480; // pixels

/** Lists the wanted labs (all if none are given) that have a picture, as {number, folder, picture}. */
export function labsWithPictures(root, wanted) {
  const labs = path.join(root, "labs");
  return fs
    .readdirSync(labs)
    .filter((name) => fs.existsSync(path.join(labs, name, "lab.json")))
    .sort()
    .map((name) => {
      const folder = path.join(labs, name);
      const { lab, picture } = JSON.parse(fs.readFileSync(path.join(folder, "lab.json"), "utf8"));
      return { number: lab, folder, picture };
    })
    .filter(({ number, picture }) => picture && (!wanted || wanted.includes(number)));
}

const fileOf = (lab) => ["png", "jpg"].map((end) => path.join(lab.folder, `picture.${end}`)).find(fs.existsSync);

/** Adds a problem for each lab whose picture is missing or not shown, with its description, in README.md. */
export function checkPictures(root, problems) {
  const readme = fs.readFileSync(path.join(root, "README.md"), "utf8");
  for (const lab of labsWithPictures(root)) {
    const json = path.relative(root, path.join(lab.folder, "lab.json"));
    const file = fileOf(lab);
    if (!file) {
      problems.add(json, 0, `has no picture: ./carlo slides --pictures ${lab.number}`);
    } else if (!readme.includes(`<img src="${path.relative(root, file)}" alt="${lab.picture.alt}"`)) {
      problems.add("README.md", 0, `does not show ${path.relative(root, file)} with the alt of ${json}`);
    }
  }
}

export const commandOf = ({ number, picture }) => [
  "lab",
  String(number),
  "--solutions",
  ...(picture.options ?? []),
];

/** Writes labs/NN_name/picture.png, or .jpg where a PNG would be too large. Returns the file. */
export function writePicture(root, lab, page) {
  const data = drawn(root, page, lab.picture);
  const [, type, bytes] = /^data:image\/(png|jpeg);base64,(.*)$/.exec(data) ?? [];
  if (!type) throw new UserError(`lab ${lab.number}: ${data || "Chromium drew nothing"}`);
  for (const old of ["png", "jpg"]) fs.rmSync(path.join(lab.folder, `picture.${old}`), { force: true });
  const file = path.join(lab.folder, `picture.${type === "png" ? "png" : "jpg"}`);
  fs.writeFileSync(file, Buffer.from(bytes, "base64"));
  return file;
}

/** Returns the picture as a data URL, or a line that says why there is none. */
function drawn(root, page, picture) {
  const scratch = fs.mkdtempSync(path.join(os.tmpdir(), "carlo-picture-"));
  try {
    const file = path.join(scratch, "page.html");
    const script = `<script>(${draw})(${JSON.stringify({ ...picture, most, wide })})</script>`;
    fs.writeFileSync(file, page.replace("</body>", () => `${script}</body>`));
    const { stdout } = spawnSync(
      path.join(root, "slides/tool/chromium.sh"),
      [
        `--window-size=${picture.width ?? 600},900`,
        "--virtual-time-budget=30000",
        "--dump-dom",
        pathToFileURL(file).href,
      ],
      { encoding: "utf8", maxBuffer: 1 << 26, timeout: 180_000, stdio: ["ignore", "pipe", "ignore"] },
    );
    return /<pre id="picture">([^<]*)/.exec(stdout ?? "")?.[1] ?? "";
  } finally {
    fs.rmSync(scratch, { recursive: true });
  }
}

/** Runs in the page: replaces the document by the picture's data URL once everything is drawn. */
function draw({ section, figures, press = [], stacked = false, most, wide }) {
  const leave = (text) => {
    const result = document.createElement("pre");
    result.id = "picture";
    result.textContent = text;
    document.body.replaceChildren(result);
  };
  const find = (caption) => {
    const places = [...document.querySelectorAll("section")].filter((one) =>
      (one.querySelector("h2")?.textContent ?? "").startsWith(section),
    );
    return places
      .flatMap((place) => [...place.querySelectorAll("figure")])
      .find((figure) => (figure.querySelector("figcaption")?.textContent ?? "").startsWith(caption))
      ?.querySelector("canvas, svg, img");
  };
  const styles = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-linecap", "stroke-dasharray"];
  styles.push("stroke-opacity", "opacity", "font", "text-anchor", "display");
  // Copies the colours into the drawing, since the page's style does not apply inside an image.
  const asImage = async (svg) => {
    const copy = svg.cloneNode(true);
    const [from, to] = [svg, copy].map((one) => [one, ...one.querySelectorAll("*")]);
    from.forEach((one, i) => {
      const style = getComputedStyle(one);
      for (const name of styles)
        to[i].style.setProperty(name, style.getPropertyValue(name));
    });
    const box = svg.getBoundingClientRect();
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.setAttribute("width", box.width);
    copy.setAttribute("height", box.height);
    const image = new Image();
    image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
    await image.decode();
    return image;
  };
  const compose = async () => {
    for (const words of press) {
      const button = [...document.querySelectorAll("button")].find((one) => one.textContent === words);
      if (!button) return leave(`no button "${words}"`);
      button.click();
    }
    await new Promise((done) => setTimeout(done, 3000));
    const missing = figures.find((caption) => !find(caption));
    if (missing) return leave(`no figure "${missing}" in the section "${section}"`);
    const parts = await Promise.all(
      figures.map(find).map((one) => (one.tagName === "svg" ? asImage(one) : one)),
    );
    const size = (one) =>
      one.tagName === "IMG" ? [one.naturalWidth || one.width, one.naturalHeight || one.height] : [one.width, one.height];
    const gap = 8;
    const gaps = gap * (parts.length - 1);
    const shares = parts.map((one) => size(one)[0] / size(one)[1]);
    // Side by side they have the same height, stacked the same width.
    const height = (wide - gaps) / shares.reduce((sum, share) => sum + share, 0);
    const boxes = shares.map((share) => (stacked ? [wide, wide / share] : [height * share, height]));
    const out = document.createElement("canvas");
    out.width = wide;
    out.height = Math.round(stacked ? gaps + boxes.reduce((sum, box) => sum + box[1], 0) : height);
    const context = out.getContext("2d");
    context.fillStyle = "white";
    context.fillRect(0, 0, out.width, out.height);
    context.imageSmoothingQuality = "high";
    let place = 0;
    parts.forEach((part, i) => {
      context.drawImage(part, ...(stacked ? [0, place] : [place, 0]), ...boxes[i]);
      place += boxes[i][stacked ? 1 : 0] + gap;
    });
    let data = out.toDataURL("image/png");
    for (let quality = 0.92; (data.length * 3) / 4 > most && quality > 0.3; quality -= 0.08)
      data = out.toDataURL("image/jpeg", quality);
    leave(data);
  };
  addEventListener("load", () =>
    setTimeout(() => compose().catch((error) => leave(String(error))), 5000),
  );
}
