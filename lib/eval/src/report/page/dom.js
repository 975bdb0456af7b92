// Creates elements of the page.

const SVG = "http://www.w3.org/2000/svg";

function fillElement(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name.startsWith("on")) {
      element.addEventListener(name.slice(2), value);
    } else if (value === true) {
      element.setAttribute(name, "");
    } else if (value !== false && value !== null && value !== undefined) {
      element.setAttribute(name, value);
    }
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/** Creates an HTML element; attributes that begin with "on" are listeners. */
function html(tag, attributes, ...children) {
  return fillElement(document.createElement(tag), attributes, children);
}

/** Creates an element of an inline SVG. */
function svg(tag, attributes, ...children) {
  return fillElement(document.createElementNS(SVG, tag), attributes, children);
}

function byId(id) {
  return document.getElementById(id);
}

/** Announces a text to screen readers. */
function announce(text) {
  byId("live").textContent = text;
}

/** Creates a table from rows of cells; the first cell of each row is its header. */
function table(caption, head, rows, attributes) {
  const headCells = head.map((cell, i) => html("th", { scope: "col", class: i ? "number" : null }, cell));
  const bodyRows = rows.map((cells) =>
    html("tr", null, cells.map((cell, i) =>
      i === 0 ? html("th", { scope: "row" }, cell) : html("td", { class: "number" }, cell))));
  return html("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
    html("table", attributes, html("caption", null, caption),
      html("thead", null, html("tr", null, headCells)), html("tbody", null, bodyRows)));
}

/** Binds the button that chooses the light or dark theme; until it is used, the system decides. */
function bindTheme() {
  const themes = ["system", "light", "dark"];
  const button = byId("theme");
  button.addEventListener("click", () => {
    const next = themes[(themes.indexOf(document.documentElement.dataset.theme || "system") + 1) % themes.length];
    document.documentElement.dataset.theme = next;
    button.textContent = `Theme: ${next}`;
  });
}
