// The site's pages.

import fs from "node:fs";
import path from "node:path";

import { functionsSvg, plotSvg } from "../tool/plot.mjs";
import { escaped } from "../tool/pictures.mjs";
import { htmlOf } from "./handout.mjs";

/** Which experiments a lab's page has, [name, title]: those that its script defines, in its order. */
const experimentsOf = (root, lab) =>
  lab.live
    ? [...fs.readFileSync(path.join(root, `slides/site/web/lab${lab.number}.js`), "utf8")
        .matchAll(/^carlo\.experiment\("([a-z]+)", \{\s*title: "([^"]*)"/gm)].map(([, name, title]) => [name, title.replaceAll("'", "’")])
    : [];

function navigation(labs, here) {
  const link = (page, text, title = "") =>
    `<li><a href="${page}"${title && ` title="${escaped(title)}"`}${page === here ? ' aria-current="page"' : ""}>${text}</a></li>`;
  return `<nav aria-label="Site"><ol>${link("index.html", "Carlo")}${labs
    .map((lab) => link(lab.page, lab.number, `Lab ${lab.number}: ${lab.title}`)).join("")}${link("gallery.html", "Scenes")}${
    link("glossary.html", "Glossary")}${link("students.html", "Students")}${link("instructors.html", "Instructors")}</ol></nav>`;
}

/** A page's sections, [anchor, words, those within]; folded at first on a phone. */
function contents(sections) {
  const list = (entries) => entries.length ? `<ul>${entries.map(([id, words, within = []]) =>
    `<li><a href="#${id}">${words}</a>${list(within)}</li>`).join("")}</ul>` : "";
  return `<details class="contents" open><summary>On this page</summary><nav aria-label="On this page">${list(sections)}</nav></details>
<script>if (innerWidth < 640) document.querySelector(".contents").open = false;</script>`;
}

export function page({ labs, source }, { name, title, lead = "", sections = [], body, scripts = [] }) {
  return `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>${escaped(title)}</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark"><link rel="icon" href="data:,">
<link rel="stylesheet" href="site.css">
</head><body>
<a class="skip" href="#main">Skip to the text</a>
<header>${navigation(labs, name)}
<h1>${escaped(title)}</h1>${lead ? `\n<p class="lead">${lead}</p>` : ""}${sections.length ? `\n${contents(sections)}` : ""}</header>
<main id="main">
${body}
</main>
<footer>Carlo: Monte Carlo rendering labs in C++20. The pages compute with the suite’s own library and solutions,
compiled to WebAssembly. Formulas are set by KaTeX (MIT; its fonts: SIL Open Font License).${
    source.address && ` The repository: <a href="${escaped(source.address)}">${escaped(source.address)}</a>.`}${
    source.commit && ` Made from commit ${escaped(source.commit)}.`}</footer>
${scripts.map((file) => `<script src="${file}"></script>`).join("\n")}
</body></html>
`;
}

const section = (id, title, body) => `<section id="${id}"><h2>${title}</h2>\n${body}\n</section>`;

function figuresOf({ book }, lab) {
  const kinds = ["loglog", "lines", "points", "bars", "functions"];
  const alts = new Map(book.decks.filter((deck) => deck.number === lab.digits).flatMap((deck) =>
    deck.slides.flatMap((slide) => slide.lines.flatMap((line) => {
      const found = /^!\[([^\]]*)\]\(figure:([^)]+)\)/.exec(line);
      return found ? [[found[2], { alt: found[1], title: slide.title }]] : [];
    }))));
  return [...alts].flatMap(([id, { alt, title }]) => {
    const figure = { ...book.definitions.figures.get(id), narrow: true };
    if (!kinds.includes(figure.kind)) return [];
    const svg = figure.kind === "functions" ? functionsSvg(book.runs, figure, alt)
      : plotSvg(book.runs, figure, alt, book.data.get(figure.number).figures[id].series);
    return [`<figure><figcaption>${escaped(title)}<span>${escaped(alt)}</span></figcaption>${svg}</figure>`];
  });
}

function decksOf({ book, decks }, wanted) {
  return book.decks.filter(wanted).map((deck) => {
    const file = `${deck.name}.html`, words = `${escaped(deck.front.title)}, ${deck.slides.length} slides, ${deck.front.minutes} minutes`;
    return `<li>${decks.has(file) ? `<a href="slides/${file}">${words}</a>` : words}</li>`;
  }).join("");
}

