"use strict";
// In a box with a slider, elements with data-first and data-last are shown while the slider is
// between.
for (const box of document.querySelectorAll(".slider")) {
  const input = box.querySelector("input");
  const show = () => {
    const at = Number(input.value);
    for (const part of box.querySelectorAll("[data-first]")) {
      const shown = part.dataset.first <= at && at <= part.dataset.last;
      part.style.display = shown ? "" : "none";
      if (shown && part.tagName === "OUTPUT") input.setAttribute("aria-valuetext", part.textContent);
    }
  };
  input.addEventListener("input", show);
  show();
}
