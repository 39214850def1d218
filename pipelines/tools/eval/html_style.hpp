// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::eval {

/// The style sheet of the HTML report.
inline constexpr const char* kHtmlStyle = R"(
body { font: 14px/1.4 sans-serif; color: #222; margin: 1.5em; }
h1 { font-size: 1.4em; } h2 { font-size: 1.15em; margin-top: 1.8em; }
table { border-collapse: collapse; }
th, td { padding: .2em .6em; border-bottom: 1px solid #ddd; text-align: right; vertical-align: top; }
th { background: #f3f3f3; position: sticky; top: 0; }
th:nth-child(-n+3), td:nth-child(-n+3) { text-align: left; }
.sortable th { cursor: pointer; }
.sortable th[aria-sort=ascending]::after { content: " \25b4"; }
.sortable th[aria-sort=descending]::after { content: " \25be"; }
.pictures { white-space: nowrap; text-align: left; }
figure { display: inline-block; margin: 0 .3em 0 0; }
figcaption { font-size: 11px; color: #666; }
img { width: 170px; display: block; cursor: zoom-in; background: #eee; }
svg { margin: 0 1em 1em 0; }
dialog { border: 0; padding: 0; } dialog img { width: 92vw; max-height: 92vh; object-fit: contain; }
.failures { color: #a00; }
)";

/// The script of the HTML report: sorting and filtering of the results, and enlarging of pictures.
inline constexpr const char* kHtmlScript = R"(
const results = document.getElementById("results");
const body = results.tBodies[0];
// A picture that several rows share is stored once.
for (const image of document.querySelectorAll("img[data-copy]"))
  image.src = document.getElementById(image.dataset.copy).src;
function key(row, column) {
  const text = row.cells[column].dataset.value ?? row.cells[column].textContent;
  return text === "" ? NaN : isNaN(text) ? text : Number(text);
}
function compare(a, b) {
  if (Number.isNaN(a) || Number.isNaN(b)) return Number.isNaN(a) - Number.isNaN(b);
  return typeof a === "string" || typeof b === "string" ? String(a).localeCompare(String(b)) : a - b;
}
function sort(column) {
  const head = results.tHead.rows[0].cells[column];
  const descending = head.getAttribute("aria-sort") === "ascending";
  for (const cell of results.tHead.rows[0].cells) cell.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", descending ? "descending" : "ascending");
  const rows = [...body.rows];
  rows.sort((a, b) => compare(key(a, column), key(b, column)));
  if (descending) rows.reverse();
  body.append(...rows);
}
[...results.tHead.rows[0].cells].forEach((cell, column) => {
  if (!cell.classList.contains("pictures")) cell.addEventListener("click", () => sort(column));
});
function filter() {
  const wanted = ["pair", "images", "method"].map((name) => document.getElementById(name).value);
  for (const row of body.rows)
    row.hidden = wanted.some((text, column) => column === 0
      ? !row.cells[0].textContent.includes(text)
      : text !== "" && row.cells[column].textContent !== text);
}
for (const name of ["pair", "images", "method"])
  document.getElementById(name).addEventListener("input", filter);
const dialog = document.querySelector("dialog");
body.addEventListener("click", (event) => {
  if (event.target.tagName !== "IMG") return;
  dialog.firstElementChild.src = event.target.src;
  dialog.showModal();
});
dialog.addEventListener("click", () => dialog.close());
)";

}  // namespace mtstereo::eval