/** `text`: the handout. */
export function labPage(context, lab, text) {
  const live = experimentsOf(context.root, lab);
  const formulas = [...context.formulas.values()].filter((one) => one.number === lab.digits);
  const figures = figuresOf(context, lab);
  const parts = [
    ["try", "Try it", live.length && `<p>Predict first, then run. Everything below is computed in your browser, by this lab’s solution. The page’s
address holds the controls and the seed, so a link to it shows the same random numbers; times, and what is limited by time, differ. A ± is half of
a 95 % interval where nothing else is said.</p>
<noscript><p class="note">The experiments need JavaScript.</p></noscript>
${live.map(([name]) => `<article class="live" id="${name}"></article>`).join("\n")}`, live],
    ["handout", "The handout", `<div class="text">${text.html}</div>`, text.headings],
    ["formulas", "The lecture’s formulas", formulas.length && formulas.map((one) =>
      `<div class="formula" tabindex="0" id="${one.number}-${one.name}"><p>${one.number}:${one.name}, <em>${escaped(one.slide)}</em></p>${one.html}</div>`).join("\n")],
    ["plots", "Measured by the lab’s experiments", figures.length && `<p>From runs of <code>./carlo lab ${lab.number} --solutions</code>,
as the lecture shows them.</p><div class="charts plots">${figures.join("\n")}</div>
<p>The lecture’s slides for this lab:</p><ul>${decksOf(context, (deck) => deck.number === lab.digits)}</ul>`],
  ].filter(([, , body]) => body);
  return page(context, {
    name: lab.page,
    title: text.title,
    lead: text.title.replaceAll(",", "").endsWith(lab.title.replaceAll(",", "").slice(1)) ? "" : `${escaped(lab.title)}.`,
    sections: parts.map(([id, title, , within]) => [id, title, within]),
    body: parts.map(([id, title, body]) => section(id, title, body)).join("\n"),
    scripts: lab.live ? ["carlo.js", `lab${lab.number}.js`] : [],
  });
}

export const textPage = (context, name, text, lead) =>
  page(context, { name, title: text.title, lead, sections: text.headings, body: `<div class="text">${text.html}</div>` });

/** The front page: its words are those of README.md. */
export function frontPage(context, readme, tools) {
  const { markdown } = tools, html = (text) => `<div class="text">${htmlOf(text, tools, context.pages)}</div>`;
  const part = (from, to) => readme.slice(readme.indexOf(from), readme.indexOf(to, readme.indexOf(from)));
  const lead = part("Carlo is a suite", "\n\n"), picture = part("The default scene, rendered", "\n\n");
  const commands = [...part("## Start", "## Students").matchAll(/^ {4}(\.\/carlo .*)$/gm)].map(([, line]) => line);
  const first = /^ {4}(\.\/carlo lab 1 .*)$/m.exec(readme)[1];
  const alt = /!\[([^\]]*)\]\(common\/scenes\/cornell_phong.jpg\)/.exec(readme)[1];
  const cards = context.labs.map((lab) => `<li><a href="${lab.page}">${lab.picture
    ? `<img src="lab${lab.digits}-${lab.picture}" alt="${escaped(lab.alt)}">` : ""}<strong>Lab ${lab.number}</strong>
${escaped(lab.title)}</a></li>`).join("\n");
  return page(context, {
    name: "index.html",
    title: "Carlo",
    lead: markdown.renderInline(lead),
    body: `<div class="hero"><figure><img src="cornell_phong.jpg" alt="${escaped(alt)}" width="384" height="384">
<figcaption><span>${markdown.renderInline(picture)}</span></figcaption></figure>
<div><h2>Three commands</h2><p>On a Debian 12 machine, in a clone of ${context.source.address
    ? `<a href="${escaped(context.source.address)}">the repository</a>` : "the repository"}. Each installs whatever is missing. Other machines: <a href="students.html#text-your-machine">the students’ sheet</a>.</p>
<pre class="scroll" tabindex="0">${escaped([...commands, first].join("\n"))}</pre>
<p>Or install nothing: the experiments on the labs’ pages run in your browser. New to all this? Begin with lab 1 and
<a href="lab01.html#curse">the curse of dimensions</a>. To see where the labs lead, try lab 8’s <a href="lab08.html#tracer">path tracer</a>.</p></div></div>
<section><h2>For a course</h2>${html(part("**For a course**", "\n\n").replace("**For a course**: for", "For"))}
${context.decks.size ? `<p>The slides:</p><ul>${decksOf(context, (deck) => context.decks.has(`${deck.name}.html`))}</ul>` : ""}</section>
<section><h2>The labs</h2><p>Each page has the handout, the lecture’s formulas, and experiments that run in your browser on the suite’s own code.</p>
<ul class="cards">${cards}</ul></section>
<section><h2>How fast, how accurate</h2>${html(part("## How fast, how accurate", "    ./carlo bench\n").replace(/^## .*/, ""))}
<p><a href="gallery.html">See each scene</a> with its noise, its error against time and the other renderers’ times.</p></section>`,
  });
}
