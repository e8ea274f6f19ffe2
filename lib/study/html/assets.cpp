#include "study/html/assets.h"

namespace phos::inline study {

const char* const kPageStyle = R"css(
:root { color-scheme: light; font: 15px/1.45 system-ui, sans-serif; color: #222; background: #fff; }
body { margin: 0 auto; padding: 1.2rem; max-width: 1500px; }
h1 { font-size: 1.5rem; margin: 0 0 .3rem; } h2 { font-size: 1.2rem; margin: 2rem 0 .5rem; border-bottom: 1px solid #ccc; }
p { margin: .4rem 0; max-width: 70rem; } .doubt { background: #fff3cd; border-left: 4px solid #d69e00; padding: .4rem .8rem; }
.plots { display: flex; flex-wrap: wrap; gap: 1rem; } .plots img { width: 438px; max-width: 100%; height: auto; border: 1px solid #ddd; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .87rem; }
th, td { padding: .25rem .6rem; text-align: left; border-bottom: 1px solid #e4e4e4; vertical-align: top; white-space: nowrap; }
table.sorts th { cursor: pointer; background: #f3f3f3; position: sticky; top: 0; } th.up::after { content: " \25b2"; } th.down::after { content: " \25bc"; }
tr.front td { background: #eaf4ea; } tr.failed td { color: #a00; }
pre { margin: .3rem 0; padding: .5rem; background: #f6f6f6; overflow-x: auto; font-size: .8rem; white-space: pre; }
.compare { margin: .6rem 0; } .compare select { max-width: 45%; font: inherit; }
.stage { position: relative; display: inline-block; max-width: 100%; margin: .5rem 0; line-height: 0; }
.stage img { max-width: 100%; min-width: 400px; image-rendering: pixelated; } .stage img + img { position: absolute; left: 0; top: 0; }
.compare input[type=range] { display: block; width: 100%; margin: 0; }
.pair { display: flex; flex-wrap: wrap; gap: 1rem; }
.gallery { display: flex; flex-wrap: wrap; gap: 1rem; } .gallery figure { margin: 0; max-width: 455px; } .gallery img { max-width: 100%; display: block; }
figcaption { font-size: .82rem; color: #444; }
)css";

const char* const kPageScript = R"js(
for (const table of document.querySelectorAll("table.sorts")) {
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => head.addEventListener("click", () => {
    const down = head.classList.contains("up");
    heads.forEach(h => h.classList.remove("up", "down"));
    head.classList.add(down ? "down" : "up");
    const key = row => {
      const cell = row.cells[column];
      const number = cell.dataset.v === undefined ? parseFloat(cell.textContent) : parseFloat(cell.dataset.v);
      return Number.isNaN(number) ? cell.textContent : number;
    };
    const rows = [...table.tBodies[0].rows].sort((a, b) => {
      const x = key(a), y = key(b);
      const order = typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y));
      return down ? -order : order;
    });
    rows.forEach(row => table.tBodies[0].appendChild(row));
  }));
}
for (const box of document.querySelectorAll(".compare")) {
  const [left, right] = box.querySelectorAll("select");
  const [below, above] = box.querySelectorAll(".stage img");
  const slider = box.querySelector("input[type=range]");
  const differences = box.querySelectorAll(".pair img");
  const show = () => {
    above.src = document.getElementById(left.value).src;
    below.src = document.getElementById(right.value).src;
    [left, right].forEach((choice, i) => {
      const other = document.getElementById(choice.value + "d");
      differences[i].hidden = !other;
      if (other) differences[i].src = other.src;
    });
    above.style.clipPath = "inset(0 " + (100 - slider.value) + "% 0 0)";
  };
  [left, right, slider].forEach(control => control.addEventListener("input", show));
  show();
}
)js";

}  // namespace phos::inline study
